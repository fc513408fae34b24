#include "sweep/metrics/read_metrics.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "description/variant_kinds.hpp"
#include "output/run_columns.hpp"
#include "simulation/write_run.hpp"

namespace wormdrive {
namespace {

/// A unit that columns have, and that of an integral over time.
struct ColumnUnit {
  Unit own, integral;
};
constexpr Unit metre_per_second_squared{"m_per_s2", "m/s^2"}, watt{"W", "W"};
constexpr std::array column_units{
    ColumnUnit{unit::radian, {"rad_s", "rad s"}},
    ColumnUnit{unit::radian_per_second, unit::radian},
    ColumnUnit{unit::radian_per_second_squared, unit::radian_per_second},
    ColumnUnit{unit::metre, {"m_s", "m s"}},
    ColumnUnit{unit::metre_per_second, unit::metre},
    ColumnUnit{metre_per_second_squared, unit::metre_per_second},
    ColumnUnit{unit::newton_metre, {"Nms", "N m s"}},
    ColumnUnit{unit::newton, {"Ns", "N s"}},
    ColumnUnit{unit::volt, {"Vs", "V s"}},
    ColumnUnit{unit::ampere, {"As", "A s"}},
    ColumnUnit{watt, {"J", "J"}},
};

ColumnUnit unit_of(const std::string& symbol) {
  const auto found = std::find_if(column_units.begin(), column_units.end(),
                                  [&](const ColumnUnit& u) { return u.own.symbol == symbol; });
  return found != column_units.end() ? *found : ColumnUnit{unit::none, unit::second};
}

/// The columns of a table that change over time.
std::vector<ColumnDescription> columns_of(const Scenario& scenario, bool of_controller) {
  const RunContents contents = contents_of(scenario);
  std::vector<ColumnDescription> columns = of_controller ? descriptions(controller_columns(), scenario.axis)
                                                         : descriptions(trajectory_columns(contents), scenario.axis);
  std::erase_if(columns, [](const ColumnDescription& c) { return c.name == "time"; });
  return columns;
}

bool is_name(const std::string& text) {
  return !text.empty() && text.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == std::string::npos &&
         (text.front() < '0' || text.front() > '9');
}

class MetricReader {
 public:
  MetricReader(TableReader& table, const Scenario& scenario) : table_(table), scenario_(scenario) {}

  OwnMetric read(const std::vector<std::string>& taken) {
    OwnMetric metric;
    metric.name = table_.required_text("name", "the name of the metric").value_or("");
    if (table_.has("name") && !is_name(metric.name))
      table_.fault("name",
                   fmt::format("'{}' cannot be the name of a metric; use small letters, digits and _", metric.name));
    if (std::find(taken.begin(), taken.end(), metric.name) != taken.end())
      table_.fault("name", fmt::format("the name '{}' is taken; choose another one", metric.name));
    metric.of_controller = table_.choice("table", {"trajectory", "controller"}, Presence::optional) == "controller";
    metric.column = table_.required_text("column", "a column of the result of a run").value_or("");
    std::optional<ColumnDescription> column;
    if (metric.of_controller && !scenario_.control) {
      table_.fault("table", "the scenario has no controller; its runs have the columns of the trajectory alone");
    } else if (table_.has("column")) {
      const std::vector<ColumnDescription> columns = columns_of(scenario_, metric.of_controller);
      std::vector<std::string> names;
      for (const ColumnDescription& c : columns) names.push_back(c.name);
      const auto found = std::find(names.begin(), names.end(), metric.column);
      if (found == names.end())
        table_.fault("column",
                     fmt::format("runs have no column '{}'; {}", metric.column, suggestion(metric.column, names)));
      else
        column = columns[static_cast<std::size_t>(found - names.begin())];
    }
    read_window(metric);
    const auto kind = table_.choice("kind", kinds_of<MetricKind>(), Presence::required);
    if (!kind || !column) {
      table_.ignore_unknown();  // which keys it may have, and in which unit, hangs on its kind and column
    } else {
      const ColumnUnit units = unit_of(column->units);
      unit_ = units.own;
      metric.kind = make_kind<MetricKind>(*kind);
      std::visit([&](auto& what) { read_kind(what, metric); }, metric.kind);
      metric.unit = metric.is_time()                                ? unit::second
                    : std::holds_alternative<Integral>(metric.kind) ? units.integral
                                                                    : units.own;
      metric.meaning = fmt::format("{} of {}", *kind, column->long_name);
    }
    table_.finish();
    return metric;
  }

 private:
  void read_window(OwnMetric& metric) {
    const double end = scenario_.run.duration;
    metric.from = table_.number("from", unit::second, bounds::not_negative, Presence::optional, "start of what counts")
                      .value_or(0.0);
    metric.to =
        table_.number("to", unit::second, bounds::positive, Presence::optional, "end of what counts").value_or(end);
    if (table_.has("to_s") && metric.to > end)
      table_.fault("to_s", fmt::format("{} = {} s must be at most the duration of the run, {} s",
                                       table_.path_of("to_s"), metric.to, end));
    metric.to = std::min(metric.to, end);
    if (!(metric.from < metric.to))
      table_.fault("from_s", fmt::format("{} = {} s must be less than {}", table_.path_of("from_s"), metric.from,
                                         metric.to < end ? fmt::format("to_s = {} s", metric.to)
                                                         : fmt::format("the duration of the run, {} s", end)));
  }

  template <class Plain>
  void read_kind(Plain&, const OwnMetric&) {}
  void read_kind(ValueAt& value, const OwnMetric& metric) {
    value.time =
        table_.number("at", unit::second, bounds::not_negative, Presence::required, "time of the value").value_or(0.0);
    if (value.time < metric.from || value.time > metric.to)
      table_.fault("at_s", fmt::format("{} = {} s is not within what counts, {} s to {} s", table_.path_of("at_s"),
                                       value.time, metric.from, metric.to));
  }
  void read_kind(TimeQuantile& quantile, const OwnMetric&) {
    quantile.share = table_
                         .number("time", unit::percent, bounds::between(0, 1), Presence::required,
                                 "share of the time for which the column is below")
                         .value_or(0.0);
  }
  void read_kind(CrossingTime& crossing, const OwnMetric&) {
    crossing.level =
        table_.number("level", unit_, bounds::any, Presence::required, "level that is crossed").value_or(0.0);
    const auto direction = table_.choice("direction", {"either", "rising", "falling"}, Presence::optional);
    crossing.rising = direction != "falling";
    crossing.falling = direction != "rising";
    crossing.number = static_cast<int>(
        table_.number("number", unit::whole, bounds::between(1, 1e9), Presence::optional, "which crossing")
            .value_or(1.0));
  }
  void read_kind(SettlingTime& settling, const OwnMetric&) {
    settling.band =
        table_.number("band", unit_, bounds::positive, Presence::required, "half width of the band").value_or(0.0);
    settling.target = table_.number("target", unit_, bounds::any, Presence::optional,
                                    "middle of the band; the last value if not stated");
  }

  TableReader& table_;
  const Scenario& scenario_;
  Unit unit_;
};

}  // namespace

std::vector<OwnMetric> read_own_metrics(TableReader& root, const Scenario& scenario,
                                        const std::vector<std::string>& taken) {
  std::vector<OwnMetric> list;
  std::vector<std::string> names = taken;
  names.insert(names.end(), {"index", "reason", "status"});  // columns of /trials
  const std::vector<const toml::table*> tables = root.tables("metric");
  for (std::size_t k = 0; k < tables.size(); ++k) {
    TableReader table(tables[k], fmt::format("metric[{}]", k), Axis::rotary, root.faults(), root.where());
    list.push_back(MetricReader(table, scenario).read(names));
    names.push_back(list.back().name);
  }
  return list;
}

Metric as_metric(const std::vector<OwnMetric>& own, std::size_t place) {
  const OwnMetric& metric = own[place];
  Metric made{metric.name, metric.unit, metric.meaning, [place](const Outcome& o) { return o.own[place]; }};
  if (metric.is_time()) made.missing = std::numeric_limits<double>::infinity();
  return made;
}

}  // namespace wormdrive
