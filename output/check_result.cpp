#include "output/check_result.hpp"

#include <algorithm>
#include <iterator>
#include <limits>

#include <fmt/format.h>

#include "output/run_columns.hpp"

namespace wormdrive {
namespace {

using Columns = std::vector<ColumnDescription>;

/// The first column is the one over which the others stand.
void check_table(const StoredTable& table, const Columns& columns, Range first, Range others) {
  for (const ColumnDescription& column : columns) table.check(column, &column == &columns.front() ? first : others);
}

/// The same of one that has a row at least, whatever wrote it.
void check_filled_table(const StoredTable& table, const Columns& columns, Range first, Range others) {
  check_table(table, columns, first, others);
  if (table.rows() == 0) table.column(columns.front().name).reject("has no rows");
}

Columns numbers(std::initializer_list<const char*> names) {
  Columns list;
  for (const char* const name : names) list.push_back({name, "", ""});
  return list;
}
ColumnDescription yes_or_no(const std::string& name) { return {name, "", "", "no yes", {0, 1}}; }

void check_statics(hid_t file) {
  check_filled_table(StoredTable(file, "statics"),
                     numbers({"load_torque", "stick_low", "stick_high", "static_surface"}), Range::rising,
                     Range::finite);
  read_text_attribute(file, "regime");
}

void check_steady(hid_t file) {
  check_filled_table(StoredTable(file, "model"), numbers({"worm_speed", "motor_torque"}), Range::finite, Range::finite);
  if (!has_member(file, "records")) return;
  const StoredTable records(file, "records");
  check_table(records, numbers({"worm_speed", "motor_torque", "motor_torque_model", "samples", "left_out"}),
              Range::finite, Range::finite);
  records.check_texts("record");
  for (const char* const name : {"rms_error", "rms_torque"}) read_number_attribute(file, name);
}

/// Where no torque keeps a speed there are no numbers.
void check_efficiency(hid_t file) {
  const StoredTable map(file, "efficiency");
  check_filled_table(map, numbers({"worm_speed", "load_torque"}), Range::finite, Range::finite);
  check_table(map, numbers({"motor_torque", "motor_power", "load_power", "loss", "efficiency"}), Range::any,
              Range::any);
}

/// Its rows are those of a study, which whoever knows the study looks at.
void check_sweep(hid_t file) {
  const StoredTable trials(file, "trials");
  for (const char* const name : {"first_trial", "end_trial"}) read_integer_attribute(file, name);
  for (const char* const name : {"study", "build"}) read_text_attribute(file, name);
}

/// Its runs are those of a study, as the trials of a sweep; what came of them is there once it is complete.
void check_rare(hid_t file) {
  const StoredTable runs(file, "runs");
  for (const char* const name : {"study", "build", "settings"}) read_text_attribute(file, name);
  if (!has_member(file, "estimates")) return;
  const StoredTable estimates(file, "estimates"), levels(file, "levels");
  check_table(estimates, numbers({"index", "probability", "low", "high", "variation", "runs"}), Range::finite,
              Range::any);
  estimates.check_texts("method");
  const Hdf5Handle estimated = open_object(file, "estimates");
  read_text_attribute(estimated, "metric");
  read_number_attribute(estimated, "limit");
  read_integer_attribute(estimated, "above");
  check_filled_table(levels, numbers({"index", "distance", "share", "variation", "acceptance"}), Range::finite,
                     Range::any);
  const bool has_design_point = has_member(file, "design_point");
  if (const std::size_t due = has_design_point ? 2 : 1; estimates.rows() != due)
    estimates.column("index").reject(fmt::format("has {} rows, not {}", estimates.rows(), due));
  const auto check_within = [](const StoredTable& table, const char* name, double most) {
    for (const double value : table.column(name).values())
      if (!(value >= 0.0 && value <= most)) table.column(name).reject(fmt::format("contains {}", value));
  };
  check_within(estimates, "probability", std::numeric_limits<double>::infinity());  // weighted, it may pass 1
  check_within(estimates, "runs", 0x1p53);
  for (const char* const name : {"share", "acceptance"}) check_within(levels, name, 1.0);
  if (!has_design_point) return;
  const StoredTable design(file, "design_point");
  const Hdf5Handle designed = open_object(file, "design_point");
  read_number_attribute(designed, "beta");
  read_integer_attribute(designed, "converged");
  check_table(design, numbers({"index", "value", "importance"}), Range::finite, Range::any);
  for (const char* const name : {"parameter", "unit"}) design.check_texts(name);
}

void check_diagnosis(hid_t file) {
  const StoredTable residual(file, "residual"), torques(file, "torques"), prediction(file, "prediction"),
      ranking(file, "ranking"), certificate(file, "certificate");
  check_table(residual, numbers({"time", "gear_angle", "gear_speed", "load_torque", "worm_phase", "before", "after"}),
              Range::any, Range::any);
  residual.check(yes_or_no("held_out"), Range::any);
  const StoredTable examples(file, "examples");
  check_table(examples, numbers({"time", "example", "horizon"}), Range::finite, Range::finite);
  check_table(examples, numbers({"measured", "before", "after"}), Range::any, Range::any);
  check_table(torques, numbers({"worm_speed", "load_torque"}), Range::finite, Range::finite);
  check_table(torques, numbers({"measured", "before", "after"}), Range::any, Range::any);
  check_table(prediction, numbers({"horizon", "before", "after", "after_low", "after_high", "noise_floor"}), Range::any,
              Range::any);
  check_table(ranking, numbers({"delta_bic", "held_out_gain"}), Range::any, Range::any);
  ranking.check(yes_or_no("named"), Range::any);
  check_table(certificate, numbers({"detectable", "nameable", "likeness"}), Range::any, Range::any);
  certificate.check(yes_or_no("observable"), Range::any);
  torques.check_texts("point");
  prediction.check_texts("unit");
  for (const char* const name : {"effect", "outcome"}) ranking.check_texts(name);
  for (const char* const name : {"effect", "parameter", "chosen", "unit", "nearest"}) certificate.check_texts(name);
}

}  // namespace

void check_run(hid_t file) {
  const StoredTable trajectory(file, "trajectory"), events(file, "events");
  RunContents contents{.elastic = trajectory.has("gear_motion"),
                       .winding = trajectory.has("motor_current"),
                       .stops = trajectory.has("hard_stops_impulse")};
  StateLayout<EffectList<double>>::for_each([&](std::string_view id, const EffectState& state, std::size_t place) {
    if (const StateColumn column = state_column(id, state, place); trajectory.has(column.description.name))
      contents.states.push_back(column);
  });
  check_filled_table(trajectory, descriptions(trajectory_columns(contents), Axis::rotary), Range::rising,
                     Range::finite);
  check_table(events, descriptions(event_columns(contents), Axis::rotary), Range::ordered, Range::finite);
  if (!has_member(file, "controller")) return;
  const StoredTable controller(file, "controller");
  Columns columns = descriptions(controller_columns(), Axis::rotary);
  std::erase_if(columns, [&](const ColumnDescription& column) {  // results of older programs have none
    return column.name == "disturbance_torque" && !controller.has(column.name);
  });
  check_table(controller, columns, Range::rising, Range::finite);
}

void check_result(hid_t file) {
  struct Kind {
    const char* name;
    void (*check)(hid_t);
  };
  constexpr Kind kinds[] = {{"run", check_run},
                            {"statics", check_statics},
                            {"steady", check_steady},
                            {"efficiency", check_efficiency},
                            {"sweep", check_sweep},
                            {"rare", check_rare},
                            {"diagnosis", check_diagnosis}};
  const std::string kind = read_text_attribute(file, "kind");
  const auto* const known =
      std::find_if(std::begin(kinds), std::end(kinds), [&](const Kind& k) { return kind == k.name; });
  if (known == std::end(kinds))
    throw ReadFault(
        file_of(file),
        fmt::format("its kind '{}' is none of run, statics, steady, efficiency, sweep, rare and diagnosis", kind));
  for (const char* const name : {"title", "scenario"}) read_text_attribute(file, name);
  known->check(file);
}

}  // namespace wormdrive
