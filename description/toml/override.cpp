#include "description/toml/override.hpp"

#include <algorithm>
#include <charconv>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "description/diagnostics.hpp"

namespace wormdrive {
namespace {

/// One step of an override's path: into a table by its key, or into an array by its index.
using PathStep = std::variant<std::string, std::size_t>;

/// "motor.torque[1].torque_Nm" in steps.
std::vector<PathStep> split_path(const std::string& path, const Location& where) {
  std::vector<PathStep> steps;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    const std::string part = path.substr(begin, end - begin);
    const std::string key = part.substr(0, part.find('['));
    if (key.empty()) reject(where, "an empty key; write table.key=value");
    steps.emplace_back(key);
    for (std::size_t open = key.size(); open < part.size();) {
      std::size_t index = 0;
      const char* const digits = part.data() + open + 1;
      const auto [stop, error] = std::from_chars(digits, part.data() + part.size(), index);
      if (part[open] != '[' || error != std::errc() || *stop != ']')
        reject(where, fmt::format("'{}' does not end with an index like [0]", part));
      steps.emplace_back(index);
      open = static_cast<std::size_t>(stop + 1 - part.data());
    }
    begin = end + 1;
  }
  return steps;
}

/// A table with the one key `value`. A bare word is taken as a string, so that --set run.method=adams needs no quotes
/// inside quotes.
toml::table parse_value(const std::string& text, const Location& where) {
  try {
    toml::table parsed = toml::parse("value = " + text, where.file);
    if (parsed.size() == 1) return parsed;
  } catch (const toml::parse_error&) {
  }
  try {
    return toml::parse(fmt::format("value = '''{}'''", text), where.file);
  } catch (const toml::parse_error& error) {
    reject(where, fmt::format("neither a TOML value nor plain text: {}", error.description()));
  }
}

/// Applies an override; what it inserts keeps it as its origin.
class Override {
 public:
  explicit Override(const std::string& assignment) : where_{"--set " + assignment} {
    const std::size_t equals = assignment.find('=');
    if (equals == std::string::npos) reject(where_, "no '='; write table.key=value");
    steps_ = split_path(trimmed(assignment.substr(0, equals)), where_);
    value_ = parse_value(assignment.substr(equals + 1), where_);
  }

  void apply_to(toml::table& root) {
    toml::node* node = &root;
    std::string path;
    for (std::size_t k = 0; k < steps_.size(); ++k) {
      const bool last = k + 1 == steps_.size();
      node = std::visit([&](const auto& step) { return next(*node, step, path, last); }, steps_[k]);
    }
  }

 private:
  static std::string trimmed(const std::string& text) {
    const std::size_t begin = text.find_first_not_of(' ');
    return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(' ') + 1 - begin);
  }

  /// The node under a key, made where it is missing; the last one is the new value.
  toml::node* next(toml::node& node, const std::string& key, std::string& path, bool last) {
    toml::array* const array = node.as_array();
    if (array && array->size() == 1) return next(*array->get(0), key, path, last);  // results write a single term so
    toml::table* const table = node.as_table();
    if (array) reject(where_, fmt::format("{0} is an array; name one of its elements, as in {0}[0]", path));
    if (!table) reject(where_, fmt::format("{} is not a table", path));
    path += path.empty() ? key : "." + key;
    toml::key origin(key, value_.get("value")->source());
    if (last) return &table->insert_or_assign(std::move(origin), take(value_)).first->second;
    if (toml::node* const present = table->get(key)) return present;
    toml::table made = parse_value("{}", where_);
    return &table->insert(std::move(origin), take(made)).first->second;
  }

  /// The element of an array; the last one is the new value.
  toml::node* next(toml::node& node, std::size_t index, std::string& path, bool last) {
    toml::array* const array = node.as_array();
    if (!array) reject(where_, fmt::format("{} is not an array; leave out the index [{}]", path, index));
    if (index >= array->size())
      reject(where_, fmt::format("{} has no element [{}], counted from 0; it has {}", path, index, array->size()));
    path += fmt::format("[{}]", index);
    if (last) array->replace(array->cbegin() + static_cast<std::ptrdiff_t>(index), take(value_));
    return array->get(index);
  }

  static toml::node&& take(toml::table& parsed) { return std::move(*parsed.get("value")); }

  Location where_;
  std::vector<PathStep> steps_;
  toml::table value_;
};

}  // namespace

void apply_override(toml::table& root, const std::string& assignment) { Override(assignment).apply_to(root); }

}  // namespace wormdrive
