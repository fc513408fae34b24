// The worked example of docs/howto/add_a_load.md. What stands between the markers stands on that page, word for word;
// tests/docs/run_howto.py compares the two.
// [howto]
#include <limits>
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/moment.hpp"

namespace wormdrive {

/// A spiral spring between the gear shaft and the frame: tau_l = -stiffness (theta_g - rest_angle).
struct SpiralSpring {
  static constexpr std::string_view kind = "spiral_spring";
  static constexpr std::string_view meaning = "spring that turns the gear back, -stiffness (theta_g - rest_angle)";
  double stiffness{};      ///< [N m/rad]
  double rest_angle{0.0};  ///< [rad]

  static constexpr auto fields() {
    using P = SpiralSpring;
    return std::tuple{
        Field{&P::stiffness, "stiffness", unit::newton_metre_per_radian, bounds::not_negative, "torque per angle"},
        Field{&P::rest_angle, "rest_angle", unit::degrees, bounds::any, "gear angle at which the spring is relaxed",
              Presence::optional}};
  }

  double inertia() const { return 0.0; }
  void enter(double) {}
  double next_knot(double) const { return std::numeric_limits<double>::infinity(); }
  double fastest() const { return 0.0; }
  double ripple() const { return 0.0; }

  /// Load torque tau_l [N m] at the present gear angle.
  template <class S>
  S torque(const Moment<S>& at) const {
    return -stiffness * (at.theta_g - rest_angle);
  }
};

}  // namespace wormdrive
// [/howto]

#include <cmath>

#include "catch.hpp"
#include "core/numbers/series.hpp"
#include "core/worm_drive.hpp"
#include "events/cvode_solver.hpp"
#include "events/simulate.hpp"

using namespace wormdrive;

namespace {

constexpr SpiralSpring spring{.stiffness = 0.8, .rest_angle = 0.25};

/// The last instant of a drive that the spring alone moves, from rest at angle 0.
auto released(const GearMesh<double>& mesh, double duration) {
  WormDrive<double, SpiralSpring> drive(mesh, spring, {}, {});
  CvodeSolver solver(drive, SolverSettings{.relative_tolerance = 1e-12, .absolute_tolerance = 1e-14});
  const Timetable times(0.0, duration, std::numeric_limits<double>::infinity());
  return simulate(drive, solver, times, {}, [](const auto&, const auto&) {});
}

}  // namespace

TEST_CASE("the load of the how-to pulls towards its rest angle, at a rate that derivatives along the motion see") {
  REQUIRE(spring.torque(Moment<double>{0.0, 0.25, 0.0, 0.0}) == 0.0);
  using Flow = Series<double, 1>;
  const Flow torque = spring.torque(Moment<Flow>{Flow(0.0), Flow::variable(1.25), Flow(1.0), Flow(1.0)});
  REQUIRE(torque[0] == -0.8);
  REQUIRE(torque[1] == -0.8);
}

TEST_CASE("the load of the how-to swings a free inertia about its rest angle and is held by a self-locking gear") {
  const double J = 0.02, t = 1.3;
  const auto free = released(GearMesh<double>::without_teeth(J), t);
  REQUIRE(std::abs(free.x[0] - 0.25 * (1.0 - std::cos(std::sqrt(0.8 / J) * t))) <= 1e-9);

  MeshParameters<double> gear;
  gear.i = 60;
  gear.lambda = 4 * unit::degree;
  gear.phi_n = 20 * unit::degree;
  gear.lw = 0.011;
  gear.lg = 0.045;
  gear.mu = 0.25;
  gear.Jw = 2.53e-5;
  gear.Jg = 7.39e-4;
  const auto held = released(GearMesh<double>(gear), t);
  REQUIRE(held.x[0] == 0.0);
  REQUIRE(held.mode == Mode{});
}
