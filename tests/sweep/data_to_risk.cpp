#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "catch.hpp"
#include "cli/program.hpp"
#include "description/toml/parse_scenario.hpp"
#include "description/toml/write_scenario.hpp"
#include "diagnosis/report/uncertainty_study.hpp"
#include "sweep/study/load_study.hpp"
#include "sweep/trial.hpp"

// From what data leave open to how often a limit is missed: where all is linear and normal, in closed form.

namespace wormdrive::test::sweep_data_to_risk {
namespace {

/// A motor that lifts a constant load with a constant torque, for a second.
Scenario hoist() {
  return parse_scenario(good_scenario, "hoist.toml",
                        {"motor.torque.torque_Nm=0.05", "load.torque_Nm=-0.2", "effect.torque_offset.torque_Nm=1e-3",
                         "effect.worm_coulomb.torque_Nm=5e-3", "effect.load_magnitude.share=0.02", "run.duration_s=1",
                         "run.solver=taylor"},
                        Purpose::run);
}

/// A diagnosis of it that leaves three numbers open, which depend on each other.
Diagnosis diagnosed() {
  Diagnosis d;
  d.extended = hoist();
  d.uncertainty = {{"torque_offset", "worm_coulomb", "load_magnitude"},
                   {{"torque", unit::newton_metre, 1e-3, 1e-3, 0.0, 0.0},
                    {"torque", unit::newton_metre, 5e-3, 5e-4, 0.0, 0.0},
                    {"share", unit::none, 0.02, 0.05, 0.0, 0.0}},
                   {{1.0, 0.7, -0.6}, {0.7, 1.0, -0.5}, {-0.6, -0.5, 1.0}}};
  return d;
}

/// The speed of the gear after a second, and how it changes with each of the three numbers: forward against the load
/// [YehWu2009, eq. 18].
struct Linear {
  double speed;
  std::vector<double> gradient;
};
Linear in_closed_form() {
  const double lambda = 4 * std::numbers::pi / 180, phi = 20 * std::numbers::pi / 180, mu = 0.25;
  const double C = 0.011 / 0.045 * (std::cos(phi) * std::sin(lambda) + mu * std::cos(lambda)) /
                   (std::cos(phi) * std::cos(lambda) - mu * std::sin(lambda));
  const double inertia = 2.53e-5 * 60 + C * 7.39e-4;
  return {(0.05 + 1e-3 - 5e-3 - C * 0.2 * 1.02) / inertia, {1.0 / inertia, -1.0 / inertia, -C * 0.2 / inertia}};
}

}  // namespace

TEST_CASE("the risk that data leave is that of the closed form where all is linear and normal", "[sweep]") {
  const Diagnosis d = diagnosed();
  const Linear linear = in_closed_form();
  double variance = 0.0;
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b)
      variance += linear.gradient[a] * linear.gradient[b] * d.uncertainty.numbers[a].standard_error *
                  d.uncertainty.numbers[b].standard_error * d.uncertainty.correlation[a][b];
  const double deviation = std::sqrt(variance);

  constexpr int trials = 20'000;
  const std::string text =
      edited(uncertainty_study(d), "\ntrials = 1000", "\ntrials = " + std::to_string(trials)) +
      "\n[[threshold]]\nmetric = \"final_gear_speed\"\nbelow_rad_per_s = " + std::to_string(linear.speed - deviation) +
      "\n";
  const Study study = parse_study(text, to_toml(d.extended), "uncertainty.toml");
  REQUIRE(study.thresholds.size() == 1);
  std::size_t metric = 0;
  while (study.metrics[metric].name != "final_gear_speed") ++metric;
  double sum = 0.0, squares = 0.0;
  int missed = 0;
  Trials made(study);
  made.make({0, trials}, [&](const Trial& trial) {
    REQUIRE(trial.status == TrialStatus::done);
    const double z = (trial.metrics[metric] - linear.speed) / deviation;
    sum += z;
    squares += z * z;
    missed += study.thresholds[0].missed_by(trial.metrics[metric]);
  });
  const double error = 4.0 / std::sqrt(trials);  // four standard errors of what is 1
  CHECK(std::abs(sum / trials) < error);
  CHECK(std::abs(squares / trials - 1.0) < std::sqrt(2.0) * error);
  const double expected = 0.5 * std::erfc(std::sqrt(0.5));  // one deviation below the mean
  CHECK(std::abs(static_cast<double>(missed) / trials - expected) < std::sqrt(expected * (1.0 - expected)) * error);
}

}  // namespace wormdrive::test::sweep_data_to_risk
