// The worked example of docs/howto/derivatives.md. What stands between the markers stands on that page, word for word;
// tests/docs/run_howto.py compares the two.
// [howto]
#include <array>

#include "core/load.hpp"
#include "events/sensitivity/sensitivity.hpp"

namespace wormdrive {

/// What friction and payload do to an arm that swings for two seconds, a row every 10 ms.
inline Sensitivities friction_or_payload(const MeshParameters<double>& mesh, const GravityArm& arm) {
  RigidDrive drive{GearMesh<double>(mesh), {{arm}}, {}, {}, {}};
  drive.motor.terms = {Sinusoid{.amplitude = 0.05, .frequency = 1.5}};
  // on, so that there is something to differentiate by; zero, so that nothing changes
  std::get<std::optional<MeshFriction<double>>>(drive.effects.list) = {0.0};
  std::get<std::optional<LoadMagnitude<double>>>(drive.effects.list) = {0.0};

  const std::array by{parameter(drive, "mesh_friction", "change"), parameter(drive, "load_magnitude", "share")};
  const SolverSettings settings{.solver = SolverKind::taylor};
  return sensitivities(drive, by, Timetable(0.0, 2.0, 0.01), settings);
}

}  // namespace wormdrive
// [/howto]

#include "catch.hpp"
#include "support.hpp"

TEST_CASE("the derivatives of the how-to tell what a change of friction and payload does to the end of the run") {
  using namespace wormdrive;
  const Sensitivities s = friction_or_payload(test::table1(), test::fig9_load());
  const auto& end = s.rows.back();
  REQUIRE(end.t == 2.0);
  REQUIRE(end.state_by.cols() == 2);

  MeshParameters<double> rougher = test::table1();
  rougher.mu += 1e-5;
  GravityArm heavier = test::fig9_load();
  *heavier.amplitude *= 1.0 + 1e-5;
  const auto moved = [&](const MeshParameters<double>& mesh, const GravityArm& arm) {
    return (friction_or_payload(mesh, arm).rows.back().state - end.state).eval();
  };
  REQUIRE((moved(rougher, test::fig9_load()) - 1e-5 * end.state_by.col(0)).norm() <= 1e-3 * 1e-5 * end.state_by.norm());
  REQUIRE((moved(test::table1(), heavier) - 1e-5 * end.state_by.col(1)).norm() <= 1e-3 * 1e-5 * end.state_by.norm());
}
