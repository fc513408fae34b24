// How fast is a sweep of a drive that has one effect, sensor, load or controller more than the nominal one: trials of
// the closed loop of fig. 10 (3 s at 1 kHz, metrics and monitor included), one after the other with power series and
// with CVODE, and as many as fit in the lanes of one register. sweep_effects [name of a row...] [--seconds per row]
#include <algorithm>
#include <cstdlib>
#include <functional>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "events/simulation_failure.hpp"
#include "simulation/load_scenario.hpp"
#include "simulation/run_batch.hpp"
#include "statistics/cpu_time.hpp"

using namespace wormdrive;

namespace {

/// What a scenario has beside the nominal one, in a strength of about 1 in which trials differ.
struct Addition {
  std::string_view name;
  std::function<void(Scenario&, double strength)> change;
};

template <class Effect>
void put(Scenario& scenario, const Effect& effect) {
  std::get<std::optional<Effect>>(scenario.effects.list) = effect;
}

const double degree = unit::degrees.si;

std::vector<Addition> additions(const Scenario& with_pid) {
  return {
      {"nominal", [](Scenario& s, double x) { std::get<MeshParameters<double>>(s.mesh).mu *= x; }},
      {"torque_gain", [](Scenario& s, double x) { put(s, TorqueGain<double>{0.1 * x}); }},
      {"torque_offset", [](Scenario& s, double x) { put(s, TorqueOffset<double>{1e-3 * x}); }},
      {"friction_asymmetry", [](Scenario& s, double x) { put(s, FrictionAsymmetry<double>{0.02 * x}); }},
      {"static_friction", [](Scenario& s, double x) { put(s, StaticFriction<double>{0.02 * x}); }},
      {"worm_coulomb", [](Scenario& s, double x) { put(s, WormCoulomb<double>{1e-3 * x}); }},
      {"bearing_asymmetry",
       [](Scenario& s, double x) {
         put(s, BearingAsymmetry<double>{5e-4 * x, 0.0});
       }},
      {"worm_viscous", [](Scenario& s, double x) { put(s, WormViscous<double>{1e-5 * x}); }},
      {"gear_viscous", [](Scenario& s, double x) { put(s, GearViscous<double>{1e-3 * x}); }},
      {"dc_motor",
       [](Scenario& s, double x) { put(s, DcMotor<double>{.resistance = 2.0 * x, .torque_constant = 0.05}); }},
      {"encoder_scale", [](Scenario& s, double x) { put(s, EncoderScale<double>{1e-3 * x}); }},
      {"encoder_offset", [](Scenario& s, double x) { put(s, EncoderOffset<double>{1e-3 * x}); }},
      {"encoder counts", [](Scenario& s, double x) { s.control->sensor.counts = std::round(40000 * x); }},
      {"encoder noise", [](Scenario& s, double x) { s.control->sensor.noise = 1e-5 * x; }},
      {"encoder_delay", [](Scenario& s, double x) { put(s, EncoderDelay<double>{2e-4 * x}); }},
      {"delay of a sample",
       [](Scenario& s, double x) {
         s.control->sampling.delay = 1.0;
         std::get<MeshParameters<double>>(s.mesh).mu *= x;
       }},
      {"disturbance", [](Scenario& s, double x) { s.control->disturbance.deviation = 1e-4 * x; }},
      {"saturation", [](Scenario& s, double x) { put(s, TorqueSaturation<double>{0.05 * x}); }},
      {"pid",
       [law = with_pid.control->law](Scenario& s, double x) {
         s.control->law = law;
         std::get<MeshParameters<double>>(s.mesh).mu *= x;
       }},
      {"constant load", [](Scenario& s, double x) { s.load = Signal{{Constant{0.0196 * x}}}; }},
      {"sinusoidal load",
       [](Scenario& s, double x) {
         s.load = Signal{{Sinusoid{.amplitude = 0.0196 * x, .frequency = 2.0, .phase = 0.3}}};
       }},
      {"table load",
       [](Scenario& s, double x) {
         std::vector<double> angles, torques;
         for (int k = -18; k <= 18; ++k) {
           angles.push_back(10.0 * k * degree);
           torques.push_back(0.0196 * x * std::cos(10.0 * k * degree));
         }
         s.load = LoadSum{{AngleTable(angles, torques)}};
       }},
      {"load_spring",
       [](Scenario& s, double x) {
         put(s, LoadSpring<double>{0.05 * x, 0.0});
       }},
      {"stribeck",
       [](Scenario& s, double x) {
         put(s, Stribeck<double>{0.05 * x, 0.1});
       }},
      {"agma", [](Scenario& s, double x) { put(s, Agma<double>{x}); }},
      {"position_friction",
       [](Scenario& s, double x) {
         put(s, PositionFriction<double>{0.2 * x, 0.0});
       }},
      {"friction_drift",
       [](Scenario& s, double x) {
         put(s, FrictionDrift<double>{0.1 * x, 3.0});
       }},
      {"cogging",
       [](Scenario& s, double x) {
         put(s, Cogging<double>{5e-4 * x, 4.0, 0.0});
       }},
      {"transmission_error",
       [](Scenario& s, double x) {
         put(s, TransmissionError<double>{0.05 * x * degree, 0.0});
       }},
      {"actuator_delay", [](Scenario& s, double x) { put(s, ActuatorDelay<double>{2e-4 * x}); }},
      {"actuator_lag", [](Scenario& s, double x) { put(s, ActuatorLag<double>{5e-4 * x}); }},
      {"torque_map",
       [](Scenario& s, double x) {
         put(s, TorqueMap<double>{MapAxis::worm_speed, x, {{-40, -10, 0, 10, 40}, {1e-3, 8e-4, 0, -8e-4, -1e-3}}});
       }},
      {"friction_map",
       [](Scenario& s, double x) {
         put(s, FrictionMap<double>{FrictionAxis::gear_angle,
                                    FrictionValue::share,
                                    x,
                                    {{-0.4, -0.1, 0, 0.1, 0.4}, {0.1, -0.1, 0.1, -0.1, 0.1}}});
       }},
      {"load_map",
       [](Scenario& s, double x) {
         put(s, LoadMap<double>{LoadAxis::time, x, {{0, 1, 2, 3}, {0, 0.1, -0.1, 0.1}}});
       }},
      {"vibration",
       [](Scenario& s, double x) {
         put(s, Vibration<double>{5e-4 * x, 20.0, 0.0});
       }},
      {"thread_friction",
       [](Scenario& s, double x) {
         put(s, ThreadFriction<double>{0.2 * x, 0.0});
       }},
      {"crank", [](Scenario& s, double x) { put(s, LoadCrank<double>{.mass = 0.05 * x, .crank = 0.02, .rod = 0.08}); }},
      // whose equations compare, or are others from a time on
      {"friction_under_load", [](Scenario& s, double x) { put(s, FrictionUnderLoad<double>{0.2 * x}); }},
      {"fan beside the arm",
       [](Scenario& s, double x) {
         s.load = LoadSum{{std::get<GravityArm>(s.load), Fan{.rated_torque = 0.01 * x, .rated_speed = 2.0}}};
       }},
      {"soft stops beside the arm",
       [](Scenario& s, double x) {
         s.load = LoadSum{{std::get<GravityArm>(s.load),
                           EndStops{.low = -0.13 * x, .high = 0.13 * x, .stiffness = 20.0, .damping = 0.1}}};
       }},
      {"brake", [](Scenario& s, double x) { put(s, HoldingBrake<double>{.torque = 0.01 * x, .opens = 0.1}); }},
      // with states
      {"winding",
       [](Scenario& s, double x) {
         put(s, DcMotor<double>{.resistance = 0.8, .torque_constant = 0.04, .inductance = 6e-4 * x});
       }},
      {"current loop",
       [](Scenario& s, double x) {
         put(s, DcMotor<double>{.resistance = 0.8,
                                .torque_constant = 0.04,
                                .inductance = 6e-4,
                                .supply_voltage = 24.0,
                                .current_bandwidth = 400.0 * x,
                                .current_limit = 8.0});
       }},
      {"warm winding",
       [](Scenario& s, double x) {
         put(s, DcMotor<double>{.resistance = 0.8,
                                .torque_constant = 0.04,
                                .heat_capacity = 20.0 * x,
                                .temperature_coefficient = 0.004});
       }},
      {"bristles",
       [](Scenario& s, double x) { put(s, WormLuGre<double>{.coulomb_torque = 2e-3, .stiffness = 0.5 * x}); }},
      {"warm gearbox",
       [](Scenario& s, double x) {
         put(s, GearboxHeat<double>{.friction_decay = 5e-3 * x, .heat_capacity = 100.0, .thermal_resistance = 1.0});
       }},
      {"twisting coupling",
       [](Scenario& s, double x) {
         put(s, LoadCoupling<double>{1e-3, 200.0 * x, 0.01});
       }},
      {"hard stops",
       [](Scenario& s, double x) {
         put(s, HardStops<double>{-6.0 * x, 6.0 * x});
       }},
  };
}

/// Trials per second of a core: batches of so many trials, repeated for at least so long [s]; the fastest counts, for
/// other programs slow a batch down and never speed it up.
double rate(int trials, double seconds, const std::function<void()>& batch) {
  double fastest = 0.0, spent = 0.0;
  for (int k = 0; k < 2 || spent < seconds; ++k) {
    const double begin = thread_cpu_time();
    batch();
    const double time = thread_cpu_time() - begin;
    spent += time;
    fastest = std::max(fastest, trials / time);
  }
  return fastest;
}

struct Rates {
  double together, alone, cvode;
};
Rates rates(const Scenario& nominal, const Addition& addition, double seconds) {
  constexpr int trials = 16;
  std::vector<Scenario> scenarios(trials, nominal);
  for (int k = 0; k < trials; ++k) addition.change(scenarios[k], 0.95 + 0.1 * k / (trials - 1));
  Scenario by_cvode = scenarios.front();
  by_cvode.run.solver = SolverKind::cvode;
  const auto runs = [](const Scenario& scenario) {
    try {
      run_scenario(scenario);
    } catch (const SimulationFailure& halt) {
      fmt::print(stderr, "{}\n", halt.what());
    }
  };
  return {rate(trials, seconds, [&] { run_batch(scenarios); }), rate(1, seconds, [&] { runs(scenarios.front()); }),
          rate(1, 0.0, [&] { runs(by_cvode); })};
}

}  // namespace

int main(int argc, char** argv) {
  double seconds = 0.2;
  std::vector<std::string_view> wanted;
  for (int k = 1; k < argc; ++k)
    if (std::string_view(argv[k]) == "--seconds" && k + 1 < argc)
      seconds = std::atof(argv[++k]);
    else
      wanted.push_back(argv[k]);
  const auto shipped = [](const std::string& name) {
    return load_scenario(WORMDRIVE_SCENARIOS "/" + name, {"run.solver=taylor", "run.report_interval_s=3"},
                         Purpose::run);
  };
  const Scenario nominal = shipped("fig10_sliding_014rad_bare.toml");
  const std::vector<Addition> all = additions(shipped("fig10_pid_014rad_bare.toml"));
  const double first = rates(nominal, all.front(), seconds).together;
  fmt::print("| on, or uncertain | in a sweep | alone | `cvode` | nominal / in a sweep | in a sweep / `cvode` |\n");
  fmt::print("|---|---|---|---|---|---|\n");
  for (const Addition& addition : all) {
    if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), addition.name) == wanted.end()) continue;
    const Rates r = rates(nominal, addition, seconds);
    const auto per_second = [](double x) { return x < 100 ? fmt::format("{:.1f}", x) : fmt::format("{:.0f}", x); };
    fmt::print("| {} | {} | {} | {} | {:.2f} | {:.3g} |\n", addition.name, per_second(r.together), per_second(r.alone),
               per_second(r.cvode), first / r.together, r.together / r.cvode);
    std::fflush(stdout);
  }
}
