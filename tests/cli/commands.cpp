#include <cmath>

#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "cli/program.hpp"

// What the commands print and write: JSON beside files, overrides, names, silence.

namespace wormdrive::test::cli_commands {

using nlohmann::json;

namespace {

const std::string fig9 = shipped("fig09_switching.toml"), nothing;

/// Standard output of a command that succeeds and has nothing to complain about.
std::string printed(const Folder& folder, const std::vector<std::string>& words) {
  const Outcome outcome = folder.run(words);
  INFO(outcome.err);
  REQUIRE(outcome.exit == 0);
  REQUIRE(outcome.err == nothing);
  return outcome.out;
}

double attribute(hid_t file, const std::string& name) {
  const Hdf5Handle handle(H5Aopen(file, name.c_str(), H5P_DEFAULT), H5Aclose, "no attribute " + name);
  double value = 0.0;
  check_hdf5(H5Aread(handle, H5T_NATIVE_DOUBLE, &value), "cannot read " + name);
  return value;
}

json run_with(const Folder& folder, const std::vector<std::string>& overrides, const std::string& scenario) {
  std::vector<std::string> words{"check", scenario, "--json"};
  for (const std::string& override : overrides) words.insert(words.end(), {"--set", override});
  return json::parse(printed(folder, words)).at("parameters");
}

}  // namespace

TEST_CASE("run --json contains the numbers of the file that it writes") {
  const Folder folder;
  const json said = json::parse(printed(folder, {"run", fig9, "--json", "--audit", "-o", "r.h5"}));
  const Hdf5Handle file = open_hdf5(folder / "r.h5");
  CHECK(said.at("title") == read_text_attribute(file, "title"));
  CHECK(said.at("output") == "r.h5");
  CHECK(said.at("solver") == read_text_attribute(file, "solver"));
  CHECK(said.at("steps").get<double>() == attribute(file, "solver_steps"));
  CHECK(said.at("evaluations").get<double>() == attribute(file, "solver_evaluations"));
  CHECK(said.at("gear_angle").get<double>() == read_column(file, "trajectory/gear_angle").back());
  CHECK(said.at("gear_speed").get<double>() == read_column(file, "trajectory/gear_speed").back());
  const std::vector<double> kinds = read_column(file, "events/kind");
  for (const auto& [name, kind] : {std::pair{"break_away", 0}, {"stop", 1}, {"reversal", 2}, {"flank_change", 3}})
    CHECK(said.at("events").at(name) == std::count(kinds.begin(), kinds.end(), kind));
  CHECK(said.at("audit").at("missed") == 0);
  CHECK(said.at("audit").at("events") == 12);
  CHECK(said.at("warnings").size() == 1);
}

TEST_CASE("statics --json contains the numbers of the file that it writes") {
  const Folder folder;
  const json said =
      json::parse(printed(folder, {"statics", fig9, "--json", "-o", "s.h5", "--points", "7", "--max-load", "2"}));
  const Hdf5Handle file = open_hdf5(folder / "s.h5");
  CHECK(read_text_attribute(file, "kind") == "statics");
  CHECK(said.at("regime") == read_text_attribute(file, "regime"));
  for (const std::string name : {"C1", "C2", "H"}) CHECK(said.at(name).get<double>() == attribute(file, name));
  CHECK(said.at("load_torque_Nm").get<std::vector<double>>() == read_column(file, "statics/load_torque"));
  CHECK(said.at("stick_low_Nm").get<std::vector<double>>() == read_column(file, "statics/stick_low"));
  CHECK(said.at("stick_high_Nm").get<std::vector<double>>() == read_column(file, "statics/stick_high"));
  CHECK(said.at("load_torque_Nm").size() == 7);
  CHECK(said.at("load_torque_Nm").back() == 2.0);
}

TEST_CASE("steady --json contains the numbers of the file that it writes") {
  const Folder folder;
  folder.write("d.csv", "record,worm_speed_rad_per_s,motor_torque_Nm\nup,10,0.001\nup,12,0.003\ndown,-10,-0.002\n");
  const json said = json::parse(printed(folder, {"steady", shipped("measured_worm_drive.toml"), "--json", "--data",
                                                 "d.csv", "-o", "s.h5", "--points", "5"}));
  const Hdf5Handle file = open_hdf5(folder / "s.h5");
  CHECK(read_text_attribute(file, "kind") == "steady");
  CHECK(said.at("worm_speed_rad_per_s").get<std::vector<double>>() == read_column(file, "model/worm_speed"));
  CHECK(said.at("motor_torque_Nm").get<std::vector<double>>() == read_column(file, "model/motor_torque"));
  CHECK(said.at("worm_speed_rad_per_s").size() == 10);
  CHECK(said.at("rms_error_Nm").get<double>() == attribute(file, "rms_error"));
  CHECK(said.at("rms_torque_Nm").get<double>() == attribute(file, "rms_torque"));
  CHECK(said.at("rms_torque_Nm").get<double>() == 0.002);
  const json& records = said.at("records");
  REQUIRE(records.size() == 2);
  CHECK(records[0].at("record") == "up");
  CHECK(records[0].at("worm_speed_rad_per_s") == 11.0);
  CHECK(records[0].at("samples") == 2);
  for (std::size_t k = 0; k < 2; ++k) {
    CHECK(records[k].at("motor_torque_Nm").get<double>() == read_column(file, "records/motor_torque")[k]);
    CHECK(records[k].at("motor_torque_model_Nm").get<double>() == read_column(file, "records/motor_torque_model")[k]);
  }
}

TEST_CASE("check --json states parameters with units, and a scenario that can be run") {
  const Folder folder;
  const json said = json::parse(printed(folder, {"check", fig9, "--json"}));
  CHECK(said.at("parameters").at("mesh.lead_angle_deg").at("value") == 4.0);
  CHECK(said.at("parameters").at("motor.torque.amplitude_Nm").at("unit") == "N m");
  CHECK(std::abs(said.at("derived").at("mu_g").at("value").get<double>() - 13.4382) <= 1e-4);
  CHECK(said.at("regime").get<std::string>().starts_with("gear self-locking; "));
  folder.write("again.toml", said.at("scenario"));
  CHECK(json::parse(printed(folder, {"check", "again.toml", "--json"})) == said);
  // where the worm is slowest, at k = 1 - 0.2 rad, eq. 17 has the least room
  const std::string eccentric = "effect.transmission_error={amplitude_deg=11.459155902616466, phase_deg=0}";
  const json slower = json::parse(printed(folder, {"check", fig9, "--json", "--set", eccentric})).at("derived");
  const auto value = [&](const json& derived, const std::string& name) {
    return derived.at(name).at("value").get<double>();
  };
  const double surface = value(said.at("derived"), "Jw i/Jg"), C1 = value(slower, "C1");
  CHECK(std::abs(value(slower, "C1 + Jw i k^2/Jg") - (C1 + 0.64 * surface)) <= 1e-12);
  CHECK(std::abs(value(said.at("derived"), "C1 + Jw i/Jg") - (C1 + surface)) <= 1e-12);
  folder.write("mass.toml", "[mesh]\nkind = \"none\"\ninertia_kgm2 = 1\n");
  CHECK(json::parse(printed(folder, {"check", "mass.toml", "--json"})).at("derived") == json::object());
}

TEST_CASE("statics prints at which torques the drive rests, bearings included") {
  const Folder folder;
  folder.write("s.toml", good_scenario);  // C1 -0.0470643, C2 0.0836831, load 0.02 N m
  for (const auto& [coulomb, told] : {std::pair{"0", "at rest from -0.00167366 to 0.000941286 N m\n"},
                                      {"0.01", "at rest from -0.0116737 to 0.0109413 N m\n"}})
    CHECK(printed(folder, {"statics", "s.toml", "--set", std::string("effect.worm_coulomb.torque_Nm=") + coulomb})
              .ends_with(std::string("  start    with all effects, at the initial angle (load 0.02 N m): ") + told));
  CHECK(printed(folder, {"steady", "s.toml"}).find("  load     0.02 N m, at the initial angle and time 0\n") !=
        std::string::npos);
}

TEST_CASE("JSON is valid whatever bytes a file name has") {
  const Folder folder;
  const json said = json::parse(printed(folder, {"run", fig9, "--json", "-o", "\xff.h5"}));
  CHECK(said.at("output") == "\xEF\xBF\xBD.h5");
  CHECK(folder.names() == std::set<std::string>{"\xff.h5"});
}

TEST_CASE("the option --quiet prints nothing") {
  const Folder folder;
  for (const std::vector<std::string>& words : {std::vector<std::string>{"run", fig9, "-q"},
                                                {"run", fig9, "--quiet", "--audit"},
                                                {"check", fig9, "-q"},
                                                {"statics", fig9, "-q", "-o", "a.h5"},
                                                {"steady", fig9, "-q", "-o", "b.h5"},
                                                {"statics", fig9, "-q"}})
    CHECK(printed(folder, words) == nothing);
  CHECK(folder.names() == std::set<std::string>{"a.h5", "b.h5", "fig09_switching.h5"});
}

TEST_CASE("a result is named after its scenario and written to the current folder") {
  const Folder folder;
  std::filesystem::create_directory(folder / "scenarios");
  folder.write("scenarios/my arm.toml", good_scenario);
  printed(folder, {"run", "scenarios/my arm.toml"});
  printed(folder, {"run", "my arm.h5"});
  CHECK(folder.names() == std::set<std::string>{"my arm.h5", "my arm_again.h5", "scenarios"});
  CHECK(read_text_attribute(open_hdf5(folder / "my arm.h5"), "command_line") ==
        "wormdrive run 'scenarios/my arm.toml'");
}

TEST_CASE("the terminal names the file, the events and how to see them") {
  const Folder folder;
  const std::string out = printed(folder, {"run", fig9, "--audit"});
  for (const std::string words :
       {"Fig. 9: engagement switching under a sinusoidal motor torque\n",
        "  regime   gear self-locking; C1 -0.0471, C2 0.0837, H 3.4957; eq. 17 holds by a factor of 43.6\n",
        "  warning  geometry does not close: lg/(lw tan lambda) = 58.50 but ratio = 60; lead_angle_deg = 3.9005 would "
        "close it\n",
        " evaluations, 12 events: 1 break-away, 6 flank changes, 5 reversals\n", "12 guard events, 0 missed",
        "  wrote    fig09_switching.h5    see it: wormdrive plot fig09_switching.h5\n"}) {
    INFO(words << "\n" << out);
    CHECK(out.find(words) != std::string::npos);
  }
}

TEST_CASE("overrides reach nested keys, elements of arrays and new tables") {
  const Folder folder;
  const std::string arm = shipped("measured_worm_drive.toml");
  const json p =
      run_with(folder,
               {"mesh.friction=0.13", "motor.torque[2].torque_Nm=0.5",
                "effect.worm_viscous.coefficient_Nms_per_rad=2e-5", "effect.gear_viscous.coefficient_Nms_per_rad=3e-5",
                "initial.gear_angle_deg=90", "run.duration_s = 2", "effect.gear_coulomb.on=false"},
               arm);
  CHECK(p.at("mesh.friction").at("value") == 0.13);
  CHECK(p.at("motor.torque[2].torque_Nm").at("value") == 0.5);
  CHECK(p.at("motor.torque[1].torque_Nm").at("value") == 0.0022);
  CHECK(p.at("effect.worm_viscous.coefficient_Nms_per_rad").at("value") == 2e-5);
  CHECK(p.at("effect.gear_viscous.coefficient_Nms_per_rad").at("value") == 3e-5);
  CHECK(p.at("run.duration_s").at("value") == 2.0);
  CHECK(std::abs(p.at("initial.gear_angle_rad").at("value").get<double>() - std::acos(0.0)) <= 1e-15);
  CHECK(!p.contains("effect.gear_coulomb.torque_Nm"));
}

TEST_CASE("a run names the solver of the scenario and counts its evaluations") {
  const Folder folder;
  const std::string text = printed(folder, {"run", fig9, "--set", "run.solver=taylor"});
  CHECK(text.find("2 s with taylor (rtol 1e-12)") != std::string::npos);
  CHECK(text.find("12 events: 1 break-away, 6 flank changes, 5 reversals") != std::string::npos);
}

TEST_CASE("overrides take words without quotes, quotes, arrays and elements of arrays of numbers") {
  const Folder folder;
  const auto scenario = [&](const std::vector<std::string>& words) {
    std::vector<std::string> all{"check", fig9, "--json"};
    for (const std::string& word : words) all.insert(all.end(), {"--set", word});
    return json::parse(printed(folder, all)).at("scenario").get<std::string>();
  };
  const auto has = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  CHECK(has(scenario({"run.method=adams"}), "method = 'adams'\n"));
  CHECK(has(scenario({"title=it's \"quoted\" = #1"}), R"(title = "it's \"quoted\" = #1")"));
  CHECK(has(scenario({"title=3 turns"}), "title = '3 turns'\n"));
  CHECK(has(scenario({"load.kind=constant", "load.torque_Nm=2", "run.duration_s=3"}), "duration_s = 3.0\n"));
  CHECK(has(scenario({"motor.torque={kind = \"samples\", times_s = [0, 1, 2], torques_Nm = [1, 2, 3]}",
                      "motor.torque.torques_Nm[1]=-0.5"}),
            "torques_Nm = [1.0, -0.5, 3.0]\n"));
  CHECK(has(scenario({"mesh.friction=0.1", "mesh.friction=0.2"}), "friction = 0.2\n"));  // the last one counts
}

TEST_CASE("list prints effects, torques, loads and scenarios") {
  const Folder folder;
  for (const auto& [what, words] :
       {std::pair<std::string, std::vector<std::string>>{
            "effects", {"worm_coulomb", "worm_viscous", "gear_coulomb", "gear_viscous", "coefficient_Nms_per_rad"}},
        {"torques", {"constant", "sinusoid", "ramp", "step", "staircase", "samples", "amplitude_Nm", "rate_Nm_per_s"}},
        {"loads", {"gravity_arm", "angle_table", "mass_kg", "angles_deg"}},
        {"scenarios",
         {"fig09_switching.toml", "Fig. 9: engagement switching under a sinusoidal motor torque",
          "measured_worm_drive.toml"}}}) {
    const std::string out = printed(folder, {"list", what});
    for (const std::string& word : words) {
      INFO(word << " in\n" << out);
      CHECK(out.find(word) != std::string::npos);
    }
  }
}

TEST_CASE("help and version end with exit code 0") {
  const Folder folder;
  CHECK(printed(folder, {"--version"}).starts_with("wormdrive 0."));
  for (const std::string command : {"run", "check", "statics", "steady", "plot", "list"}) {
    CHECK(printed(folder, {"--help"}).find("  " + command + " ") != std::string::npos);
    CHECK(printed(folder, {command, "--help"}).find("--help") != std::string::npos);
  }
  CHECK(folder.names().empty());
}

TEST_CASE("help groups the commands by what the user wants to do") {
  const std::string help = printed(Folder(), {"--help"});
  INFO(help);
  CHECK(help.starts_with(
      "wormdrive: simulate, sweep and diagnose worm-gear drives\nUsage: wormdrive [OPTIONS] COMMAND\n"));
  std::size_t at = 0;
  for (const std::string words : {"\nDescribe a drive:\n  new ",
                                  "\n  list ",
                                  "\n  check ",
                                  "\n  schema ",
                                  "\nSimulate it:\n  run ",
                                  "\n  view ",
                                  "\n  statics ",
                                  "\n  steady ",
                                  "\n  fmu ",
                                  "\nLook at results:\n  plot ",
                                  "\n  report ",
                                  "\n  diff ",
                                  "\n  export ",
                                  "\nVary uncertain parameters:\n  sweep ",
                                  "\n  summary ",
                                  "\n  worst ",
                                  "\n  rare ",
                                  "\n  replay ",
                                  "\n  merge ",
                                  "\nExplain measured data:\n  diagnose ",
                                  "\nwormdrive COMMAND --help explains a command."}) {
    INFO(words);
    const std::size_t found = help.find(words, at);
    REQUIRE(found != std::string::npos);
    at = found;
  }
}

TEST_CASE("a full standard output ends with exit code 4") {
  const Folder folder;
  const Outcome outcome =
      Process({"/bin/sh", "-c", "'" WORMDRIVE_PROGRAM "' check '" + fig9 + "' --json > /dev/full"}, folder.path())
          .wait();
  CHECK(outcome.exit == 4);
  CHECK(outcome.err.find("No space left on device") != std::string::npos);
}

TEST_CASE("the index of an array with a single table may be omitted") {
  const Folder folder;
  printed(folder, {"run", fig9, "-q"});
  const json p = run_with(folder, {"motor.torque.amplitude_Nm=0.06"}, "fig09_switching.h5");
  CHECK(p.at("motor.torque.amplitude_Nm").at("value") == 0.06);
}

TEST_CASE("the result of a part that runs again is named after the run") {
  const Folder folder;
  printed(folder, {"run", fig9, "-q"});
  std::filesystem::rename(folder / "fig09_switching.h5", folder / "cut.h5.part");
  printed(folder, {"run", "cut.h5.part", "-q"});
  CHECK(std::filesystem::exists(folder / "cut_again.h5"));
}

TEST_CASE("several results share one picture: break-aways in the map of statics, runs over the motor torque",
          "[slow]") {
  const Folder folder;
  const std::string forward = shipped("fig08_ramp_07cm_forward.toml"),
                    backward = shipped("fig08_ramp_07cm_backward.toml");
  printed(folder, {"run", forward, "-q", "-o", "f.h5"});
  printed(folder, {"run", backward, "-q", "-o", "b.h5"});
  printed(folder, {"statics", forward, "-q", "-o", "s.h5"});
  CHECK(printed(folder, {"plot", "s.h5", "f.h5", "b.h5"}) == "  wrote    s.png\n");
  CHECK(std::filesystem::file_size(folder / "s.png") > 10000);
  printed(folder, {"plot", "f.h5", "b.h5", "--over", "motor_torque", "-o", "over.png"});
  CHECK(std::filesystem::file_size(folder / "over.png") > 10000);

  const Outcome alone = folder.run({"plot", "f.h5", "b.h5"});
  CHECK(alone.exit == 2);
  CHECK(alone.err == "plot: several runs need --over motor_torque, or a statics or sweep file first\n");
  const Outcome missing = folder.run({"plot", "no.h5", "f.h5", "neither.h5"});
  CHECK(missing.exit == 2);
  CHECK(missing.err ==
        "neither.h5: error: cannot be read: No such file or directory\n"
        "no.h5: error: cannot be read: No such file or directory\n");
}

}  // namespace wormdrive::test::cli_commands
