#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/describe.hpp"
#include "cli/help_commands.hpp"
#include "cli/report_assets.hpp"
#include "cli/result_file.hpp"
#include "output/trajectory.hpp"
#include "scenarios/faults.hpp"
#include "scenarios/load_scenario.hpp"
#include "scenarios/quantities.hpp"

namespace wormdrive {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t buckets = 1500;  ///< of a long table, from each of which the extremes of every column are shown

/// The rows of a table that show every extreme: all of a short one; of a long one the first, the last and, of equally
/// many rows each, those where a column is largest and smallest.
std::vector<std::size_t> shown_rows(const std::vector<std::vector<double>>& columns) {
  const std::size_t rows = columns.front().size(), each = rows / buckets;
  std::set<std::size_t> shown;
  if (each < 4) {
    for (std::size_t k = 0; k < rows; ++k) shown.insert(shown.end(), k);
  } else {
    for (const auto& column : columns)
      for (std::size_t begin = 0; begin < rows; begin += each) {
        const auto first = column.begin() + static_cast<std::ptrdiff_t>(begin);
        const auto last = column.begin() + static_cast<std::ptrdiff_t>(std::min(begin + each, rows));
        const auto [low, high] = std::minmax_element(first, last);
        shown.insert({static_cast<std::size_t>(low - column.begin()), static_cast<std::size_t>(high - column.begin())});
      }
    shown.insert({0, rows - 1});
  }
  return {shown.begin(), shown.end()};
}

/// Eight digits are more than a screen shows; NaN has no number in JSON.
Json shortened(double value) {
  return std::isfinite(value) ? Json(std::strtod(fmt::format("{:.8g}", value).c_str(), nullptr)) : Json(nullptr);
}

/// A table of the file, its first column `over`.
Json table(const ResultFile& file, const std::string& name, const std::string& over) {
  std::vector<std::string> names = file.columns(name);
  std::stable_partition(names.begin(), names.end(), [&](const std::string& column) { return column == over; });
  std::vector<std::vector<double>> columns;
  for (const std::string& column : names) columns.push_back(file.column(name + "/" + column));
  Json result{{"rows", columns.front().size()}, {"columns", Json::array()}};
  const std::vector<std::size_t> rows = shown_rows(columns);
  result["shown"] = rows.size();
  for (std::size_t k = 0; k < names.size(); ++k) {
    const std::string at = name + "/" + names[k];
    Json values = Json::array();
    for (const std::size_t row : rows) values.push_back(shortened(columns[k][row]));
    result["columns"].push_back({{"name", names[k]},
                                 {"units", file.attribute(at, "units")},
                                 {"long_name", file.attribute(at, "long_name")},
                                 {"flags", file.attribute(at, "flag_meanings")},
                                 {"values", std::move(values)}});
  }
  return result;
}

Json events(const ResultFile& file) {
  const std::vector<std::string> names = file.columns("events");
  Json list = Json::array();
  const std::vector<double> times = file.column("events/time");
  for (std::size_t k = 0; k < times.size(); ++k) list.push_back(Json::object());
  for (const std::string& name : names) {
    const std::vector<double> values = file.column("events/" + name);
    for (std::size_t k = 0; k < values.size(); ++k)
      if (name == "kind")
        list[k][name] = wormdrive::name(event_kinds[static_cast<std::size_t>(values[k])]);
      else
        list[k][name] = name == "time" ? Json(values[k]) : shortened(values[k]);
  }
  return list;
}

Json as_json(const std::vector<Quantity>& list) {
  Json all = Json::array();
  for (const Quantity& q : list)
    all.push_back({{"name", q.name}, {"value", shortened(q.value)}, {"unit", q.unit}, {"meaning", q.meaning}});
  return all;
}

Json report_data(const ResultFile& file, const Scenario& scenario) {
  Json data{{"title", scenario.title},
            {"file", std::filesystem::path(file.path()).filename().string()},
            {"regime", describe_mesh(scenario)},
            {"trajectory", table(file, "trajectory", "time")},
            {"events", events(file)},
            {"parameters", as_json(parameters(scenario))},
            {"derived", as_json(derived(scenario))},
            {"warnings", warnings(scenario)}};
  if (file.has("controller")) data["controller"] = table(file, "controller", "time");
  for (const char* name : {"command_line", "wormdrive_version", "commit", "libraries", "created", "solver"})
    data["provenance"][name] = file.attribute("/", name);
  return data;
}

std::string escaped(const std::string& text) {
  std::string html;
  for (const char c : text) html += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  return html;
}

/// JSON inside <script>: "</script>" in a text must not end it.
std::string embedded(const Json& data) {
  std::string text = data.dump(-1, ' ', false, Json::error_handler_t::replace), safe;
  for (const char c : text) safe += c == '<' ? "\\u003c" : std::string(1, c);
  return safe;
}

/// The page with every {{mark}} of its template filled in, in one pass: contents are not looked into.
std::string page(const Json& data) {
  const std::string title = escaped(data.at("title").get<std::string>()), content = embedded(data);
  const std::pair<std::string_view, std::string_view> contents[] = {{"{{title}}", title},
                                                                    {"{{dygraphs.notice}}", assets::dygraphs_notice},
                                                                    {"{{data}}", content},
                                                                    {"{{dygraphs.css}}", assets::dygraphs_css},
                                                                    {"{{page.css}}", assets::page_css},
                                                                    {"{{dygraphs.js}}", assets::dygraphs_js},
                                                                    {"{{page.js}}", assets::page_js}};
  std::string html;
  std::string_view rest = assets::page_html;
  for (std::size_t at = rest.find("{{"); at != std::string_view::npos; at = rest.find("{{")) {
    html += rest.substr(0, at);
    rest.remove_prefix(at);
    const auto mark = std::find_if(std::begin(contents), std::end(contents),
                                   [&](const auto& entry) { return rest.starts_with(entry.first); });
    html += mark->second;
    rest.remove_prefix(mark->first.size());
  }
  return html += rest;
}

void write_page(const std::string& path, const std::string& html) {
  const std::string part = path + ".part";
  if (std::error_code none; std::filesystem::exists(path, none) && !std::filesystem::is_regular_file(path, none))
    throw OutputFault(fmt::format("cannot write {}: it is not a plain file", path));
  errno = 0;
  std::FILE* const file = std::fopen(part.c_str(), "wb");
  const bool written = file && std::fwrite(html.data(), 1, html.size(), file) == html.size();
  const bool closed = file && std::fclose(file) == 0;
  if (!written || !closed || std::rename(part.c_str(), path.c_str()) != 0) {
    const int reason = errno;
    if (file) std::remove(part.c_str());
    throw OutputFault(fmt::format("cannot write {}: {}", path, std::strerror(reason)));
  }
}

}  // namespace

int report_command(const ReportOptions& options) {
  const ResultFile file(options.file);
  if (!file.has("trajectory") || !file.has("events"))
    refuse({options.file}, fmt::format("is the result of '{}'; a report shows a run", file.attribute("/", "kind")));
  const Scenario scenario = load_scenario(options.file, {}, Purpose::look);
  const std::string output = options.output.empty()
                                 ? std::filesystem::path(options.file).replace_extension(".html").filename().string()
                                 : options.output;
  refuse_to_overwrite(output, options.file);
  const Json data = report_data(file, scenario);
  write_page(output, page(data));
  print_item("wrote", fmt::format("{}    open it in a browser; it needs nothing else", output));
  return 0;
}

}  // namespace wormdrive
