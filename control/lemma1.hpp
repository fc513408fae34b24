#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

#include "control/nominal.hpp"
#include "control/sliding.hpp"
#include "core/field.hpp"

namespace wormdrive {

/// Relative variations around the nominal model that a sliding controller is to withstand.
struct Variations {
  double C1{0.0}, C2{0.0}, load{0.0}, inertia{0.0};

  static constexpr auto fields() {
    using P = Variations;
    constexpr Presence o = Presence::optional;
    constexpr Bounds share = bounds::between(0.0, 0.99);
    return std::tuple{Field{&P::C1, "C1", unit::none, share, "relative variation of C1", o},
                      Field{&P::C2, "C2", unit::none, share, "relative variation of C2", o},
                      Field{&P::load, "load", unit::none, share, "relative error of the load estimate", o},
                      Field{&P::inertia, "gear_inertia", unit::none, share, "relative variation of Jg", o}};
  }
};

/// What Lemma 1 needs for one of the two branches C1, C2 [YehWu2009, eq. 20-21].
struct BranchBounds {
  double b_hat;     ///< 1/(Jw i + C Jg), nominal [1/(kg m^2)]
  double d_hat;     ///< nominal, 1/Jg for any C [1/(kg m^2)]
  double beta;      ///< least gain margin over the variations
  double D;         ///< largest |d - d_hat| [1/(kg m^2)]
  double E;         ///< largest |e - e_hat|, e_hat = 0 [rad/s^2]
  double eta;       ///< least eta of this branch, M b_hat/2 - D |tau_l_hat| - E [rad/s^2]
};

/// The numbers of Lemma 1 for a nominal model and its variations.
struct Lemma1 {
  std::array<BranchBounds, 2> branch;  ///< of C1 and C2
  double M;                            ///< largest |(Jw i/Jg) tau_l_tilde| [N m]
  double eta;                          ///< least eta, never negative [rad/s^2]
  double largest_load;                 ///< largest |tau_l_hat| [N m]
};

/// Bounds over all corners of the variations: every quantity is monotone in each of them.
inline Lemma1 lemma1(const NominalModel& nominal, const Variations& variations) {
  Lemma1 result{};
  result.largest_load = std::abs(nominal.load_torque) + std::abs(nominal.load_constant);
  const double load_error = variations.load * result.largest_load;
  const std::array<double, 2> C{nominal.C1, nominal.C2}, share{variations.C1, variations.C2};
  for (int k = 0; k < 2; ++k) {
    BranchBounds& branch = result.branch[k];
    branch.b_hat = 1.0 / nominal.inertia(C[k]);
    branch.d_hat = 1.0 / nominal.Jg;
    branch.beta = 1.0;
    for (const double c : {-1.0, 1.0})
      for (const double j : {-1.0, 1.0}) {
        const double Ck = C[k] * (1.0 + c * share[k]), Jg = nominal.Jg * (1.0 + j * variations.inertia);
        const double inertia = nominal.Jw_i + Ck * Jg;
        const double ratio = branch.b_hat * inertia;
        branch.beta = std::max({branch.beta, ratio, ratio > 0.0 ? 1.0 / ratio : std::numeric_limits<double>::infinity()});
        branch.D = std::max(branch.D, std::abs(1.0 / Jg - branch.d_hat));
        branch.E = std::max(branch.E, std::abs(Ck * load_error / inertia));
        result.M = std::max(result.M, nominal.Jw_i / Jg * load_error);
      }
  }
  // At zero load D |tau_l_hat| vanishes while M may not: the least eta is needed there.
  for (BranchBounds& branch : result.branch) {
    branch.eta = 0.5 * result.M * branch.b_hat - branch.E;
    result.eta = std::max(result.eta, branch.eta);
  }
  return result;
}

/// One condition of Lemma 1 with its margin.
struct Condition {
  std::string name;
  double actual, needed;
  std::string unit;
  bool holds() const { return actual >= needed; }
};

/// The conditions under which the sliding law is well defined and reaches its layer, each with what it needs.
inline std::vector<Condition> conditions(const SlidingParameters& p, const Lemma1& lemma) {
  return {{"beta1 >= 2", p.beta1, 2.0, ""},
          {"beta2 >= 2", p.beta2, 2.0, ""},
          {"beta1 >= gain variation of branch 1", p.beta1, lemma.branch[0].beta, ""},
          {"beta2 >= gain variation of branch 2", p.beta2, lemma.branch[1].beta, ""},
          {"D1 >= |d1 - d1_hat|", p.D1, lemma.branch[0].D, "1/(kg m^2)"},
          {"D2 >= |d2 - d2_hat|", p.D2, lemma.branch[1].D, "1/(kg m^2)"},
          {"E1 >= |e1 - e1_hat|", p.E1, lemma.branch[0].E, "rad/s^2"},
          {"E2 >= |e2 - e2_hat|", p.E2, lemma.branch[1].E, "rad/s^2"},
          {"eta >= max(0, M b_hat/2 - D |tau_l_hat| - E)", p.eta, lemma.eta, "rad/s^2"}};
}

/// Guaranteed tracking precision [rad]: 2 Phi/lambda_c, and the sharp L1 bound 2 Phi/(e lambda_c).
inline double guaranteed_precision(const SlidingParameters& p) { return 2.0 * p.Phi / p.lambda_c; }
inline double sharp_precision(const SlidingParameters& p) { return guaranteed_precision(p) / std::numbers::e; }

}  // namespace wormdrive
