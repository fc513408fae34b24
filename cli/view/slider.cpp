#include "cli/view/slider.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "description/diagnostics.hpp"
#include "description/keys.hpp"
#include "description/number_text.hpp"

namespace wormdrive {
namespace {

/// Tables whose numbers say how a run is computed or judged, not what the drive is.
bool is_of_the_run(const std::string& key) {
  return key.starts_with("run.") || key.starts_with("metrics.") || key.starts_with("tolerance.") ||
         key.starts_with("limits.");
}

/// The farthest of some values, from the most to the least, that a scenario admits; else the value itself.
double farthest(const Quantity& q, std::initializer_list<double> factors, const Admits& admits) {
  for (const double factor : factors)
    if (admits(q.name, factor * q.value)) return factor * q.value;
  return q.value;
}

/// Nothing where a quantity cannot be changed: a count, a number of points.
std::optional<Slider> around(const Quantity& q, const Admits& admits) {
  const double less = farthest(q, {0.5, 0.75, 0.9}, admits), more = farthest(q, {2.0, 1.5, 1.25, 1.1}, admits);
  if (less == more) return std::nullopt;
  return Slider{q, std::min(less, more), std::max(less, more)};
}

[[noreturn]] void fault(const std::string& wanted, const std::string& what) { reject({"--vary " + wanted}, what); }

Slider ranged(const Quantity& q, const std::string& wanted, const std::string& range) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const std::size_t dots = range.find("..");
  const double low = number_in(range.substr(0, dots)).value_or(none),
               high = dots == std::string::npos ? none : number_in(range.substr(dots + 2)).value_or(none);
  if (!(low < high)) fault(wanted, fmt::format("'{}' is no range; it reads low..high", range));
  return {q, low, high};
}

Slider chosen(const std::vector<Quantity>& all, const std::string& wanted, const Admits& admits) {
  const std::size_t equals = wanted.find('=');
  const std::string key = wanted.substr(0, equals);
  const auto found = std::find_if(all.begin(), all.end(), [&](const Quantity& q) { return q.name == key; });
  if (found == all.end()) {
    std::vector<std::string> keys;
    for (const Quantity& q : all) keys.push_back(q.name);
    const auto meant = probably_meant(key, keys);
    fault(wanted, fmt::format("the scenario has no number '{}'; {}", key,
                              meant ? fmt::format("did you mean '{}'?", *meant) : "wormdrive check lists its numbers"));
  }
  if (equals != std::string::npos) return ranged(*found, wanted, wanted.substr(equals + 1));
  if (found->value == 0.0)
    fault(wanted, fmt::format("'{}' is 0, which gives no range; state one: {}=low..high", key, key));
  if (auto slider = around(*found, admits)) return *slider;
  fault(wanted, fmt::format("'{}' cannot be changed by a slider", key));
}

}  // namespace

std::vector<Slider> sliders(const Scenario& scenario, const std::vector<std::string>& wanted, const Admits& admits) {
  const std::vector<Quantity> all = parameters(scenario);
  std::vector<Slider> list;
  for (const std::string& one : wanted) list.push_back(chosen(all, one, admits));
  if (!wanted.empty()) return list;
  for (const Quantity& q : all)
    if (q.value != 0.0 && !is_of_the_run(q.name))
      if (auto slider = around(q, admits)) list.push_back(*slider);
  return list;
}

}  // namespace wormdrive
