#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <tuple>

#include "control/anti_windup.hpp"
#include "control/compensation.hpp"
#include "control/controller_signals.hpp"
#include "control/lemma1.hpp"
#include "control/nominal.hpp"
#include "core/field.hpp"
#include "core/numbers/lanes.hpp"

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

/// The sliding controller with smoothing inside the boundary layer [YehWu2009, eq. 20-24] and compensation [eq. 25], of
/// one trial or of several at once. It holds everything that no sample changes, and the integral of the error.
template <class V>
class SlidingLawOf {
 public:
  SlidingLawOf() = default;
  SlidingLawOf(const SlidingParameters& p, const NominalModel& nominal, const SlidingBounds& bounds)
      : C_{nominal.C1, nominal.C2},
        surface_(nominal.surface()),
        twice_lambda_(2.0 * p.lambda_c),
        lambda_squared_(p.lambda_c * p.lambda_c),
        per_layer_(1.0 / p.Phi),
        epsilon_(p.epsilon) {
    for (const std::size_t k : {0, 1}) {
      const double beta = k == 0 ? p.beta1 : p.beta2;
      inertia_[k] = nominal.inertia(C_[k]);
      d_[k] = (C_[k] + nominal.surface()) / inertia_[k];
      of_load_[k] = inertia_[k] * (beta * bounds.D[k]);
      of_input_[k] = inertia_[k] * (beta - 1.0);
      constant_[k] = inertia_[k] * (beta * (bounds.E[k] + p.eta));
    }
  }

  /// load: estimated load torque tau_l_hat at the measured angle [N m].
  [[gnu::always_inline]] ControlSignalsOf<V> operator()(const MeasurementOf<V>& m, const V& load) {
    integrate((m.angle - m.desired.angle) * m.period);
    return decide(m, load, branches(m, load));
  }
  /// Lets the integral of the error grow by itself ...
  [[gnu::always_inline]] void integrate(const V& growth) { integral_ += growth; }
  /// ... and decides with what it is now. sides: the branches [N m].
  [[gnu::always_inline]] ControlSignalsOf<V> decide(const MeasurementOf<V>& m, const V& load,
                                                    const std::array<V, 2>& sides) const {
    const V e = m.angle - m.desired.angle, e_rate = m.speed - m.desired.speed;
    const V s = e_rate + twice_lambda_ * e + lambda_squared_ * integral_;
    const auto& [u1, u2] = sides;
    const V share = within_limits<V>(s * per_layer_, -1.0, 1.0);
    const V u = 0.5 * (1.0 + share) * u1 + 0.5 * (1.0 - share) * u2;  // [eq. 24]
    const V compensation = break_in_compensation<V>(C_[0], C_[1], load, m.speed, m.desired.speed, epsilon_);
    return {u + (surface_ * load + compensation), s, u, compensation};
  }
  /// u_1 above the layer and u_2 below it [N m].
  [[gnu::always_inline]] std::array<V, 2> branches(const MeasurementOf<V>& m, const V& load) const {
    const V e = m.angle - m.desired.angle, e_rate = m.speed - m.desired.speed;
    const V wanted = m.desired.acceleration - twice_lambda_ * e_rate - lambda_squared_ * e;

    // Both branches side by side, u_hat / b_hat and the gain k / b_hat with k = beta (D |tau_l_hat| + E + eta) +
    // (beta - 1) |u_hat|. Forward C1 acts on the left flank, for s >= Phi, and C2 on the right one, for s <= -Phi;
    // backward they change sides [eq. 22-23].
    const Both<V> u_hat = wanted - load * d_, input = inertia_ * u_hat;
    const Both<V> gain = (abs(load) * of_load_ + constant_) + of_input_ * abs(u_hat);
    const Both<V> below = input - gain, above = input + gain;
    const auto forward = goes_forward(m.speed, m.desired.speed);
    return {select_steady<V>(forward, below[0], below[1]), select_steady<V>(forward, above[1], above[0])};
  }
  /// Calls visit(number) for every number that samples change.
  template <class Visit>
  void visit_memory(Visit&& visit) {
    visit(integral_);
  }

 private:
  Both<V> inertia_, d_;
  Both<V> of_load_, of_input_, constant_;  ///< what k / b_hat has of |tau_l_hat|, of |u_hat| and without them
  std::array<V, 2> C_;
  V surface_, twice_lambda_, lambda_squared_, per_layer_, epsilon_;
  V integral_ = 0.0;
};

/// The law with its estimate of the load.
class SlidingController {
 public:
  SlidingController(const SlidingParameters& parameters, const NominalModel& nominal, const Variations& variations)
      : nominal_(nominal),
        law_(parameters, nominal, SlidingBounds(parameters, lemma1(nominal, variations))),
        lambda_c_(parameters.lambda_c),
        Phi_(parameters.Phi) {}

  ControlSignals operator()(const Measurement& m) {
    const double load = nominal_.load(m.angle);
    return growth_.method == AntiWindup::none ? law_(m, load) : decide_within_limit(m, load);
  }
  /// Time constant of the anti-windup [s], that of the error within the layer.
  double tracking_time() const { return 1.0 / lambda_c_; }
  void prevent_windup(const IntegralGrowth& growth) { growth_ = growth; }
  template <class Visit>
  void visit_memory(Visit&& visit) {
    law_.visit_memory(visit);
    for (double* const number :
         {&before_.torque, &before_.s, &before_.u, &before_.compensation, &branches_[0], &branches_[1]})
      visit(*number);
  }

 private:
  /// Not inline: that would cost the law without anti-windup a tenth of its time.
  [[gnu::noinline]] ControlSignals decide_within_limit(Measurement m, double load) {
    law_.integrate(growth_(m.angle - m.desired.angle, m.period, beyond(m.applied)));
    branches_ = law_.branches(m, load);
    before_ = law_.decide(m, load, branches_);
    return before_;
  }
  /// How far the integral lies beyond the value with which the law would have asked for the torque that was applied at
  /// the sample before: s on its line through the layer, or, where no s asks for it, the edge that comes nearest.
  double beyond(double applied) const {
    const auto [u1, u2] = branches_;
    if (applied == before_.torque || u1 == u2) return 0.0;
    const double u = before_.u + (applied - before_.torque);
    const double s = Phi_ * std::clamp((2.0 * u - (u1 + u2)) / (u1 - u2), -1.0, 1.0);
    return (before_.s - s) / (lambda_c_ * lambda_c_);
  }

  NominalModel nominal_;
  SlidingLawOf<double> law_;
  double lambda_c_, Phi_;
  IntegralGrowth growth_;
  ControlSignals before_{};           ///< at the sample before
  std::array<double, 2> branches_{};  ///< likewise
};

inline SlidingController make_controller(const SlidingParameters& p, const NominalModel& nominal,
                                         const Variations& variations) {
  return {p, nominal, variations};
}

}  // namespace wormdrive
