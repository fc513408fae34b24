#include "near_ties/verdict.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "judge/shadow.hpp"

namespace wormdrive::test::near_ties {

namespace {

bool same_modes(const ProgramRun& a, const ProgramRun& b) {
  return a.start == b.start &&
         std::equal(a.changes.begin(), a.changes.end(), b.changes.begin(), b.changes.end(),
                    [](const Change& x, const Change& y) { return x.before == y.before && x.after == y.after; });
}

double largest_delay(const ProgramRun& a, const ProgramRun& b) {
  double delay = 0.0;
  for (std::size_t k = 0; k < a.changes.size(); ++k) delay = std::max(delay, std::abs(a.changes[k].t - b.changes[k].t));
  return delay;
}

judge::Mode rigid(const Modes& modes) { return {modes[0], modes[1]}; }

std::string contradiction(const Case& tie, By by, const ProgramRun& run, long most_steps) {
  std::vector<judge::Event> events;
  for (const Change& change : run.changes) events.push_back({change.t, rigid(change.before), rigid(change.after)});
  const double slower = std::max(1.0, tie.drive.end), per_second = by == By::taylor ? 10.0 * tolerance * slower : 0.0;
  const judge::Exactness exactness{.relative = 1e-9 + per_second, .absolute = 1e-11 / slower};
  return judge::Shadow(tie.drive, exactness, most_steps).contradiction(rigid(run.start), events);
}

}  // namespace

Judgement judgement(const Case& tie, bool judged) {
  std::vector<By> solvers{By::bdf, By::adams};
  if (!tie.elastic) solvers.push_back(By::taylor);
  std::vector<ProgramRun> runs;
  for (const By by : solvers) {
    runs.push_back(run(tie, by));
    if (!runs.back().broken.empty()) return {Verdict::silent, fmt::format("{}: {}", name(by), runs.back().broken)};
  }
  for (std::size_t k = 0; k < runs.size(); ++k)
    if (!runs[k].halt.empty()) return {Verdict::halt, fmt::format("{}: {}", name(solvers[k]), runs[k].halt)};

  const bool same = std::all_of(runs.begin(), runs.end(), [&](const ProgramRun& r) { return same_modes(r, runs[0]); });
  if (tie.elastic) {
    if (!same) return {Verdict::silent, "the lists of elastic teeth differ"};
    const double apart = largest_delay(runs[0], runs[1]);
    if (apart > 1e-6 * tie.drive.end)
      return {Verdict::silent, fmt::format("elastic teeth: events {:.3g} s apart", apart)};
    return {Verdict::agree};
  }
  if (same && !judged) return {Verdict::not_judged};
  for (std::size_t k = 0; k < runs.size(); ++k) {
    try {
      const std::string found = contradiction(tie, solvers[k], runs[k], same ? 6000 : 20'000);
      if (!found.empty()) return {Verdict::silent, fmt::format("{}: {}", name(solvers[k]), found)};
    } catch (const judge::GivesUp&) {
      if (same) return {Verdict::not_judged};
      return {Verdict::silent, "lists differ, and the judge gives up"};
    }
  }
  return {same ? Verdict::agree : Verdict::rounding};
}

}  // namespace wormdrive::test::near_ties
