#pragma once
#include <string>

#include <fmt/format.h>

namespace wormdrive {

/// A word as a shell takes it back: quoted unless every character of it is plain.
inline std::string shell_word(const std::string& word) {
  if (!word.empty() && word.find_first_of(" \t\r\n'\"$&|;<>()*?[]{}#~`\\!^") == std::string::npos) return word;
  std::string quoted;
  for (const char c : word) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return fmt::format("'{}'", quoted);
}

/// The same of a path, which no command takes for an option.
inline std::string shell_path(const std::string& path) {
  return shell_word(path.starts_with('-') ? "./" + path : path);
}

}  // namespace wormdrive
