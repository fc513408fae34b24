#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <tuple>

#include "control/compensation.hpp"
#include "control/controller_signals.hpp"
#include "control/lemma1.hpp"
#include "control/nominal.hpp"
#include "core/field.hpp"
#include "core/pair.hpp"

namespace wormdrive {

/// Numbers of the sliding controller [YehWu2009, eq. 20-25].
struct SlidingParameters {
  static constexpr std::string_view kind = "sliding";
  static constexpr std::string_view meaning = "sliding controller with a boundary layer [YehWu2009, eq. 20-25]";
  double lambda_c{};  ///< closed-loop bandwidth [rad/s]
  double Phi{};       ///< boundary layer [rad/s]
  double eta{};       ///< reaching rate [rad/s^2]
  double beta1{2.0}, beta2{2.0};
  std::optional<double> D1{}, D2{};  ///< bounds of |d_k - d_k_hat| [1/(kg m^2)]; those of the variations if not stated
  std::optional<double> E1{}, E2{};  ///< bounds of |e_k - e_k_hat| [rad/s^2]; likewise
  double epsilon{0.005};             ///< speed up to which eq. 25 acts [rad/s]

  static constexpr auto fields() {
    using P = SlidingParameters;
    constexpr Presence o = Presence::optional;
    constexpr Unit per_inertia{"per_kgm2", "1/(kg m^2)"};
    return std::tuple{
        Field{&P::lambda_c, "bandwidth", unit::radian_per_second, bounds::positive, "closed-loop bandwidth lambda_c"},
        Field{&P::Phi, "layer", unit::radian_per_second, bounds::positive, "half width Phi of the boundary layer of s"},
        Field{&P::eta, "eta", unit::radian_per_second_squared, bounds::not_negative, "reaching rate eta"},
        Field{&P::beta1, "beta1", unit::none, Bounds{.low = 1.0}, "gain margin beta_1", o},
        Field{&P::beta2, "beta2", unit::none, Bounds{.low = 1.0}, "gain margin beta_2", o},
        Field{&P::D1, "D1", per_inertia, bounds::not_negative, "bound D_1; from the variations if not stated", o},
        Field{&P::D2, "D2", per_inertia, bounds::not_negative, "bound D_2; from the variations if not stated", o},
        Field{&P::E1, "E1", unit::radian_per_second_squared, bounds::not_negative,
              "bound E_1; from the variations if not stated", o},
        Field{&P::E2, "E2", unit::radian_per_second_squared, bounds::not_negative,
              "bound E_2; from the variations if not stated", o},
        Field{&P::epsilon, "break_in_speed", unit::radian_per_second, bounds::not_negative,
              "speed up to which the break-in compensation acts", o}};
  }
};

/// The bounds that a sliding controller works with: as stated, else as the variations ask.
struct SlidingBounds {
  std::array<double, 2> D, E;  ///< of the branches C1 and C2

  SlidingBounds(const SlidingParameters& p, const Lemma1& lemma)
      : D{p.D1.value_or(lemma.branch[0].D), p.D2.value_or(lemma.branch[1].D)},
        E{p.E1.value_or(lemma.branch[0].E), p.E2.value_or(lemma.branch[1].E)} {}
};

/// The sliding controller with smoothing inside the boundary layer [YehWu2009, eq. 20-24] and compensation [eq. 25].
class SlidingController {
 public:
  SlidingController(const SlidingParameters& parameters, const NominalModel& nominal, const Variations& variations)
      : SlidingController(parameters, nominal, SlidingBounds(parameters, lemma1(nominal, variations))) {}

  ControlSignals operator()(const Measurement& m) {
    const double load = nominal_.load(m.angle);
    const double e = m.angle - m.desired.angle, e_rate = m.speed - m.desired.speed;
    integral_ += e * m.period;
    const double s = e_rate + twice_lambda_ * e + lambda_squared_ * integral_;
    const double wanted = m.desired.acceleration - twice_lambda_ * e_rate - lambda_squared_ * e;
    const bool forward = branch(m.speed, m.desired.speed) == Motion::forward;
    const Pair u12 = laws_[forward ? 0 : 1].inputs(load, wanted);
    const double share = std::clamp(s * per_layer_, -1.0, 1.0);
    const double u = 0.5 * (1.0 + share) * u12[0] + 0.5 * (1.0 - share) * u12[1];  // [eq. 24]
    const double compensation = break_in_compensation(nominal_, load, m.speed, m.desired.speed, p_.epsilon);
    return {u + (surface_ * load + compensation), s, u, compensation};
  }

 private:
  /// The law for one direction of motion, side by side: u1 carries the left flank and is used for s >= Phi, u2 the
  /// right one for s <= -Phi [eq. 22-23]. It holds everything that no sample changes.
  class Law {
   public:
    /// left, right: 0 where C1 acts on that flank, 1 where C2 does.
    Law(const SlidingParameters& p, const NominalModel& nominal, const SlidingBounds& bounds, int left, int right) {
      for (const int lane : {0, 1}) {
        const int k = lane == 0 ? left : right;
        const double C = k == 0 ? nominal.C1 : nominal.C2, beta = k == 0 ? p.beta1 : p.beta2;
        inertia_[lane] = nominal.inertia(C);
        d_[lane] = (C + nominal.surface()) / inertia_[lane];
        const double against = (lane == 0 ? -1.0 : 1.0) * inertia_[lane];
        of_load_[lane] = against * (beta * bounds.D[k]);
        of_input_[lane] = against * (beta - 1.0);
        constant_[lane] = against * (beta * (bounds.E[k] + p.eta));
      }
    }

    /// (u_hat -+ k) / b_hat [N m], with the gain k = beta (D |tau_l_hat| + E + eta) + (beta - 1) |u_hat|.
    Pair inputs(double load, double wanted) const {
      const Pair u_hat = wanted - d_ * load;
      return inertia_ * u_hat + ((of_load_ * std::abs(load) + constant_) + of_input_ * abs(u_hat));
    }

   private:
    Pair inertia_{}, d_{};
    Pair of_load_{}, of_input_{}, constant_{};  ///< what -+ k / b_hat has of |tau_l_hat|, of |u_hat| and without them
  };

  SlidingController(const SlidingParameters& p, const NominalModel& nominal, const SlidingBounds& bounds)
      : p_(p),
        nominal_(nominal),
        surface_(nominal.surface()),
        twice_lambda_(2.0 * p.lambda_c),
        lambda_squared_(p.lambda_c * p.lambda_c),
        per_layer_(1.0 / p.Phi),
        laws_{Law(p, nominal, bounds, 0, 1), Law(p, nominal, bounds, 1, 0)} {}

  SlidingParameters p_;
  NominalModel nominal_;
  double surface_, twice_lambda_, lambda_squared_, per_layer_;
  std::array<Law, 2> laws_;  ///< forward, backward
  double integral_ = 0.0;
};

inline SlidingController make_controller(const SlidingParameters& p, const NominalModel& nominal,
                                         const Variations& variations) {
  return {p, nominal, variations};
}

}  // namespace wormdrive
