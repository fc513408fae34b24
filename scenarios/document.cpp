#include "scenarios/document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace wormdrive {
namespace {

[[noreturn]] void fail(const Location& where, const std::string& what) {
  Faults faults;
  faults.add(where, what);
  faults.raise();
  throw std::logic_error("a fault was added");
}

/// toml++ may read past a NUL byte, so it never sees one.
void refuse_nul(std::string_view text, const std::string& name) {
  const std::size_t position = text.find('\0');
  if (position == std::string_view::npos) return;
  const std::string_view before = text.substr(0, position);
  const auto line = static_cast<std::uint32_t>(1 + std::count(before.begin(), before.end(), '\n'));
  const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 = 0
  fail({name, line, static_cast<std::uint32_t>(position - line_start + 1)}, "a NUL byte; a scenario is plain text");
}

toml::table parse(std::string_view text, const std::string& name) {
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    const Location where = location(error.source());
    fail({name, where.line, where.column}, fmt::format("not valid TOML: {}", error.description()));
  }
}

/// One step of an override's path: a key, or an index in brackets.
struct Step {
  std::string key;
  std::vector<std::size_t> indices;
};

std::vector<Step> split_path(const std::string& path, const Location& where) {
  std::vector<Step> steps;
  std::stringstream parts(path);
  for (std::string part; std::getline(parts, part, '.');) {
    Step step{part.substr(0, part.find('[')), {}};
    for (std::size_t open = part.find('['); open != std::string::npos; open = part.find('[', open + 1)) {
      std::size_t index = 0;
      const char* const begin = part.data() + open + 1;
      const auto [end, error] = std::from_chars(begin, part.data() + part.size(), index);
      if (error != std::errc() || *end != ']') fail(where, fmt::format("'{}' is not an index like [0]", part));
      step.indices.push_back(index);
    }
    if (step.key.empty()) fail(where, "an empty key; write table.key=value");
    steps.push_back(step);
  }
  if (steps.empty()) fail(where, "an empty key; write table.key=value");
  return steps;
}

/// The table in which the last key of a path stands, made where it is missing.
toml::table& descend(toml::table& root, const std::vector<Step>& steps, const Location& where) {
  toml::table* table = &root;
  for (std::size_t k = 0; k + 1 < steps.size(); ++k) {
    toml::node* node = table->get(steps[k].key);
    if (!node) node = &table->insert(steps[k].key, toml::table{}).first->second;
    for (const std::size_t index : steps[k].indices) {
      toml::array* const array = node->as_array();
      if (!array || index >= array->size())
        fail(where, fmt::format("there is no {}[{}] in the scenario", steps[k].key, index));
      node = array->get(index);
    }
    table = node->as_table();
    if (!table) fail(where, fmt::format("'{}' is not a table", steps[k].key));
  }
  return *table;
}

void apply_override(toml::table& root, const std::string& assignment) {
  const Location where{"--set " + assignment};
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos) fail(where, "no '='; write table.key=value");
  const std::string value = assignment.substr(equals + 1);
  refuse_nul(value, where.file);
  const std::vector<Step> steps = split_path(assignment.substr(0, equals), where);
  toml::table& table = descend(root, steps, where);
  if (!steps.back().indices.empty()) fail(where, "the path must end with a key");
  // A bare word is taken as a string, so that --set run.method=adams needs no quotes inside quotes.
  toml::table parsed;
  try {
    parsed = toml::parse("value = " + value, where.file);
  } catch (const toml::parse_error&) {
    parsed = toml::parse("value = '" + value + "'", where.file);
  }
  table.insert_or_assign(steps.back().key, std::move(*parsed.get("value")));
}

}  // namespace

std::string read_text(const std::string& path) {
  if (std::filesystem::is_directory(path)) fail({path}, "cannot be read: it is a directory");
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (file) text << file.rdbuf();
  if (!file) fail({path}, fmt::format("cannot be read: {}", std::strerror(errno != 0 ? errno : EIO)));
  return text.str();
}

toml::table parse_document(std::string_view text, const std::string& name, const std::vector<std::string>& overrides) {
  refuse_nul(text, name);
  toml::table root = parse(text, name);
  for (const std::string& assignment : overrides) apply_override(root, assignment);
  return root;
}

Location location(const toml::source_region& region) {
  Location where{region.path ? *region.path : "", region.begin.line, region.begin.column};
  if (where.file.starts_with("--set")) where.line = where.column = 0;
  return where;
}

}  // namespace wormdrive
