// The worked example of docs/howto/add_a_controller.md. What stands between the markers stands on that page, word for
// word; tests/docs/run_howto.py compares the two.
// [howto]
#include <string_view>
#include <tuple>

#include "control/compensation.hpp"
#include "control/controller_signals.hpp"
#include "control/lemma1.hpp"
#include "core/field.hpp"

namespace wormdrive {

namespace unit {
inline constexpr Unit newton_metre_per_rad{"Nm_per_rad", "N m/rad"};
}

/// Proportional-derivative control with the estimated load and the break-in compensation.
struct PdParameters {
  static constexpr std::string_view kind = "pd";
  static constexpr std::string_view meaning = "proportional and derivative of the error";
  double Kp{};            ///< [N m/rad]
  double Kd{};            ///< [N m s/rad]
  double epsilon{0.005};  ///< speed up to which eq. 25 acts [rad/s]

  static constexpr auto fields() {
    using P = PdParameters;
    return std::tuple{
        Field{&P::Kp, "Kp", unit::newton_metre_per_rad, bounds::not_negative, "torque per angle error"},
        Field{&P::Kd, "Kd", unit::newton_metre_second_per_radian, bounds::not_negative, "torque per speed error"},
        Field{&P::epsilon, "break_in_speed", unit::radian_per_second, bounds::not_negative,
              "speed up to which the break-in compensation acts", Presence::optional}};
  }
};

class PdController {
 public:
  PdController(const PdParameters& parameters, const NominalModel& nominal) : p_(parameters), nominal_(nominal) {}

  ControlSignals operator()(const Measurement& m) const {
    const double e = m.angle - m.desired.angle, e_rate = m.speed - m.desired.speed;
    const double compensation =
        break_in_compensation(nominal_, nominal_.load(m.angle), m.speed, m.desired.speed, p_.epsilon);
    return {.torque = -p_.Kp * e - p_.Kd * e_rate + compensation, .compensation = compensation};
  }

 private:
  PdParameters p_;
  NominalModel nominal_;
};

inline PdController make_controller(const PdParameters& p, const NominalModel& nominal, const Variations&) {
  return {p, nominal};
}

}  // namespace wormdrive
// [/howto]

#include <cmath>
#include <limits>

#include "catch.hpp"
#include "control/closed_loop.hpp"
#include "support.hpp"

using namespace wormdrive;
using namespace wormdrive::test;

TEST_CASE("the controller of the how-to brings a free inertia to its angle as the sampled oscillator that it is") {
  const double J = 0.02, Kp = 0.5, Kd = 0.08, T = 1e-3;
  const NominalModel nominal{1.0, 1.0, 0.0, J, 0.0, 0.0, 0.0};
  auto d = WormDrive<double, TimedLoad>(GearMesh<double>::without_teeth(J), make_load(Signal{}), {}, {});
  CvodeSolver solver(d, tight(adams, 1e-12));
  SensorSettings exact;
  exact.exact_speed = true;
  ClosedLoop loop(make_controller(PdParameters{Kp, Kd, 0.0}, nominal, {}), Reference{{StepReference{0.3, 0.0}}}, exact,
                  SamplingSettings{T}, DisturbanceSettings{}, [](const ControlRecord&) {});
  const auto end = simulate(d, solver, loop, Timetable(0.0, 0.5, std::numeric_limits<double>::infinity(), {T, 0.0}), {},
                            [](const auto&, const auto&) {});
  // between samples the torque is held: theta += T omega + T^2 a/2, omega += T a
  double theta = 0.0, omega = 0.0;
  for (int k = 0; k < 500; ++k) {
    const double a = (-Kp * (theta - 0.3) - Kd * omega) / J;
    theta += T * omega + 0.5 * T * T * a;
    omega += T * a;
  }
  REQUIRE(std::abs(end.x[0] - theta) <= 1e-9);
  REQUIRE(std::abs(end.x[1] - omega) <= 1e-8);
}
