#include <cmath>
#include <numbers>
#include <random>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/bad_input.hpp"

// A linear axis has forces and positions wherever a diagnosis or a torque at constant speed is told, written or drawn;
// and data may have any names.

namespace wormdrive::test::cli_linear_diagnosis {

using nlohmann::json;

namespace {

/// Six seconds of the sledge with viscous friction that nobody stated.
std::string recorded(const std::string& header) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, 1e-5);
  std::string text = header + "\n";
  double x = 0.0, v = 0.0;
  for (int k = 0; k < 6000; ++k) {
    const double t = 1e-3 * k, u = 8.0 * std::sin(2.0 * std::numbers::pi * 0.7 * t) +
                                   4.0 * std::cos(2.0 * std::numbers::pi * 3.1 * t) + (t > 3.0 ? 2.0 : -2.0);
    text += fmt::format("{:.3f},{:.6f},{:.7f}\n", t, u, x + noise(random));
    for (int step = 0; step < 10; ++step) {
      v += 1e-4 * (u - 5.0 * v) / 2.0;
      x += 1e-4 * v;
    }
  }
  return text;
}

const std::string nothing;

/// Names the words of turning in a text.
std::string turning(const std::string& text) {
  std::string found;
  for (const char* const word :
       {"N m", "Nm", " rad", "\"rad", "[rad", "torque ", "torques", "gear speed", "gear angle"})
    if (text.find(word) != std::string::npos) found += fmt::format("'{}' ", word);
  return found;
}

/// All words in the pictures of a result.
const std::string words_of_pictures = R"(
import sys
sys.path.insert(0, sys.argv[1])
import h5py, matplotlib
matplotlib.use("Agg")
from matplotlib.text import Text
import diagnosis, steady
with h5py.File(sys.argv[2]) as file:
    figures = [steady.draw(file)] if "model" in file else [diagnosis.draw(file, part) for part in ("prediction", "residual")]
for figure in figures:
    figure.canvas.draw()
    for text in figure.findobj(Text):
        print(text.get_text())
)";
std::string pictured(const Folder& folder, const std::string& file) {
  folder.write("words.py", words_of_pictures);
  const std::string plots = WORMDRIVE_TESTS "/../plots";
  const Outcome outcome = Process({WORMDRIVE_PYTHON, "words.py", plots, file}, folder.path()).wait();
  INFO(outcome.err);
  CHECK(outcome.exit == 0);
  return outcome.out;
}

std::string units_of(const std::string& path, const std::string& column) {
  const Hdf5Handle file = open_hdf5(path);
  const Hdf5Handle dataset(H5Dopen2(file, column.c_str(), H5P_DEFAULT), H5Dclose, "cannot open " + column);
  return read_text_attribute(dataset, "units");
}

}  // namespace

TEST_CASE("a diagnosis on a linear axis, of a scenario without [run], prints forces and positions throughout",
          "[slow]") {
  const Folder folder;
  folder.write("s.toml", sledge_of_two_kilograms);
  folder.write("r.csv", recorded("time_s,motor_force_N,position_m"));
  const Outcome found = folder.run({"diagnose", "s.toml", "r.csv", "-o", "out", "--no-pictures"});
  INFO(found.out << found.err);
  REQUIRE(found.exit == 0);
  CHECK(found.out.find("worm viscous") != std::string::npos);
  CHECK(found.out.find("N s/m") != std::string::npos);
  CHECK(turning(found.out) == nothing);
  const json report = json::parse(folder.read("out/diagnosis.json"));
  CHECK(turning(report.dump()) == nothing);
  CHECK(report.at("noise").contains("force_N"));
  CHECK(report.at("noise").contains("position_m"));
  for (const auto& [column, units] : {std::pair{"residual/gear_angle", "m"},
                                      {"residual/gear_speed", "m/s"},
                                      {"residual/load_torque", "N"},
                                      {"residual/before", "N"},
                                      {"examples/measured", "m"}})
    CHECK(units_of(folder / "out/diagnosis.h5", column) == units);
  CHECK(turning(pictured(folder, "out/diagnosis.h5")) == nothing);
  CHECK(pictured(folder, "out/diagnosis.h5").find("position, forward [m]") != std::string::npos);
  CHECK(folder.read("out/extended.toml").find("[run]") == std::string::npos);
  const Outcome page = folder.run({"report", "out"});
  INFO(page.err);
  CHECK(page.exit == 0);
  CHECK(folder.run({"check", "out/extended.toml", "-q"}).exit == 0);
  CHECK(folder.run({"run", "out/extended.toml", "-q"}).err ==
        "out/extended.toml: error: there is no [run]; it needs duration_s\n");
  CHECK(folder.run({"run", "out/extended.toml", "-q", "--set", "run.duration_s=0.1"}).exit == 0);
}

TEST_CASE("torque at constant speed is a force on a linear axis, in the result and its picture", "[slow]") {
  const Folder folder;
  folder.write("s.toml", sledge_of_two_kilograms + "[effect.worm_viscous]\ncoefficient_Ns_per_m = 3\n");
  const Outcome steady = folder.run({"steady", "s.toml", "-o", "s.h5"});
  REQUIRE(steady.exit == 0);
  CHECK(turning(steady.out) == nothing);
  CHECK(steady.out.find("the motor force is 0 throughout") == std::string::npos);
  const std::string words = pictured(folder, "s.h5");
  CHECK(turning(words) == nothing);
  CHECK(words.find("motor force [N]") != std::string::npos);
  CHECK(folder.run({"check", "s.toml"}).out.find("the motor force is 0 throughout") != std::string::npos);
}

TEST_CASE("a sweep of a linear axis prints forces and positions: referee, summary and worst drive") {
  const Folder folder;
  folder.write("s.toml", sledge_of_two_kilograms +
                             "[effect.worm_coulomb]\nforce_N = 1\n"
                             "[[motor.torque]]\nkind = \"sinusoid\"\namplitude_N = 8\nfrequency_Hz = 0.7\n"
                             "[run]\nduration_s = 0.5\nsolver = \"taylor\"\n");
  folder.write("study.toml", R"(scenario = "s.toml"
[sweep]
design = "monte_carlo"
trials = 20
seed = 3
[[parameter]]
path = "effect.worm_coulomb.force_N"
distribution = "uniform"
low = 0.5
high = 1.5
[[threshold]]
metric = "final_gear_speed"
below_m_per_s = 0.1
)");
  for (const auto& words : {std::vector<std::string>{"sweep", "study.toml", "-o", "sweep.h5"},
                            {"summary", "sweep.h5"},
                            {"worst", "sweep.h5", "-o", "worst.h5"}}) {
    const Outcome outcome = folder.run(words);
    INFO(words.front() << ": " << outcome.out << outcome.err);
    CHECK(outcome.exit == 0);
    CHECK(turning(outcome.out) == nothing);
    CHECK(outcome.out.find("positions agree within") != std::string::npos);
  }
  CHECK(units_of(folder / "sweep.h5", "referee/angle_difference") == "m");
  CHECK(units_of(folder / "sweep.h5", "referee/closed_speed_difference") == "m/s");
}

TEST_CASE("faults of a recording on a linear axis are reported in its units") {
  const Folder folder;
  folder.write("s.toml", sledge_of_two_kilograms);
  folder.write("small.csv", edited(recorded("time_s,motor_force_N,position_m"), "position_m", "y"));
  folder.write("none.csv", "a,b\n1,2\n");
  check_rejected(folder,
                 {{"other name",
                   "",
                   "small.csv:1: error: no column 'position_m'; the header line names time_s, motor_force_N, y; [data] "
                   "position_m = \"...\" in the scenario would say which it is",
                   {"diagnose", "s.toml", "small.csv", "-o", "out"},
                   true},
                  {"no kind",
                   "",
                   "none.csv:1: error: the columns a, b make neither a recording (time_s, motor_force_N, position_m) "
                   "nor records at constant speed (record, worm_speed_m_per_s, motor_force_N) nor a break-in table "
                   "(load_force_N, motor_force_N); [data] in the scenario tells other names, see docs/recordings.md",
                   {"diagnose", "s.toml", "none.csv", "-o", "out"},
                   true}});
}

TEST_CASE("[data] also gives the column names of records at constant speed and of break-in tables", "[slow]") {
  const Folder folder;
  std::string usual = "record,worm_speed_rad_per_s,motor_torque_Nm\n", own = "run,w,u\n";
  for (int k = 1; k <= 4; ++k)
    for (const int way : {-1, 1})
      for (const double more : {0.0, 1e-5}) {
        const std::string row = fmt::format("r{}{},{},{}\n", k, way, 3.0 * k * way, way * (0.004 + 2e-4 * k) + more);
        usual += row;
        own += row;
      }
  folder.write("usual.csv", usual);
  folder.write("own.csv", own);
  folder.write("s.toml", good_scenario);
  folder.write("named.toml",
               good_scenario + "[data]\nrecord = \"run\"\nworm_speed_rad_per_s = \"w\"\nmotor_torque_Nm = \"u\"\n");
  const Outcome a = folder.run({"steady", "s.toml", "--data", "usual.csv", "--json"}),
                b = folder.run({"steady", "named.toml", "--data", "own.csv", "--json"});
  INFO(b.err);
  REQUIRE(a.exit == 0);
  CHECK(a.out == b.out);
  const auto diagnosed = [&](const std::string& scenario, const std::string& data) {
    const Outcome outcome = folder.run({"diagnose", scenario, data, "-o", "out", "-q", "--no-pictures"});
    INFO(outcome.err);
    REQUIRE(outcome.exit == 0);
    json found = json::parse(folder.read("out/diagnosis.json"));
    found.at("data").erase("files");
    return found;
  };
  CHECK(diagnosed("s.toml", "usual.csv") == diagnosed("named.toml", "own.csv"));
  check_rejected(folder, {{"the usual name where another is told",
                           "",
                           "usual.csv:1: error: no column 'run'; the header line names record, worm_speed_rad_per_s, "
                           "motor_torque_Nm",
                           {"steady", "named.toml", "--data", "usual.csv"},
                           true}});
}

}  // namespace wormdrive::test::cli_linear_diagnosis
