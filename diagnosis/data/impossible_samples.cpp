#include "diagnosis/data/impossible_samples.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "diagnosis/data/needed_torque.hpp"
#include "diagnosis/rules/recordings.hpp"
#include "statistics/robust.hpp"

namespace wormdrive {
namespace {

/// How far off a straight line the readings of an encoder may be.
struct Straightness {
  double tolerance, bend;

  Straightness(const std::vector<double>& y, const std::vector<std::uint8_t>& valid, const SampleLimits& limits)
      : bend(limits.largest_acceleration * limits.period * limits.period) {
    std::vector<double> seconds;
    for (std::size_t k = 1; k + 1 < y.size(); ++k)
      if (valid[k - 1] && valid[k] && valid[k + 1]) seconds.push_back(y[k + 1] - 2.0 * y[k] + y[k - 1]);
    const double deviation = seconds.empty() ? 0.0 : robust_deviation(std::move(seconds));
    tolerance = rules::impossible_deviations * std::max(deviation, resolution(y, valid));
  }
};

/// The readings of an encoder, and how far a sample may lie from where its neighbours put it.
class Path {
 public:
  Path(std::span<double> y, const Straightness& straight) : y_(y), straight_(straight) {}

  /// Whether the samples a < b continue what ends with the samples before k.
  bool continues(std::size_t k, std::size_t at) const {
    const std::size_t reach = std::min<std::size_t>(3, k - 1);
    const double slope = (y_[k - 1] - y_[k - 1 - reach]) / static_cast<double>(reach);
    const double ahead = static_cast<double>(at - k + 1), span = ahead + static_cast<double>(reach);
    return std::abs(y_[at] - y_[k - 1] - slope * ahead) <
           straight_.tolerance * (1.0 + ahead / static_cast<double>(reach)) + straight_.bend * span * span;
  }
  void bridge(std::size_t from, std::size_t to) {
    for (std::size_t k = from; k < to; ++k)
      y_[k] = y_[from - 1] +
              (y_[to] - y_[from - 1]) * static_cast<double>(k - from + 1) / static_cast<double>(to - from + 1);
  }

 private:
  std::span<double> y_;
  const Straightness& straight_;
};

[[noreturn]] void refuse_jump(const RecordedTable& table, const RecordedValues& angle, std::size_t k) {
  const double jump = angle.values[k] - angle.values[k - 1], turns = jump / (2.0 * std::numbers::pi);
  const bool within_a_turn = std::abs(turns) > 0.5 && std::abs(turns - std::round(turns)) < rules::near_whole_turn;
  reject(table.where(k),
         fmt::format("{} jumps from {:.6g} to {:.6g} within one sample: {}", angle.name,
                     angle.in_file(angle.values[k - 1]), angle.in_file(angle.values[k]),
                     within_a_turn ? "it is counted within one turn; unwrap it"
                                   : "no drive moves so fast; cut the recording there or mend its encoder"));
}

/// Readings that stand still beside samples at which the gear moved at a speed that nothing reaches so soon, but an
/// impact of teeth with a gap, on one side.
void refuse_standing(const RecordedTable& table, const RecordedValues& angle, const std::vector<std::uint8_t>& valid,
                     const SampleLimits& limits) {
  const std::vector<double>& y = angle.values;
  const auto [low, high] = std::minmax_element(y.begin(), y.end());
  constexpr std::size_t look = rules::beside_standstill;
  const double sudden =
      rules::impossible_start * limits.largest_acceleration * static_cast<double>(look) * limits.period +
      rules::rounding_of_speed * resolution(y, valid) / (static_cast<double>(look - 1) * limits.period);
  // speed between two samples, or between the first and the one before the second, should that be a wrong one
  const auto speed = [&](std::size_t a, std::size_t b) {
    const double steps = static_cast<double>(b - a);
    const double all = (y[b] - y[a]) / (steps * limits.period);
    const double fewer = (y[b - 1] - y[a]) / ((steps - 1.0) * limits.period);
    return std::min(std::abs(all), std::abs(fewer));
  };
  for (std::size_t from = 0; from < y.size();) {
    std::size_t to = from + 1, readings = valid[from];  // rows put in between two equal readings are none
    for (; to < y.size() && y[to] == y[from]; ++to) readings += valid[to];
    if (readings >= rules::standing_readings) {
      const double before = from < look || table.crosses_pause(from, look) ? 0.0 : speed(from - look, from - 1);
      const double after = to + look > y.size() || table.crosses_pause(to, look) ? 0.0 : speed(to, to + look - 1);
      if (std::min(before, after) > sudden || std::max(before, after) > std::max(sudden, limits.impact_speed))
        reject(
            table.where(from),
            fmt::format("{} stands at {:.6g} from {:.4g} s to {:.4g} s and moves at {:.2g} {} just {}: the encoder {}",
                        angle.name, angle.in_file(y[from]), table.time.values[from], table.time.values[to - 1],
                        std::max(before, after), units_on(table.axis, "rad/s"), before > after ? "before" : "after",
                        y[from] == *low || y[from] == *high ? "is at the end of its range" : "was stuck"));
    }
    from = to;
  }
}

std::string group_told(const RecordedTable& table, const std::string& what, double value, std::size_t from,
                       std::size_t to) {
  const std::string where = table.has_lines ? fmt::format(" (line {})", table.where(from).line) : "";
  if (to - from == 1)
    return fmt::format("left out: {} = {:.6g} at {:.6g} s{}, which no measurement can have given", what, value,
                       table.time.values[from], where);
  return fmt::format("left out: {} from {:.6g} s to {:.6g} s{}, {} samples that no measurement can have given", what,
                     table.time.values[from], table.time.values[to - 1], where, to - from);
}

/// Follows an angle from an undisturbed stretch on, backward to the begin and forward to the end, and leaves out what
/// is off its path.
template <class Leave>
void follow(const RecordedTable& table, RecordedValues& angle, std::size_t begin, std::size_t end,
            const Straightness& straight, Leave&& leave) {
  const std::span<double> y = std::span(angle.values).subspan(begin, end - begin);
  if (y.size() <= rules::undisturbed_samples) return;
  Path path(y, straight);
  std::reverse(y.begin(), y.end());
  for (const bool reversed : {true, false}) {
    for (std::size_t k = reversed ? y.size() - rules::undisturbed_samples : rules::undisturbed_samples; k < y.size();
         ++k) {
      if (path.continues(k, k)) continue;
      std::size_t back = k + 1;
      while (back < y.size() && back - k <= rules::longest_impossible && !path.continues(k, back)) ++back;
      if (back < y.size() && back - k > rules::longest_impossible) {
        if (reversed) break;
        refuse_jump(table, angle, begin + k);
      }
      const std::size_t from = begin + (reversed ? y.size() - back : k);
      leave(angle.name, angle.in_file(y[k]), from, from + (back - k));
      if (back < y.size())
        path.bridge(k, back);
      else
        std::fill(y.begin() + static_cast<std::ptrdiff_t>(k), y.end(), y[k - 1]);
    }
    if (reversed) std::reverse(y.begin(), y.end());
  }
}

}  // namespace

double widest_gap(double ratio) { return rules::widest_gap * 2.0 * std::numbers::pi / ratio; }

SampleLimits sample_limits(const Scenario& scenario, double period, const std::vector<double>& torque) {
  const double peak = usual_peak(torque);
  SampleLimits limits{period, largest_acceleration(scenario, peak), 1.0, 0.0};
  if (const auto* const mesh = std::get_if<MeshParameters<double>>(&scenario.mesh)) {
    limits.ratio = mesh->i;
    limits.impact_speed = std::sqrt(2.0 * widest_gap(mesh->i) * peak / (mesh->Jw * mesh->i));
  }
  return limits;
}

double resolution(const std::vector<double>& angles, const std::vector<std::uint8_t>& valid) {
  std::vector<double> sorted;
  for (std::size_t k = 0; k < angles.size(); ++k)
    if (valid[k]) sorted.push_back(angles[k]);
  if (sorted.empty()) return 0.0;
  std::sort(sorted.begin(), sorted.end());
  const double range = sorted.back() - sorted.front();
  std::vector<double> steps;
  for (std::size_t k = 1; k < sorted.size(); ++k)
    if (sorted[k] - sorted[k - 1] > 1e-9 * range) steps.push_back(sorted[k] - sorted[k - 1]);
  if (steps.size() < rules::fewest_differences) return 0.0;
  std::sort(steps.begin(), steps.end());
  const double step = steps[steps.size() / 500];  // not the very smallest: a last digit may round
  // readings of an encoder differ by whole steps; only small differences can tell
  double near = 0.0, whole = 0.0;
  for (const double s : steps) {
    if (s > rules::largest_telling_difference * step) break;
    near += 1.0;
    whole += std::abs(s / step - std::round(s / step)) < rules::near_whole_reading ? 1.0 : 0.0;
  }
  return whole > rules::least_whole_readings * near ? step : 0.0;
}

std::vector<std::string> leave_out_impossible(RecordedTable& table, const SampleLimits& limits,
                                              std::vector<std::uint8_t>& valid) {
  std::vector<std::string> remarks;
  std::size_t left_out = 0;
  const auto leave = [&](const std::string& what, double value, std::size_t from, std::size_t to) {
    remarks.push_back(group_told(table, what, value, from, to));
    for (std::size_t k = from; k < to; ++k) valid[k] = 0;
    left_out += to - from;
  };
  std::vector<double>& u = table.torque.values;
  // a drive that rests most of the time has torques far from the median too, but never one of a size all its own
  const double middle = median(u);
  std::vector<double> sizes;
  for (const double torque : u) sizes.push_back(torque - middle);
  const double far = std::max(rules::impossible_deviations * robust_deviation(u),
                              rules::impossible_peaks * usual_peak(std::move(sizes)));
  for (std::size_t k = 0; k < u.size(); ++k) {
    if (far == 0.0 || std::abs(u[k] - middle) <= far) continue;
    leave(table.torque.name, table.torque.in_file(u[k]), k, k + 1);
    u[k] = k > 0 ? u[k - 1] : middle;
  }
  SampleLimits of_worm = limits;
  of_worm.largest_acceleration *= limits.ratio;
  of_worm.impact_speed *= limits.ratio;
  for (const auto& [angle, own] : {std::pair{&table.angle, limits}, std::pair{&table.worm_angle, of_worm}}) {
    std::vector<double>& y = angle->values;
    if (y.empty()) continue;
    refuse_standing(table, *angle, valid, own);
    const Straightness straight(y, valid, own);
    std::size_t begin = 0;
    for (std::size_t stretch = 0; stretch <= table.restarts.size(); ++stretch) {
      const std::size_t end = stretch < table.restarts.size() ? table.restarts[stretch] : y.size();
      follow(table, *angle, begin, end, straight, leave);
      begin = end;
    }
  }
  if (static_cast<double>(left_out) > rules::most_impossible * static_cast<double>(u.size()))
    reject(table.where(),
           fmt::format("{} of {} samples are such that no measurement can have given them", left_out, u.size()));
  return remarks;
}

}  // namespace wormdrive
