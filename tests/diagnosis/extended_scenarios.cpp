// Whatever a diagnosis can find, the scenario that it writes is one that every command takes.
#include "catch.hpp"
#include "cli/program.hpp"
#include "description/build.hpp"
#include "description/diagnostics.hpp"
#include "description/rejection.hpp"
#include "description/toml/parse_scenario.hpp"
#include "description/toml/write_scenario.hpp"
#include "diagnosis/candidates/tolerances.hpp"
#include "diagnosis/points/candidates.hpp"
#include "diagnosis/recordings.hpp"
#include "diagnosis/verdict/extended_scenario.hpp"
#include "simulation/load_scenario.hpp"

namespace wormdrive::test::diagnosis_extended_scenarios {

namespace {

/// Drives of every kind that a diagnosis takes, ready to run.
std::vector<Scenario> stated_scenarios() {
  std::vector<Scenario> all;
  const auto add = [&](const std::string& file, const std::vector<std::string>& changes = {}) {
    all.push_back(load_scenario(shipped(file), changes, Purpose::run));
  };
  add("fig09_switching.toml");
  add("fig09_switching.toml", {"effect.agma.scale=1"});
  add("fig09_switching.toml", {"effect.stribeck.drop=0.05", "effect.stribeck.speed_m_per_s=0.02"});
  add("fig09_switching.toml",
      {"effect.worm_viscous.coefficient_Nms_per_rad=1e-5", "effect.worm_coulomb.torque_Nm=1e-3",
       "effect.static_friction.rise=0.02", "effect.transmission_error={amplitude_deg=0.02, phase_deg=0}"});
  add("fig09_switching.toml", {"run.solver=taylor"});
  add("fig09_backlash.toml");
  add("fig10_sliding_014rad_bare.toml");
  add("measured_servo_axis.toml");
  all.push_back(nominal_arm());
  all.back().run.duration = 1000.0;  // much longer than the recording
  return all;
}

/// Of a recording of eight seconds in which such a drive moves as on a bench.
Magnitudes typical_sizes(const Scenario& scenario) {
  const GearMesh<double> mesh = stated_mesh(scenario);
  Magnitudes m{.torque = 0.03, .largest_torque = 0.1, .rare_torques = {0.09, 0.08, 0.07}, .gear_speed = 1.0};
  m.has_teeth = mesh.has_teeth;
  m.worm_speed = mesh.i * m.gear_speed;
  m.worm_inertia = mesh.has_teeth ? mesh.Jw : mesh.Jg;
  m.load_torque = 0.3;
  if (mesh.has_teeth) {
    m.sliding_speed = mesh.sliding_speed(m.worm_speed);
    m.stated_friction = mesh.mu;
    m.friction = std::max(mesh.mu, std::tan(mesh.lambda) * std::cos(mesh.phi_n));
    m.gear_arm = mesh.gear_arm(0.0);
    m.gear_inertia = total_gear_inertia(scenario);
    m.has_worm_encoder = true;
  }
  m.duration = 8.0;
  m.period = 1e-3;
  m.load_turns = true;
  return m;
}

const std::string none;

/// Why a scenario is refused that a diagnosis has extended by what it has found; empty if it is not.
std::string refusal(const Scenario& stated, const Effects<double>& found) {
  std::vector<std::string> remarks;
  const std::string text = to_toml(extended_scenario(stated, found, {}, remarks));
  try {
    for (const Purpose purpose : {Purpose::run, Purpose::look}) {
      const Scenario again = parse_scenario(text, "extended.toml", {}, purpose);
      if (const auto why = why_it_cannot_run(again)) return *why;
      if (to_toml(again) != text) return "it is another one when it is read";
    }
  } catch (const InputFault& fault) {
    return fault.what();
  }
  return "";
}

}  // namespace

TEST_CASE("the scenario that a diagnosis extends by any one candidate is taken by check, run and diagnose") {
  for (const Scenario& stated : stated_scenarios()) {
    const Magnitudes sizes = typical_sizes(stated);
    for (const Candidate& candidate : candidates(stated.effects, sizes, toleranced_coordinates(stated, sizes, {}))) {
      for (const CandidateStart& start : candidate.starts)
        for (const double size : {-1.0, 1.0}) {  // one that shows
          const Coordinate& first = candidate.coordinates.front();
          std::vector<double> values = start.values;
          values.front() += size * first.scale;
          if (values.front() <= first.low || values.front() >= first.high) continue;  // a bound is no answer
          Effects<double> found = stated.effects;
          apply(found, candidate.coordinates, values);
          for (const FieldValue& f : start.chosen) set_field(found, f);
          INFO(stated.title << ": " << candidate.effect << " of " << values.front());
          CHECK(refusal(stated, found) == none);
        }
    }
  }
}

TEST_CASE("the same of candidates for torque points") {
  for (const Scenario& stated : stated_scenarios()) {
    for (const double speed : {0.0, 20.0}) {  // break-ins, and records at constant speed
      TorquePoints points;
      points.worm_speed = {speed, -0.5 * speed};
      points.load_torque = {0.3, 0.3};
      points.torque = {0.03, -0.01};
      for (const PointCandidate& candidate : point_candidates(stated, points))
        for (std::vector<double> values : candidate.starts)
          for (const double size : {-0.04, 0.04}) {  // one that shows
            const Coordinate& first = candidate.coordinates.front();
            values.front() = first.centre + size * first.scale;
            if (values.front() <= first.low || values.front() >= first.high) continue;
            Effects<double> found = stated.effects;
            apply(found, candidate.coordinates, values);
            INFO(stated.title << ": " << candidate.effect << " of " << values.front());
            CHECK(refusal(stated, found) == none);
          }
    }
  }
}

TEST_CASE("what elastic teeth exclude is left out beside them, and said") {
  const Scenario arm = nominal_arm();
  Effects<double> found;
  std::get<std::optional<Backlash<double>>>(found.list) = Backlash<double>{1e-3};
  std::get<std::optional<StaticFriction<double>>>(found.list) = StaticFriction<double>{0.05};
  std::get<std::optional<TransmissionError<double>>>(found.list) = TransmissionError<double>{1e-4};
  std::vector<std::string> remarks;
  const Scenario extended = extended_scenario(arm, found, {}, remarks);
  CHECK_FALSE(why_it_cannot_run(extended));
  CHECK(remarks == std::vector<std::string>{
                       "the extended scenario leaves static_friction out: elastic teeth hold with the friction of "
                       "sliding",
                       "the extended scenario leaves transmission_error out: elastic teeth run at an even pitch"});
}

TEST_CASE("a friction that would drift below nothing in a long run ends the run where the recording ends") {
  Scenario arm = nominal_arm();
  arm.run.duration = 100.0;
  Effects<double> found;
  std::get<std::optional<FrictionDrift<double>>>(found.list) = FrictionDrift<double>{-0.3, 8.0};
  std::vector<std::string> remarks;
  CHECK(extended_scenario(arm, found, {}, remarks).run.duration == 8.0);
  CHECK(remarks.size() == 1);
  arm.run.duration = 20.0;
  CHECK(extended_scenario(arm, found, {}, remarks).run.duration == 20.0);
  CHECK(remarks.size() == 1);
}

}  // namespace wormdrive::test::diagnosis_extended_scenarios
