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
  double epsilon{0.005};         ///< speed up to which eq. 25 acts [rad/s]

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
      : p_(parameters), nominal_(nominal), bounds_(parameters, lemma1(nominal, variations)) {}

  ControlSignals operator()(const Measurement& m) {
    const double e = m.angle - m.desired.angle, e_rate = m.speed - m.desired.speed;
    integral_ += e * m.period;
    const double s = e_rate + 2.0 * p_.lambda_c * e + p_.lambda_c * p_.lambda_c * integral_;
    const double load = nominal_.load(m.angle);
    const double wanted = m.desired.acceleration - 2.0 * p_.lambda_c * e_rate - p_.lambda_c * p_.lambda_c * e;
    const Motion motion = branch(m.speed, m.desired.speed);
    // u1 carries the left flank and is used for s >= Phi, u2 the right one for s <= -Phi [eq. 22-23]
    const Branch left = branch_of(Flank::left, motion, load, wanted);
    const Branch right = branch_of(Flank::right, motion, load, wanted);
    const double u1 = left.inertia * (left.u_hat - left.gain), u2 = right.inertia * (right.u_hat + right.gain);
    const double share = std::clamp(s / p_.Phi, -1.0, 1.0);
    const double u = 0.5 * ((u1 - u2) * share + u1 + u2);  // [eq. 24]
    const double compensation = break_in_compensation(nominal_, load, m.speed, m.desired.speed, p_.epsilon);
    return {u + nominal_.surface() * load + compensation, s, u, compensation};
  }

 private:
  struct Branch {
    double inertia, u_hat, gain;
  };
  Branch branch_of(Flank flank, Motion motion, double load, double wanted) const {
    const double C = nominal_.C(motion, flank), inertia = nominal_.inertia(C);
    const double d = (C + nominal_.surface()) / inertia;
    const double u_hat = wanted - d * load;
    const std::size_t k = sign(motion) * sign(flank) > 0 ? 0 : 1;
    const double beta = k == 0 ? p_.beta1 : p_.beta2;
    return {inertia, u_hat,
            beta * (bounds_.D[k] * std::abs(load) + bounds_.E[k] + p_.eta) + (beta - 1.0) * std::abs(u_hat)};
  }

  SlidingParameters p_;
  NominalModel nominal_;
  SlidingBounds bounds_;
  double integral_ = 0.0;
};

inline SlidingController make_controller(const SlidingParameters& p, const NominalModel& nominal,
                                         const Variations& variations) {
  return {p, nominal, variations};
}

}  // namespace wormdrive
