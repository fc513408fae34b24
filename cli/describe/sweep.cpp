#include "cli/describe/sweep.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/describe/drive.hpp"
#include "description/keys.hpp"

namespace wormdrive {
namespace {

std::vector<ReasonTable::Entry> by_frequency(const ReasonTable& reasons) {
  std::vector<ReasonTable::Entry> list = reasons.entries();
  std::stable_sort(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.count > b.count; });
  return list;
}

void raise(Disagreement& largest, const Disagreement& found) {
  largest.angle = std::max(largest.angle, found.angle);
  largest.speed = std::max(largest.speed, found.speed);
}

}  // namespace

std::string in_unit(const Unit& unit) {
  return unit.symbol == unit::none.symbol ? "" : fmt::format(" {}", unit.symbol);
}

std::string with_interval(const SampleEstimate& e, double scale) {
  if (!e.has_interval()) return fmt::format("{:.4g}", e.value * scale);
  return fmt::format("{:.4g} [{:.4g}, {:.4g}]", e.value * scale, e.low * scale, e.high * scale);
}

std::string with_interval(const std::optional<SampleEstimate>& e) { return e ? with_interval(*e) : "unknown"; }

std::string with_value(const Metric& metric, double value) {
  return std::isnan(value) ? fmt::format("without {}", metric.name)
                           : fmt::format("{} {:.6g}{}", metric.name, value, in_unit(metric.unit));
}

std::string how_it_ended(const Study& study, const std::string& metric_name, const Trial& trial) {
  if (trial.status != TrialStatus::done) return fmt::format("{}: {}", name(trial.status), trial.reason);
  const std::size_t place = study.place_of(metric_name);
  return with_value(study.metrics[place], trial.metrics[place]);
}

void print_study(const Study& study, TrialRange range) {
  fmt::print("{}\n", study.title);
  const std::string part =
      range.size() == study.trials() ? "" : fmt::format(", here {} to {}", range.first, range.end - 1);
  print_item("study", fmt::format("{} of {} parameter{}, {}{} trials{}, seed {}",
                                  std::visit([](const auto& design) { return design.kind; }, study.design),
                                  study.parameters.size(), study.parameters.size() == 1 ? "" : "s",
                                  study.may_end_early() ? "at most " : "", study.trials(), part, study.seed));
  print_item("scenario", study.scenario.title);
}

void print_failures(const ReasonTable& reasons) {
  constexpr std::size_t most = 5;
  const auto list = by_frequency(reasons);
  for (std::size_t k = 0; k < std::min(most, list.size()); ++k)
    print_item("failed", fmt::format("{} trial{}: {}", list[k].count, list[k].count == 1 ? "" : "s", list[k].example));
  if (list.size() > most)
    print_item("failed", fmt::format("{} reasons in total, for {} trials", list.size(), reasons.total()));
}

void print_verdicts(const std::vector<RefereeVerdict>& verdicts, const Study& study) {
  if (verdicts.empty()) return;
  const std::string rad = units_on(study.scenario.axis, "rad"), rad_per_s = units_on(study.scenario.axis, "rad/s");
  const std::string_view angles = angles_on(study.scenario.axis);
  Disagreement replayed, closed;
  std::vector<std::uint64_t> others;
  std::size_t in_loop = 0, parted = 0;
  const RefereeVerdict* first_parted = nullptr;
  for (const RefereeVerdict& verdict : verdicts) {
    raise(replayed, verdict.found);
    if (verdict.in_loop.closed) {
      ++in_loop;
      raise(closed, *verdict.in_loop.closed);
    }
    if (const auto& at = verdict.in_loop.parted) {
      ++parted;
      if (!first_parted || *at < *first_parted->in_loop.parted) first_parted = &verdict;
    }
    if (!verdict.agrees(study.referee_tolerance)) others.push_back(verdict.trial);
  }
  std::sort(others.begin(), others.end());
  const auto agreement = [&](const Disagreement& largest) {
    return fmt::format("{} agree within {:.2g} {}, speeds within {:.2g} {}", angles, largest.angle, rad, largest.speed,
                       rad_per_s);
  };
  print_item("referee", fmt::format("cvode repeated {} trial{} under the recorded {}: {}", verdicts.size(),
                                    verdicts.size() == 1 ? "" : "s", in_words_of(study.scenario.axis, "torque"),
                                    agreement(replayed)));
  if (in_loop > 0)
    print_item("referee", fmt::format("{} of them in closed loop as well: {}", in_loop, agreement(closed)));
  if (parted > 0)
    print_item("referee",
               fmt::format("in closed loop the sensor's counts differ from some time on in {} of them; first "
                           "in trial {} at {:.6g} s",
                           parted, first_parted->trial, *first_parted->in_loop.parted));
  constexpr std::size_t most = 10;
  const std::vector<std::uint64_t> first(others.begin(), others.begin() + std::min(most, others.size()));
  if (!others.empty())
    print_item("referee", fmt::format("cvode differs by more than {:g} {}, or fails, in {} of them: trial{} {}{}",
                                      study.referee_tolerance, rad, others.size(), others.size() == 1 ? "" : "s",
                                      fmt::join(first, ", "), others.size() > most ? ", ..." : ""));
}

std::string too_many_failed(const ReasonTable& reasons, std::uint64_t trials, std::uint64_t most) {
  return fmt::format("{} of {} trials failed, more than --max-failures {}; most frequent reason: {}", reasons.total(),
                     trials, most, by_frequency(reasons).front().example);
}

}  // namespace wormdrive
