#pragma once
#include <cmath>
#include <string_view>
#include <tuple>

#include "control/anti_windup.hpp"
#include "control/compensation.hpp"
#include "control/controller_signals.hpp"
#include "control/lemma1.hpp"
#include "control/nominal.hpp"
#include "core/field.hpp"

namespace wormdrive {

/// Weights of the linear-quadratic design on the nominal model with integral action.
struct PidParameters {
  static constexpr std::string_view kind = "pid";
  static constexpr std::string_view meaning = "PID as linear-quadratic regulator with integral action";
  double integral_weight{};  ///< of (integral of e)^2
  double angle_weight{};     ///< of e^2
  double speed_weight{};     ///< of e'^2
  double torque_weight{1.0};
  double feedforward{0.0};  ///< share of theta_d'' fed forward, 0 or 1
  double epsilon{0.005};    ///< speed below which eq. 25 acts [rad/s]

  static constexpr auto fields() {
    using P = PidParameters;
    constexpr Presence o = Presence::optional;
    return std::tuple{
        Field{&P::integral_weight, "integral_weight", unit::none, bounds::positive,
              "weight of the integral of e, squared"},
        Field{&P::angle_weight, "angle_weight", unit::none, bounds::not_negative, "weight of e squared"},
        Field{&P::speed_weight, "speed_weight", unit::none, bounds::not_negative, "weight of e' squared"},
        Field{&P::torque_weight, "torque_weight", unit::none, bounds::positive, "weight of the torque squared", o},
        Field{&P::feedforward, "feedforward", unit::none, bounds::between(0, 1), "share of theta_d'' fed forward", o},
        Field{&P::epsilon, "break_in_speed", unit::radian_per_second, bounds::not_negative,
              "speed up to which the break-in compensation acts", o}};
  }
};

/// Gains of u = -(Ki Int(e) + Kp e + Kd e') in N m per (rad s), rad and rad/s.
struct PidGains {
  double Ki{}, Kp{}, Kd{};
};

/// Whether M s^3 + Kd s^2 + Kp s + Ki has all its zeros on the left [Routh and Hurwitz].
inline bool stabilises(const PidGains& g, double M) {
  return g.Ki > 0.0 && g.Kd > 0.0 && g.Kp * g.Kd > M * g.Ki && std::isfinite(g.Ki + g.Kp + g.Kd);
}

/// Gains that minimise the weighted squares for M e'' = u; all 0 where there are none.
PidGains lqr_gains(const PidParameters& weights, double M);

/// u = -(Ki Int(e) + Kp e + Kd e') with feedforward and break-in compensation, of one trial or of several at once.
template <class V>
class PidLawOf {
 public:
  PidLawOf() = default;
  PidLawOf(const PidGains& gains, const PidParameters& p, const NominalModel& nominal)
      : Ki_(gains.Ki),
        Kp_(gains.Kp),
        Kd_(gains.Kd),
        feedforward_(p.feedforward * mean_inertia(nominal)),
        C1_(nominal.C1),
        C2_(nominal.C2),
        epsilon_(p.epsilon) {}

  /// load: estimated load torque tau_l_hat at the measured angle [N m].
  [[gnu::always_inline]] ControlSignalsOf<V> operator()(const MeasurementOf<V>& m, const V& load) {
    integrate((m.angle - m.desired.angle) * m.period);
    return decide(m, load);
  }
  /// Lets the integral of the error grow by itself ...
  [[gnu::always_inline]] void integrate(const V& growth) { integral_ += growth; }
  /// ... and decides with what it is now.
  [[gnu::always_inline]] ControlSignalsOf<V> decide(const MeasurementOf<V>& m, const V& load) const {
    const V e = m.angle - m.desired.angle, e_rate = m.speed - m.desired.speed;
    const V feedback = -(Ki_ * integral_ + Kp_ * e + Kd_ * e_rate);
    const V feedforward = feedforward_ * m.desired.acceleration;
    const V compensation = break_in_compensation<V>(C1_, C2_, load, m.speed, m.desired.speed, epsilon_);
    return {feedback + feedforward + compensation, 0.0, 0.0, compensation};
  }
  /// Calls visit(number) for every number that samples change.
  template <class Visit>
  void visit_memory(Visit&& visit) {
    visit(integral_);
  }

 private:
  V Ki_, Kp_, Kd_;
  V feedforward_;  ///< inertia that feedforward counts on [kg m^2]
  V C1_, C2_, epsilon_;
  V integral_ = 0.0;
};

/// PID as linear-quadratic regulator with integral action on the nominal model, with the sliding controller's load
/// and break-in compensation.
class PidController {
 public:
  PidController(const PidParameters& parameters, const NominalModel& nominal)
      : nominal_(nominal),
        gains_(lqr_gains(parameters, mean_inertia(nominal))),
        law_(gains_, parameters, nominal),
        per_Ki_(1.0 / gains_.Ki) {}

  const PidGains& gains() const { return gains_; }
  /// Time constant of the anti-windup [s], the geometric mean of reset and derivative time.
  double tracking_time() const { return std::sqrt(gains_.Kd / gains_.Ki); }
  void prevent_windup(const IntegralGrowth& growth) { growth_ = growth; }

  ControlSignals operator()(const Measurement& m) {
    law_.integrate(growth_(m.angle - m.desired.angle, m.period, (m.applied - decided_) * per_Ki_));
    const ControlSignals signals = law_.decide(m, nominal_.load(m.angle));
    decided_ = signals.torque;
    return signals;
  }
  /// Calls visit(number) for every number that samples change.
  template <class Visit>
  void visit_memory(Visit&& visit) {
    law_.visit_memory(visit);
    visit(decided_);
  }

 private:
  NominalModel nominal_;
  PidGains gains_;
  PidLawOf<double> law_;
  double per_Ki_;  ///< [rad s/(N m)]
  IntegralGrowth growth_;
  double decided_ = 0.0;  ///< at the sample before [N m]
};

inline PidController make_controller(const PidParameters& p, const NominalModel& nominal, const Variations&) {
  return {p, nominal};
}

}  // namespace wormdrive
