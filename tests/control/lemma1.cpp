#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

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
  // by hand: theta'' = b u + d tau_l_hat + e with u = tau_m - (Jw i/Jg_hat) tau_l_hat, Jg_hat = bare
  const Lemma1 lemma = lemma1(nominal(bare), {.C1 = 0.0, .C2 = 0.0, .load = 0.1, .inertia = 0.1, .friction = {}});
  const auto D = [&](double C, double Jg) { return std::abs((C + Jw_i / bare) / (Jw_i + C * Jg) - 1.0 / bare); };
  REQUIRE(close(lemma.branch[0].D, std::max(D(C1, 0.9 * bare), D(C1, 1.1 * bare)), 1e-10));
  REQUIRE(close(lemma.branch[1].D, std::max(D(C2, 0.9 * bare), D(C2, 1.1 * bare)), 1e-10));
  // and the true surface is off by Jw i (1/Jg - 1/Jg_hat) tau_l_hat besides
  REQUIRE(close(lemma.M, Jw_i / (0.9 * bare) * 0.1 * tau + (Jw_i / (0.9 * bare) - Jw_i / bare) * tau, 1e-12));
}

TEST_CASE("the bounds cover what the law that runs needs anywhere within the variations, and hardly more") {
  std::mt19937_64 random(22);
  const auto between = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  for (int n = 0; n < 60; ++n) {
    // half of them stated by the friction, some about the friction at which C1 is 0
    const double mu =
        n % 5 == 0 ? GearMesh<double>(table1()).mu_w() * (n % 10 == 0 ? 1.0 : between(0.9, 1.1)) : between(0.02, 0.5);
    const GearMesh<double> mesh(table1(mu));
    const NominalModel believed{mesh.C1(), mesh.C2(),           Jw_i, bare * std::pow(10.0, between(-1.0, 0.5)), tau,
                                0.0,       between(-0.05, 0.05)};
    Variations v{.C1 = between(0.0, 0.4),
                 .C2 = between(0.0, 0.4),
                 .load = between(0.0, 0.3),
                 .inertia = between(0.0, 0.3),
                 .friction = {}};
    const bool by_friction = n % 2 == 0;
    if (by_friction) v.friction = between(0.0, 0.3);
    const double change = v.friction.value_or(0.0);
    const Lemma1 lemma = lemma1(believed, in_terms_of_C(v, mesh));
    const double load_error = v.load * (std::abs(tau) + std::abs(believed.load_constant));
    for (const int k : {0, 1}) {
      // the law asks theta'' for what it computes from its own numbers; the drive gives what its equation says
      const double C_hat = k == 0 ? believed.C1 : believed.C2, Jg_hat = believed.Jg;
      double beta = 1.0, D = 0.0, E = 0.0, M = 0.0;
      for (int scan = 0; scan < 20000; ++scan) {
        const auto share = [&] { return scan % 2 == 0 ? between(-1.0, 1.0) : std::copysign(1.0, between(-1.0, 1.0)); };
        const double C = by_friction ? C_by_hand((k == 0 ? 1.0 : -1.0) * mu * (1.0 + share() * change))
                                     : C_hat * (1.0 + share() * (k == 0 ? v.C1 : v.C2));
        const double Jg = Jg_hat * (1.0 + share() * v.inertia), wrong = share() * load_error, load = 1.0;
        const double u = between(-1.0, 1.0), tau_m = u + Jw_i / Jg_hat * load;
        const double drive = (tau_m + C * load) / (Jw_i + C * Jg), b = 1.0 / (Jw_i + C * Jg);
        D = std::max(D, std::abs((drive - b * u) / load - 1.0 / Jg_hat));
        E = std::max(E, std::abs(C * wrong * b));
        beta = std::max({beta, b * (Jw_i + C_hat * Jg_hat), 1.0 / (b * (Jw_i + C_hat * Jg_hat))});
        M = std::max(M, std::abs(Jw_i / Jg * wrong) + std::abs(Jw_i / Jg - Jw_i / Jg_hat) * lemma.largest_load);
      }
      INFO("case " << n << ", branch C" << k + 1 << ", mu " << mu << ", by friction " << by_friction);
      const BranchBounds& bounds = lemma.branch[k];
      const double rounding = 1e-12 / Jg_hat;
      // the friction bends C: a variation to either side is taken for as large as the larger
      const double slack = by_friction ? 1.5 : 1.001;
      CHECK((bounds.D >= D - rounding && bounds.D <= slack * D + rounding));
      CHECK((bounds.E >= E * (1 - 1e-12) && bounds.E <= slack * E));
      CHECK((bounds.beta >= beta * (1 - 1e-12) && bounds.beta - 1.0 <= slack * (beta - 1.0) + 1e-12));
      CHECK((lemma.M >= M * (1 - 1e-12) && lemma.M <= 1.001 * M));
    }
  }
}

TEST_CASE("where C1 is 0 a variation of the friction still has its bounds, and one of C1 as a share covers nothing") {
  GearMesh<double> mesh(table1());
  mesh.mu = mesh.mu_w();
  NominalModel believed = nominal(bare);
  believed.C1 = 0.0;
  believed.C2 = mesh.C2();
  const Variations v = in_terms_of_C({.load = 0.1, .inertia = 0.1, .friction = 0.1}, mesh);
  const Lemma1 lemma = lemma1(believed, v);
  const double C = C_by_hand(0.9 * mesh.mu_w()), inertia = Jw_i + C * 0.9 * bare;
  REQUIRE(close(lemma.branch[0].E, C * 0.1 * tau / inertia, 0.03));
  REQUIRE(close(lemma.branch[0].D, C * 0.1 / inertia, 0.03));
  REQUIRE(lemma.branch[0].beta < 1.2);
  NominalModel drive = believed;
  drive.C1 = C;
  const auto list = conditions_on_drive(believed, v, drive, 0.0);
  REQUIRE(named(list, "|C1 - C1_hat|").holds());
  REQUIRE(named(list, "|C1 - C1_hat|").key == "controller.variation.friction");
  REQUIRE(!named(list, "|C1 - C1_hat|").of_key);
  REQUIRE(!named(conditions_on_drive(believed, printed, drive, 0.0), "|C1 - C1_hat|").holds());
  REQUIRE(named(conditions_on_drive(believed, printed, believed, 0.0), "|C1 - C1_hat|").holds());
}

TEST_CASE("ten percent of friction are 13 percent of C1 and 8 percent of C2") {
  const Variations v =
      in_terms_of_C({.C1 = 0.0, .C2 = 0.0, .load = 0.1, .inertia = 0.0, .friction = 0.1}, GearMesh<double>(table1()));
  const auto [by_C1, by_C2] = v.by_friction.value();
  // C bends: ten percent less friction change it more than ten percent more
  REQUIRE(close(by_C1, C_by_hand(0.225) - C1, 1e-12));
  REQUIRE(close(by_C2, C_by_hand(-0.275) - C2, 1e-12));
  REQUIRE(close(by_C1 / -C1, 0.134, 0.01));
  REQUIRE(close(by_C2 / C2, 0.081, 0.01));
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

TEST_CASE("variations that let a branch lose its inertia leave no finite gain margin and no finite bound") {
  const Lemma1 lemma = lemma1(nominal(loaded), {.C1 = 2.0, .C2 = 0.1, .load = 0.1, .inertia = 0.0, .friction = {}});
  REQUIRE(lemma.branch[0].beta == std::numeric_limits<double>::infinity());
  REQUIRE(lemma.branch[0].D == std::numeric_limits<double>::infinity());
  REQUIRE(lemma.branch[0].E == std::numeric_limits<double>::infinity());
  REQUIRE(lemma.branch[1].E < 1.0);
  REQUIRE(!named(conditions(sliding(), lemma), "beta1 >= max(b_hat/b, b/b_hat)").holds());
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
