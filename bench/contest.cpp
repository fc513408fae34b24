#include "bench/contest.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <optional>

#include <alloca.h>
#include <fmt/format.h>

#include "statistics/cpu_time.hpp"

namespace bench {
namespace {

constexpr double shortest = 1e-3;  ///< a measurement repeats its run until it takes this long [s]
constexpr double patience = 4.0;   ///< CPU time that all measurements of one contender may take [s] ...
constexpr int least = 3;           ///< ... unless there were fewer of them

/// A contender at the tolerance with which it takes part.
struct Entry {
  const Contender* contender;
  double tolerance, error;
  Outcome outcome;
  std::function<Outcome()> timed;
  Timing timing{};
};

Entry entry(const Contender& contender, double tolerance, const Outcome& reference) {
  Prepared prepared = contender.prepare(tolerance);
  const Outcome end = prepared.compared();
  const double error = std::max(std::abs(end.theta - reference.theta), std::abs(end.omega - reference.omega));
  return {&contender, tolerance, error, end, std::move(prepared.timed)};
}

/// Half a decade at a time from loose to tight. The next tighter tolerance must do as well, for an error can pass
/// through zero by luck.
std::optional<Entry> loosest(const Contender& contender, const Outcome& reference) {
  if (!contender.adjustable) return entry(contender, 0.0, reference);
  std::optional<Entry> candidate;
  try {
    for (int half = 10; half <= 27; ++half) {
      Entry tried = entry(contender, std::pow(10.0, -0.5 * half), reference);
      const bool good = tried.error <= accuracy;
      if (good && candidate) return candidate;
      candidate.reset();
      if (good) candidate = std::move(tried);
    }
  } catch (const std::exception&) {  // no solver works at every tolerance
  }
  return candidate;
}

std::string ratio(const std::vector<Entry>& entries, const Entry& e, const char* to) {
  for (const Entry& other : entries)
    if (other.contender->name == to) return fmt::format("{:.2f}", e.timing.median() / other.timing.median());
  return "-";
}

void print(const Contest& contest, const std::vector<Entry>& entries, const Options& options) {
  if (!options.rows) {
    fmt::print("\n{}\n\n", contest.title);
    fmt::print(
        "| contender | tolerance | evaluations | events | error | CPU time [{}] | of cvode Adams | of taylor |\n",
        contest.per_what);
    fmt::print("|---|---|---|---|---|---|---|---|\n");
  }
  for (const Entry& e : entries) {
    const std::string tolerance = e.contender->adjustable ? fmt::format("{:.0e}", e.tolerance) : "-";
    const double time = e.timing.median() / contest.per;
    if (options.rows)
      fmt::print("{}\t{}\t{}\t{}\t{}\t{}\t{:.1e}\t{:.6g}\n", contest.title, contest.per_what, e.contender->name,
                 tolerance, e.outcome.evaluations, e.outcome.events, e.error, time);
    else
      fmt::print("| {} | {} | {} | {} | {:.1e} | {:.4g} | {} | {} |\n", e.contender->name, tolerance,
                 e.outcome.evaluations, e.outcome.events, e.error, time, ratio(entries, e, "cvode Adams"),
                 ratio(entries, e, "taylor"));
  }
}

}  // namespace

void Timing::measure(const std::function<Outcome()>& run, int k) {
  constexpr int page = 4096, shift = 65 * 16;  // visits every multiple of 16 in a page
  volatile char* room = static_cast<char*>(alloca(1 + std::abs(k) * shift % page));
  room[0] = 0;
  const double start = wormdrive::thread_cpu_time();
  double spent = 0.0;
  int runs = 0;
  do {
    run();
    ++runs;
    spent = wormdrive::thread_cpu_time() - start;
  } while (spent < shortest);
  total_ += spent;
  if (k >= 0) times_.push_back(spent / runs);
}

double Timing::median() const {
  std::vector<double> sorted = times_;
  const auto middle = sorted.begin() + std::ssize(sorted) / 2;
  std::nth_element(sorted.begin(), middle, sorted.end());
  return *middle;
}

void hold(const Contest& contest, const Options& options) {
  std::vector<Entry> entries;
  for (const Contender& contender : contest.contenders) {
    if (auto found = loosest(contender, contest.reference))
      entries.push_back(std::move(*found));
    else
      fmt::print(stderr, "{}: {} does not reach {:.0e}\n", contest.title, contender.name, accuracy);
  }
  for (int k = -1; k < options.repetitions; ++k)
    for (Entry& e : entries)
      if (k < least || e.timing.total() < patience) e.timing.measure(e.timed, k);
  print(contest, entries, options);
}

Options options(int argc, char** argv) {
  Options chosen;
  for (int k = 1; k < argc; ++k) {
    if (std::strcmp(argv[k], "--rows") == 0) {
      chosen.rows = true;
    } else if (std::strcmp(argv[k], "--repetitions") == 0 && k + 1 < argc) {
      chosen.repetitions = std::atoi(argv[++k]);
    } else {
      chosen.repetitions = 0;
      break;
    }
  }
  if (chosen.repetitions < least) {
    fmt::print(stderr, "usage: {} [--rows] [--repetitions N]   with N >= {}\n", argv[0], least);
    std::exit(2);
  }
#ifndef NDEBUG
  fmt::print(stderr, "not a release build: the times say nothing\n");
#endif
  return chosen;
}

}  // namespace bench
