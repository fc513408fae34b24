#include "sweep/file/reason_table.hpp"

#include <algorithm>
#include <numeric>
#include <regex>
#include <utility>

namespace wormdrive {

ReasonTable::ReasonTable(std::vector<Entry> entries) : entries_(std::move(entries)) {
  for (std::size_t k = 0; k < entries_.size(); ++k) codes_.emplace(kind_of_reason(entries_[k].example), k + 1);
}

std::size_t ReasonTable::code(const std::string& reason, std::uint64_t trial, std::uint64_t trials) {
  if (reason.empty()) return 0;
  const std::string kind = kind_of_reason(reason);
  auto known = codes_.find(kind);
  if (known == codes_.end()) {
    if (entries_.size() < most) entries_.push_back({entries_.size() + 1 == most ? "another reason" : reason});
    if (entries_.size() < most) known = codes_.emplace(kind, entries_.size()).first;
  }
  const std::size_t code = known == codes_.end() ? most : known->second;
  Entry& entry = entries_[code - 1];
  entry.count += trials;
  if (trial < entry.first) {
    entry.first = trial;
    if (code < most) entry.example = reason;
  }
  return code;
}

std::uint64_t ReasonTable::total() const {
  return std::accumulate(entries_.begin(), entries_.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const Entry& entry) { return sum + entry.count; });
}

std::vector<std::size_t> ReasonTable::order() const {
  std::vector<std::size_t> order(entries_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto end = order.begin() + static_cast<std::ptrdiff_t>(std::min(order.size(), most - 1));
  std::stable_sort(order.begin(), end,
                   [&](std::size_t a, std::size_t b) { return entries_[a].first < entries_[b].first; });
  return order;
}

bool ReasonTable::in_order() const {
  const std::vector<std::size_t> wanted = order();
  return std::is_sorted(wanted.begin(), wanted.end()) &&
         std::all_of(entries_.begin(), entries_.end(), [](const Entry& entry) { return entry.count > 0; });
}

std::vector<std::size_t> ReasonTable::put_in_order() {
  const std::vector<std::size_t> wanted = order();
  std::vector<std::size_t> new_codes(entries_.size() + 1);
  std::vector<Entry> entries;
  for (const std::size_t old : wanted) {
    entries.push_back(std::move(entries_[old]));
    new_codes[old + 1] = entries.size();
  }
  *this = ReasonTable(std::move(entries));
  return new_codes;
}

std::string kind_of_reason(const std::string& reason) {
  static const std::regex halted("^cannot go on at t = .*: "), numbers("(= |^|[ (])-?[0-9][0-9.e+-]*");
  std::string kind = std::regex_replace(reason, halted, "", std::regex_constants::format_first_only);
  return std::regex_replace(kind, numbers, "$1...");
}

}  // namespace wormdrive
