#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/report/diagnosis_tables.hpp"
#include "cli/report/kinds.hpp"
#include "description/diagnostics.hpp"
#include "diagnosis/report/diagnosis_json.hpp"
#include "output/classic_locale.hpp"

namespace wormdrive {
namespace {

using nlohmann::json;

std::string findings_of(const ResultFile& file) {
  return (std::filesystem::path(file.path()).parent_path() / "diagnosis.json").string();
}

json read_findings(const ResultFile& file) {
  const std::string path = findings_of(file);
  std::ifstream text(path);
  const ClassicLocale read_so;
  const json findings = json::parse(text, nullptr, false);
  if (findings.is_discarded()) reject({path}, "cannot be read; wormdrive diagnose writes it next to diagnosis.h5");
  return findings;
}

/// What a verdict means, for those who have not read the documentation.
std::string_view meaning(Verdict verdict) {
  switch (verdict) {
    case Verdict::adequate: return "the scenario contains every effect that these data show";
    case Verdict::named: return "the causes are known";
    case Verdict::ambiguous: return "the cause is one of a class that these data cannot distinguish";
    case Verdict::unexplained: return "something is missing that no effect of the catalogue explains";
  }
  return "";
}

std::string explained(const std::string& verdict) {
  for (const Verdict known : {Verdict::adequate, Verdict::named, Verdict::ambiguous, Verdict::unexplained})
    if (name(known) == verdict) return fmt::format("{}: {}", verdict, meaning(known));
  return verdict;
}

/// "of a recording over time, bench.csv"
std::string described_data(const json& data) {
  std::string all = text(data.at("kind"));
  for (const json& file : data.at("files")) all += ", " + std::filesystem::path(text(file)).filename().string();
  return all;
}

/// Time where it rises throughout; else, of several recordings, the number of the sample.
bool rises(const std::vector<double>& time) {
  return !time.empty() && std::is_sorted(time.begin(), time.end()) && !std::isnan(time.front());
}

std::vector<ReportPanel> residual_panels(const ResultFile& file, const std::vector<double>& over) {
  const auto series = [&](const std::string& name) {
    const std::string at = "residual/" + name;
    return ReportSeries{name, file.attribute(at, "units"), file.attribute(at, "long_name"), file.column(at)};
  };
  std::vector<ReportPanel> panels{{over, {series("before"), series("after")}}};
  for (const std::string name : {"gear_speed", "gear_angle", "load_torque"})
    if (ReportSeries one = series(name);
        std::any_of(one.values.begin(), one.values.end(), [](double x) { return !std::isnan(x); }))
      panels.push_back({over, {std::move(one)}});
  return panels;
}

std::vector<ReportBand> held_out_bands(const ResultFile& file, const std::vector<double>& over) {
  const std::vector<double> held_out = file.column("residual/held_out");
  std::vector<ReportBand> bands;
  for (std::size_t k = 0; k < over.size(); ++k) {
    if (held_out[k] == 0.0) continue;
    if (bands.empty() || held_out[k - 1] == 0.0) bands.push_back({over[k], over[k], "stuck", "not used for the fit"});
    bands.back().to = over[k];
  }
  return bands;
}

struct Predictions {
  std::string units, what;
  std::vector<double> horizon, example, time, measured, before, after;
};

/// The error of predictions of one horizon over time, one stretch after the other with a gap between them.
ReportPanel prediction_panel(const Predictions& p, double horizon) {
  const std::string what = fmt::format("error of the {} predicted {:g} s ahead, stated model", p.what, horizon);
  ReportPanel panel{{}, {{"before", p.units, what, {}}, {"after", p.units, "extended model", {}}}};
  std::map<double, double> start;  // of each stretch
  for (std::size_t k = 0; k < p.time.size(); ++k) start.try_emplace(p.example[k], p.time[k]);
  std::vector<std::size_t> rows;
  for (std::size_t k = 0; k < p.time.size(); ++k)
    if (p.horizon[k] == horizon) rows.push_back(k);
  std::stable_sort(rows.begin(), rows.end(),
                   [&](std::size_t a, std::size_t b) { return start.at(p.example[a]) < start.at(p.example[b]); });
  for (std::size_t n = 0; n < rows.size(); ++n) {
    const std::size_t k = rows[n];
    const bool gap = n > 0 && p.example[k] != p.example[rows[n - 1]];
    panel.over.push_back(p.time[k]);
    panel.series[0].values.push_back(gap ? NAN : p.before[k] - p.measured[k]);
    panel.series[1].values.push_back(gap ? NAN : p.after[k] - p.measured[k]);
  }
  return panel;
}

void add_predictions(const ResultFile& file, ReportGroup& group) {
  if (!file.has("examples")) return;
  const auto column = [&](const std::string& name) { return file.column("examples/" + name); };
  const std::string units = file.attribute("examples/measured", "units");
  const Predictions p{units,
                      units == "m" ? "position" : "angle",
                      column("horizon"),
                      column("example"),
                      column("time"),
                      column("measured"),
                      column("before"),
                      column("after")};
  for (const double horizon : std::set<double>(p.horizon.begin(), p.horizon.end())) {
    ReportPanel panel = prediction_panel(p, horizon);
    if (rises(panel.over)) group.panels.insert(group.panels.begin(), std::move(panel));
  }
}

/// Torques at constant speed or at break-in: measured, and as both models have them.
void add_torques(const ResultFile& file, ReportPage& page) {
  const auto column = [&](const std::string& name) { return file.column("torques/" + name); };
  if (!file.has("torques") || column("measured").empty()) return;
  const std::vector<double> speed = column("worm_speed");
  const bool moves = std::any_of(speed.begin(), speed.end(), [](double w) { return w != 0.0; });
  const std::vector<double> over = moves ? speed : column("load_torque");
  std::vector<std::size_t> order(over.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return over[a] < over[b]; });
  ReportPanel panel{{}, {}, ReportPanel::Style::points};
  const auto described = [&](const std::string& name, const char* what) {
    return file.attribute("torques/" + name, what);
  };
  for (const std::string name : {"measured", "before", "after"}) {
    ReportSeries series{name, described(name, "units"), described(name, "long_name"), {}};
    const std::vector<double> values = column(name);
    for (const std::size_t k : order) series.values.push_back(values[k]);
    panel.series.push_back(std::move(series));
  }
  for (const std::size_t k : order) panel.over.push_back(over[k]);
  const std::string x = moves ? "worm_speed" : "load_torque";
  const std::string meaning = described(x, "long_name");
  page.groups.push_back({described("measured", "units") == "N" ? "Forces" : "Torques",
                         meaning.substr(0, meaning.find(',')),
                         described(x, "units"),
                         {std::move(panel)}});
}

ReportPage page_of(const ResultFile& file, const json& findings) {
  ReportPage page;
  page.summary = fmt::format("Diagnosis of {}. Verdict {}", described_data(findings.at("data")),
                             explained(text(findings.at("verdict"))));
  page.verdict = text(findings.at("sentence"));
  for (const json& remark : findings.at("remarks")) page.remarks.push_back(text(remark));
  if (const std::string next = text(findings.at("experiment")); !next.empty()) page.remarks.push_back("Next: " + next);
  add_torques(file, page);
  std::vector<double> over = file.column("residual/time");
  if (page.groups.empty() && !over.empty()) {
    const bool timed = rises(over);
    for (std::size_t k = 0; !timed && k < over.size(); ++k) over[k] = static_cast<double>(k);
    ReportGroup group{"", timed ? "time" : "sample", timed ? "s" : "1", residual_panels(file, over)};
    group.bands = held_out_bands(file, over);
    if (timed) add_predictions(file, group);
    page.groups.push_back(std::move(group));
  }
  add_tables(page, findings);
  return page;
}

}  // namespace

ReportPage report_of_diagnosis(const ResultFile& file) {
  const json findings = read_findings(file);
  try {
    return page_of(file, findings);
  } catch (const json::exception&) {  // a key is missing, or of another type
    reject({findings_of(file)}, "was not written by wormdrive diagnose");
  }
}

}  // namespace wormdrive
