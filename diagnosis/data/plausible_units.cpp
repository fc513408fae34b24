#include "diagnosis/data/plausible_units.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "description/keys.hpp"
#include "diagnosis/data/impossible_samples.hpp"
#include "diagnosis/data/needed_torque.hpp"
#include "diagnosis/data/torque_judge.hpp"
#include "diagnosis/rules/recordings.hpp"

namespace wormdrive {
namespace {

bool is_near(double factor, double expected, double share) { return std::abs(factor / expected - 1.0) < share; }

using Values = std::vector<double>;

Values times(Values values, double factor) {
  for (double& value : values) value *= factor;
  return values;
}

double span(const Values& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *high - *low;
}

/// What is said if the recording would be that of the drive when read so.
struct Reading {
  std::string says;
  Values torque, angle;
  bool of_sign = false;  ///< it changes nothing else
};

/// With another sign; other columns and units only where the ones that are written are in doubt.
std::vector<Reading> readings(const RecordedTable& table, const Scenario& scenario, bool is_in_doubt) {
  const Values &u = table.torque.values, &y = table.angle.values;
  const std::string &torque = table.torque.name, &angle = table.angle.name;
  std::vector<Reading> all{{fmt::format("{} fits the drive with the opposite sign", torque), times(u, -1.0), y, true},
                           {fmt::format("{} fits the drive with the opposite sign", angle), u, times(y, -1.0), true}};
  if (!is_in_doubt) return all;
  all.push_back({fmt::format("{} and {} fit the drive when they are swapped", torque, angle), y, u});
  all.push_back({fmt::format("{} fits the drive when it is read in m{}", torque, units_on(scenario.axis, "N m")),
                 times(u, 1e-3), y});
  if (scenario.axis == Axis::linear) return all;
  constexpr double pi = std::numbers::pi;
  all.push_back({fmt::format("{} fits the drive when it is read in degrees", angle), u, times(y, pi / 180.0)});
  all.push_back({fmt::format("{} fits the drive when it is read in turns", angle), u, times(y, 2.0 * pi)});
  all.push_back(
      {fmt::format("{} fits the drive when it is read in rad, not in degrees", angle), u, times(y, 180.0 / pi)});
  if (const auto* worm = std::get_if<MeshParameters<double>>(&scenario.mesh))
    all.push_back(
        {fmt::format("{} fits the drive when it is the angle of the worm", angle), u, times(y, 1.0 / worm->i)});
  return all;
}

void refuse_rest(const RecordedTable& table, const RecordedValues& column, const std::string& consequence) {
  const Values& values = column.values;
  if (span(values) == 0.0)
    reject(table.where(),
           fmt::format("{} is {:.6g} throughout: {}", column.name, column.in_file(values.front()), consequence));
}

/// Where a speed leads to from 0.
Values integral(const Values& speed, double period) {
  Values angle(speed.size(), 0.0);
  for (std::size_t k = 1; k < speed.size(); ++k) angle[k] = angle[k - 1] + 0.5 * period * (speed[k - 1] + speed[k]);
  return angle;
}

/// A speed that is recorded beside the angle has to be its derivative. The slope of where it leads to is compared with
/// that of the angle: both lose the same of what is fast for the log.
void refuse_other_speed(const RecordedTable& table, double period, const Scenario& scenario) {
  if (table.speed.values.empty()) return;
  const std::size_t half_width = slope_half_width(period);
  const Values speed = measured_motion(table.angle.values, period, half_width).speed;
  const Values recorded = measured_motion(integral(table.speed.values, period), period, half_width).speed;
  double product = 0.0, square = 0.0, other = 0.0;
  for (std::size_t k = 0; k < speed.size(); ++k) {
    if (table.crosses_pause(k, half_width)) continue;
    product += speed[k] * recorded[k];
    square += speed[k] * speed[k];
    other += recorded[k] * recorded[k];
  }
  if (square == 0.0 || other == 0.0) return;
  const double factor = product / square;
  if (product * product > rules::least_speed_likeness * square * other && factor * rules::most_speed_factor > 1.0 &&
      factor < rules::most_speed_factor)
    return;
  const auto is = [&](double expected) { return is_near(factor, expected, rules::near_unit); };
  std::string why = "is not the derivative of";
  if (is(30.0 / std::numbers::pi)) why = "is in rpm, which does not match";
  if (is(180.0 / std::numbers::pi)) why = "is in degrees per second, which does not match";
  if (const auto* worm = std::get_if<MeshParameters<double>>(&scenario.mesh))
    if (is(worm->i)) why = "is the speed of the worm, which does not match";
  reject(table.where(),
         fmt::format("{} {} {}: {:.3g} times its derivative", table.speed.name, why, table.angle.name, factor));
}

/// A worm turns as often as the ratio says, whatever drives it: how its angle goes with the gear's tells the ratio.
void refuse_other_ratio(const RecordedTable& table, const Scenario& scenario) {
  const auto* const mesh = std::get_if<MeshParameters<double>>(&scenario.mesh);
  const Values &worm = table.worm_angle.values, &gear = table.angle.values;
  if (!mesh || worm.empty()) return;
  const double n = static_cast<double>(worm.size());
  double worm_mean = 0.0, gear_mean = 0.0, product = 0.0, square = 0.0, other = 0.0;
  for (std::size_t k = 0; k < worm.size(); ++k) {
    worm_mean += worm[k] / n;
    gear_mean += gear[k] / n;
  }
  for (std::size_t k = 0; k < worm.size(); ++k) {
    product += (worm[k] - worm_mean) * (gear[k] - gear_mean);
    square += std::pow(gear[k] - gear_mean, 2);
    other += std::pow(worm[k] - worm_mean, 2);
  }
  if (square == 0.0 || product * product < rules::least_meshing * square * other) return;
  const double ratio = product / square;
  if (std::abs(ratio / mesh->i - 1.0) < rules::other_ratio) return;
  const auto is = [&](double expected) { return is_near(ratio, expected, rules::near_ratio); };
  const std::string remedy = is(-mesh->i)                             ? "turn its sign"
                             : is(1.0)                                ? "it is counted at the gear"
                             : is(mesh->i * 180.0 / std::numbers::pi) ? "it is in degrees"
                             : is(mesh->i / (2.0 * std::numbers::pi)) ? "it is in turns"
                                                                      : fmt::format("state ratio = {:.4g}", ratio);
  reject(table.where(), fmt::format("{} goes {:.4g} times as far as {}, where the scenario states a ratio of {:g}: {}",
                                    table.worm_angle.name, ratio, table.angle.name, mesh->i, remedy));
}

/// What an arm that stands at another angle than stated would leave, which is a matter of the diagnosis.
double least_missed_by_turned_arm(const TorqueJudge& judge, Scenario scenario) {
  double least = std::numeric_limits<double>::infinity();
  if (auto* const arm = std::get_if<GravityArm>(&scenario.load))
    for (int k = 1; k < 12; ++k) {
      arm->offset += std::numbers::pi / 6.0;
      least = std::min(least, judge.fit(scenario).missed);
    }
  return least;
}

}  // namespace

void refuse_implausible_units(const RecordedTable& table, const std::vector<std::uint8_t>& there, double period,
                              const Scenario& scenario) {
  refuse_rest(table, table.torque,
              in_words_of(scenario.axis, "a torque that never changes shows nothing of the drive"));
  refuse_rest(table, table.angle,
              scenario.axis == Axis::linear ? "nothing ever moved, or its encoder was stuck"
                                            : "the gear never moved, or its encoder was stuck");
  const double step = resolution(table.angle.values, there);
  if (span(table.angle.values) < rules::least_motion * step)
    reject(
        table.where(),
        fmt::format("{} moves by {:.3g} {}, less than {:g} steps of its encoder: too little to learn from",
                    table.angle.name, span(table.angle.values), units_on(scenario.axis, "rad"), rules::least_motion));
  refuse_other_speed(table, period, scenario);
  refuse_other_ratio(table, scenario);
  const TorqueJudge judge(table, table.torque.values, table.angle.values, period);
  const double as_is = judge.fit(scenario).missed;
  std::optional<Reading> best;
  double least = std::numeric_limits<double>::infinity();
  for (Reading& reading : readings(table, scenario, as_is >= rules::too_much_unaccounted)) {
    const double missed = TorqueJudge(table, reading.torque, reading.angle, period).fit(scenario).missed;
    if (missed >= least) continue;
    least = missed;
    best = std::move(reading);
  }
  if (!best || least >= rules::clearly_less * as_is) return;
  // a sign leaves all sizes as they are, so that no other slip passes for it but an arm that stands elsewhere
  const double turned = least_missed_by_turned_arm(judge, scenario);
  if (best->of_sign ? least >= rules::clearly_less * turned : least >= rules::well_accounted || least >= turned) return;
  reject(table.where(),
         fmt::format("{}, not as it stands ({:.0f} % of the {} unaccounted for, {:.0f} % as it stands)", best->says,
                     100.0 * least, in_words_of(scenario.axis, "torque"), 100.0 * std::min(as_is, 99.0)));
}

void refuse_implausible_size(const RecordedTable& table, double period, const Scenario& scenario) {
  if (!std::holds_alternative<MeshParameters<double>>(scenario.mesh)) return;
  const TorqueFit as_is = TorqueJudge(table, table.torque.values, table.angle.values, period).fit(scenario);
  const auto wrong = [](double factor) { return factor > rules::wrong_size || factor * rules::wrong_size < 1.0; };
  if (!(as_is.missed > rules::too_much_unaccounted && wrong(as_is.factor) && wrong(as_is.factor_rms))) return;
  const bool in_degrees = is_near(as_is.factor, std::numbers::pi / 180.0, rules::near_unit);
  reject(table.where(),
         fmt::format("{} is {:.2g} times what the drive of the scenario needs for this motion: wrong unit, or wrong "
                     "scenario{}",
                     table.torque.name, as_is.factor,
                     in_degrees ? fmt::format("; so it is if {} is in degrees", table.angle.name) : ""));
}

}  // namespace wormdrive
