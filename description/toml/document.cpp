#include "description/toml/document.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <vector>

#include <fmt/format.h>

#include "description/toml/override.hpp"

namespace wormdrive {
namespace {

/// toml++ may read past a NUL byte, so it never sees one.
void reject_nul(std::string_view text, const std::string& name) {
  const std::size_t position = text.find('\0');
  if (position == std::string_view::npos) return;
  const std::string_view before = text.substr(0, position);
  const auto line = static_cast<std::uint32_t>(1 + std::count(before.begin(), before.end(), '\n'));
  const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 = 0
  reject({name, line, static_cast<std::uint32_t>(position - line_start + 1)},
         "a NUL byte; a scenario is plain text or a result file (.h5)");
}

/// What was probably meant at a place where TOML cannot be read; empty if nothing is known of it.
std::string_view hint(std::string_view text, const Location& where) {
  for (std::uint32_t line = 1; line < where.line; ++line)
    text = text.substr(std::min(text.find('\n'), text.size() - 1) + 1);
  const auto is = [&](std::size_t column, bool (*what)(char)) {  // counted from 1, as in where
    return column >= 1 && column <= text.size() && what(text[column - 1]);
  };
  const auto comma = [](char c) { return c == ','; };
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  if (is(where.column, comma) && is(where.column - 1, digit) && is(where.column + 1, digit))
    return "; write decimals with a point, as in 0.25";
  return is(where.column, letter) ? "; a word needs quotes, as in kind = \"constant\"" : "";
}

toml::table parse(std::string_view text, const std::string& name) {
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    const Location where = location(error.source());
    reject({name, where.line, where.column},
           fmt::format("not valid TOML: {}{}", error.description(), hint(text, where)));
  }
}

std::string unreadable_for(int reason) {
  return fmt::format("cannot be read: {}", std::strerror(reason != 0 ? reason : EIO));
}

/// Opens a file to read; returns why it cannot be.
std::optional<std::string> opened(std::ifstream& file, const std::string& path) {
  if (std::error_code none; std::filesystem::is_directory(path, none)) return "cannot be read: it is a directory";
  errno = 0;
  file.open(path, std::ios::binary);
  return file.good() ? std::nullopt : std::optional(unreadable_for(errno));
}

}  // namespace

std::optional<std::string> why_unreadable(const std::string& path) {
  std::ifstream file;
  return opened(file, path);
}

std::string read_text(const std::string& path) {
  std::ifstream file;  // opened once: a pipe gives its text to whoever comes first
  if (const auto why = opened(file, path)) reject({path}, *why);
  errno = 0;
  std::string text;
  std::vector<char> piece(1 << 16);
  // what follows a NUL byte is not wanted: no text has one, and a device may never end
  for (bool goes_on = file.good(); goes_on;) {
    file.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    text.append(piece.data(), static_cast<std::size_t>(file.gcount()));
    goes_on =
        file.good() && text.find('\0', text.size() - static_cast<std::size_t>(file.gcount())) == std::string::npos;
  }
  if (!file && !file.eof()) reject({path}, unreadable_for(errno));
  return text;
}

toml::table parse_document(std::string_view text, const std::string& name, const std::vector<std::string>& overrides) {
  reject_nul(text, name);
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
