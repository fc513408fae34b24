#include "description/diagnostics.hpp"

#include <algorithm>
#include <tuple>

#include <fmt/format.h>

#include "description/one_line.hpp"

namespace wormdrive {
namespace {

std::string lines(const std::vector<Fault>& faults) {
  std::string text;
  for (const Fault& fault : faults)
    text += fmt::format("{}{}", text.empty() ? "" : "\n",
                        one_line(fmt::format("{}: error: {}", to_string(fault.where), fault.what)));
  return text;
}

}  // namespace

std::string to_string(const Location& where) {
  if (where.line == 0) return where.file;
  if (where.column == 0) return fmt::format("{}:{}", where.file, where.line);
  return fmt::format("{}:{}:{}", where.file, where.line, where.column);
}

InputFault::InputFault(std::vector<Fault> list) : std::runtime_error(lines(list)), faults(std::move(list)) {}

void reject(const Location& where, const std::string& what) { throw InputFault({{where, what}}); }

void Diagnostics::add(const Location& where, std::string what) { list_.push_back({where, std::move(what)}); }

void Diagnostics::raise() const {
  if (list_.empty()) return;
  std::vector<Fault> sorted = list_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Fault& a, const Fault& b) {
    return std::tie(a.where.file, a.where.line, a.where.column) < std::tie(b.where.file, b.where.line, b.where.column);
  });
  throw InputFault(std::move(sorted));
}

}  // namespace wormdrive
