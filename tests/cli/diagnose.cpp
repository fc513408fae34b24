#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "cli/bad_input.hpp"
#include "diagnosis/break_in_data.hpp"

// `wormdrive diagnose` from file to folder: what it writes, what the report holds, and what it refuses.

namespace wormdrive::test::cli_diagnose {

using nlohmann::json;

namespace {

const std::string scenario = shipped("fig07_break_in_07cm_forward.toml");

json report(const Folder& folder) { return json::parse(folder.read("out/diagnosis.json")); }

/// Whether a value has one of the types, by name.
bool is(const json& value, const std::string& types) { return types.find(value.type_name()) != std::string::npos; }

void check_members(const json& object, const std::vector<std::pair<std::string, std::string>>& members) {
  CHECK(object.size() == members.size());
  for (const auto& [key, types] : members) {
    INFO(key);
    REQUIRE(object.contains(key));
    CHECK(is(object.at(key), types));
  }
}

}  // namespace

TEST_CASE("a diagnosis writes its folder, names the friction, and its extended scenario runs", "[slow]") {
  const Folder folder;
  folder.write("b.csv", break_in_csv(0.25, 0.03, 3));
  const Outcome outcome = folder.run({"diagnose", scenario, "b.csv", "--set", "mesh.friction=0.2", "-o", "out"});
  INFO(outcome.out << outcome.err);
  REQUIRE(outcome.exit == 0);
  CHECK(outcome.err.empty());
  CHECK(outcome.out.find("found    mu_s = 0.2") != std::string::npos);
  for (const char* const name : {"diagnosis.json", "extended.toml", "diagnosis.h5", "prediction.png", "residual.png",
                                 "ranking.png", "certificate.png"})
    CHECK(std::filesystem::exists(folder / (std::string("out/") + name)));
  for (const auto& entry : std::filesystem::directory_iterator(folder / "out"))
    CHECK(entry.path().extension() != ".part");
  CHECK(report(folder).at("verdict") != "adequate");
  CHECK(outcome.out.find("out/diagnosis.json    see it: wormdrive report out\n") != std::string::npos);
  CHECK(folder.read("out/extended.toml")
            .starts_with("# A scenario that wormdrive diagnose has extended; causes: static_friction.\n"
                         "# The data cannot tell the causes of this class apart: static_friction, mesh_friction.\n"));
  CHECK(folder.run({"run", "out/extended.toml", "-q"}).exit == 0);
}

TEST_CASE("the JSON of a diagnosis has every key with its type, and null instead of NaN") {
  const Folder folder;
  folder.write("b.csv", break_in_csv(0.25, 0.03, 3));
  const Outcome outcome =
      folder.run({"diagnose", scenario, "b.csv", "--set", "mesh.friction=0.2", "-o", "out", "--json", "--no-pictures"});
  REQUIRE(outcome.exit == 0);
  CHECK(json::parse(outcome.out) == report(folder));
  const json d = report(folder);
  check_members(d, {{"verdict", "string"},
                    {"sentence", "string"},
                    {"data", "object"},
                    {"causes", "array"},
                    {"classes", "array"},
                    {"ranking", "array"},
                    {"gain", "array"},
                    {"calibration", "array"},
                    {"uncertainty", "object"},
                    {"identified", "array"},
                    {"certificate", "array"},
                    {"unobservable", "array"},
                    {"adequacy", "array"},
                    {"noise", "object"},
                    {"experiment", "string null"},
                    {"since", "null"},
                    {"remarks", "array"},
                    {"settings", "object"},
                    {"program", "string"}});
  check_members(d["data"], {{"kind", "string"}, {"files", "array"}});
  check_members(d["causes"].at(0), {{"effect", "string"}, {"parameters", "array"}, {"remedy", "string,null"}});
  check_members(d["causes"][0]["parameters"].at(0), {{"name", "string"},
                                                     {"value", "number"},
                                                     {"standard_error", "number"},
                                                     {"low", "number"},
                                                     {"high", "number"},
                                                     {"unit", "string"}});
  for (const json& c : d["ranking"])
    check_members(c, {{"effect", "string"},
                      {"parameters", "array"},
                      {"delta_bic", "number"},
                      {"held_out_gain_nats", "number"},
                      {"named", "boolean"},
                      {"outcome", "string"}});
  check_members(d["gain"].at(0), {{"horizon_s", "null"},
                                  {"before", "number"},
                                  {"after", "number"},
                                  {"after_low", "number"},
                                  {"after_high", "number"},
                                  {"noise_floor", "null"},
                                  {"constant_speed", "null"},
                                  {"unit", "string"}});
  for (const json& v : d["certificate"])
    check_members(v, {{"effect", "string"},
                      {"parameter", "string"},
                      {"chosen", "string null"},
                      {"unit", "string"},
                      {"observable", "boolean"},
                      {"detectable", "number null"},
                      {"nameable", "number null"},
                      {"nearest", "string null"},
                      {"likeness", "number"}});
  check_members(d["settings"], {{"seed", "number"}, {"passes", "number"}});
  check_members(d["noise"], {{"torque_Nm", "number"}, {"angle_rad", "number null"}});
  CHECK(d["identified"].size() == 3);
}

TEST_CASE("the same data give the same report, whatever the threads", "[slow]") {
  const Folder folder;
  folder.write("b.csv", break_in_csv(0.25, 0.03, 4));
  std::vector<json> reports;
  for (const std::string threads : {"1", "2"}) {
    REQUIRE(
        folder.run({"diagnose", scenario, "b.csv", "-o", "out", "-q", "--no-pictures", "--threads", threads}).exit ==
        0);
    reports.push_back(report(folder));
  }
  CHECK(reports[0] == reports[1]);
}

TEST_CASE("data of no kind, of two kinds and too few data are rejected, and nothing is written") {
  const Folder folder;
  folder.write("b.csv", break_in_csv(0.25, 0.03, 3));
  folder.write("few.csv", "load_torque_Nm,motor_torque_Nm\n0.2,0.01\n0.2,-0.02\n");
  folder.write("none.csv", "a,b\n1,2\n");
  folder.write("records.csv", "record,worm_speed_rad_per_s,motor_torque_Nm\na,1,0.1\n");
  const auto words = [](const std::string& data) {
    return std::vector<std::string>{"diagnose", scenario, data, "-o", "out"};
  };
  check_rejected(
      folder,
      {
          {"few", "", "few.csv: error: 2 break-in torques; at least 6 are needed, in both directions", words("few.csv"),
           true},
          {"no kind", "",
           "none.csv:1: error: the columns a, b make neither a recording (time_s, motor_torque_Nm, gear_angle_rad) nor "
           "records at constant speed (record, worm_speed_rad_per_s, motor_torque_Nm) nor a break-in table "
           "(load_torque_Nm, motor_torque_Nm); [data] in the scenario tells other names, see docs/recordings.md",
           words("none.csv"), true},
          {"two kinds",
           "",
           "records.csv: error: holds records at constant speed, but b.csv holds a break-in table; diagnose them one "
           "by one",
           {"diagnose", scenario, "b.csv", "records.csv", "-o", "out"},
           true},
          {"one record", "",
           "records.csv: error: 1 records at constant speed; a diagnosis needs at least 8, in both directions",
           words("records.csv"), true},
          {"load of nothing",
           "",
           "--load c.csv:mass_kg=2: error: must be FILE:KEY=VALUE of one of the recordings b.csv, as in "
           "b.csv:mass_kg=0.9",
           {"diagnose", scenario, "b.csv", "--load", "c.csv:mass_kg=2", "-o", "out"},
           true},
          {"load of a table",
           "",
           "b.csv: error: holds a break-in table; a load of its own is for a recording over time",
           {"diagnose", scenario, "b.csv", "--load", "b.csv:torque_Nm=2", "-o", "out"},
           true},
          {"draws of a table",
           "",
           "b.csv: error: holds a break-in table; draws are for a recording over time",
           {"diagnose", scenario, "b.csv", "--draws", "50", "-o", "out"},
           true},
          {"too few draws",
           "",
           "wormdrive diagnose: error: --draws: Value 9 not in range 10 to 1000000; see wormdrive diagnose --help or "
           "docs/howto/first_diagnosis.md",
           {"diagnose", scenario, "b.csv", "--draws", "9", "-o", "out"},
           true},
          {"absent", "", "absent.csv: error: cannot be read: No such file or directory", words("absent.csv"), true},
      });
}

TEST_CASE("an output folder that cannot be created ends with exit code 4") {
  const Folder folder;
  folder.write("b.csv", break_in_csv(0.25, 0.03, 3));
  folder.write("out", "a file");
  const Outcome outcome = folder.run({"diagnose", scenario, "b.csv", "-o", "out", "-q"});
  CHECK(outcome.exit == 4);
  CHECK(outcome.err.starts_with("wormdrive: cannot make the folder out: "));
  CHECK(folder.read("out") == "a file");
}

TEST_CASE("a diagnosis never writes over what it reads") {
  const Folder folder;
  std::filesystem::create_directory(folder / "out");
  folder.write("b.csv", break_in_csv(0.25, 0.03, 3));
  std::filesystem::copy_file(scenario, folder / "out/extended.toml");
  const Outcome outcome = folder.run({"diagnose", "out/extended.toml", "b.csv", "-o", "out", "-q"});
  CHECK(outcome.exit == 2);
  CHECK(outcome.err ==
        "out/extended.toml: error: the result would overwrite out/extended.toml; choose another --output\n");
}

TEST_CASE("impossible tolerances and column names are rejected") {
  const auto with = [](const std::string& tables) { return good_scenario + tables; };
  check_rejected(
      Folder(),
      {
          {"unit", with("[tolerance]\nfriction = 1\n"),
           "s.toml:20:1: error: unknown key 'friction' in [tolerance]; did you mean 'friction_share'?"},
          {"negative", with("[tolerance]\nload_percent = -1\n"),
           "s.toml:20:16: error: tolerance.load_percent = -1 % must be at least 0 %"},
          {"twice", with("[tolerance]\nload_percent = 1\nload_share = 0.01\n"),
           "s.toml:21:14: error: tolerance.load_share is stated twice, also as load_percent; keep one"},
          {"text", with("[tolerance]\ngear_inertia_percent = \"1 %\"\n"),
           "s.toml:20:24: error: tolerance.gear_inertia_percent must be a number, not a string"},
          {"no table", "tolerance = 1\n" + good_scenario,
           "s.toml:1:13: error: tolerance must be a table, not a number"},
          {"number", with("[data]\ntime_s = 3\n"), "s.toml:20:10: error: data.time_s must be a string, not a number"},
          {"unknown", with("[data]\nmotor_torque = \"u\"\n"),
           "s.toml:20:1: error: unknown key 'motor_torque' in [data]; did you mean 'motor_torque_Nm'?"},
          {"empty", with("[data]\ngear_angle_rad = \"\"\n"),
           "s.toml:20:18: error: data.gear_angle_rad = \"\" names no column"},
      });
}

TEST_CASE("a recording with another payload is diagnosed with the load that it states", "[slow]") {
  const Folder folder;
  const std::string bench = shipped("example_bench.toml");
  const auto keep = [&](const std::string& file, const std::string& mass) {
    REQUIRE(folder
                .run({"run", bench, "--set", "run.duration_s=4", "--set", "run.report_interval_s=0.002", "--set",
                      "load.mass_kg=" + mass, "-o", file, "-q"})
                .exit == 0);
  };
  keep("light.h5", "1.0");
  keep("heavy.h5", "1.3");
  std::vector<std::string> words{"diagnose", bench, "light.h5", "heavy.h5", "-o", "out", "-q", "--no-pictures"};
  REQUIRE(folder.run(words).exit == 0);
  CHECK(report(folder)["verdict"] != "adequate");
  words.insert(words.end(), {"--load", "heavy.h5:mass_kg=1.3"});
  REQUIRE(folder.run(words).exit == 0);
  CHECK(report(folder)["verdict"] == "adequate");
}

}  // namespace wormdrive::test::cli_diagnose
