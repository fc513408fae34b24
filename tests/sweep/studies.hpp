#pragma once
// What the tests of sweeps share: a folder with a scenario and a study, and rows to compare.
#include <algorithm>

#include "cli/program.hpp"

namespace wormdrive::test {

/// Fast trials of an open loop; line numbers in the tests count from the first line.
inline const std::string good_study = R"(title = "A good study"
scenario = "s.toml"
set = ["run.solver=taylor", "run.report_interval_s=0.01"]
[sweep]
design = "monte_carlo"
trials = 200
seed = 3
[[parameter]]
path = "mesh.friction"
distribution = "truncated_normal"
mean = 0.25
deviation = 0.05
low = 0.1
[[parameter]]
path = "effect.worm_coulomb.torque_Nm"
distribution = "lognormal"
median = 1e-3
log_deviation = 0.5
[[threshold]]
metric = "final_gear_speed"
below_rad_per_s = -2.5
)";
inline std::string study_but(const std::string& part, const std::string& by) { return edited(good_study, part, by); }

/// Closed loops that run in lanes, among them some that are refused and some that have to run alone.
inline const std::string lanes_study = R"(scenario = ")" + shipped("fig10_sliding_014rad_bare.toml") + R"("
set = ["run.solver=taylor", "run.duration_s=0.3", "metrics.from_s=0.1", "run.report_interval_s=0.3"]
[sweep]
design = "monte_carlo"
trials = 200
seed = 3
[[parameter]]
path = "mesh.friction"
distribution = "discrete"
values = [0.25, 0.3, 20]
weights = [60, 37, 3]
[[parameter]]
path = "effect.mesh_friction.change"
distribution = "uniform"
low = -0.05
high = 0.05
[[parameter]]
path = "sensor.counts"
distribution = "discrete"
values = [0, 20000]
weights = [9, 1]
[[parameter]]
path = "effect.encoder_delay.delay_s"
distribution = "discrete"
values = [0, 2e-4]
weights = [9, 1]
)";

/// How many rows have a status in a file that another program may be writing; 0 while there is no such file.
inline std::size_t rows_so_far(const std::string& path, const std::string& status) {
  try {
    const std::vector<double> all = read_column(open_hdf5_while_written(path), status);
    return all.size() - static_cast<std::size_t>(std::count(all.begin(), all.end(), 0.0));
  } catch (const OutputFault&) {
    return 0;
  }
}

/// A folder with s.toml and study.toml.
struct StudyFolder : Folder {
  explicit StudyFolder(const std::string& study = good_study) {
    write("s.toml", good_scenario);
    write("study.toml", study);
  }
  Outcome sweep(std::vector<std::string> words) const {
    words.insert(words.begin(), {"sweep", "study.toml"});
    return run(words);
  }
  /// A sweep that gets a signal as soon as it has some trials. What can be caught has to leave some, however slow the
  /// machine is.
  Outcome interrupted(std::vector<std::string> words, int signal, int times = 1) const {
    words.insert(words.begin(), {WORMDRIVE_PROGRAM, "sweep", "study.toml"});
    const auto part = [this] {
      for (const std::string& name : names())
        if (name.ends_with(".h5.part")) return name;
      return std::string();
    };
    for (useconds_t wait = 50'000;; wait *= 2) {
      Process process(words, path());
      while (part().empty()) usleep(1000);
      usleep(wait);
      for (int k = 0; k < times; ++k) process.kill(signal), usleep(100);
      const Outcome outcome = process.wait();
      if (signal == SIGKILL || outcome.exit != 128 + signal || present(part()) > 0) return outcome;
    }
  }
  /// The table of trials byte for byte.
  std::map<std::string, std::vector<char>> rows(const std::string& file) const {
    return bytes(open_hdf5(*this / file), "trials");
  }
  /// How many trials a file has; 0 if there is no such file.
  std::size_t present(const std::string& file) const {
    if (!names().contains(file)) return 0;
    const std::vector<double> status = column(file, "status");
    return status.size() - static_cast<std::size_t>(std::count(status.begin(), status.end(), 0.0));
  }
  std::vector<double> column(const std::string& file, const std::string& name) const {
    return read_column(open_hdf5(*this / file), "trials/" + name);
  }
};

/// What is wrong with a study, and all of stderr about it without its last line break.
struct BadStudy {
  std::string part, by, message;
};

/// Sweeps a study with one part after the other replaced and checks message, exit code, and that no file came or went.
/// data: a CSV file that stands beside it, by name; none if empty.
inline void check_rejected(const std::string& study, const std::vector<BadStudy>& cases,
                           const std::pair<std::string, std::string>& data = {}) {
  for (const BadStudy& bad : cases) {
    const StudyFolder folder(edited(study, bad.part, bad.by));
    if (!data.first.empty()) folder.write(data.first, data.second);
    const std::set<std::string> before = folder.names();
    const Outcome outcome = folder.sweep({});
    INFO("case: " << bad.by << "\nexpected:\n" << bad.message << "\nfound:\n" << outcome.err);
    CHECK(outcome.err == bad.message + "\n");
    CHECK(outcome.exit == 2);
    CHECK(folder.names() == before);
  }
}

}  // namespace wormdrive::test
