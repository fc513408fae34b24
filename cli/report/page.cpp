#include "cli/report/page.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/report/assets.hpp"
#include "cli/report/thinning.hpp"
#include "description/number_text.hpp"
#include "description/one_line.hpp"

namespace wormdrive {
namespace {

using Json = nlohmann::ordered_json;

/// Eight digits are more than a screen shows; NaN has no number in JSON.
Json shortened(double value) {
  if (!std::isfinite(value)) return nullptr;
  if (value == 0.0) return 0.0;
  // A power of ten up to 1e22 is exact, so that the nearest double to these digits comes out and is written with them.
  const int digits = 7 - static_cast<int>(std::floor(std::log10(std::abs(value))));
  if (digits > 22 || digits < -22) return number_in(fmt::format("{:.8g}", value)).value_or(value);
  const double power = std::pow(10.0, std::abs(digits));
  return digits >= 0 ? std::round(value * power) / power : std::round(value / power) * power;
}
Json chosen(const std::vector<double>& values, const std::vector<std::size_t>& rows) {
  Json list = Json::array();
  for (const std::size_t row : rows) list.push_back(shortened(values[row]));
  return list;
}

std::string name(ReportPanel::Style style) {
  switch (style) {
    case ReportPanel::Style::lines: return "lines";
    case ReportPanel::Style::steps: return "steps";
    case ReportPanel::Style::points: return "points";
  }
  return "";
}

Json as_json(const ReportPanel& panel) {
  std::vector<const std::vector<double>*> columns;
  for (const ReportSeries& s : panel.series) columns.push_back(&s.values);
  const std::vector<std::size_t> rows = rows_with_extremes(columns);
  Json made{{"style", name(panel.style)},
            {"filled", panel.filled},
            {"rows", panel.over.size()},
            {"limits", panel.limits},
            {"series", Json::array()}};
  made["over"] = Json::array();
  for (const std::size_t row : rows) made["over"].push_back(panel.over[row]);
  for (const ReportSeries& s : panel.series)
    made["series"].push_back(
        {{"name", s.name}, {"units", s.units}, {"meaning", s.meaning}, {"values", chosen(s.values, rows)}});
  return made;
}

Json as_json(const ReportEvent& e) {
  Json changes = Json::array();
  for (const ReportEvent::Change& c : e.changes)
    changes.push_back({c.name, c.units, shortened(c.before), shortened(c.after)});
  return {{"at", e.at}, {"what", e.what}, {"before", e.before}, {"after", e.after}, {"changes", std::move(changes)}};
}

Json as_json(const ReportGroup& group) {
  Json made{{"title", group.title},          {"over", group.over},     {"units", group.units},
            {"panels", Json::array()},       {"bands", Json::array()}, {"events", Json::array()},
            {"all_events", group.all_events}};
  for (const ReportPanel& panel : group.panels) made["panels"].push_back(as_json(panel));
  for (const ReportBand& b : group.bands) made["bands"].push_back({b.from, b.to, b.kind, b.meaning});
  for (const ReportEvent& e : group.events) made["events"].push_back(as_json(e));
  return made;
}

Json as_json(const ReportTable& table) {
  Json made{{"title", table.title}, {"note", table.note}, {"heads", Json::array()}, {"rows", Json::array()}};
  for (const ReportTable::Head& head : table.heads) made["heads"].push_back({head.name, head.number});
  for (const auto& row : table.rows) {
    Json cells = Json::array();
    for (const auto& cell : row)
      cells.push_back(std::holds_alternative<double>(cell) ? shortened(std::get<double>(cell))
                                                           : Json(std::get<std::string>(cell)));
    made["rows"].push_back(std::move(cells));
  }
  return made;
}

Json as_json(const ReportPage& page) {
  Json made{{"title", page.title},     {"summary", page.summary}, {"verdict", page.verdict}, {"remarks", page.remarks},
            {"groups", Json::array()}, {"tables", Json::array()}, {"texts", Json::array()}};
  for (const ReportGroup& group : page.groups) made["groups"].push_back(as_json(group));
  for (const ReportTable& table : page.tables) made["tables"].push_back(as_json(table));
  for (const ReportText& text : page.texts) made["texts"].push_back({text.title, text.text});
  return made;
}

std::string escaped(const std::string& text) {
  std::string html;
  for (const char c : one_line(text))  // control characters are none of HTML's
    html += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  return html;
}

/// Bytes that are no UTF-8, as in a file's name, are replaced.
std::string dumped(const Json& data) { return data.dump(-1, ' ', false, Json::error_handler_t::replace); }

}  // namespace

std::string words(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

ReportTable table_of(const std::string& title, const std::vector<Quantity>& quantities) {
  ReportTable table{title, {{"name"}, {"value", true}, {"unit"}, {"meaning"}}, {}};
  for (const Quantity& q : quantities) table.rows.push_back({q.name, q.value, q.unit == "1" ? "" : q.unit, q.meaning});
  return table;
}

std::string to_json(const ReportPage& page) { return dumped(as_json(page)); }

/// "</script>" in a text must not end it.
std::string embedded(const Json& data) {
  std::string safe;
  for (const char c : dumped(data))
    if (c == '<')
      safe += "\\u003c";
    else
      safe += c;
  return safe;
}

/// Every {{mark}} of the template is filled in, in one pass: contents are not looked into.
std::string to_html(const ReportPage& page, const PageAdditions& additions) {
  const std::string title = escaped(page.title), content = embedded(as_json(page));
  const std::pair<std::string_view, std::string_view> contents[] = {{"{{title}}", title},
                                                                    {"{{dygraphs.notice}}", assets::dygraphs_notice},
                                                                    {"{{data}}", content},
                                                                    {"{{dygraphs.css}}", assets::dygraphs_css},
                                                                    {"{{page.css}}", assets::page_css},
                                                                    {"{{dygraphs.js}}", assets::dygraphs_js},
                                                                    {"{{page.js}}", assets::page_js},
                                                                    {"{{before}}", additions.before},
                                                                    {"{{after}}", additions.after}};
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

}  // namespace wormdrive
