#include "cli/describe_sweep.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "cli/describe.hpp"

namespace wormdrive {
namespace {

std::vector<ReasonTable::Entry> by_frequency(const ReasonTable& reasons) {
  std::vector<ReasonTable::Entry> list = reasons.entries();
  std::stable_sort(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.count > b.count; });
  return list;
}

}  // namespace

void print_study(const Study& study, TrialRange range) {
  fmt::print("{}\n", study.title);
  const std::string part =
      range.size() == study.trials() ? "" : fmt::format(", of these {} to {}", range.first, range.end - 1);
  print_item("study", fmt::format("{} of {} parameter{}, {} trials{}, seed {}",
                                  std::visit([](const auto& design) { return design.kind; }, study.design),
                                  study.parameters.size(), study.parameters.size() == 1 ? "" : "s", study.trials(),
                                  part, study.seed));
  print_item("scenario", study.scenario.title);
}

void print_failures(const ReasonTable& reasons) {
  constexpr std::size_t most = 5;
  const auto list = by_frequency(reasons);
  for (std::size_t k = 0; k < std::min(most, list.size()); ++k)
    print_item("failed", fmt::format("{}: {}", list[k].count, list[k].example));
  if (list.size() > most)
    print_item("failed", fmt::format("... {} reasons, {} trials in all", list.size(), reasons.total()));
}

std::string most_frequent(const ReasonTable& reasons) { return by_frequency(reasons).front().example; }

}  // namespace wormdrive
