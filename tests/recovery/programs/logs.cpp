#include "recovery/programs/logs.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>

#include <fmt/format.h>

#include "recovery/lost_rows.hpp"
#include "recovery/tables.hpp"
#include "statistics/parallel.hpp"

namespace recovery {
namespace {

std::string kind_of(const Logging& l) {
  return l.missing == 0.0 ? "jitter" : l.jitter == 0.0 ? "rows missing" : "jitter, rows missing";
}

/// The bench with another rate, for as long as 24 000 samples last, and no shorter than a diagnosis needs.
Logged drawn_log(Case bench, std::size_t k) {
  truth::Generator generator(bench.seed + 2);
  Logged log{std::move(bench), {}};
  log.bench.period = 1e-6 * std::round(1e6 / over_decades(100.0, 10000.0, generator));
  const double duration =
      std::max({3.5, 1200.0 * log.bench.period, std::min(log.bench.duration, 24000.0 * log.bench.period)});
  log.bench.duration = std::round(duration / log.bench.period) * log.bench.period;
  const double jitter = over_decades(0.01, 0.2, generator), missing = over_decades(0.001, 0.05, generator);
  const auto run = static_cast<std::size_t>(over_decades(1.0, 31.0, generator));
  if (k % 3 != 1) log.logging.jitter = jitter;
  if (k % 3 != 0) log.logging = {log.logging.jitter, missing, run};
  return log;
}

Outcome as_logged(Case bench, const Logging& logging, const Diagnose& diagnose) {
  bench.jitter = logging.jitter;
  return outcome(bench, diagnose, [&](truth::Recording& recorded) {
    if (logging.missing == 0.0) return;
    truth::Generator generator(bench.seed + 3);
    lose(recorded, lost_rows(recorded.time.size(), logging.missing, logging.run, generator));
  });
}

}  // namespace

bool Logged::agree() const {
  auto a = clean.named, b = uneven.named;
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  return clean.score == uneven.score && a == b && clean.flagged == uneven.flagged;
}

std::vector<Logged> logs(const Plan& plan, const Diagnose& diagnose, int threads) {
  Plan empty = plan;
  empty.kind = Kind::nothing;
  const std::vector<Case> with = draw(plan), without = draw(empty);
  std::vector<Logged> all(with.size());
  wormdrive::parallel_for(all.size(), threads, [&](std::size_t k) {
    Logged& log = all[k] = drawn_log((k / 3) % 2 == 0 ? with[k] : without[k], k);
    log.clean = as_logged(log.bench, {}, diagnose);
    log.uneven = as_logged(log.bench, log.logging, diagnose);
    std::cout << fmt::format("{:.5g} Hz, jitter {:.2g}, {:.2g} missing in runs of {}: {}\n  clean  {}\n  uneven {}\n",
                             1.0 / log.bench.period, log.logging.jitter, log.logging.missing, log.logging.run,
                             log.agree() ? "the same" : "DIFFERENT", line(log.clean), line(log.uneven))
              << std::flush;
  });
  return all;
}

std::string table(const std::vector<Logged>& logged) {
  std::string text =
      "| log | n | same answer | right: clean | right: uneven | false names: clean | false names: uneven |\n"
      "|---|---|---|---|---|---|---|\n";
  const auto row = [&](std::string_view title, auto&& counts) {
    long n = 0, same = 0, right[2]{}, wrong[2]{};
    for (const Logged& log : logged) {
      if (!counts(log)) continue;
      ++n;
      same += log.agree();
      for (const int k : {0, 1}) {
        const Score score = (k == 0 ? log.clean : log.uneven).score;
        right[k] += score == Score::exact || score == Score::in_class;
        wrong[k] += score == Score::wrong || score == Score::extra;
      }
    }
    text +=
        fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", title, n, same, right[0], right[1], wrong[0], wrong[1]);
  };
  for (const char* kind : {"jitter", "rows missing", "jitter, rows missing"})
    row(kind, [&](const Logged& log) { return kind_of(log.logging) == kind; });
  row("nothing hidden", [](const Logged& log) { return log.bench.hidden.empty(); });
  row("an effect above the certificate",
      [](const Logged& log) { return !log.bench.hidden.empty() && log.clean.observable; });
  row("all", [](const Logged&) { return true; });
  return text;
}

}  // namespace recovery
