#include "sweep/metrics/metric.hpp"

#include <cmath>

#include <fmt/format.h>

#include "description/build_control.hpp"
#include "description/keys.hpp"
#include "simulation/write_run.hpp"

namespace wormdrive {
namespace {

void add_tracking(std::vector<Metric>& list, bool follows) {
  for_each_field<Metrics>([&](const auto& field) {
    if (!follows && is_of_tracking(field.member)) return;
    list.push_back({std::string(field.name), field.unit, std::string(field.meaning),
                    [member = field.member](const Outcome& o) { return o.run.control->metrics.*member; }});
  });
}

void add_lemma1(std::vector<Metric>& list, const Scenario& scenario) {
  list.push_back({"layer_reached", unit::second, "first sample within the boundary layer",
                  [](const Outcome& o) { return o.run.control->lemma->reached(); },
                  std::numeric_limits<double>::infinity()});
  const auto promises = make_monitor(scenario.control->law, make_lemma1(scenario))->violations();
  for (std::size_t k = 0; k < promises.size(); ++k)
    list.push_back({fmt::format("{}_violations", promises[k].name), unit::none,
                    fmt::format("samples that broke {}", promises[k].promise),
                    [k, duration = scenario.run.duration](const Outcome& o) {
                      const Lemma1Monitor& lemma = *o.run.control->lemma;
                      return judged_violations(lemma, lemma.violations()[k], duration);
                    }});
  const std::vector<Condition> conditions = lemma1_conditions(scenario);
  for (std::size_t k = 0; k < conditions.size(); ++k) {
    list.push_back({fmt::format("condition_{}", k + 1), unit::none,
                    fmt::format("margin of {}, negative if it fails", conditions[k].rule),
                    [k](const Outcome& o) { return o.conditions[k].margin(); }});
    list.back().least_is_worst = true;
    list.back().condition = conditions[k];
  }
}

}  // namespace

std::vector<Metric> metrics_of(const Scenario& scenario) {
  std::vector<Metric> list;
  if (scenario.control) add_tracking(list, !scenario.control->reference.terms.empty());
  if (scenario.control && std::holds_alternative<SlidingParameters>(scenario.control->law)) add_lemma1(list, scenario);
  const RunContents contents = contents_of(scenario);
  for (const EventKind kind : event_kinds)
    if (can_happen(kind, contents))
      list.push_back({fmt::format("{}_events", name(kind)), unit::none,
                      fmt::format("events of the kind {}, over the whole run", name(kind)), [kind](const Outcome& o) {
                        return static_cast<double>(o.run.events[static_cast<std::size_t>(kind)]);
                      }});
  list.push_back(
      {"final_gear_angle", unit::radian, "gear angle at the end", [](const Outcome& o) { return o.run.end.theta_g; }});
  list.push_back({"final_gear_speed", unit::radian_per_second, "gear speed at the end",
                  [](const Outcome& o) { return o.run.end.omega_g; }});
  for (Metric& metric : list) {
    metric.unit = spellings(metric.name, metric.unit, scenario.axis).front().unit;
    metric.meaning = in_words_of(scenario.axis, metric.meaning);
  }
  return list;
}

}  // namespace wormdrive
