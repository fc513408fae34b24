// The rows of a sweep are the same bits however it is made.
#include <chrono>
#include <thread>

#include <fmt/format.h>

#include "catch.hpp"
#include "sweep/studies.hpp"

using namespace wormdrive;
using namespace wormdrive::test;

namespace {

const std::string many = study_but("trials = 200", "trials = 60000");

}  // namespace

TEST_CASE("1, 2 and 8 threads make the same rows", "[sweep]") {
  for (const char* design : {"monte_carlo", "latin_hypercube", "sobol"}) {
    const StudyFolder folder(study_but("monte_carlo", design));
    for (const char* threads : {"1", "2", "8"}) {
      const Outcome outcome = folder.sweep({"-o", std::string(threads) + ".h5", "--threads", threads});
      INFO(outcome.err);
      REQUIRE(outcome.exit == 0);
    }
    const auto one = folder.rows("1.h5");
    CHECK(one.at("index").size() == 200 * sizeof(double));
    CHECK(one == folder.rows("2.h5"));
    CHECK(one == folder.rows("8.h5"));
  }
}

TEST_CASE("another seed makes other rows", "[sweep]") {
  const StudyFolder folder;
  REQUIRE(folder.sweep({"-o", "a.h5"}).exit == 0);
  folder.write("study.toml", study_but("seed = 3", "seed = 4"));
  REQUIRE(folder.sweep({"-o", "b.h5"}).exit == 0);
  CHECK(folder.rows("a.h5") != folder.rows("b.h5"));
}

TEST_CASE("seven shards merged are the whole sweep, in any order", "[sweep]") {
  const StudyFolder folder(study_but("monte_carlo", "latin_hypercube"));
  REQUIRE(folder.sweep({"-o", "whole.h5"}).exit == 0);
  std::vector<std::string> merge{"merge"};
  for (int k = 7; k >= 1; --k) {
    const std::string shard = std::to_string(k) + ".h5";
    REQUIRE(folder.sweep({"-o", shard, "--shard", std::to_string(k) + "/7"}).exit == 0);
    merge.push_back(shard);
  }
  merge.insert(merge.end(), {"-o", "merged.h5"});
  const Outcome merged = folder.run(merge);
  INFO(merged.err);
  REQUIRE(merged.exit == 0);
  CHECK(folder.rows("merged.h5") == folder.rows("whole.h5"));
}

TEST_CASE("a sweep that was killed again and again and resumed is the whole sweep", "[sweep]") {
  const StudyFolder folder(many);
  REQUIRE(folder.sweep({"-o", "whole.h5"}).exit == 0);
  std::uint64_t kept = 0;
  for (int k = 0; k < 8; ++k) {
    Process process({WORMDRIVE_PROGRAM, "sweep", "study.toml", "-o", "killed.h5", "--resume"}, folder.path());
    std::this_thread::sleep_for(std::chrono::milliseconds(60 + 45 * k));
    process.kill();
    if (process.wait().exit == 0) break;  // it was done before
    for (const char* part : {"killed.h5.part", "killed.h5.part.before"})
      if (folder.names().contains(part) && is_hdf5(folder / part))
        kept = std::max<std::uint64_t>(kept, read_column(open_hdf5(folder / part), "trials/index").size());
  }
  const Outcome last = folder.sweep({"-o", "killed.h5", "--resume"});
  INFO(last.err);
  REQUIRE(last.exit == 0);
  CHECK(kept > 0);  // else nothing was resumed
  CHECK(folder.rows("killed.h5") == folder.rows("whole.h5"));
  CHECK(folder.names() == std::set<std::string>{"s.toml", "study.toml", "whole.h5", "killed.h5"});
}

TEST_CASE("SIGTERM ends a sweep with all that is done, and it says how to go on", "[sweep]") {
  const StudyFolder folder(many);
  REQUIRE(folder.sweep({"-o", "whole.h5"}).exit == 0);
  Process process({WORMDRIVE_PROGRAM, "sweep", "study.toml", "-o", "ended.h5"}, folder.path());
  while (!folder.names().contains("ended.h5.part")) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  process.kill(SIGTERM);
  const Outcome ended = process.wait();
  CHECK(ended.exit == 128 + SIGTERM);
  CHECK(ended.err.starts_with("wormdrive: interrupted after "));
  CHECK(ended.err.ends_with("go on with: wormdrive sweep study.toml -o ended.h5 --resume\n"));
  const std::size_t kept = folder.column("ended.h5.part", "index").size();
  CHECK(ended.err.find(fmt::format("after {} of 60000 trials", kept)) != std::string::npos);
  REQUIRE(folder.sweep({"-o", "ended.h5", "--resume"}).exit == 0);
  CHECK(folder.rows("ended.h5") == folder.rows("whole.h5"));
}

TEST_CASE("a full disk costs no row that was safe, and the sweep goes on when there is room", "[sweep]") {
  const StudyFolder folder(many);
  REQUIRE(folder.sweep({"-o", "whole.h5"}).exit == 0);
  const Outcome full = folder.run({"sweep", "study.toml", "-o", "full.h5"}, 2'000'000);
  CHECK(full.exit == 4);
  CHECK(full.err.find("make room, then go on with: wormdrive sweep study.toml -o full.h5 --resume\n") !=
        std::string::npos);
  const Outcome resumed = folder.sweep({"-o", "full.h5", "--resume"});
  INFO(full.err << resumed.err);
  REQUIRE(resumed.exit == 0);
  CHECK(resumed.out.find(" were there already") != std::string::npos);
  CHECK(folder.rows("full.h5") == folder.rows("whole.h5"));
}

TEST_CASE("a trial runs again with its trajectory and the same metrics, with either solver", "[sweep]") {
  const StudyFolder folder;
  for (const char* solver : {"taylor", "cvode"}) {
    // reports that no sample or step meets
    folder.write("study.toml",
                 study_but("[\"run.solver=taylor\", \"run.report_interval_s=0.01\"]",
                           fmt::format("[\"run.solver={}\", \"run.report_interval_s=0.00037\"]", solver)));
    REQUIRE(folder.sweep({"-o", "sweep.h5"}).exit == 0);
    const Outcome outcome = folder.run({"replay", "sweep.h5", "--trial", "123", "-o", "run.h5"});
    INFO(outcome.err);
    CHECK(outcome.exit == 0);
    CHECK(outcome.out.find("every metric is that of the sweep, to the last bit") != std::string::npos);
    CHECK(read_column(open_hdf5(folder / "run.h5"), "trajectory/gear_speed").back() ==
          folder.column("sweep.h5", "final_gear_speed")[123]);
  }
}
