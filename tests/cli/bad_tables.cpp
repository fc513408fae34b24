// One malformed input per line:
// clang-format off
#include "cli/bad_input.hpp"

// What the program says about tables of numbers, stated in a scenario or read from a CSV file.

namespace wormdrive::test::cli_bad_tables {

namespace {

const std::string motor = "kind = \"constant\"\ntorque_Nm = -0.05";
const std::string load = "kind = \"constant\"\ntorque_Nm = 0.02";

std::string samples(const std::string& lines) { return good_but(motor, "kind = \"samples\"\n" + lines); }
std::string angles(const std::string& lines) { return good_but(load, "kind = \"angle_table\"\n" + lines); }
const std::string reads_csv = samples("file = \"t.csv\"");

}  // namespace

TEST_CASE("arrays that do not form a table are rejected with the reason") {
  check_rejected(Folder(), {
      {"none", good_but(motor, "kind = \"samples\""), "s.toml:11:1: error: [motor.torque] lacks 'file' (a CSV file), or 'times_s' and 'torques_Nm'"},
      {"one of two", samples("times_s = [0, 1]"), "s.toml:11:1: error: [motor.torque] lacks 'file' (a CSV file), or 'times_s' and 'torques_Nm'"},
      {"different length", samples("times_s = [0, 1, 2]\ntorques_Nm = [1, 2]"),
       "s.toml:13:11: error: motor.torque.times_s has 3 values but torques_Nm has 2 values"},
      {"too short", samples("times_s = [0]\ntorques_Nm = [1]"), "s.toml:13:11: error: motor.torque.times_s has 1 value; at least 2 are needed"},
      {"nan", samples("times_s = [0, 1]\ntorques_Nm = [1, nan]"),
       "s.toml:14:18: error: motor.torque.torques_Nm[1] = nan must be a finite number"},
      {"text", samples("times_s = [0, 1]\ntorques_Nm = [1, \"2\"]"),
       "s.toml:14:18: error: motor.torque.torques_Nm[1] must be a number, not a string"},
      {"no array", samples("times_s = 0\ntorques_Nm = [1, 2]"), "s.toml:13:11: error: motor.torque.times_s must be an array of numbers, not a number"},
      {"not increasing", samples("times_s = [0, 1, 1]\ntorques_Nm = [1, 2, 3]"),
       "s.toml:13:11: error: motor.torque.times_s[2] = 1 does not increase after 1"},
      {"interpolation", samples("times_s = [0, 1]\ntorques_Nm = [1, 2]\ninterpolation = \"cubic\""),
       "s.toml:15:17: error: motor.torque.interpolation = \"cubic\" must be one of \"hold\", \"linear\""},
      {"file as well", samples("file = \"t.csv\"\ntimes_s = [0, 1]"),
       "s.toml:13:8: error: motor.torque.file = \"t.csv\" cannot be read: No such file or directory\n"
       "s.toml:14:11: error: motor.torque.times_s is stated along with 'file'; keep one"},
      {"three angles", angles("angles_deg = [0, 1, 2]\ntorques_Nm = [1, 2, 3]"), "s.toml:16:14: error: load.angles_deg has 3 values; at least 4 are needed"},
      {"angles not increasing", angles("angles_deg = [0, 10, 5, 20]\ntorques_Nm = [1, 2, 3, 4]"),
       "s.toml:16:14: error: load.angles_deg[2] = 5 does not increase after 10"},
      {"angles in rad not increasing", angles("angles_rad = [0, 1, 0.5, 2]\ntorques_Nm = [1, 2, 3, 4]"),
       "s.toml:16:14: error: load.angles_rad[2] = 0.5 does not increase after 1"},
      {"no table of an effect", good_scenario + "[effect.torque_map]\nover = \"worm_speed\"\n",
       "s.toml:19:1: error: [effect.torque_map] lacks 'file' (a CSV file), or 'speeds_rad_per_s' and 'torques_Nm'"},
      {"speeds over the angle", good_scenario + "[effect.torque_map]\nover = \"gear_angle\"\nspeeds_rad_per_s = [0, 1, 2, 3]\ntorques_Nm = [1, 2, 3, 4]\n",
       "s.toml:19:1: error: [effect.torque_map] lacks 'file' (a CSV file), or 'angles_deg' and 'torques_Nm'\n"
       "s.toml:21:1: error: unknown key 'speeds_rad_per_s' in [effect.torque_map]; valid keys: on, over, shaft, scale, angles_deg, angles_rad, torques_Nm"},
      {"angles twice", angles("angles_deg = [0, 1, 2, 3]\nangles_rad = [0, 1, 2, 3]\ntorques_Nm = [1, 2, 3, 4]"),
       "s.toml:17:14: error: load.angles_rad is stated twice, also as angles_deg; keep one"}});
}

TEST_CASE("an unreadable CSV file is reported at the line of the scenario that names it") {
  const Folder folder;
  std::filesystem::create_directory(folder / "folder");
  folder.write("short.csv", "time_s,motor_torque_Nm\n0,1\n");
  check_rejected(folder, {
      {"missing", samples("file = \"no.csv\""), "s.toml:13:8: error: motor.torque.file = \"no.csv\" cannot be read: No such file or directory"},
      {"folder", samples("file = \"folder\""), "s.toml:13:8: error: motor.torque.file = \"folder\" cannot be read: it is a directory"},
      {"no text", samples("file = 3"), "s.toml:13:8: error: motor.torque.file must be a string, not a number"},
      {"one row", samples("file = \"short.csv\""),
       "s.toml:13:8: error: motor.torque.file = \"short.csv\" has 1 row below its header line; at least 2 are needed"},
      {"misspelled column key", samples("file = \"short.csv\"\nx_colum = \"t\""),
       "s.toml:13:8: error: motor.torque.file = \"short.csv\" has 1 row below its header line; at least 2 are needed\n"
       "s.toml:14:1: error: unknown key 'x_colum' in [motor.torque]; did you mean 'x_column'?"}});
}

TEST_CASE("faults inside a CSV file are reported with the line of that file") {
  struct BadCsv {
    std::string name, text, message;
  };
  const std::string header = "time_s,motor_torque_Nm\n";
  const Folder folder;
  for (const BadCsv& bad : {
           BadCsv{"empty", "", "t.csv:1: error: no header line with column names"},
           {"no header", "0,1\n1,2\n", "t.csv:1: error: no column 'time_s'; the header line names 0, 1"},
           {"no such column", "time_s,torque\n0,1\n1,2\n", "t.csv:1: error: no column 'motor_torque_Nm'; the header line names time_s, torque"},
           {"other separator", "time_s;motor_torque_Nm\n0;1\n", "t.csv:1: error: no column 'time_s'; the header line names time_s;motor_torque_Nm"},
           {"no number", header + "0,1\n1,x\n", "t.csv:3: error: motor_torque_Nm = 'x' is not a finite number"},
           {"number and more", header + "0,1\n1,2 Nm\n", "t.csv:3: error: motor_torque_Nm = '2 Nm' is not a finite number"},
           {"nan", header + "0,1\n1,nan\n", "t.csv:3: error: motor_torque_Nm = 'nan' is not a finite number"},
           {"empty cell", header + "0,1\n1,\n", "t.csv:3: error: motor_torque_Nm = '' is not a finite number"},
           {"a cell too many", header + "0,1\n1,2,3\n", "t.csv:3: error: 3 cells where the header has 2"},
           {"a cell too few", header + "0,1\n1\n", "t.csv:3: error: 1 cells where the header has 2"},
           {"empty line inside", header + "0,1\n\n1,2\n", "t.csv:3: error: an empty line inside the table"},
           {"time stands still", header + "0,1\n0.5,2\n0.5,3\n", "t.csv:4: error: time_s = 0.5 does not increase after 0.5"},
           {"a NUL byte", header + "0,1\n1," + std::string(1, '\0') + "\n", "t.csv:3: error: a NUL byte; a CSV file is plain text"}}) {
    folder.write("t.csv", bad.text);
    check_rejected(folder, {{bad.name, reads_csv, bad.message + " (motor.torque.file at s.toml:13:8)"}});
  }
}

TEST_CASE("CSV files of spreadsheets and of printf are read") {
  const Folder folder;
  folder.write("t.csv", "\xEF\xBB\xBF\"time_s\" , motor_torque_Nm,note\r\n0,+1e-3,a\r\n  0.5 ,-0.002,b\r\n\r\n");
  folder.write("s.toml", reads_csv);
  const Outcome outcome = folder.run({"check", "s.toml", "--set", "run.duration_s=1"});
  INFO(outcome.err);
  REQUIRE(outcome.exit == 0);
  REQUIRE(folder.run({"run", "s.toml", "-q"}).exit == 0);
  const std::string scenario = read_text_attribute(wormdrive::open_hdf5(folder / "s.h5"), "scenario");
  REQUIRE(scenario.find("times_s = [0.0, 0.5]\ntorques_Nm = [0.001, -0.002]\n") != std::string::npos);
}

TEST_CASE("a load reads the column with its own name or the one that the scenario names") {
  const Folder folder;
  folder.write("t.csv", "time_s,load_torque_Nm,motor_torque_Nm,t,tau\n0,1,2,0,3\n1,1,2,2,3\n");
  const auto stored = [&](const std::string& lines) {
    folder.write("s.toml", good_but(load, lines));
    const Outcome outcome = folder.run({"run", "s.toml", "-q"});
    INFO(outcome.err);
    REQUIRE(outcome.exit == 0);
    return read_text_attribute(wormdrive::open_hdf5(folder / "s.h5"), "scenario");
  };
  REQUIRE(stored("kind = \"samples\"\nfile = \"t.csv\"").find("torques_Nm = [1.0, 1.0]\n") != std::string::npos);
  REQUIRE(stored("kind = \"samples\"\nfile = \"t.csv\"\nx_column = \"t\"\ny_column = \"tau\"")
              .find("times_s = [0.0, 2.0]\ntorques_Nm = [3.0, 3.0]\n") != std::string::npos);
}

}  // namespace wormdrive::test::cli_bad_tables
