// Near ties in any number: how many runs of drives in which something just touches something else end in a halt, and
// how many in a wrong answer without a word. Exit status 1 if there is one of these.
#include <atomic>
#include <cstdio>
#include <map>
#include <mutex>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>

#include "judge/judge.hpp"
#include "near_ties/generator.hpp"
#include "near_ties/verdict.hpp"

namespace {

using namespace wormdrive::test::near_ties;

/// One case with everything that is known of it.
int show(std::uint64_t seed, std::uint64_t index) {
  const Case tie = make_case(seed, index);
  std::printf("case %llu: %s", static_cast<unsigned long long>(index), describe(tie).c_str());
  for (const By by : {By::bdf, By::adams, By::taylor}) {
    if (tie.elastic && by == By::taylor) continue;
    const ProgramRun r = run(tie, by);
    std::printf("%s %s\n%s", name(by), r.halt.c_str(), describe(r).c_str());
  }
  if (!tie.elastic) {
    std::printf("judge\n  ");
    judge::Judge<judge::Quad> judge(tie.drive);
    try {
      judge.run();
    } catch (const judge::GivesUp& tired) {
      std::printf("%s ", tired.what());
    }
    std::printf("(%d,%d,0)", judge.start.motion, judge.start.flank);
    for (const auto& event : judge.events)
      std::printf(" %.15g: (%d,%d,0)", event.t, event.after.motion, event.after.flank);
    std::printf(" ends at %.12g rad, %.6g rad/s\n", static_cast<double>(judge.course().theta),
                static_cast<double>(judge.course().omega));
  }
  const Judgement found = judgement(tie, true);
  std::printf("%s %s\n", names[static_cast<int>(found.verdict)], found.reason.c_str());
  return found.verdict == Verdict::silent;
}

}  // namespace

int main(int count, char** words) {
  std::uint64_t seed = 1, cases = 1000;
  std::int64_t one = -1;
  int threads = 1, judged = 1;
  CLI::App app("runs near ties by every solver and counts halts and silent differences");
  app.add_option("--seed", seed);
  app.add_option("--cases", cases);
  app.add_option("--case", one, "run this one alone and tell everything");
  app.add_option("--threads", threads);
  app.add_option("--judged", judged, "the judge sees one in this many; all whose events differ");
  CLI11_PARSE(app, count, words);
  if (one >= 0) return show(seed, static_cast<std::uint64_t>(one));

  std::atomic<std::uint64_t> next{0};
  std::mutex lock;
  std::map<Verdict, long> verdicts;
  std::map<std::string, std::map<Verdict, long>> kinds;
  const auto work = [&] {
    for (std::uint64_t k; (k = next++) < cases;) {
      const Case tie = make_case(seed, k);
      const Judgement found = judgement(tie, k % judged == 0);
      const std::scoped_lock hold(lock);
      ++verdicts[found.verdict];
      ++kinds[tie.tie + (tie.elastic ? ", elastic" : "")][found.verdict];
      if (!found.reason.empty()) {
        std::printf("case %llu, %s, excess %.3g: %s: %s\n", static_cast<unsigned long long>(k), tie.tie.c_str(),
                    tie.excess, names[static_cast<int>(found.verdict)], found.reason.c_str());
        std::fflush(stdout);
      }
    }
  };
  std::vector<std::thread> pool;
  for (int k = 1; k < threads; ++k) pool.emplace_back(work);
  work();
  for (std::thread& thread : pool) thread.join();
  for (const auto& [kind, of] : kinds) {
    std::printf("%-45s", kind.c_str());
    for (const auto& [verdict, number] : of) std::printf(" %s %ld", names[static_cast<int>(verdict)], number);
    std::printf("\n");
  }
  for (const auto& [verdict, number] : verdicts)
    std::printf("%s: %ld, %.3f %%\n", names[static_cast<int>(verdict)], number, 100.0 * number / cases);
  return verdicts[Verdict::silent] > 0;
}
