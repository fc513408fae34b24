// The file of an estimate of rare misses: what is there of it survives, and the estimate goes on to the same digits.
#include "sweep/rare/rare_file.hpp"

#include <atomic>
#include <stdexcept>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "sweep/studies.hpp"
#include "sweep/study/load_study.hpp"

namespace wormdrive::test::sweep_rare_file {

namespace {

const std::string rare_study = study_but("below_rad_per_s = -2.5", "below_rad_per_s = -3.2");

struct Killed : std::runtime_error {
  Killed() : std::runtime_error("killed") {}
};

/// An estimate that is killed as soon as some of its runs are safe; how many are.
std::size_t killed(const StudyFolder& folder, std::vector<std::string> words) {
  const auto runs = [&] { return rows_so_far(folder / "r.h5.part", "runs/status"); };
  words.insert(words.begin(), WORMDRIVE_PROGRAM);
  Process process(words, folder.path());
  while (runs() == 0) usleep(20'000);
  process.kill(SIGKILL);
  process.wait();
  return runs();
}

void check_same(const RareEvent& a, const RareEvent& b) {
  CHECK(a.subset.estimate.probability == b.subset.estimate.probability);
  CHECK(a.subset.estimate.variation == b.subset.estimate.variation);
  CHECK(a.subset.estimate.evaluations == b.subset.estimate.evaluations);
  CHECK(a.design.point == b.design.point);
  CHECK(a.likely.parameters == b.likely.parameters);
  CHECK(a.importance.probability == b.importance.probability);
}

}  // namespace

TEST_CASE("an estimate that ends ten times before its time goes on to the same digits, on any number of threads") {
  const StudyFolder folder(rare_study);
  const Study study = load_study(folder / "study.toml");
  RareSettings settings{"final_gear_speed", 200, 200};
  const RareEvent whole = estimate_rare_event(study, "study.toml", settings);
  REQUIRE(whole.subset.levels.size() >= 2);
  REQUIRE_FALSE(whole.median_misses);
  std::uint64_t before = 0;
  for (int round = 0; round < 11; ++round) {
    settings.threads = 1 + static_cast<unsigned>(round % 3);
    RareFile file(folder / "r.h5", study, settings, "wormdrive rare", true, Replace::same_kind);
    CHECK((file.from_before() > before || round == 0));
    before = file.from_before();
    settings.kept = file.runs();
    std::atomic<int> left = round < 10 ? 70 : 1'000'000;
    settings.kept.keep = [&, keep = settings.kept.keep](Trial run) {
      if (left-- <= 0) throw Killed();
      keep(std::move(run));
    };
    if (round < 10) {
      REQUIRE_THROWS_AS(estimate_rare_event(study, "study.toml", settings), Killed);
      continue;
    }
    const RareEvent resumed = estimate_rare_event(study, "study.toml", settings);
    check_same(resumed, whole);
    file.finish(resumed);
  }
  CHECK(before >= 600);
  CHECK(folder.names() == std::set<std::string>{"s.toml", "study.toml", "r.h5"});
  // complete, it gives the same again without a run
  settings.kept = {};
  RareFile complete(folder / "r.h5", study, settings, "wormdrive rare", true, Replace::same_kind);
  CHECK(complete.from_before() == whole.subset.estimate.evaluations + 1 + whole.design.evaluations + 1 + 200);
  settings.kept = complete.runs();
  settings.kept.keep = [](const Trial&) { FAIL("a run of a complete estimate is made again"); };
  check_same(estimate_rare_event(study, "study.toml", settings), whole);
}

TEST_CASE("kill -9 leaves the runs of an estimate, and --resume gives the numbers of one that was never killed",
          "[sweep][slow]") {
  const StudyFolder folder(rare_study);
  std::vector<std::string> words{"rare", "study.toml", "--per-level", "4000", "--threads", "1", "--json"};
  const Outcome whole = folder.run(words);
  REQUIRE(whole.exit == 0);
  words.insert(words.end(), {"-o", "r.h5"});
  const std::size_t left = killed(folder, words);
  CHECK(left > 0);
  const Outcome again = folder.run(words);
  CHECK(again.exit == 2);
  CHECK(again.err == fmt::format("r.h5.part: error: contains {} runs of an interrupted estimate; add --resume to "
                                 "continue it, or delete it to start again\n",
                                 left));
  words.push_back("--resume");
  std::vector<std::string> others = words;
  others[3] = "500";
  CHECK(folder.run(others).err ==
        "r.h5.part: error: cannot be resumed: it was made with --metric final_gear_speed --per-level 4000 --samples "
        "2000, not --metric final_gear_speed --per-level 500 --samples 2000; undo the change, or delete the file to "
        "start again\n");
  const Outcome resumed = folder.run(words);
  REQUIRE(resumed.exit == 0);
  CHECK(resumed.out == whole.out);
  const auto told = nlohmann::json::parse(whole.out);
  const Hdf5Handle file = open_hdf5(folder / "r.h5");
  CHECK(read_column(file, "estimates/probability")[0] == told["subset_simulation"]["probability"].get<double>());
  CHECK(read_column(file, "levels/share").size() == told["levels"].size());
  CHECK(folder.names() == std::set<std::string>{"s.toml", "study.toml", "r.h5"});
}

TEST_CASE("a full disk loses no run of an estimate that is kept, and says how to go on", "[sweep][slow]") {
  const StudyFolder folder(rare_study);
  std::vector<std::string> words{"rare", "study.toml", "--per-level", "4000", "--threads", "1", "-o", "r.h5"};
  CHECK(killed(folder, words) > 0);
  words.push_back("--resume");
  constexpr rlim_t room = 100'000;
  const Outcome full = folder.run(words, room);
  CHECK(full.exit == 4);
  INFO(full.err);
  CHECK(full.err.find('\n') == full.err.size() - 1);  // one line
  CHECK(full.err.starts_with("wormdrive: cannot write r.h5.part"));
  CHECK(
      full.err.ends_with("File too large; runs older than a second are safe; free some space, then continue with: "
                         "wormdrive rare study.toml --per-level 4000 --threads 1 -o r.h5 --resume\n"));
  CHECK(folder.run(words).exit == 0);
}

TEST_CASE("an estimate is no other result: it is not resumed without its file, nor written over one", "[sweep]") {
  const StudyFolder folder(rare_study);
  CHECK(folder.run({"rare", "study.toml", "--resume"}).err ==
        "study.toml: error: cannot be resumed without --output\n");
  for (const std::string input : {"study.toml", "s.toml"})
    CHECK(folder.run({"rare", "study.toml", "-o", input, "--force"}).err ==
          fmt::format("{0}: error: the result would overwrite {0}; choose another --output\n", input));
  folder.write("mine.h5", "somebody's");
  const Outcome over = folder.run({"rare", "study.toml", "-o", "mine.h5"});
  CHECK(over.exit == 4);
  folder.write("r.h5.whole", "somebody's, too");
  CHECK(folder.run({"rare", "study.toml", "--per-level", "100", "--samples", "100", "-o", "r.h5"}).exit == 4);
  CHECK(folder.names().contains("r.h5.whole"));
  std::filesystem::remove(folder / "r.h5.whole");
  CHECK(folder.run({"rare", "study.toml", "--per-level", "100", "--samples", "100", "-o", "r.h5", "--resume"}).exit ==
        0);
  CHECK(
      folder.run({"rare", "study.toml", "--per-level", "200", "-o", "r.h5"}).err ==
      "wormdrive: cannot write r.h5: it holds a finished estimate; choose another name, or replace it with --force\n");
  CHECK(folder.run({"rare", "study.toml", "--per-level", "100", "-o", "r.h5", "--force"}).exit == 0);
  CHECK(folder.run({"diff", "r.h5", "r.h5"}).exit == 0);
  const Outcome summary = folder.run({"summary", "r.h5"});
  CHECK(summary.exit == 2);
  CHECK(summary.err == "r.h5: error: it is a result of 'rare', not of a sweep; wormdrive report shows it\n");
  REQUIRE(folder.sweep({"-o", "sweep.h5"}).exit == 0);
  const Outcome other = folder.run({"rare", "study.toml", "-o", "sweep.h5", "--resume"});
  CHECK(other.exit == 2);
  CHECK(other.err == "sweep.h5: error: cannot be resumed: it is not the result of an estimate\n");
}

TEST_CASE("a limit to which a metric only jumps is told in one line, and nothing is left") {
  const StudyFolder folder(
      study_but("metric = \"final_gear_speed\"\nbelow_rad_per_s = -2.5", "metric = \"stop_events\"\nabove = 5"));
  const Outcome outcome = folder.run({"rare", "study.toml", "--per-level", "100", "-o", "r.h5"});
  CHECK(outcome.exit == 2);
  CHECK(outcome.err ==
        "study.toml: error: stop_events comes no nearer to its limit than 5 (a share of 1 of the drives): none misses "
        "it, "
        "or the metric jumps to it; subset simulation needs one that gradually approaches its limit\n");
  for (const char* left : {"r.h5", "r.h5.part"}) CHECK_FALSE(std::filesystem::exists(folder / left));
}

}  // namespace wormdrive::test::sweep_rare_file
