#include "output/run_file.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "catch.hpp"
#include "cli/program.hpp"

// The layout of run files, as a stranger to the program reads it.

namespace wormdrive::test::output_run_file {

namespace {

/// Runs fig. 9, which has all kinds of events but a stop, and opens its result.
class Fig9 {
 public:
  Fig9() {
    outcome_ = folder_.run({"run", shipped("fig09_switching.toml"), "-q", "--set", "run.report_interval_s=0.001"});
    if (outcome_.exit != 0) throw std::runtime_error(outcome_.err);
    file_ = open_hdf5(path());
  }
  hid_t file() const { return file_; }
  std::string path() const { return folder_ / "fig09_switching.h5"; }
  std::vector<double> operator[](const std::string& column) const { return read_column(file_, column); }
  /// Text of an attribute of a column, empty if there is none.
  std::string text(const std::string& column, const std::string& attribute) const {
    const Hdf5Handle dataset(H5Dopen2(file_, column.c_str(), H5P_DEFAULT), H5Dclose, "cannot open " + column);
    return H5Aexists(dataset, attribute.c_str()) > 0 ? read_text_attribute(dataset, attribute) : "";
  }

 private:
  Folder folder_;
  Outcome outcome_;
  Hdf5Handle file_;
};

struct Column {
  std::string name, units, long_name, flag_meanings;
};

const std::string motions = "backward stuck forward", flanks = "right none left";
const std::vector<Column> trajectory{{"flank", "", "flank that carries the load", flanks},
                                     {"gear_acceleration", "rad/s^2", "gear acceleration theta_g''", ""},
                                     {"gear_angle", "rad", "gear angle theta_g", ""},
                                     {"gear_speed", "rad/s", "gear speed theta_g'", ""},
                                     {"load_torque", "N m", "load torque tau_l on the gear", ""},
                                     {"motion", "", "sign of the gear speed", motions},
                                     {"motor_torque", "N m", "motor torque tau_m on the worm", ""},
                                     {"normal_force", "N", "normal force Wn between the teeth", ""},
                                     {"time", "s", "time", ""}};
const std::vector<Column> events{{"acceleration_after", "rad/s^2", "gear acceleration just after", ""},
                                 {"acceleration_before", "rad/s^2", "gear acceleration just before", ""},
                                 {"flank_after", "", "flank that carries the load after", flanks},
                                 {"flank_before", "", "flank that carried the load before", flanks},
                                 {"gear_angle", "rad", "gear angle theta_g", ""},
                                 {"gear_speed", "rad/s", "gear speed theta_g'", ""},
                                 {"kind", "", "what happened", "break_away stop reversal flank_change"},
                                 {"load_torque_after", "N m", "load torque just after", ""},
                                 {"load_torque_before", "N m", "load torque just before", ""},
                                 {"motion_after", "", "sign of the gear speed after", motions},
                                 {"motion_before", "", "sign of the gear speed before", motions},
                                 {"motor_torque_after", "N m", "motor torque just after", ""},
                                 {"motor_torque_before", "N m", "motor torque just before", ""},
                                 {"time", "s", "time", ""}};

}  // namespace

TEST_CASE("a run file has the columns of its layout, each with units or flags and a sentence") {
  const Fig9 run;
  for (const auto& [group, columns] : {std::pair{"trajectory", trajectory}, {"events", events}}) {
    const Hdf5Handle table(H5Gopen2(run.file(), group, H5P_DEFAULT), H5Gclose, "no table");
    std::vector<std::string> names;
    for (const Column& column : columns) names.push_back(column.name);
    for (const std::string& expected : names) {
      const auto present = members(table);
      INFO(group << "/" << expected);
      CHECK(std::find(present.begin(), present.end(), expected) != present.end());
    }
    for (const Column& column : columns) {
      const std::string path = std::string(group) + "/" + column.name;
      INFO(path);
      CHECK(run.text(path, "units") == column.units);
      CHECK(run.text(path, "long_name") == column.long_name);
      CHECK(run.text(path, "flag_meanings") == column.flag_meanings);
    }
  }
  for (const std::string attribute : {"title", "kind", "scenario", "command_line", "wormdrive_version", "commit",
                                      "sources", "libraries", "created", "solver"})
    CHECK_FALSE(read_text_attribute(run.file(), attribute).empty());
  CHECK(read_text_attribute(run.file(), "kind") == "run");
  CHECK(read_text_attribute(run.file(), "command_line") ==
        "wormdrive run " + shipped("fig09_switching.toml") + " -q --set run.report_interval_s=0.001");
  for (const std::string number : {"solver_steps", "solver_evaluations", "solver_restarts", "solver_guard_evaluations"})
    CHECK(H5Aexists(run.file(), number.c_str()) > 0);
}

TEST_CASE("times increase strictly and hold every report, both ends and every event") {
  const Fig9 run;
  const std::vector<double> time = run["trajectory/time"], at = run["events/time"];
  REQUIRE(std::is_sorted(time.begin(), time.end(), std::less_equal<>()));
  REQUIRE(time.front() == 0.0);
  REQUIRE(time.back() == 2.0);
  REQUIRE(at.size() == 12);
  REQUIRE(time.size() == 2001 + at.size());
  for (int k = 0; k <= 2000; ++k) REQUIRE(std::binary_search(time.begin(), time.end(), k * 0.001));
  for (const double t : at) REQUIRE(std::binary_search(time.begin(), time.end(), t));
}

TEST_CASE("rows are right-continuous at events, and the events hold the left limits") {
  const Fig9 run;
  const std::vector<double> time = run["trajectory/time"], at = run["events/time"];
  int jumps = 0;
  for (std::size_t k = 0; k < at.size(); ++k) {
    const auto row = static_cast<std::size_t>(std::lower_bound(time.begin(), time.end(), at[k]) - time.begin());
    INFO("event " << k << " at " << at[k] << " s");
    for (const auto& [in_rows, after, before] : {std::tuple{"motion", "motion_after", "motion_before"},
                                                 {"flank", "flank_after", "flank_before"},
                                                 {"gear_acceleration", "acceleration_after", "acceleration_before"},
                                                 {"motor_torque", "motor_torque_after", "motor_torque_before"},
                                                 {"load_torque", "load_torque_after", "load_torque_before"},
                                                 {"gear_angle", "gear_angle", "gear_angle"},
                                                 {"gear_speed", "gear_speed", "gear_speed"}}) {
      const std::vector<double> rows = run[std::string("trajectory/") + in_rows];
      INFO(in_rows);
      CHECK(rows[row] == run[std::string("events/") + after][k]);
      // just before: the row before it is at most a millisecond away
      const double left = run[std::string("events/") + before][k];
      CHECK(std::abs(rows[row - 1] - left) <= 0.05 * std::max(1.0, std::abs(left)));
    }
    if (std::abs(run["events/acceleration_after"][k] - run["events/acceleration_before"][k]) > 1e-3) ++jumps;
    CHECK((run["events/motion_after"][k] != run["events/motion_before"][k] ||
           run["events/flank_after"][k] != run["events/flank_before"][k]));
  }
  CHECK(jumps == 5);  // the reversals; the break-away and the flank changes are continuous
}

TEST_CASE("a run of a hundred rows makes a file of a hundred, and not of thousands") {
  const Folder folder;
  REQUIRE(folder.run({"run", shipped("fig09_switching.toml"), "-q", "--set", "run.report_interval_s=0.02"}).exit == 0);
  CHECK(std::filesystem::file_size(folder / "fig09_switching.h5") < 150'000);
}

TEST_CASE("h5py finds every column with its units and its time axis") {
  const Fig9 run;
  const Outcome outcome = Process({WORMDRIVE_PYTHON, h5py_script, run.path()}, ".").wait();
  INFO(outcome.err);
  REQUIRE(outcome.exit == 0);
  for (const std::string line :
       {"trajectory/gear_speed: 2013 float64 over time, rad/s, gear speed theta_g'\n",
        "trajectory/motion: 2013 int8 over time, -1 backward 0 stuck 1 forward, sign of the gear speed\n",
        "events/kind: 12 int8 over time, 0 break_away 1 stop 2 reversal 3 flank_change, what happened\n",
        "run of 'Fig. 9: engagement switching under a sinusoidal motor torque' by wormdrive run "}) {
    INFO(line << "\n" << outcome.out);
    CHECK(outcome.out.find(line) != std::string::npos);
  }
}

TEST_CASE("a scenario of more than 64 KB is stored whole") {
  const Folder folder;
  std::string times, torques;
  for (int k = 0; k < 6000; ++k) {
    times += std::to_string(k) + ",";
    torques += "0.123456789" + std::to_string(1000 + k) + ",";
  }
  folder.write("s.toml", good_but("kind = \"constant\"\ntorque_Nm = -0.05",
                                  "kind = \"samples\"\ntimes_s = [" + times + "]\ntorques_Nm = [" + torques + "]"));
  REQUIRE(folder.run({"run", "s.toml", "-q"}).exit == 0);
  const Hdf5Handle file = open_hdf5(folder / "s.h5");
  const std::string scenario = read_text_attribute(file, "scenario");
  REQUIRE(scenario.size() > 65536);
  REQUIRE(scenario.find("0.1234567896999]") != std::string::npos);
  REQUIRE(folder.run({"run", "s.h5", "-q", "-o", "again.h5"}).exit == 0);
  REQUIRE(read_text_attribute(open_hdf5(folder / "again.h5"), "scenario") == scenario);
}

TEST_CASE("a result written in many portions has the same rows as one written in few") {
  const Folder folder;
  folder.write("s.toml", edited(good_scenario, "duration_s = 0.01", "duration_s = 1\nreport_interval_s = 4e-5"));
  REQUIRE(folder.run({"run", "s.toml", "-q"}).exit == 0);
  const std::vector<double> time = read_column(open_hdf5(folder / "s.h5"), "trajectory/time");
  REQUIRE(time.size() == 25001 + read_column(open_hdf5(folder / "s.h5"), "events/time").size());
  REQUIRE(std::is_sorted(time.begin(), time.end(), std::less_equal<>()));
}

TEST_CASE("a part disappears unless it is finished or kept") {
  const Folder folder;
  const std::string path = folder / "r.h5";
  {
    const PartFile dropped(path, "run");
    CHECK(folder.names() == std::set<std::string>{"r.h5.part", "r.h5.part.lock"});
  }
  CHECK(folder.names().empty());
  {
    PartFile kept(path, "run");
    kept.keep();
  }
  CHECK(folder.names() == std::set<std::string>{"r.h5.part"});
  {
    PartFile finished(path, "run", Replace::anything);  // the part says of no kind that it is one
    finished.finish();
  }
  CHECK(folder.names() == std::set<std::string>{"r.h5"});
}

TEST_CASE("with elastic teeth motions have the signs of the speeds, without friction as well") {
  const Folder folder;
  const Outcome run = folder.run({"run", shipped("fig09_backlash.toml"), "-q", "-o", "a.h5", "--set", "mesh.friction=0",
                                  "--set", "run.duration_s=0.05"});
  REQUIRE(run.exit == 0);
  const Hdf5Handle file = open_hdf5(folder / "a.h5");
  int turned = 0;
  for (const auto& [motion, speed] : {std::pair{"motion", "worm_speed"}, std::pair{"gear_motion", "gear_speed"}}) {
    const auto signs = read_column(file, std::string("trajectory/") + motion),
               speeds = read_column(file, std::string("trajectory/") + speed);
    for (std::size_t k = 0; k < signs.size(); ++k) {
      REQUIRE(signs[k] * speeds[k] >= 0.0);
      turned += signs[k] < 0.0;
    }
  }
  REQUIRE(turned > 0);
}

}  // namespace wormdrive::test::output_run_file
