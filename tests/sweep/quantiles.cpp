// Quantiles against those of mpmath 1.2.1 with 40 digits (incomplete beta by 2F1, all else by its closed form), which
// scipy.stats 1.10.1 confirms to single precision and better, into the far tails.
#include "catch.hpp"
#include "numbers.hpp"
#include "sweep/study/distribution.hpp"

namespace wormdrive::test::sweep_quantiles {

namespace {

constexpr double far_up = 1.0 - 0x1p-40;  ///< exact, and its distance to 1 as well

struct Expected {
  Distribution distribution;
  double far_down, thousandth, median, far_up;  ///< at 1e-12, 1e-3, 1/2, 1 - 2^-40
};

}  // namespace

TEST_CASE("quantiles equal those of mpmath from tail to tail", "[sweep]") {
  const Expected list[] = {
      {LogUniform{1e-4, 1e2}, 0.00010000000000138156, 0.00010139113857366795, 0.1, 100.0 - 1.2565133654677518e-9},
      {Pert{1.0, 2.0, 6.0}, 1.0000003134257441, 1.0315698708392351, 2.3833612969625942, 5.9951032260159491},
      {Gumbel{2.0, 0.5}, 0.34053045248202194, 1.0336776330419673, 2.1832564602908322, 15.862943611198679},
      {Weibull{1.5, 3.0}, 3.000000000001e-8, 0.030010005837410523, 2.349659306323954, 27.481781961792719},
      {Weibull{1.5, 3.0, -1.0}, 3.000000000001e-8 - 1.0, 0.030010005837410523 - 1.0, 1.349659306323954,
       26.481781961792719},
      {Beta{2.0, 5.0, -1.0, 3.0}, -0.99999896720408546, -0.96697802884901329, 0.057799933182639849,
       3.0 - 4.0 * 0.002731037660345522}};
  for (const Expected& e : list) {
    INFO(std::visit([](const auto& d) { return d.kind; }, e.distribution));
    CHECK(close(quantile(e.distribution, 1e-12), e.far_down, 1e-13));
    CHECK(close(quantile(e.distribution, 1e-3), e.thousandth, 1e-13));
    CHECK(close(quantile(e.distribution, 0.5), e.median, 1e-13));
    CHECK(close(quantile(e.distribution, far_up), e.far_up, 1e-13));
  }
}

TEST_CASE("beta quantiles keep their digits at either end, whatever the shapes", "[sweep]") {
  struct Shape {
    double alpha, beta, far_down, thousandth, median, below_high;
  };
  const Shape list[] = {
      {2, 5, 2.581989786361007e-7, 0.0082554927877466776, 0.26444998329565996, 0.002731037660345522},
      {0.5, 0.5, 2.4674011002723396e-24, 2.4673990709169442e-6, 0.5, 2.0409863535372884e-24},
      {0.1, 3, 2.3669013519449408e-121, 2.3669013519449145e-31, 0.00023123990750011795, 0.00028691402303687994},
      {200, 30, 0.6690881729588228, 0.79240777541338398, 0.87063692117844891, 0.026478611021230816}};
  for (const Shape& s : list) {
    INFO("shapes " << s.alpha << " and " << s.beta);
    const Beta from_zero{s.alpha, s.beta, 0.0, 1.0}, to_zero{s.alpha, s.beta, -1.0, 0.0};
    CHECK(close(from_zero.quantile(1e-12), s.far_down, 1e-13));
    CHECK(close(from_zero.quantile(1e-3), s.thousandth, 1e-13));
    CHECK(close(from_zero.quantile(0.5), s.median, 1e-13));
    CHECK(close(-to_zero.quantile(far_up), s.below_high, 1e-13));
  }
  for (const double alpha : {1e-3, 0.3, 1.0, 40.0, 1e5})
    for (const double beta : {1e-3, 0.3, 1.0, 40.0, 1e5}) {
      INFO("shapes " << alpha << " and " << beta);
      const Beta d{alpha, beta, -3.0, 2.0};
      double before = -3.0;
      for (const double u : {1e-300, 1e-12, 0.01, 0.3, 0.5, 0.7, 0.99, 1.0 - 1e-12, 1.0 - 0x1p-53}) {
        const double x = d.quantile(u);
        CHECK((x >= before && x <= 2.0));
        before = x;
      }
    }
}

TEST_CASE("an empirical distribution has the values of the file, each as likely as the others", "[sweep]") {
  const Empirical measured{{1.0, 2.0, 2.0, 7.0}};
  CHECK(measured.quantile(1e-12) == 1.0);
  CHECK(measured.quantile(0.25 - 1e-12) == 1.0);
  CHECK(measured.quantile(0.25) == 2.0);
  CHECK(measured.quantile(0.75 - 1e-12) == 2.0);
  CHECK(measured.quantile(1.0 - 0x1p-53) == 7.0);
}

}  // namespace wormdrive::test::sweep_quantiles
