#include "cli/export/exported_table.hpp"

#include <iterator>

#include <fmt/format.h>

#include "output/trajectory.hpp"

namespace wormdrive {
namespace {

/// "rad/s^2" as the end of a name: "_rad_per_s2"; nothing for pure numbers.
std::string suffix_of(const std::string& units) {
  if (units.empty() || units == "1") return "";
  std::string suffix = "_";
  for (const char c : units) {
    if (c == '/')
      suffix += "_per_";
    else if (c != ' ' && c != '^')
      suffix += c;
  }
  return suffix;
}

std::string word_for_kind(double kind) { return std::string(name(event_kinds[static_cast<std::size_t>(kind)])); }

}  // namespace

std::vector<ExportedTable> exported_tables(const ResultFile& run) {
  std::vector<ExportedTable> tables;
  for (const std::string table : {"trajectory", "events", "controller"}) {
    if (!run.has(table)) continue;
    ExportedTable& exported = tables.emplace_back(ExportedTable{table, {}});
    const std::vector<std::string> names = run.columns(table);
    const auto add = [&](const std::string& name) {
      const std::string path = table + "/" + name, flags = run.attribute(path, "flag_meanings");
      std::string meaning = run.attribute(path, "long_name");
      if (!flags.empty()) meaning += ": " + flags;
      exported.columns.push_back({name, run.attribute(path, "units"), meaning, run.column(path)});
    };
    add("time");  // the others stand over it
    for (const std::string& name : names)
      if (name != "time") add(name);
  }
  return tables;
}

std::string csv_of(const ExportedTable& table) {
  std::string text;
  for (const ExportedColumn& column : table.columns)
    text += (text.empty() ? "" : ",") + column.name + suffix_of(column.units);
  text += '\n';
  for (std::size_t row = 0; row < table.columns.front().values.size(); ++row) {
    for (const ExportedColumn& column : table.columns) {
      if (&column != &table.columns.front()) text += ',';
      if (column.name == "kind")
        text += word_for_kind(column.values[row]);
      else
        fmt::format_to(std::back_inserter(text), "{}", column.values[row]);
    }
    text += '\n';
  }
  return text;
}

}  // namespace wormdrive
