// What helps with scenarios: the schema, the templates of `new`, and `diff`.
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "cli/bad_input.hpp"

namespace wormdrive::test::cli_scenario_help {

namespace {

nlohmann::json schema() {
  const Outcome outcome = Folder().run({"schema"});
  REQUIRE(outcome.exit == 0);
  return nlohmann::json::parse(outcome.out);
}

/// The keys that a message lists: "...; valid keys: a, b, c".
std::set<std::string> valid_keys(const std::string& message) {
  const std::string mark = "; valid keys: ";
  std::set<std::string> keys;
  const std::size_t at = message.find(mark);
  if (at == std::string::npos) return keys;
  std::istringstream list(message.substr(at + mark.size(), message.find('\n', at) - at - mark.size()));
  for (std::string key; list >> key;) keys.insert(key.substr(0, key.find(',')));
  return keys;
}
std::set<std::string> keys_of(const nlohmann::json& table) {
  std::set<std::string> keys;
  for (const auto& [key, value] : table.at("properties").items()) keys.insert(key);
  return keys;
}

/// A key that nobody has, in a scenario that ends in the table it is about.
std::string nonsense(const std::string& scenario) { return scenario + "zzzzzzzzzzzzzzzzzzzz = 1\n"; }

}  // namespace

TEST_CASE("the schema has the keys of the reader in every table", "[slow]") {
  const nlohmann::json all = schema(), rotary = all.at("else").at("properties"),
                       linear = all.at("then").at("properties");
  const Folder folder;
  const auto check = [&](const std::string& what, const nlohmann::json& table, const std::string& scenario) {
    folder.write("s.toml", nonsense(scenario));
    const Outcome outcome = folder.run({"check", "s.toml"});
    INFO(what << "\n" << outcome.err);
    CHECK(valid_keys(outcome.err) == keys_of(table));
  };
  const auto kind = [](const nlohmann::json& kinds, const std::string& name) {
    for (const auto& one : kinds)
      if (one.at("properties").at("kind").value("const", "") == name) return one;
    throw std::out_of_range(name);
  };
  const auto kinds_in = [](const nlohmann::json& kinds) {
    std::vector<std::string> names;
    for (const auto& one : kinds) names.push_back(one.at("properties").at("kind").at("const"));
    return names;
  };
  check("mesh", rotary.at("mesh").at("oneOf")[0], good_scenario.substr(0, good_scenario.find("[motor")));
  check("run", rotary.at("run"), good_scenario);
  check("initial", rotary.at("initial"), good_scenario + "[initial]\n");
  check("linear initial", linear.at("initial"), "[mesh]\nkind = \"none\"\naxis = \"linear\"\n[initial]\n");
  check("linear mesh", linear.at("mesh"), "[mesh]\nkind = \"none\"\naxis = \"linear\"\n");
  const auto has_table = [](const nlohmann::json& table) { return table.at("properties").contains("file"); };
  for (const auto& [id, effect] : rotary.at("effect").at("properties").items())
    if (!has_table(effect)) check(id, effect, good_scenario + "[effect." + id + "]\n");
  for (const auto& [id, effect] : linear.at("effect").at("properties").items())
    if (!has_table(effect))  // whose keys hang on one another
      check("linear " + id, effect, "[mesh]\nkind = \"none\"\naxis = \"linear\"\n[effect." + id + "]\n");
  const auto torques = rotary.at("motor").at("properties").at("torque").at("oneOf")[0].at("oneOf");
  for (const std::string& name : kinds_in(torques))
    if (name != "samples")  // whose keys hang on one another
      check(name, kind(torques, name), "[motor.torque]\nkind = \"" + name + "\"\n");
  const auto loads = rotary.at("load").at("oneOf")[0].at("oneOf");
  check("gravity_arm", kind(loads, "gravity_arm"), "[load]\nkind = \"gravity_arm\"\n");
  check("fan", kind(loads, "fan"), "[load]\nkind = \"fan\"\n");
  for (const auto& law : rotary.at("controller").at("oneOf")) {
    const std::string name = law.at("properties").at("kind").at("const");
    check(name, law, "[controller]\nkind = \"" + name + "\"\n");
  }
  check("nominal", rotary.at("controller").at("oneOf")[0].at("properties").at("nominal"),
        "[controller]\nkind = \"pid\"\n[controller.nominal]\n");
  for (const std::string table : {"sensor", "disturbance", "metrics"})
    check(table, rotary.at(table), "[controller]\nkind = \"pid\"\n[" + table + "]\n");
  const auto references = rotary.at("reference").at("oneOf")[0].at("oneOf");
  for (const std::string& name : kinds_in(references))
    if (name != "table")
      check(name, kind(references, name), "[controller]\nkind = \"pid\"\n[reference]\nkind = \"" + name + "\"\n");
}

TEST_CASE("the schema states units, bounds and defaults of the fields") {
  const nlohmann::json properties = schema().at("else").at("properties");
  const auto& mesh = properties.at("mesh").at("oneOf")[0];
  const auto& lead = mesh.at("properties").at("lead_angle_deg");
  CHECK(lead.at("description") == "lead angle of the worm [deg]");
  CHECK(lead.at("exclusiveMinimum") == 0.0);
  CHECK(lead.at("maximum") == 45.0);
  CHECK(mesh.at("required").size() == 6);
  CHECK(mesh.at("allOf").size() == 2);  // angles, in either unit
  CHECK(properties.at("run").at("properties").at("relative_tolerance").at("default") == 1e-10);
}

TEST_CASE("every kind of new scenario runs unchanged") {
  for (const std::string kind : {"open_loop", "controlled", "elastic_teeth", "linear_axis"}) {
    INFO(kind);
    const Folder folder;
    CHECK(folder.run({"new", "mine.toml", "--kind", kind}).exit == 0);
    const Outcome run = folder.run({"run", "mine.toml", "--set", "run.duration_s=0.2"});
    INFO(run.err);
    CHECK(run.exit == 0);
    CHECK(folder.names() == std::set<std::string>{"mine.h5", "mine.toml"});
  }
}

TEST_CASE("a new study sweeps the new scenario") {
  const Folder folder;
  CHECK(folder.run({"new", "study.toml", "--kind", "study"}).out ==
        "  wrote    study.toml    run it: wormdrive sweep study.toml\n");
  REQUIRE(folder.run({"new", "my_drive.toml"}).exit == 0);
  folder.write("study.toml", edited(folder.read("study.toml"), "trials = 10000", "trials = 100"));
  const Outcome sweep = folder.run({"sweep", "study.toml"});
  INFO(sweep.out << sweep.err);
  CHECK(sweep.exit == 0);
  CHECK(folder.run({"summary", "study.h5"}).out.find("  trials   100 of 100\n") != std::string::npos);
}

TEST_CASE("the controller of a new scenario keeps the promises of Lemma 1") {
  const Folder folder;
  REQUIRE(folder.run({"new", "mine.toml", "--kind", "controlled"}).exit == 0);
  const Outcome run = folder.run({"run", "mine.toml"});
  INFO(run.out << run.err);
  CHECK(run.out.find("all promises kept") != std::string::npos);
}

TEST_CASE("new and diff reject bad input in one line") {
  const Folder folder;
  folder.write("s.toml", good_scenario);
  check_rejected(folder,
                 {{"over something", "", "s.toml: error: it exists; choose another name", {"new", "s.toml"}, true},
                  {"nowhere",
                   "",
                   "wormdrive: cannot write nowhere/s.toml: No such file or directory",
                   {"new", "nowhere/s.toml"},
                   true,
                   4},
                  {"no result",
                   "",
                   "s.toml: error: not an HDF5 file; wormdrive run writes one",
                   {"diff", "s.toml", "s.toml"},
                   true},
                  {"no two results",
                   "",
                   "a.h5: error: cannot be read: No such file or directory\n"
                   "b.h5: error: cannot be read: No such file or directory",
                   {"diff", "a.h5", "b.h5"},
                   true}});
}

TEST_CASE("the exit code of diff says whether two runs agree, and its output where they differ", "[slow]") {
  const Folder folder;
  const std::string scenario = shipped("fig09_switching.toml");
  REQUIRE(folder.run({"run", scenario, "-o", "a.h5"}).exit == 0);
  REQUIRE(folder.run({"run", scenario, "-o", "same.h5"}).exit == 0);
  REQUIRE(folder.run({"run", scenario, "-o", "close.h5", "--set", "run.method=adams"}).exit == 0);
  REQUIRE(folder.run({"run", scenario, "-o", "other.h5", "--set", "mesh.friction=0.2501"}).exit == 0);
  REQUIRE(folder.run({"run", scenario, "-o", "short.h5", "--set", "run.duration_s=1"}).exit == 0);
  const auto diff = [&](const std::vector<std::string>& words) {
    std::vector<std::string> all{"diff", "a.h5"};
    all.insert(all.end(), words.begin(), words.end());
    return folder.run(all);
  };
  CHECK(diff({"same.h5", "--relative", "0", "--time", "0"}).exit == 0);
  CHECK(diff({"close.h5"}).exit == 0);
  CHECK(diff({"close.h5", "--relative", "0", "--time", "0"}).exit == 1);
  const Outcome other = diff({"other.h5"});
  CHECK(other.exit == 1);
  CHECK(other.out.find("trajectory/gear_angle") != std::string::npos);
  CHECK(other.out.find("DIFFERS") != std::string::npos);
  CHECK(diff({"other.h5", "--relative", "0.1", "--time", "0.01"}).exit == 0);
  const Outcome fewer = diff({"short.h5"});
  CHECK(fewer.exit == 1);
  CHECK(fewer.out.find("events: 12 in the first result, 6 in the second") != std::string::npos);
  CHECK(diff({"other.h5", "--quiet"}).out.empty());
  CHECK(nlohmann::json::parse(diff({"same.h5", "--json"}).out).at("agree") == true);
}

}  // namespace wormdrive::test::cli_scenario_help
