#include "cli/report/diagnosis_tables.hpp"

#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace wormdrive {

using nlohmann::json;

std::string text(const json& value) { return value.is_string() ? value.get<std::string>() : ""; }

namespace {

using Cell = std::variant<std::string, double>;

/// null stands for a number that does not exist.
double number(const json& value) { return value.is_number() ? value.get<double>() : NAN; }

std::string estimate(const json& parameter) {
  const std::string unit = text(parameter.at("unit")), shown_unit = unit == "1" ? "" : " " + unit;
  const std::string name = words(text(parameter.at("name")));
  const double value = number(parameter.at("value")), error = number(parameter.at("standard_error"));
  if (std::isnan(error)) return fmt::format("{} {:.4g}{}", name, value, shown_unit);
  return fmt::format("{} {:.4g} ± {:.2g}{} (95 %: {:.4g} to {:.4g})", name, value, error, shown_unit,
                     number(parameter.at("low")), number(parameter.at("high")));
}
std::string estimates(const json& effect) {
  std::string all;
  for (const json& parameter : effect.at("parameters")) all += (all.empty() ? "" : "; ") + estimate(parameter);
  return all;
}

/// A table of findings: for each of a list a row of cells.
template <class Row>
void add(ReportPage& page, ReportTable table, const json& list, Row&& row) {
  for (const json& item : list) table.rows.push_back(row(item));
  if (!table.rows.empty()) page.tables.push_back(std::move(table));
}

/// A number with its error, of a change.
std::string with_error(const json& e) {
  const double error = number(e.at("standard_error"));
  return std::isnan(error) ? "not shown by the earlier data"
                           : fmt::format("{:.4g} ± {:.2g}", number(e.at("value")), error);
}

void add_changes(ReportPage& page, const json& since) {
  if (!since.is_object()) return;
  std::string files;
  for (const json& file : since.at("files"))
    files += (files.empty() ? "" : ", ") + std::filesystem::path(text(file)).filename().string();
  add(page,
      {"What has changed since " + files,
       {{"effect"}, {"parameter"}, {"before", true}, {"now", true}, {"change", true}, {"unit"}, {"changed"}},
       {},
       "A number has changed if it lies further from its earlier value than the errors of both explain."},
      since.at("changes"), [](const json& c) {
        const json& now = c.at("after");
        const std::string unit = text(now.at("unit"));
        return std::vector<Cell>{words(text(c.at("effect"))),
                                 words(text(now.at("name"))),
                                 with_error(c.at("before")),
                                 with_error(now),
                                 with_error(c.at("difference")),
                                 unit == "1" ? "" : unit,
                                 c.at("certain").get<bool>() ? "yes" : ""};
      });
}

}  // namespace

void add_tables(ReportPage& page, const json& findings) {
  add_changes(page, findings.value("since", json()));
  add(page, {"Causes", {{"effect"}, {"estimate"}}, {}}, findings.at("causes"), [](const json& c) {
    return std::vector<Cell>{words(text(c.at("effect"))), estimates(c)};
  });
  add(page,
      {"Evidence: every effect that was examined",
       {{"effect"}, {"dBIC", true}, {"held-out gain [nats]", true}, {"estimate"}, {"outcome"}},
       {},
       "dBIC: how much the fit gains beyond what its parameters cost. Held-out gain: on data not used for the fit."},
      findings.at("ranking"), [](const json& c) {
        return std::vector<Cell>{words(text(c.at("effect"))), number(c.at("delta_bic")),
                                 number(c.at("held_out_gain_nats")), estimates(c),
                                 (c.at("named").get<bool>() ? "" : "rejected: ") + text(c.at("outcome"))};
      });
  add(page,
      {"Prediction on data not used for the fit",
       {{"horizon [s]", true},
        {"stated model", true},
        {"extended model", true},
        {"95 % interval"},
        {"noise floor", true},
        {"unit"}},
       {},
       "Rms error at the end of predictions over this horizon; no model can fall below the noise floor."},
      findings.at("gain"), [](const json& g) {
        return std::vector<Cell>{number(g.at("horizon_s")),
                                 number(g.at("before")),
                                 number(g.at("after")),
                                 fmt::format("{:.4g} to {:.4g}", number(g.at("after_low")), number(g.at("after_high"))),
                                 number(g.at("noise_floor")),
                                 text(g.at("unit"))};
      });
  add(page, {"Calibration: stated parameters within their tolerance", {{"effect"}, {"estimate"}}, {}},
      findings.at("calibration"), [](const json& c) {
        return std::vector<Cell>{words(text(c.at("effect"))), estimates(c)};
      });
  add(page, {"Constants identified from the data", {{"constant"}}, {}}, findings.at("identified"),
      [](const json& c) { return std::vector<Cell>{estimate(c)}; });
  const bool linear = findings.at("noise").contains("force_N");
  add(page,
      {"What remains unexplained",
       {{"over"}, {"evidence [standard deviations]", true}, {linear ? "rms [N]" : "rms [N m]", true}},
       {}},
      findings.at("adequacy"), [&](const json& r) {
        return std::vector<Cell>{text(r.at("axis")), number(r.at("evidence")),
                                 number(r.at(linear ? "force_N" : "torque_Nm"))};
      });
  add(page,
      {"What these data can show",
       {{"effect"},
        {"parameter"},
        {"detectable from", true},
        {"nameable from", true},
        {"unit"},
        {"nearest effect"},
        {"likeness", true}},
       {},
       "No size: these data cannot show the effect at any size."},
      findings.at("certificate"), [](const json& v) {
        const std::string chosen = text(v.value("chosen", json()));
        return std::vector<Cell>{
            words(text(v.at("effect"))), words(text(v.at("parameter")) + (chosen.empty() ? "" : ", " + chosen)),
            number(v.at("detectable")),  number(v.at("nameable")),
            text(v.at("unit")),          words(text(v.at("nearest"))),
            number(v.at("likeness"))};
      });
}

}  // namespace wormdrive
