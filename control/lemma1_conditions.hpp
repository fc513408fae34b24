#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "control/sliding.hpp"

namespace wormdrive {

/// One condition of Lemma 1: it holds if the actual value is at least, or at most, the limit.
struct Condition {
  std::string meaning;
  std::string rule;
  double actual, limit;
  std::string unit;
  std::string key;  ///< what to change if it does not hold: the limit satisfies it, at most the actual value
  bool at_most = false;
  bool of_key = true;  ///< the values are those of the key

  double margin() const { return at_most ? limit - actual : actual - limit; }
  bool holds() const { return margin() >= 0.0; }
};

/// "reaching rate: eta >= M b_hat/2 - E [rad/s^2]"
inline std::string in_words(const Condition& c) {
  return c.meaning + ": " + c.rule + (c.at_most ? " <= " + c.key : "") + (c.unit.empty() ? "" : " [" + c.unit + "]");
}

/// Least eta [rad/s^2] with which the law is well defined whatever the load is: at zero load D |tau_l_hat| does not
/// help.
inline double least_eta(const SlidingBounds& bounds, const Lemma1& lemma) {
  double least = 0.0;
  for (std::size_t k = 0; k < 2; ++k) least = std::max(least, 0.5 * lemma.M * lemma.branch[k].b_hat - bounds.E[k]);
  return least;
}

/// The conditions of Lemma 1 on the numbers of a sliding controller [YehWu2009, Lemma 1].
inline std::vector<Condition> conditions(const SlidingParameters& p, const Lemma1& lemma) {
  const SlidingBounds bounds(p, lemma);
  std::vector<Condition> list;
  for (std::size_t k = 0; k < 2; ++k) {
    const std::string n = k == 0 ? "1" : "2";
    const BranchBounds& branch = lemma.branch[k];
    const double beta = k == 0 ? p.beta1 : p.beta2;
    list.push_back({"gain margin", "beta" + n + " >= 2", beta, 2.0, "", "controller.beta" + n});
    list.push_back({"gain margin over the variation", "beta" + n + " >= max(b_hat/b, b/b_hat)", beta, branch.beta, "",
                    "controller.beta" + n});
    list.push_back({"bound of the inertia error", "D" + n + " >= |d - d_hat|", bounds.D[k], branch.D, "1/(kg m^2)",
                    "controller.D" + n + "_per_kgm2"});
    list.push_back({"bound of the load error", "E" + n + " >= |e - e_hat|", bounds.E[k], branch.E, "rad/s^2",
                    "controller.E" + n + "_rad_per_s2"});
  }
  list.push_back({"reaching rate", "eta >= M b_hat/2 - E", p.eta, least_eta(bounds, lemma), "rad/s^2",
                  "controller.eta_rad_per_s2"});
  return list;
}

/// Whether C1 or C2 of a drive lies within its variation: as a share of its estimate, or, where it was stated by the
/// friction or the estimate is 0, as it is.
inline Condition condition_on_C(std::size_t k, double actual, double estimate, const Variations& v) {
  const std::string n = k == 0 ? "C1" : "C2";
  if (!v.by_friction && estimate != 0.0)
    return {n + " within its variation",
            "|" + n + "/" + n + "_hat - 1|",
            std::abs(actual / estimate - 1.0),
            k == 0 ? v.C1 : v.C2,
            "",
            "controller.variation." + n,
            true};
  return {n + " within the variation of the friction",
          "|" + n + " - " + n + "_hat|",
          std::abs(actual - estimate),
          v.by_friction ? (*v.by_friction)[k] : 0.0,
          "",
          "controller.variation.friction",
          true,
          false};
}

/// Whether a drive lies within the stated variations of a nominal model. load_error: largest |tau_l - tau_l_hat| [N m].
inline std::vector<Condition> conditions_on_drive(const NominalModel& nominal, const Variations& v,
                                                  const NominalModel& drive, double load_error) {
  const double largest = std::abs(nominal.load_torque) + std::abs(nominal.load_constant);
  return {condition_on_C(0, drive.C1, nominal.C1, v),
          condition_on_C(1, drive.C2, nominal.C2, v),
          {"gear-side inertia within its variation", "|Jg/Jg_hat - 1|", std::abs(drive.Jg / nominal.Jg - 1.0),
           v.inertia, "", "controller.variation.gear_inertia", true},
          {"load within its variation", "|tau_l - tau_l_hat| / |tau_l_hat|",
           load_error > 0.0 ? load_error / largest : 0.0, v.load, "", "controller.variation.load", true}};
}

/// Guaranteed tracking precision [rad]: 2 Phi/lambda_c, and the sharp L1 bound 2 Phi/(e lambda_c).
inline double guaranteed_precision(const SlidingParameters& p) { return 2.0 * p.Phi / p.lambda_c; }
inline double sharp_precision(const SlidingParameters& p) { return guaranteed_precision(p) / std::numbers::e; }

}  // namespace wormdrive
