#include <cmath>
#include <limits>
#include <numbers>

#include "catch.hpp"
#include "control/lemma1_conditions.hpp"
#include "support.hpp"

// The numbers of Lemma 1 [YehWu2009, eq. 20-21] against formulas written out by hand, from Table 1 alone.

namespace wormdrive::test::control_lemma1 {

namespace {

constexpr double Jw_i = 2.53e-5 * 60, tau = 0.0196;

/// C1 and C2 of Table 1 at mu = 0.25, written out.
double C_by_hand(double mu) {
  const double phi = 20 * std::numbers::pi / 180, lambda = 4 * std::numbers::pi / 180;
  return 0.011 / 0.045 * (std::cos(phi) * std::sin(lambda) - mu * std::cos(lambda)) /
         (std::cos(phi) * std::cos(lambda) + mu * std::sin(lambda));
}
const double C1 = C_by_hand(0.25), C2 = C_by_hand(-0.25);

NominalModel nominal(double Jg) { return {C1, C2, Jw_i, Jg, tau, 0.0, 0.0}; }
constexpr Variations printed{.C1 = 0.13, .C2 = 0.08, .load = 0.1, .inertia = 0.0, .friction = {}};
constexpr double bare = 7.39e-4, loaded = 0.0146;

SlidingParameters sliding() {
  SlidingParameters p;
  p.lambda_c = 30 * std::numbers::pi;
  p.Phi = 0.3;
  p.eta = 30.0;
  return p;
}

const Condition& named(const std::vector<Condition>& list, const std::string& rule) {
  for (const Condition& c : list)
    if (c.rule == rule) return c;
  throw std::logic_error("no condition " + rule);
}

}  // namespace

TEST_CASE("Lemma 1's numbers for the bare gear are those of a calculation by hand") {
  const Lemma1 lemma = lemma1(nominal(bare), printed);
  const double I1 = Jw_i + C1 * bare, I2 = Jw_i + C2 * bare;
  REQUIRE(close(lemma.branch[0].b_hat, 1.0 / I1, 1e-14));
  REQUIRE(close(lemma.branch[1].b_hat, 1.0 / I2, 1e-14));
  REQUIRE(close(lemma.branch[0].d_hat, 1.0 / bare, 1e-14));
  // C1 < 0: thirteen percent more of it leave less inertia, which is the larger of both ratios
  REQUIRE(close(lemma.branch[0].beta, I1 / (Jw_i + 1.13 * C1 * bare), 1e-13));
  REQUIRE(close(lemma.branch[1].beta, I2 / (Jw_i + 0.92 * C2 * bare), 1e-13));
  REQUIRE(close(lemma.branch[0].E, -1.13 * C1 * 0.1 * tau / (Jw_i + 1.13 * C1 * bare), 1e-13));
  REQUIRE(close(lemma.branch[1].E, 1.08 * C2 * 0.1 * tau / (Jw_i + 1.08 * C2 * bare), 1e-13));
  REQUIRE(close(lemma.M, Jw_i / bare * 0.1 * tau, 1e-13));
  const double eta1 = 0.5 * lemma.M / I1 - lemma.branch[0].E, eta2 = 0.5 * lemma.M / I2 - lemma.branch[1].E;
  REQUIRE(eta1 > eta2);
  REQUIRE(close(least_eta(SlidingBounds(sliding(), lemma), lemma), eta1, 1e-13));
  // the same as numbers
  REQUIRE(close(lemma.branch[0].beta, 1.00306, 1e-5));
  REQUIRE(close(lemma.branch[1].beta, 1.00314, 1e-5));
  REQUIRE(close(lemma.branch[0].E, 0.0705, 1e-3));
  REQUIRE(close(lemma.branch[1].E, 0.1118, 1e-3));
  REQUIRE(close(lemma.M, 0.00403, 1e-3));
  REQUIRE(close(eta1, 1.287, 1e-3));
}

TEST_CASE("the printed gain margins 1.12 and 1.04 need the inertia of the load, and then eta may be zero") {
  const Lemma1 lemma = lemma1(nominal(loaded), printed);
  REQUIRE(close(lemma.branch[0].beta, (Jw_i + C1 * loaded) / (Jw_i + 1.13 * C1 * loaded), 1e-13));
  REQUIRE(close(lemma.branch[1].beta, (Jw_i + C2 * loaded) / (Jw_i + 0.92 * C2 * loaded), 1e-13));
  REQUIRE(close(lemma.branch[0].beta, 1.1205, 1e-4));
  REQUIRE(close(lemma.branch[1].beta, 1.0370, 1e-4));
  REQUIRE(least_eta(SlidingBounds(sliding(), lemma), lemma) == 0.0);
  const Lemma1 of_bare = lemma1(nominal(bare), printed);
  REQUIRE(of_bare.branch[0].beta < 1.004);
  REQUIRE(of_bare.branch[1].beta < 1.004);
}

TEST_CASE("D is zero unless the inertia varies, whatever else does") {
  for (const double Jg : {bare, loaded})
    for (const double share : {0.0, 0.1, 0.5, 0.9})
      for (const BranchBounds& b :
           lemma1(nominal(Jg), {.C1 = 0.3 * share, .C2 = share, .load = share, .inertia = 0.0, .friction = {}}).branch)
        REQUIRE(b.D == 0.0);
  // by hand: 1/(0.9 Jg) - 1/Jg
  const Lemma1 lemma = lemma1(nominal(bare), {.C1 = 0.0, .C2 = 0.0, .load = 0.1, .inertia = 0.1, .friction = {}});
  for (const BranchBounds& b : lemma.branch) REQUIRE(close(b.D, 1.0 / (0.9 * bare) - 1.0 / bare, 1e-12));
  // and the true surface is off by Jw i (1/Jg - 1/Jg_hat) tau_l_hat besides
  REQUIRE(close(lemma.M, Jw_i / (0.9 * bare) * 0.1 * tau + (Jw_i / (0.9 * bare) - Jw_i / bare) * tau, 1e-12));
}

TEST_CASE("ten percent of friction are 13 percent of C1 and 8 percent of C2") {
  const Variations v =
      in_terms_of_C({.C1 = 0.0, .C2 = 0.0, .load = 0.1, .inertia = 0.0, .friction = 0.1}, GearMesh<double>(table1()));
  // C bends: ten percent less friction change it more than ten percent more
  REQUIRE(close(v.C1, 1.0 - C_by_hand(0.225) / C1, 1e-12));
  REQUIRE(close(v.C2, C_by_hand(-0.275) / C2 - 1.0, 1e-12));
  REQUIRE(close(v.C1, 0.134, 0.01));
  REQUIRE(close(v.C2, 0.081, 0.01));
  REQUIRE(!v.friction);
}

TEST_CASE("each condition of Lemma 1 fails alone when its number is too small, and its limit satisfies it") {
  const Lemma1 lemma = lemma1(nominal(bare), {.C1 = 0.13, .C2 = 0.08, .load = 0.1, .inertia = 0.1, .friction = {}});
  for (const Condition& c : conditions(sliding(), lemma)) REQUIRE(c.holds());
  const auto only = [&](const std::string& rule, auto&& change) {
    SlidingParameters p = sliding();
    change(p, 0.999);
    for (const Condition& c : conditions(p, lemma)) {
      INFO(c.rule << " " << c.actual << " " << c.limit);
      REQUIRE(c.holds() == (c.rule != rule));
    }
    const double limit = named(conditions(p, lemma), rule).limit;
    change(p, 0.0);
    if (rule.starts_with("eta")) p.eta = limit;
    if (rule.starts_with("beta1")) p.beta1 = limit;
    if (rule.starts_with("beta2")) p.beta2 = limit;
    if (rule.starts_with("D1")) p.D1 = limit;
    if (rule.starts_with("D2")) p.D2 = limit;
    if (rule.starts_with("E1")) p.E1 = limit;
    if (rule.starts_with("E2")) p.E2 = limit;
    REQUIRE(named(conditions(p, lemma), rule).margin() == 0.0);
  };
  const double eta = least_eta(SlidingBounds(sliding(), lemma), lemma);
  only("beta1 >= 2", [](SlidingParameters& p, double share) { p.beta1 = 2.0 * share; });
  only("beta2 >= 2", [](SlidingParameters& p, double share) { p.beta2 = 2.0 * share; });
  only("D1 >= |d - d_hat|", [&](SlidingParameters& p, double share) { p.D1 = share * lemma.branch[0].D; });
  only("D2 >= |d - d_hat|", [&](SlidingParameters& p, double share) { p.D2 = share * lemma.branch[1].D; });
  only("E1 >= |e - e_hat|", [&](SlidingParameters& p, double share) { p.E1 = share * lemma.branch[0].E; });
  only("E2 >= |e - e_hat|", [&](SlidingParameters& p, double share) { p.E2 = share * lemma.branch[1].E; });
  only("eta >= M b_hat/2 - E", [&](SlidingParameters& p, double share) { p.eta = share * eta; });
}

TEST_CASE("variations that let a branch lose its inertia leave no finite gain margin") {
  const Lemma1 lemma = lemma1(nominal(loaded), {.C1 = 2.0, .C2 = 0.1, .load = 0.1, .inertia = 0.0, .friction = {}});
  REQUIRE(lemma.branch[0].beta == std::numeric_limits<double>::infinity());
  REQUIRE(!named(conditions(sliding(), lemma), "beta1 >= b_hat/b, b/b_hat").holds());
}

TEST_CASE("a drive outside the stated variations is named with the share that would cover it") {
  NominalModel drive = nominal(bare);
  drive.C1 *= 1.2;
  drive.Jg *= 0.9;
  const auto list = conditions_on_drive(nominal(bare), printed, drive, 0.15 * tau);
  REQUIRE(!named(list, "|C1/C1_hat - 1|").holds());
  REQUIRE(close(named(list, "|C1/C1_hat - 1|").actual, 0.2, 1e-12));
  REQUIRE(named(list, "|C2/C2_hat - 1|").holds());
  REQUIRE(close(named(list, "|Jg/Jg_hat - 1|").actual, 0.1, 1e-12));
  REQUIRE(close(named(list, "|tau_l - tau_l_hat| / |tau_l_hat|").actual, 0.15, 1e-12));
}

TEST_CASE("the guaranteed precision is 2 Phi/lambda_c, not the printed 2 lambda_c Phi") {
  REQUIRE(close(guaranteed_precision(sliding()), 0.00637, 1e-3));
  REQUIRE(close(sharp_precision(sliding()), 0.00234, 1e-3));
}

}  // namespace wormdrive::test::control_lemma1
