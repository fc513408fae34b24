#include "description/toml/table_reader.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "description/toml/document.hpp"

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

/// Integers are numbers like any other, however long.
std::optional<double> as_double(const toml::node& node) {
  if (const auto* integer = node.as_integer()) return static_cast<double>(integer->get());
  return node.value<double>();
}

/// Where a reader looks for a table that is not there.
const toml::table nothing;

std::string with_unit(const std::string& number, const Unit& unit) {
  return unit.suffix.empty() ? number : fmt::format("{} {}", number, unit.symbol);
}

}  // namespace

std::string quantity(double si, const Unit& unit) { return with_unit(fmt::format("{:.6g}", si / unit.si), unit); }

std::string rule(const Bounds& bounds, const Unit& unit) {
  const std::string low =
      fmt::format("{} {}", bounds.low_exclusive ? "greater than" : "at least", quantity(bounds.low, unit));
  const std::string high =
      fmt::format("{} {}", bounds.high_exclusive ? "less than" : "at most", quantity(bounds.high, unit));
  if (std::isinf(bounds.high)) return "must be " + low;
  if (std::isinf(bounds.low)) return "must be " + high;
  return fmt::format("must be {} and {}", low, high);
}

TableReader::TableReader(const toml::table* table, std::string path, Axis axis, Diagnostics& faults,
                         Location missing_at)
    : present_(table != nullptr),
      table_(table ? *table : nothing),
      path_(std::move(path)),
      axis_(axis),
      faults_(faults),
      here_(location(table_.source())) {
  if (here_.file.empty() || path_.empty()) here_ = std::move(missing_at);  // the root is the whole file
}

std::string TableReader::table_name() const {
  if (path_.empty()) return whole_;
  return path_.ends_with(']') ? path_ : fmt::format("[{}]", path_);
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
  if (const auto spelling = stated(name, unit)) return number(*spelling, bounds);
  if (presence == Presence::required)
    missing_.push_back({spellings(name, unit, axis_).front().key, in_words_of(axis_, meaning)});
  return std::nullopt;
}

std::optional<double> TableReader::number(const Spelling& spelling, const Bounds& bounds) {
  const toml::node& node = *table_.get(spelling.key);
  const std::string path = path_of(spelling.key);
  const std::optional<double> value = as_double(node);
  if (!value) {
    wrong_type(spelling.key, node, "a number");
  } else if (!std::isfinite(*value)) {
    fault(spelling.key, fmt::format("{} = {} must be a finite number", path, *value));
  } else if (!bounds.contain(*value * spelling.unit.si)) {
    fault(spelling.key, fmt::format("{} = {} {}", path, with_unit(fmt::format("{}", *value), spelling.unit),
                                    rule(bounds, spelling.unit)));
  } else if (spelling.unit.whole && *value != std::floor(*value)) {
    fault(spelling.key, fmt::format("{} = {} {}", path, *value, must_be_whole));
  } else {
    return *value * spelling.unit.si;
  }
  return std::nullopt;
}

namespace {

bool is_override(const toml::table& table, const std::string& key) {
  const toml::source_path_ptr source = table.get(key)->source().path;
  return source && source->starts_with("--set ");
}

}  // namespace

std::optional<Spelling> TableReader::stated(std::string_view name, const Unit& unit) {
  std::optional<Spelling> first;
  for (const Spelling& spelling : spellings(name, unit, axis_)) {
    if (!find(spelling.key)) continue;
    // an override replaces what a file states, in whatever unit
    if (first && is_override(table_, spelling.key) != is_override(table_, first->key)) {
      if (is_override(table_, spelling.key)) first = spelling;
    } else if (first)
      fault(spelling.key, fmt::format("{} is stated twice, also as {}; keep one", path_of(spelling.key), first->key));
    else
      first = spelling;
  }
  return first;
}

std::optional<std::vector<double>> TableReader::numbers(const Spelling& spelling) {
  const toml::node& node = *table_.get(spelling.key);
  if (!node.is_array()) {
    wrong_type(spelling.key, node, "an array of numbers");
    return std::nullopt;
  }
  std::vector<double> values;
  for (const toml::node& element : *node.as_array()) {
    const std::optional<double> value = as_double(element);
    if (value && std::isfinite(*value)) {
      values.push_back(*value * spelling.unit.si);
      continue;
    }
    const std::string name = fmt::format("{}[{}]", path_of(spelling.key), values.size());
    faults_.add(location(element.source()), value
                                                ? fmt::format("{} = {} must be a finite number", name, *value)
                                                : fmt::format("{} must be a number, not {}", name, type_name(element)));
    return std::nullopt;
  }
  return values;
}

std::optional<std::string> TableReader::text(const std::string& key) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  if (!node->is_string()) wrong_type(key, *node, "a string");
  return node->value<std::string>();
}

std::optional<std::string> TableReader::line(const std::string& key) {
  const std::optional<std::string> words = text(key);
  if (!words) return words;
  for (std::size_t k = 0; k < words->size(); ++k) {
    const auto byte = static_cast<unsigned char>((*words)[k]);
    const std::string_view wide = std::string_view(*words).substr(k, 3);
    const bool no_character = wide == "\xEF\xBF\xBE" || wide == "\xEF\xBF\xBF";  // no XML has these two
    if (byte == '\t' || (byte >= 0x20 && byte != 0x7F && !no_character)) continue;
    fault(key, fmt::format("{} must be one line without control characters; its character {} is U+{:04X}", path_of(key),
                           k + 1, no_character ? 0xFF40 + static_cast<unsigned char>(wide[2]) : byte));
    return std::nullopt;
  }
  return words;
}

std::vector<std::string> TableReader::texts(const std::string& key) {
  const toml::node* node = find(key);
  if (!node) return {};
  if (!node->is_array()) wrong_type(key, *node, "an array of strings");
  std::vector<std::string> list;
  for (std::size_t k = 0; node->is_array() && k < node->as_array()->size(); ++k) {
    const toml::node& element = *node->as_array()->get(k);
    if (const auto word = element.value<std::string>())
      list.push_back(*word);
    else
      faults_.add(location(element.source()),
                  fmt::format("{}[{}] must be a string, not {}", path_of(key), k, type_name(element)));
  }
  return list;
}

std::optional<std::string> TableReader::required_text(const std::string& key, std::string_view meaning) {
  if (!find(key)) lacks(fmt::format("'{}' ({})", key, meaning));
  return text(key);
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
    lacks(fmt::format("'{}' (one of \"{}\")", key, fmt::join(words, "\", \"")));
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
  if (!array || array->empty()) {
    fault(key, fmt::format("{} must be a table or an array of tables, not {}", path_of(key),
                           array ? "an empty array" : type_name(*node)));
    return {};
  }
  std::vector<const toml::table*> list;
  for (const toml::node& element : *array) {
    if (!element.is_table())
      faults_.add(location(element.source()),
                  fmt::format("{}[{}] must be a table, not {}", path_of(key), list.size(), type_name(element)));
    list.push_back(element.as_table());
  }
  std::erase(list, nullptr);
  return list;
}

void TableReader::lacks(const std::string& what) { faults_.add(here_, fmt::format("{} lacks {}", table_name(), what)); }

void TableReader::finish() {
  for (const auto& [key, node] : table_) {
    if (!knows_all_) break;
    const std::string name(key.str());
    if (std::find(valid_.begin(), valid_.end(), name) != valid_.end()) continue;
    Location at = location(key.source());
    if (at.file.empty()) at = location(node.source());
    faults_.add(at, fmt::format("unknown {} '{}' in {}; {}", node.is_table() ? "table" : "key", name, table_name(),
                                suggestion(name, valid_)));
    // A misspelled key is one fault, not also a missing one.
    const auto meant = probably_meant(name, valid_);
    std::erase_if(missing_, [&](const Missing& missing) { return missing.key == meant; });
  }
  if (present_) {
    for (const Missing& missing : missing_) lacks(fmt::format("'{}' ({})", missing.key, missing.meaning));
  } else if (!missing_.empty()) {
    std::vector<std::string> keys;
    for (const Missing& missing : missing_) keys.push_back(missing.key);
    faults_.add(here_, fmt::format("there is no {}; it needs {}", table_name(), fmt::join(keys, ", ")));
  }
}

}  // namespace wormdrive
