#include "cli/describe/rare.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "cli/describe/drive.hpp"
#include "cli/report/kinds.hpp"

namespace wormdrive {
namespace {

/// What came of an estimate that is complete.
RareEvent read_event(const ResultFile& file) {
  std::vector<std::vector<double>> rows;
  for (const char* const name : {"probability", "variation", "low", "high", "runs"})
    rows.push_back(file.column(std::string("estimates/") + name));
  const auto estimate = [&](std::size_t k) {
    return RareEstimate{rows[0][k], rows[1][k], rows[2][k], rows[3][k], static_cast<std::uint64_t>(rows[4][k])};
  };
  RareEvent event;
  event.threshold.metric = file.attribute("estimates", "metric");
  event.threshold.limit = file.number("estimates", "limit");
  event.threshold.above = file.integer("estimates", "above") != 0;
  event.subset.estimate = estimate(0);
  const std::vector<double> distance = file.column("levels/distance"), share = file.column("levels/share"),
                            variation = file.column("levels/variation"), taken = file.column("levels/acceptance");
  for (std::size_t k = 0; k < share.size(); ++k)
    event.subset.levels.push_back({distance[k], share[k], variation[k], taken[k]});
  event.median_misses = !file.has("design_point");
  if (event.median_misses) return event;
  event.importance = estimate(1);
  event.design.beta = file.number("design_point", "beta");
  event.design.converged = file.integer("design_point", "converged") != 0;
  return event;
}

/// The probability to come as near as each level, from the limit on.
ReportGroup descent(const RareEvent& event, const std::string& metric, const std::string& units) {
  ReportPanel panel{{},
                    {{"low", "1", "lower end of the 95 % interval, as decimal logarithm", {}},
                     {"high", "1", "its upper end", {}},
                     {"probability", "1", "decimal logarithm of the probability to come as near", {}}},
                    ReportPanel::Style::lines,
                    true};
  const auto logarithm = [](double p) { return p > 0.0 ? std::log10(p) : NAN; };
  const std::span<const SubsetLevel> levels = event.subset.levels;
  for (std::size_t k = levels.size(); k-- > 0;) {
    if (!std::isfinite(levels[k].threshold)) continue;  // of drives that cannot say how near they come
    const RareEstimate p = estimate_within(levels.first(k + 1));
    panel.over.push_back(levels[k].threshold);
    panel.series[0].values.push_back(logarithm(p.low));
    panel.series[1].values.push_back(logarithm(p.high));
    panel.series[2].values.push_back(logarithm(p.probability));
  }
  return {"How rarely drives come near the limit", "distance of the " + metric + " from its limit", units, {panel}};
}

ReportTable estimates_table(const RareEvent& event) {
  ReportTable table{
      "Estimates",
      {{"method"}, {"probability", true}, {"95 % interval"}, {"coefficient of variation", true}, {"runs", true}},
      {}};
  const auto add = [&](const char* method, const RareEstimate& p) {
    table.rows.push_back({method, p.probability, fmt::format("{:.3g} to {:.3g}", p.low, p.high), p.variation,
                          static_cast<double>(p.evaluations)});
  };
  add("subset simulation", event.subset.estimate);
  if (!event.median_misses && event.design.converged) add("samples around the design point", event.importance);
  table.note = fmt::format("Check: {}.", verdict_on(event));
  return table;
}

ReportTable levels_table(const RareEvent& event, const std::string& units) {
  ReportTable table{"Levels of the subset simulation",
                    {{"level", true},
                     {"distance from the limit [" + units + "]", true},
                     {"share of its runs as near [%]", true},
                     {"proposals taken [%]", true}},
                    {}};
  for (const SubsetLevel& level : event.subset.levels)
    table.rows.push_back(
        {static_cast<double>(table.rows.size() + 1), level.threshold, 100.0 * level.share, 100.0 * level.acceptance});
  return table;
}

/// The drive that misses most likely.
ReportTable design_point_table(const ResultFile& file, const RareEvent& event) {
  ReportTable table{"The drive that misses most likely",
                    {{"parameter"}, {"value", true}, {"unit"}, {"importance [%]", true}},
                    {},
                    fmt::format("beta = {:.4g} standard deviations from the median drive{}.", event.design.beta,
                                event.design.converged ? "" : "; the search has not converged")};
  const std::vector<std::string> names = file.texts("design_point/parameter"), units = file.texts("design_point/unit");
  const std::vector<double> values = file.column("design_point/value"),
                            importance = file.column("design_point/importance");
  for (std::size_t k = 0; k < names.size(); ++k)
    table.rows.push_back({names[k], values[k], units[k], 100.0 * importance[k]});
  return table;
}

}  // namespace

ReportPage report_of_rare(const ResultFile& file) {
  ReportPage page;
  page.summary = describe_mesh(file.scenario());
  page.texts.push_back({"Study", file.attribute("/", "study")});
  if (!file.has("estimates")) {
    page.verdict = "The estimate is not complete; continue it with wormdrive rare --resume.";
    return page;
  }
  const RareEvent event = read_event(file);
  const std::string metric = words(event.threshold.metric), units = file.attribute("levels/distance", "units");
  page.verdict =
      fmt::format("A drive has {} {} {:g} {} with probability {}.", metric, event.threshold.above ? "above" : "below",
                  event.threshold.limit, units, in_words(event.subset.estimate));
  page.groups.push_back(descent(event, metric, units));
  page.tables = {estimates_table(event)};
  if (!event.median_misses) page.tables.push_back(design_point_table(file, event));
  page.tables.push_back(levels_table(event, units));
  return page;
}

}  // namespace wormdrive
