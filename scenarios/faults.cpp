#include "scenarios/faults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace wormdrive {

std::string to_string(const Location& where) {
  if (where.line == 0) return where.file;
  if (where.column == 0) return fmt::format("{}:{}", where.file, where.line);
  return fmt::format("{}:{}:{}", where.file, where.line, where.column);
}

void Faults::add(const Location& where, std::string what) { list_.push_back({where, std::move(what)}); }

void Faults::raise() const {
  if (list_.empty()) return;
  std::vector<Fault> sorted = list_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Fault& a, const Fault& b) {
    return std::tie(a.where.file, a.where.line, a.where.column) < std::tie(b.where.file, b.where.line, b.where.column);
  });
  std::string text;
  for (const Fault& fault : sorted)
    text += fmt::format("{}{}: error: {}", text.empty() ? "" : "\n", to_string(fault.where), fault.what);
  throw InputFault(text);
}

}  // namespace wormdrive
