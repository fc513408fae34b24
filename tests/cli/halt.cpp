#include <chrono>
#include <memory>
#include <random>
#include <thread>

#include "catch.hpp"
#include "cli/program.hpp"
#include "output/run_file.hpp"

// Runs that cannot go on, and runs that are killed: what they leave behind is readable.

namespace wormdrive::test::cli_halt {

namespace {

/// Opens files with h5py and prints for each how many rows it has, and whether its times increase and all columns can
/// be read.
const std::string look = R"(
import sys
import h5py
import numpy
for name in sys.argv[1:]:
    with h5py.File(name, "r") as file:
        table = {key: column[:] for key, column in file["trajectory"].items()}
        times = table["time"]
        events = file["events/time"][:]
        good = bool((numpy.diff(times) > 0).all() and numpy.isfinite(times).all() and (numpy.diff(events) >= 0).all())
        good = good and "[mesh]" in file.attrs["scenario"]
        print(name, len(times), good)
)";

Outcome h5py(const Folder& folder, const std::vector<std::string>& files) {
  std::vector<std::string> words{WORMDRIVE_PYTHON, "-c", look};
  words.insert(words.end(), files.begin(), files.end());
  return Process(words, folder.path()).wait();
}

}  // namespace

TEST_CASE("a simulation failure states time, mode, events and reason, and keeps the run up to there") {
  const Folder folder;
  folder.write("s.toml", good_but("[motor.torque]\nkind = \"constant\"\ntorque_Nm = -0.05",
                                  "[[motor.torque]]\nkind = \"ramp\"\nrate_Nm_per_s = 1\n"
                                  "[[motor.torque]]\nkind = \"step\"\ntime_s = 0.1\ntorque_Nm = 1e308"));
  const Outcome outcome =
      folder.run({"run", "s.toml", "-q", "--set", "run.duration_s=0.2", "--set", "load.torque_Nm=0.5"});
  INFO(outcome.err);
  CHECK(outcome.exit == 3);
  const auto part = [&](const std::string& words) { return outcome.err.find(words) != std::string::npos; };
  CHECK(outcome.err.starts_with("wormdrive: cannot go on at t = 0.1 s, forward, "));
  CHECK(part("break-in at 0.0235321491 s)"));
  CHECK(outcome.err.ends_with(": the acceleration is not a finite number; the run up to there is in s.h5.part\n"));
  CHECK(outcome.err.find('\n') == outcome.err.size() - 1);
  CHECK(outcome.out.empty());
  CHECK(folder.names() == std::set<std::string>{"s.h5.part", "s.toml"});

  const wormdrive::Hdf5Handle file = wormdrive::open_hdf5(folder / "s.h5.part");
  const std::vector<double> time = wormdrive::read_column(file, "trajectory/time");
  CHECK(time.front() == 0.0);
  CHECK(time.back() == 0.1);
  CHECK(time.size() == 502);                                       // 500 reports, the start, and the break-away
  CHECK(wormdrive::read_column(file, "events/time").size() == 2);  // the break-away, and the flank at the step
  CHECK(h5py(folder, {"s.h5.part"}).out == "s.h5.part 502 True\n");
  CHECK(folder.run({"check", "s.h5.part", "-q"}).exit == 0);
}

TEST_CASE("a run killed at any moment leaves no result, and its part is readable from the first flush on", "[slow]") {
  constexpr int kills = 20, at_once = 5;
  const Folder folder;
  folder.write("s.toml", edited(good_scenario, "duration_s = 0.01", "duration_s = 1000\nreport_interval_s = 1e-6"));
  // How large a part is once its empty tables are flushed: only rows, which come later, make it larger.
  const wormdrive::RunFile empty(folder / "empty.h5", {"run", "", good_scenario, ""}, wormdrive::Axis::rotary);
  const auto small = std::filesystem::file_size(folder / "empty.h5.part") + 100000;
  const auto is_flushed = [&](const std::string& name) {
    std::error_code none;
    return std::filesystem::file_size(folder / name, none) > small && !none;
  };
  const auto start = [&](const std::string& name) {
    return std::make_unique<Process>(std::vector<std::string>{WORMDRIVE_PROGRAM, "run", "s.toml", "-q", "-o", name},
                                     folder.path());
  };
  // How long a first flush takes depends on the machine: here are five runs on it, and none is killed before.
  std::vector<std::unique_ptr<Process>> first;
  const auto started = std::chrono::steady_clock::now();
  for (int k = 0; k < at_once; ++k) first.push_back(start("first" + std::to_string(k) + ".h5"));
  for (int k = 0; k < at_once; ++k) {
    const std::string name = "first" + std::to_string(k) + ".h5.part";
    for (int waits = 0; waits < 60000 && !is_flushed(name); ++waits)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    REQUIRE(is_flushed(name));
  }
  const double longest = 1.5 * std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  for (const auto& run : first) {
    run->kill();
    CHECK(run->wait().exit == 128 + SIGKILL);
  }
  std::mt19937 random(1);
  std::vector<std::string> flushed;
  for (int round = 0; round < kills / at_once; ++round) {
    std::vector<std::unique_ptr<Process>> running;
    std::vector<std::pair<double, int>> moments;
    const auto begin = std::chrono::steady_clock::now();
    for (int k = 0; k < at_once; ++k) {
      running.push_back(start(std::to_string(round * at_once + k) + ".h5"));
      moments.emplace_back(std::uniform_real_distribution(0.0, longest)(random), k);
    }
    std::sort(moments.begin(), moments.end());
    for (const auto& [moment, k] : moments) {
      std::this_thread::sleep_until(begin + std::chrono::duration<double>(moment));
      const std::string name = std::to_string(round * at_once + k) + ".h5.part";
      if (is_flushed(name)) flushed.push_back(name);
      running[static_cast<std::size_t>(k)]->kill();
      CHECK(running[static_cast<std::size_t>(k)]->wait().exit == 128 + SIGKILL);
    }
  }
  for (const std::string& name : folder.names()) CHECK(!name.ends_with(".h5"));
  REQUIRE(flushed.size() >= 5);
  const Outcome outcome = h5py(folder, flushed);
  INFO(outcome.out << outcome.err);
  CHECK(outcome.exit == 0);
  CHECK(outcome.out.find("False") == std::string::npos);
  CHECK(static_cast<std::size_t>(std::count(outcome.out.begin(), outcome.out.end(), '\n')) == flushed.size());
}

}  // namespace wormdrive::test::cli_halt
