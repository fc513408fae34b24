#include "scenarios/table_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "scenarios/document.hpp"

namespace wormdrive {
namespace {

std::string_view type_name(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::none: return "nothing";
    case toml::node_type::table: return "a table";
    case toml::node_type::array: return "an array";
    case toml::node_type::string: return "a string";
    case toml::node_type::integer:
    case toml::node_type::floating_point: return "a number";
    case toml::node_type::boolean: return "true or false";
    case toml::node_type::date:
    case toml::node_type::time:
    case toml::node_type::date_time: return "a date or time";
  }
  return "something else";
}

std::string with_unit(const std::string& number, const Unit& unit) {
  return unit.suffix.empty() ? number : fmt::format("{} {}", number, unit.symbol);
}

}  // namespace

std::string quantity(double si, const Unit& unit) { return with_unit(fmt::format("{:.6g}", si / unit.si), unit); }

std::string rule(const Bounds& bounds, const Unit& unit) {
  const std::string low = fmt::format("{} {}", bounds.low_exclusive ? "greater than" : "at least", quantity(bounds.low, unit));
  const std::string high = fmt::format("{} {}", bounds.high_exclusive ? "less than" : "at most", quantity(bounds.high, unit));
  if (std::isinf(bounds.high)) return "must be " + low;
  if (std::isinf(bounds.low)) return "must be " + high;
  return fmt::format("must be {} and {}", low, high);
}

TableReader::TableReader(const toml::table& table, std::string path, Axis axis, Faults& faults, Location missing_at)
    : table_(table), path_(std::move(path)), axis_(axis), faults_(faults), here_(location(table.source())) {
  if (here_.file.empty()) here_ = std::move(missing_at);
}

const toml::node* TableReader::find(const std::string& key) {
  if (std::find(valid_.begin(), valid_.end(), key) == valid_.end()) valid_.push_back(key);
  return table_.get(key);
}

Location TableReader::where(const std::string& key) const {
  const toml::node* node = table_.get(key);
  return node ? location(node->source()) : here_;
}

void TableReader::wrong_type(const std::string& key, const toml::node& node, std::string_view wanted) {
  fault(key, fmt::format("{} must be {}, not {}", path_of(key), wanted, type_name(node)));
}

std::optional<double> TableReader::number(std::string_view name, const Unit& unit, const Bounds& bounds,
                                          Presence presence, std::string_view meaning) {
  std::optional<double> value;
  std::optional<std::string> first;
  const std::vector<Spelling> accepted = spellings(name, unit, axis_);
  for (const Spelling& spelling : accepted) {
    const toml::node* node = find(spelling.key);
    if (!node) continue;
    if (first) fault(spelling.key, fmt::format("{} is stated twice, also as {}", path_of(spelling.key), *first));
    first = spelling.key;
    const std::optional<double> stated = node->is_number() ? node->value<double>() : std::nullopt;
    if (!stated) {
      wrong_type(spelling.key, *node, "a number");
    } else if (!std::isfinite(*stated)) {
      fault(spelling.key, fmt::format("{} = {} must be a finite number", path_of(spelling.key), *stated));
    } else if (!bounds.contain(*stated * spelling.unit.si)) {
      fault(spelling.key, fmt::format("{} = {} {}", path_of(spelling.key),
                                      with_unit(fmt::format("{}", *stated), spelling.unit), rule(bounds, spelling.unit)));
    } else {
      value = *stated * spelling.unit.si;
    }
  }
  if (!first && presence == Presence::required)
    faults_.add(here_, fmt::format("{} lacks '{}' ({})", table_name(), accepted.front().key, meaning));
  return value;
}

std::optional<std::vector<double>> TableReader::numbers(std::string_view name, const Unit& unit) {
  for (const Spelling& spelling : spellings(name, unit, axis_)) {
    const toml::node* node = find(spelling.key);
    if (!node) continue;
    const toml::array* array = node->as_array();
    if (!array) {
      wrong_type(spelling.key, *node, "an array of numbers");
      return std::nullopt;
    }
    std::vector<double> values;
    for (const toml::node& element : *array) {
      const std::optional<double> value = element.is_number() ? element.value<double>() : std::nullopt;
      if (!value || !std::isfinite(*value)) {
        faults_.add(location(element.source()),
                    fmt::format("{}[{}] must be a finite number", path_of(spelling.key), values.size()));
        return std::nullopt;
      }
      values.push_back(*value * spelling.unit.si);
    }
    return values;
  }
  return std::nullopt;
}

std::optional<std::string> TableReader::text(const std::string& key) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  if (!node->is_string()) wrong_type(key, *node, "a string");
  return node->value<std::string>();
}

std::optional<bool> TableReader::truth(const std::string& key) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  if (!node->is_boolean()) {
    wrong_type(key, *node, "true or false");
    return std::nullopt;
  }
  return node->value<bool>();
}

std::optional<std::string> TableReader::choice(const std::string& key, const std::vector<std::string>& words,
                                               Presence presence) {
  if (!find(key)) {
    if (presence == Presence::optional) return words.front();
    faults_.add(here_, fmt::format("{} lacks '{}' (one of \"{}\")", table_name(), key, fmt::join(words, "\", \"")));
    return std::nullopt;
  }
  const std::optional<std::string> word = text(key);
  if (!word || std::find(words.begin(), words.end(), *word) != words.end()) return word;
  fault(key, fmt::format("{} = \"{}\" must be one of \"{}\"", path_of(key), *word, fmt::join(words, "\", \"")));
  return std::nullopt;
}

const toml::table* TableReader::table(const std::string& key) {
  const toml::node* node = find(key);
  if (node && !node->is_table()) wrong_type(key, *node, "a table");
  return node ? node->as_table() : nullptr;
}

std::vector<const toml::table*> TableReader::tables(const std::string& key) {
  const toml::node* node = find(key);
  if (!node) return {};
  if (const toml::table* one = node->as_table()) return {one};
  const toml::array* const array = node->as_array();
  if (!array || !array->is_homogeneous<toml::table>()) {
    wrong_type(key, *node, "a table or an array of tables");
    return {};
  }
  std::vector<const toml::table*> list;
  for (const toml::node& element : *array) list.push_back(element.as_table());
  return list;
}

void TableReader::refuse_unknown_keys() {
  for (const auto& [key, node] : table_) {
    const std::string name(key.str());
    if (std::find(valid_.begin(), valid_.end(), name) != valid_.end()) continue;
    Location at = location(key.source());
    if (at.file.empty()) at = location(node.source());
    faults_.add(at, fmt::format("unknown key '{}' in {}; {}", name, table_name(), suggestion(name, valid_)));
  }
}

}  // namespace wormdrive
