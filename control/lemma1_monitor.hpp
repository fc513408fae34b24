#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "control/control_record.hpp"
#include "control/lemma1_conditions.hpp"

namespace wormdrive {

/// A promise of Lemma 1 that a run broke.
struct Violation {
  std::string_view name;     ///< one word, "layer"
  std::string_view promise;  ///< in symbols
  long count = 0;
  double first = std::numeric_limits<double>::quiet_NaN();  ///< time of the first sample that broke it [s]
  double worst = 0.0;                                       ///< largest value seen, of |u| the smallest
  double limit = 0.0;                                       ///< what was promised
};

/// At which samples a monitor has nothing to note, of one trial or of several at once.
template <class V>
struct Lemma1Quiet {
  V layer;      ///< within which |s| has to be [rad/s]; not a number before it was reached
  V settled;    ///< from when on |e| is bounded [s]
  V precision;  ///< its bound [rad]

  [[gnu::always_inline]] MaskOf<V> operator()(const ControlRecordOf<V>& record) const {
    const V e = abs(record.gear_angle - record.measured.desired.angle);
    return (abs(record.decided.s) < layer) & ((settled > record.measured.t) | (e <= precision));
  }
};

/// Watches what Lemma 1 promises: |s| stays in the layer once it has reached it, |e| stays below the guaranteed
/// precision a few time constants later, and outside the layer u lies on the side of the surface it was designed for.
class Lemma1Monitor {
 public:
  Lemma1Monitor(const SlidingParameters& p, const Lemma1& lemma)
      : Phi_(p.Phi),
        M_(lemma.M),
        settling_(10.0 / p.lambda_c),
        violations_{{{.name = "layer", .promise = "|s| <= Phi after reaching", .limit = p.Phi},
                     {.name = "precision", .promise = "|e| <= 2 Phi/lambda_c", .limit = guaranteed_precision(p)},
                     {.name = "sharp_precision", .promise = "|e| <= 2 Phi/(e lambda_c)", .limit = sharp_precision(p)},
                     {.name = "definition", .promise = "|u| >= M outside the layer", .limit = lemma.M}}},
        quiet_{std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN(),
               std::min(violations_[1].limit, violations_[2].limit)} {}

  void sample(const ControlRecord& record) {
    if (!quiet_(record)) note(record);
  }
  const Lemma1Quiet<double>& quiet() const { return quiet_; }

  /// When |s| first was within the layer [s]; not a number if never.
  double reached() const { return reached_; }
  const std::array<Violation, 4>& violations() const { return violations_; }
  bool clean() const {
    for (const Violation& v : violations_)
      if (v.count > 0) return false;
    return true;
  }

 private:
  [[gnu::noinline]] void note(const ControlRecord& record) {
    const double t = record.measured.t, s = record.decided.s, u = record.decided.u;
    if (std::abs(s) <= Phi_ && std::isnan(reached_)) {
      reached_ = t;
      quiet_.layer = Phi_;
      quiet_.settled = reached_ + settling_;
    }
    if (std::abs(s) >= Phi_) {
      const double beyond = s > 0.0 ? -u : u;
      if (beyond < M_) note(3, t, beyond);
    }
    if (std::isnan(reached_)) return;
    if (std::abs(s) > Phi_) note(0, t, std::abs(s));
    if (t < reached_ + settling_) return;
    const double e = std::abs(record.gear_angle - record.measured.desired.angle);
    for (const int k : {1, 2})
      if (e > violations_[k].limit) note(k, t, e);
  }

  void note(int k, double t, double value) {
    Violation& v = violations_[k];
    if (v.count++ == 0) {
      v.first = t;
      v.worst = value;
    }
    v.worst = k == 3 ? std::min(v.worst, value) : std::max(v.worst, value);
  }

  double Phi_, M_, settling_;
  double reached_ = std::numeric_limits<double>::quiet_NaN();
  std::array<Violation, 4> violations_;
  Lemma1Quiet<double> quiet_;
};

/// How often a run that ended at a time [s] broke a promise. One about what comes after the layer was reached, or after
/// the run settled, is not kept by a run that never came to that: not a number.
inline double judged_violations(const Lemma1Monitor& lemma, const Violation& promise, double end) {
  const bool was_judged = promise.name == "definition" ||
                          (promise.name == "layer" ? !std::isnan(lemma.reached()) : lemma.quiet().settled < end);
  return was_judged ? static_cast<double>(promise.count) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace wormdrive
