#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "cli/describe/drive.hpp"
#include "cli/report/kinds.hpp"
#include "cli/report/thinning.hpp"
#include "description/diagnostics.hpp"

namespace wormdrive {
namespace {

/// A column as one that is drawn, with its units.
ReportSeries column_of(const ResultFile& file, const std::string& name, const std::string& meaning) {
  return {name.substr(name.find('/') + 1), file.attribute(name, "units"), meaning, file.column(name)};
}

/// The rows in the order of the speed, which a curve as well as its records need not have.
std::vector<std::size_t> rising(const std::vector<double>& speed) {
  std::vector<std::size_t> rows(speed.size());
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  std::stable_sort(rows.begin(), rows.end(), [&](std::size_t a, std::size_t b) { return speed[a] < speed[b]; });
  return rows;
}

ReportPanel sorted(const ReportPanel& panel) {
  ReportPanel list = panel;
  const std::vector<std::size_t> rows = rising(panel.over);
  for (std::size_t n = 0; n < rows.size(); ++n) {
    list.over[n] = panel.over[rows[n]];
    for (std::size_t k = 0; k < list.series.size(); ++k) list.series[k].values[n] = panel.series[k].values[rows[n]];
  }
  return list;
}

/// The torque of the model, with a gap at standstill, where it is an interval.
ReportPanel curve(const ResultFile& file) {
  ReportPanel panel{file.column("model/worm_speed"),
                    {column_of(file, "model/motor_torque", file.attribute("model/motor_torque", "long_name"))}};
  panel.over.push_back(0.0);
  panel.series[0].values.push_back(NAN);
  return panel;
}

/// Measured torques as points, the model as a line: rows of the curve have no measurement.
ReportPanel measured_and_model(const ResultFile& file) {
  const std::vector<double> speed = file.column("records/worm_speed"),
                            model = file.column("records/motor_torque_model");
  ReportPanel panel = curve(file);
  panel.style = ReportPanel::Style::points;
  ReportSeries measured = column_of(file, "records/motor_torque", "measured, mean of a record");
  measured.name = "measured";
  measured.values.insert(measured.values.begin(), panel.over.size(), NAN);
  panel.over.insert(panel.over.end(), speed.begin(), speed.end());
  panel.series[0].name = "model";
  panel.series[0].values.insert(panel.series[0].values.end(), model.begin(), model.end());
  panel.series.insert(panel.series.begin(), std::move(measured));
  return sorted(panel);
}

ReportPanel difference(const ResultFile& file) {
  const std::vector<double> model = file.column("records/motor_torque_model");
  ReportSeries left = column_of(file, "records/motor_torque", "measured minus model");
  left.name = "difference";
  for (std::size_t k = 0; k < model.size(); ++k) left.values[k] -= model[k];
  return sorted({file.column("records/worm_speed"), {std::move(left)}, ReportPanel::Style::points});
}

ReportTable record_table(const ResultFile& file) {
  const auto column = [&](const std::string& name) { return file.column("records/" + name); };
  const std::vector<double> speed = column("worm_speed"), measured = column("motor_torque"),
                            model = column("motor_torque_model"), samples = column("samples"),
                            left_out = column("left_out");
  const std::vector<std::string> names = file.texts("records/record");
  ReportTable table{"Records",
                    {{"record"},
                     {"worm speed [rad/s]", true},
                     {"measured [N m]", true},
                     {"model [N m]", true},
                     {"measured minus model [N m]", true},
                     {"samples", true},
                     {"left out", true}},
                    {},
                    "Left out: physically impossible samples."};
  for (const std::size_t k : rising(speed))
    table.rows.push_back(
        {names.at(k), speed[k], measured[k], model[k], measured[k] - model[k], samples[k], left_out[k]});
  return table;
}

ReportTable curve_table(const ReportPanel& curve, const std::string& speed_unit) {
  const ReportSeries& torque = curve.series.front();
  const std::string quantity = torque.units == "N" ? "motor force" : "motor torque";
  ReportTable table{
      fmt::format("M{} at constant speed", quantity.substr(1)),
      {{fmt::format("speed [{}]", speed_unit), true}, {fmt::format("{} [{}]", quantity, torque.units), true}},
      {}};
  for (const std::size_t k : even_rows(curve.over.size(), 11))
    if (!std::isnan(torque.values[k])) table.rows.push_back({curve.over[k], torque.values[k]});
  return table;
}

}  // namespace

ReportPage report_of_steady(const ResultFile& file) {
  if (!file.has("model")) reject({file.path()}, "contains no curve");
  ReportPage page;
  page.summary = describe_mesh(file.scenario());
  ReportGroup group{
      "", file.attribute("model/worm_speed", "long_name"), file.attribute("model/worm_speed", "units"), {}};
  if (!file.has("records")) {
    group.panels.push_back(sorted(curve(file)));
    page.tables.push_back(curve_table(group.panels.front(), group.units));
    page.verdict = fmt::format(
        "The motor {} that keeps the drive at a constant speed; at standstill friction balances any value in an "
        "interval.",
        group.units == "m/s" ? "force" : "torque");
  } else {
    group.panels = {measured_and_model(file), difference(file)};
    page.tables.push_back(record_table(file));
    page.verdict = fmt::format(
        "The model differs from the mean torques of {} records ({:.3g} mN m rms) by {:.2g} mN m rms.",
        page.tables.front().rows.size(), 1e3 * file.number("/", "rms_torque"), 1e3 * file.number("/", "rms_error"));
  }
  page.groups.push_back(std::move(group));
  return page;
}

}  // namespace wormdrive
