#include "diagnosis/data/forgotten_load.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "description/diagnostics.hpp"
#include "diagnosis/data/torque_judge.hpp"
#include "diagnosis/rules/recordings.hpp"

namespace wormdrive {
namespace {

/// An arm with the share of the torque that it leaves unexplained.
struct Explained {
  double torque = 0.0, offset = 0.0, missed = 1e9;
};

/// What a torque offset and dry friction of the worm would leave, of the sizes that leave least: where a load's torque
/// hardly changes, it pulls and loads the teeth as these do.
double least_missed_by_constants(const TorqueJudge& judge, Scenario scenario, double largest) {
  auto& friction = std::get<std::optional<WormCoulomb<double>>>(scenario.effects.list);
  double least = judge.fit(scenario).missed_but_for_offset;
  const double stated = friction ? friction->torque : 0.0;
  for (double torque = largest; torque > largest / 100.0; torque /= 1.5) {
    friction = {stated + torque};
    least = std::min(least, judge.fit(scenario).missed_but_for_offset);
  }
  return least;
}

}  // namespace

void reject_forgotten_load(const RecordedTable& table, double period, const Scenario& scenario) {
  const auto* const mesh = std::get_if<MeshParameters<double>>(&scenario.mesh);
  const auto* const load = std::get_if<Signal>(&scenario.load);
  if (!mesh || !load || !load->terms.empty()) return;
  const TorqueJudge judge(table, table.torque.values, table.angle.values, period);
  const double as_it_is = judge.fit(scenario).missed_rms;

  Explained best;
  Scenario with = scenario;
  const auto look = [&](double torque, double offset) {
    GravityArm arm;
    arm.amplitude = torque;
    arm.offset = offset;
    with.load = arm;
    if (const double left = judge.fit(with).missed_rms; left < best.missed) best = {torque, offset, left};
  };
  // what the motor could hold without any loss, and less by the losses of a gear
  const double usual = median_size(table.torque.values), largest = mesh->i * usual;
  constexpr double turn = 2.0 * std::numbers::pi;
  for (double torque = 4.0 * largest; torque > largest / 40.0; torque /= 2.0)
    for (int k = 0; k < 12; ++k) look(torque, turn * k / 12.0);
  for (double step = 0.5; step > 0.02; step *= 0.6) {
    const Explained from = best;
    for (const double angle : {-step, 0.0, step})
      for (const double factor : {1.0 - 0.6 * step, 1.0, 1.0 + 0.6 * step})
        look(from.torque * factor, from.offset + angle);
  }
  if (best.missed > rules::less_with_load * least_missed_by_constants(judge, scenario, usual)) return;
  reject(
      table.where(),
      fmt::format("{} does not fit a drive without a load ({:.0f} % of it unaccounted for) but one with a mass on an "
                  "arm, about {:.2g} N m at an angle_offset of {:.0f} deg ({:.0f} %): state the [load]",
                  table.torque.name, 100.0 * std::min(as_it_is, 99.0), best.torque,
                  std::remainder(best.offset, turn) * 360.0 / turn, 100.0 * best.missed));
}

}  // namespace wormdrive
