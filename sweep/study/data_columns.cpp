#include "sweep/study/data_columns.hpp"

#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "description/toml/read_pairs.hpp"

namespace wormdrive {
namespace {

/// A key of TOML, whatever stands in it.
std::string quoted_key(const std::string& key) {
  std::string text = "\"";
  for (const char c : key) {
    if (c == '"' || c == '\\') text += '\\';
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      text += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    else
      text += c;
  }
  return text + '"';
}

}  // namespace

std::string same_for_one_file(const std::string& name) {
  return std::filesystem::path(name).lexically_normal().string();
}

std::vector<double> DataColumns::read(TableReader& table, const std::string& key, const std::string& file,
                                      const std::string& column) {
  std::vector<double> values;
  if (auto in_text = stated(file, column)) {
    values = std::move(*in_text);
  } else {
    const Csv* const found = csv(table, key, file);
    if (!found) return {};
    tell_faults_of_file(table, key, file, [&] { values = found->numbers(column); });
    if (values.empty()) return {};
    read_[file][column] = values;
  }
  if (const std::size_t rows = rows_.try_emplace(same_for_one_file(file), values.size()).first->second;
      rows != values.size())
    table.fault(key,
                fmt::format("{} = \"{}\": column '{}' has {} rows but another one has {}; remove [data] to have the "
                            "file read again",
                            table.path_of(key), file, column, values.size(), rows));
  return values;
}

const Csv* DataColumns::csv(TableReader& table, const std::string& key, const std::string& file) {
  const auto [place, is_new] = files_.try_emplace(file);
  std::optional<Csv>& csv = place->second;
  if (is_new && !folder_)
    table.fault(key, fmt::format("{} = \"{}\": its values are not in [data]", table.path_of(key), file));
  if (is_new && folder_)
    tell_faults_of_file(table, key, file, [&] {
      Csv found = read_csv((std::filesystem::path(*folder_) / file).string());
      if (found.columns.front().empty())
        table.fault(key, fmt::format("{} = \"{}\" has no row below its header line", table.path_of(key), file));
      else
        csv = std::move(found);
    });
  return csv ? &*csv : nullptr;
}

std::optional<std::vector<double>> DataColumns::stated(const std::string& file, const std::string& column) const {
  const toml::table* const data = root_["data"].as_table();
  const toml::node* const columns = data ? data->get(file) : nullptr;
  const toml::node* const list = columns && columns->is_table() ? columns->as_table()->get(column) : nullptr;
  if (!list || !list->is_array() || list->as_array()->empty()) return std::nullopt;
  std::vector<double> values;
  for (const toml::node& element : *list->as_array()) {
    values.push_back(element.value<double>().value_or(std::nan("")));
    if (!std::isfinite(values.back())) return std::nullopt;
  }
  return values;
}

std::string DataColumns::text() const {
  std::string text;
  for (const auto& [file, columns] : read_) {
    text += fmt::format("\n[data.{}]\n", quoted_key(file));
    for (const auto& [column, values] : columns)
      text += fmt::format("{} = [{}]\n", quoted_key(column), fmt::join(values, ", "));
  }
  return text;
}

}  // namespace wormdrive
