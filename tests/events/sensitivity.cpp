#include <array>
#include <cmath>
#include <iostream>
#include <optional>
#include <type_traits>

#include "catch.hpp"
#include "lively_drive.hpp"

// The derivatives of a run by its parameters, through reversals, stick, break-away and changes of the flank.

namespace wormdrive::test::events_sensitivity {

namespace {

using namespace lively_drive;

/// A torque against the motion that is no line.
CubicTable map_over(const std::vector<double>& points) { return {points, {0.012, 0.01, 0.0, -0.009, -0.012}}; }

/// One of every effect of the rigid drive, of a size that shows.
Effects<double> one_of_each() {
  return effects(TorqueSaturation<double>{0.03}, ActuatorDelay<double>{0.007}, ActuatorLag<double>{0.004},
                 DcMotor<double>{12.0, 0.025}, TorqueGain<double>{0.05}, TorqueOffset<double>{0.001},
                 Cogging<double>{0.001, 2.0, 0.3}, WormCoulomb<double>{0.006}, WormViscous<double>{4e-5},
                 WormLuGre<double>{1e-3, 2e-3, 5.0}, BearingAsymmetry<double>{5e-4, 1e-5}, HoldingBrake<double>{0.001},
                 WormInertia<double>{2e-6}, Agma<double>{0.9}, MeshFriction<double>{0.01},
                 Stribeck<double>{0.03, 0.1, 1.0}, FrictionAsymmetry<double>{0.01}, PositionFriction<double>{0.1, 0.4},
                 ThreadFriction<double>{0.05, 0.9}, FrictionDrift<double>{0.05, 2.0}, StaticFriction<double>{0.1, 0.2},
                 GearboxHeat<double>{0.01, 1e-5, 0.02, {}, {}, 5.0},
                 TorqueMap<double>{MapAxis::worm_speed, 1.2, map_over({-120, -40, 0, 30, 120}), MapShaft::gear},
                 Vibration<double>{1e-3, 3.0, 0.4},
                 FrictionMap<double>{FrictionAxis::time, FrictionValue::share, 0.8, map_over({-1, 0, 1, 2, 4})},
                 LoadMap<double>{LoadAxis::gear_angle, 1.5, map_over({-3, -1, 0, 1, 3})},
                 TransmissionError<double>{0.005, 0.3}, GearCoulomb<double>{0.008}, GearViscous<double>{1e-4},
                 FrictionUnderLoad<double>{0.1}, GearInertia<double>{1e-4}, LoadMagnitude<double>{0.05},
                 LoadAngle<double>{0.05}, LoadSpring<double>{0.01, 0.2}, LoadCoupling<double>{1e-4},
                 LoadCrank<double>{0.2, 0.03, 0.07, 0.4}, LoadFourBar<double>{1e-4, 0.03, 0.07, 0.06, 0.08, 1.4},
                 EncoderScale<double>{0.01}, EncoderOffset<double>{0.01});
}

/// What makes the teeth elastic belongs to other drives; a late angle, stops and what has states alone have tests of
/// their own.
template <class Effect>
constexpr bool left_out = std::is_same_v<Effect, ToothCompliance<double>> || std::is_same_v<Effect, Backlash<double>> ||
                          std::is_same_v<Effect, EncoderDelay<double>> || std::is_same_v<Effect, HardStops<double>> ||
                          std::is_same_v<Effect, MeshLuGre<double>>;

}  // namespace

TEST_CASE("series, CVODES and differences agree within 1e-6 on the derivatives by every effect's parameters",
          "[slow]") {
  one_of_each().for_each([]<class Effect>(const std::optional<Effect>& effect) {
    if constexpr (!left_out<Effect>) {
      INFO(Effect::id << " of the catalogue is missing here");
      REQUIRE(effect.has_value());
      check_effect(*effect);
    }
  });
}

TEST_CASE("they agree where the parameters are zero, as they are where a fit starts", "[slow]") {
  const auto drive = lively(effects(
      TorqueGain<double>{}, TorqueOffset<double>{}, Cogging<double>{0.0, 24.0, 0.3}, BearingAsymmetry<double>{},
      WormInertia<double>{}, MeshFriction<double>{}, Stribeck<double>{0.0, 0.1, 2.0}, FrictionAsymmetry<double>{},
      PositionFriction<double>{0.0, 0.4}, ThreadFriction<double>{0.0, 0.9}, FrictionDrift<double>{0.0, 2.0},
      GearViscous<double>{}, GearInertia<double>{}, LoadMagnitude<double>{}, LoadAngle<double>{},
      LoadSpring<double>{0.0, 0.2}, TorqueMap<double>{MapAxis::gear_angle, 0.0, map_over({-2, -1, 0, 1, 2})},
      Vibration<double>{0.0, 3.0, 0.4}));
  std::vector<Parameter> zero;
  for (const Parameter& p : continuous_parameters(drive))
    if (p.value == 0.0 && p.table != "initial") zero.push_back(p);
  REQUIRE(zero.size() == 19);
  const auto found = agreement(drive, zero, Timetable(0, duration, 0.0131));
  std::cout << "at zero: series against CVODES " << found.cvodes << ", against differences " << found.differences
            << "\n";
}

TEST_CASE("they agree on the derivatives by the mesh and by the state at the start") {
  auto drive = lively();
  drive.initial = {0.1, 0.7};
  auto by = in_table(continuous_parameters(drive), "mesh");
  REQUIRE(by.size() == 8);
  for (const Parameter& p : in_table(continuous_parameters(drive), "initial")) by.push_back(p);
  const auto found = agreement(drive, by, Timetable(0, duration, 0.0131));
  std::cout << "mesh and start: series against CVODES " << found.cvodes << ", against differences " << found.differences
            << "\n";
}

TEST_CASE("they agree under a load that changes its law at the points of a table") {
  const AngleTable table({-3.0, -0.4, -0.1, 0.05, 0.3, 0.9, 3.0}, {0.03, 0.02, -0.03, 0.01, 0.025, -0.02, 0.01});
  const auto arm = lively(effects(LoadAngle<double>{0.05}));
  const RigidDrive drive{arm.mesh, {{table}}, arm.effects, arm.motor};
  const auto found =
      agreement(drive, {parameter(drive, "load_angle", "angle"), parameter(drive, "worm_coulomb", "torque")},
                Timetable(0, duration, 0.0131));
  std::cout << "table: series against CVODES " << found.cvodes << ", against differences " << found.differences << "\n";
}

TEST_CASE("they agree where knots of the command move with its delay, at a limit and through a lag") {
  for (const bool lags : {false, true}) {
    Effects<double> on =
        effects(TorqueSaturation<double>{0.03}, ActuatorDelay<double>{0.0073}, TorqueGain<double>{0.02});
    if (lags) std::get<std::optional<ActuatorLag<double>>>(on.list) = {0.004};
    auto drive = lively(on);
    for (const double t : {0.31, 0.77, 1.43, 1.69})
      drive.motor.terms.push_back(Step{.torque = (t > 1.5 ? -0.02 : 0.01), .time = t});
    auto by = in_table(continuous_parameters(drive), "actuator_delay");
    for (const auto* table : {"torque_saturation", "actuator_lag", "torque_gain", "worm_coulomb"})
      for (const Parameter& p : in_table(continuous_parameters(drive), table)) by.push_back(p);
    REQUIRE(by.size() == (lags ? 5 : 4));
    const auto found = agreement(drive, by, Timetable(0, duration, 0.0131));
    std::cout << "steps" << (lags ? " with a lag" : "") << ": series against CVODES " << found.cvodes
              << ", against differences " << found.differences << "\n";
  }
}

TEST_CASE("a measured angle that comes late is an earlier one: its derivative by the delay is minus the speed") {
  const auto drive = lively(effects(EncoderDelay<double>{0.01}, EncoderScale<double>{0.02}));
  const std::array by{parameter(drive, "encoder_delay", "delay")};
  for (const By solver : every_solver) {
    const Sensitivities s = sensitivities(drive, by, Timetable(0, duration, 0.0131), tight(solver, 1e-12));
    for (const auto& row : s.rows) {
      CHECK(std::abs(row.measured_by[0] + 1.02 * row.state[1]) <= 1e-15);
      CHECK(row.state_by.isZero(0.0));
    }
  }
}

}  // namespace wormdrive::test::events_sensitivity
