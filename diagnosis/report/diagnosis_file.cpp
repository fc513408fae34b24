#include "diagnosis/report/diagnosis_file.hpp"

#include <limits>

#include "description/keys.hpp"

namespace wormdrive {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// A column of a table whose rows the others count; one that was not recorded is NaN throughout.
std::vector<double> filled(std::vector<double> column, std::size_t rows) {
  if (column.size() != rows) column.assign(rows, nothing);
  return column;
}

template <class T>
std::vector<double> as_doubles(const std::vector<T>& values) {
  return {values.begin(), values.end()};
}

ColumnDescription flag(const std::string& name, const std::string& long_name) {
  return {name, "", long_name, "no yes", {0, 1}};
}

void write_residual(hid_t file, const ResidualTorque& r, Axis axis) {
  const std::size_t rows = r.after.size();
  GrowingTable(file, "residual",
               on_axis(axis, {{"time", "s", "time, of recordings one after another"},
                              {"gear_angle", "rad", "gear angle"},
                              {"gear_speed", "rad/s", "gear speed"},
                              {"load_torque", "N m", "load torque"},
                              {"worm_phase", "rad", "angle of the worm within its turn"},
                              {"before", "N m", "torque that the scenario lacks"},
                              {"after", "N m", "torque that the extended scenario lacks"},
                              flag("held_out", "not used for the fit")}),
               rows)
      .append({filled(r.time, rows), filled(r.gear_angle, rows), filled(r.gear_speed, rows),
               filled(r.load_torque, rows), filled(r.worm_phase, rows), filled(r.before, rows), r.after,
               filled(as_doubles(r.held_out), rows)});
}

void write_examples(hid_t file, const std::vector<PredictionExample>& examples, Axis axis) {
  GrowingTable table(file, "examples",
                     on_axis(axis, {{"time", "s", "time"},
                                    {"example", "1", "number of the stretch"},
                                    {"horizon", "s", "how far it is predicted ahead"},
                                    {"measured", "rad", "gear angle as measured"},
                                    {"before", "rad", "gear angle as the scenario predicts it"},
                                    {"after", "rad", "gear angle as the extended scenario predicts it"}}));
  for (std::size_t k = 0; k < examples.size(); ++k) {
    const PredictionExample& e = examples[k];
    const std::size_t rows = e.time.size();
    table.append({e.time, std::vector<double>(rows, static_cast<double>(k)), std::vector<double>(rows, e.horizon),
                  e.measured, e.before, e.after});
  }
}

void write_torques(hid_t file, const PredictedTorques& t, Axis axis) {
  GrowingTable table(
      file, "torques",
      on_axis(axis, {{"worm_speed", "rad/s", "worm speed, 0 at break-in"},
                     {"load_torque", "N m", "load torque"},
                     {"measured", "N m", "motor torque as measured"},
                     {"before", "N m", "motor torque as the scenario predicts it"},
                     {"after", "N m", "motor torque as the extended scenario predicts it by a fit without it"}}));
  table.append({t.worm_speed, t.load_torque, t.measured, t.before, t.after});
  write_texts(table.group(), "point", "name of the record or direction of the break-in", t.names);
}

void write_prediction(hid_t file, const std::vector<PredictionError>& errors) {
  std::vector<std::vector<double>> columns(6);
  std::vector<std::string> units;
  for (const PredictionError& e : errors) {
    const double row[] = {e.horizon, e.before, e.after, e.after_low, e.after_high, e.floor};
    for (std::size_t k = 0; k < columns.size(); ++k) columns[k].push_back(row[k]);
    units.emplace_back(e.unit.symbol);
  }
  GrowingTable table(file, "prediction",
                     {{"horizon", "s", "how far ahead; NaN for torques"},
                      {"before", "see unit", "rms error of the scenario on data not used for the fit"},
                      {"after", "see unit", "rms error of the extended scenario"},
                      {"after_low", "see unit", "lower end of its 95 % interval"},
                      {"after_high", "see unit", "upper end of its 95 % interval"},
                      {"noise_floor", "see unit", "what the noise of the data alone comes to"}});
  table.append(columns);
  write_texts(table.group(), "unit", "unit of the errors", units);
}

void write_ranking(hid_t file, const std::vector<RankedCandidate>& ranking) {
  std::vector<std::vector<double>> columns(3);
  std::vector<std::string> effects, outcomes;
  for (const RankedCandidate& c : ranking) {
    columns[0].push_back(c.delta_bic);
    columns[1].push_back(c.held_out_gain);
    columns[2].push_back(c.named ? 1.0 : 0.0);
    effects.push_back(c.effect.effect);
    outcomes.push_back(c.outcome);
  }
  GrowingTable table(file, "ranking",
                     {{"delta_bic", "1", "BIC without the effect less that with it"},
                      {"held_out_gain", "1", "log likelihood gained on data not used for the fit [nats]"},
                      flag("named", "named as a cause")});
  table.append(columns);
  write_texts(table.group(), "effect", "id of the effect", effects);
  write_texts(table.group(), "outcome", "named, or why not", outcomes);
}

void write_certificate(hid_t file, const std::vector<Visibility>& certificate) {
  std::vector<std::vector<double>> columns(4);
  std::vector<std::string> effects, parameters, chosen, units, nearest;
  for (const Visibility& v : certificate) {
    const double row[] = {v.detectable / v.unit.si, v.nameable / v.unit.si, v.likeness, v.observable ? 1.0 : 0.0};
    for (std::size_t k = 0; k < columns.size(); ++k) columns[k].push_back(row[k]);
    effects.push_back(v.effect);
    parameters.push_back(v.field);
    chosen.push_back(v.chosen);
    units.emplace_back(v.unit.symbol);
    nearest.push_back(v.nearest);
  }
  GrowingTable table(
      file, "certificate",
      {{"detectable", "see unit", "smallest size that these data show"},
       {"nameable", "see unit", "smallest size that can be told from other effects, of exact twins as their class"},
       {"likeness", "1", "share of the signature that the nearest other effect can imitate"},
       flag("observable", "the data can show it")});
  table.append(columns);
  write_texts(table.group(), "effect", "id of the effect", effects);
  write_texts(table.group(), "parameter", "whose size is told", parameters);
  write_texts(table.group(), "chosen", "for which choice; empty where there is one only", chosen);
  write_texts(table.group(), "unit", "unit of the sizes", units);
  write_texts(table.group(), "nearest", "the nearest other effect", nearest);
}

}  // namespace

std::vector<ColumnDescription> on_axis(Axis axis, std::vector<ColumnDescription> columns) {
  for (ColumnDescription& column : columns) {
    column.units = units_on(axis, column.units);
    column.long_name = in_words_of(axis, column.long_name);
  }
  return columns;
}

void write_diagnosis(const std::string& path, const Diagnosis& diagnosis, const Provenance& provenance,
                     Replace replace) {
  PartFile file(path, provenance.kind, replace);
  write_provenance(file.file(), provenance);
  write_attribute(file.file(), "sentence", diagnosis.sentence);
  write_residual(file.file(), diagnosis.residual, diagnosis.extended.axis);
  write_examples(file.file(), diagnosis.examples, diagnosis.extended.axis);
  write_torques(file.file(), diagnosis.torques, diagnosis.extended.axis);
  write_prediction(file.file(), diagnosis.prediction);
  write_ranking(file.file(), diagnosis.ranking);
  write_certificate(file.file(), diagnosis.certificate);
  file.finish();
}

}  // namespace wormdrive
