// What `diff` says of two results of each kind: no table of numbers is left out, and no row is lost silently.
#include <limits>

#include "catch.hpp"
#include "cli/changed_results.hpp"
#include "diagnosis/break_in_data.hpp"
#include "output/hdf5/table.hpp"

namespace wormdrive::test::cli_diff {

namespace {

std::string data_of(const std::string& rows) { return "record,worm_speed_rad_per_s,motor_torque_Nm\n" + rows; }

}  // namespace

TEST_CASE("diff compares what was recorded at constant speed, record by record") {
  const ResultFolder folder;
  const auto steady = [&](const std::string& name, const std::string& rows) {
    folder.write("data.csv", data_of(rows));
    folder.make({"steady", "s.toml", "--data", "data.csv", "--max-speed", "20", "-q", "-o", name});
  };
  steady("a.h5", "down,-20,-0.01\nup,20,0.03\nup,20,0.05\n");
  steady("order.h5", "up,20,0.03\nup,20,0.05\ndown,-20,-0.01\n");
  steady("torque.h5", "down,-20,-0.01\nup,20,0.03\nup,20,0.06\n");
  steady("fewer.h5", "up,20,0.03\nup,20,0.05\n");
  folder.make({"steady", "s.toml", "--max-speed", "20", "-q", "-o", "alone.h5"});
  CHECK(folder.diff("a.h5", "order.h5").exit == 0);

  const Outcome torque = folder.diff("a.h5", "torque.h5");
  INFO(torque.out);
  CHECK(torque.exit == 1);
  CHECK(line_of(torque.out, "records/motor_torque").find(" 0.005 at up ") != std::string::npos);
  CHECK(line_of(torque.out, "records/motor_torque").ends_with("DIFFERS"));
  CHECK(line_of(torque.out, "rms_error").ends_with("DIFFERS"));
  CHECK_FALSE(line_of(torque.out, "model/motor_torque").ends_with("DIFFERS"));
  CHECK(torque.out.ends_with("the results differ: 0 events and 84 rows compared\n"));

  const Outcome fewer = folder.diff("a.h5", "fewer.h5");
  CHECK(fewer.exit == 1);
  CHECK(tells(fewer, "records: 1 row compared; 1 in a.h5 only, 0 in fewer.h5 only"));
  const Outcome alone = folder.diff("a.h5", "alone.h5");
  CHECK(alone.exit == 1);
  CHECK(tells(alone, "records: in a.h5 only"));
  CHECK(tells(alone, "rms_error: in a.h5 only"));
  check_every_column(folder, "a.h5", {"model", "records"});
}

TEST_CASE("diff counts the rows that only one result has: another load is a difference, another time is none") {
  const ResultFolder folder;
  folder.make({"statics", "s.toml", "--max-load", "1", "--points", "3", "-q", "-o", "one.h5"});
  folder.make({"statics", "s.toml", "--max-load", "7", "--points", "5", "-q", "-o", "seven.h5"});
  const Outcome statics = folder.diff("one.h5", "seven.h5");
  INFO(statics.out);
  CHECK(statics.exit == 1);
  CHECK(tells(statics, "statics: 1 row compared; 2 in one.h5 only, 4 in seven.h5 only"));
  CHECK(statics.out.ends_with("the results differ: 0 events and 1 rows compared\n"));
  folder.make({"steady", "s.toml", "--max-speed", "1", "--points", "1", "-q", "-o", "slow.h5"});
  folder.make({"steady", "s.toml", "--max-speed", "2", "--points", "1", "-q", "-o", "fast.h5"});
  const Outcome steady = folder.diff("slow.h5", "fast.h5");
  CHECK(steady.exit == 1);
  CHECK(tells(steady, "model: no worm_speed in common"));
  CHECK(tells(steady, "model: 0 rows compared; 2 in slow.h5 only, 2 in fast.h5 only"));

  folder.make({"run", "s.toml", "--set", "run.report_interval_s=0.001", "-q", "-o", "often.h5"});
  folder.make({"run", "s.toml", "--set", "run.report_interval_s=0.002", "-q", "-o", "seldom.h5"});
  const Outcome runs = folder.diff("often.h5", "seldom.h5");
  INFO(runs.out);
  CHECK(runs.exit == 0);
  CHECK(tells(runs, "note: trajectory: 6 rows compared; 5 in often.h5 only, 0 in seldom.h5 only"));
  CHECK(runs.out.ends_with("the results agree: 0 events and 6 rows compared\n"));
  const auto json = nlohmann::json::parse(folder.diff("often.h5", "seldom.h5", {"--json"}).out);
  CHECK(json.at("tables") ==
        nlohmann::json::parse(R"([{"table": "trajectory", "rows": 6, "first_only": 5, "second_only": 0}])"));
  CHECK(json.at("notes").size() == 1);
  CHECK(json.at("faults").empty());
  CHECK(folder.diff("often.h5", "often.h5").out.find("note") == std::string::npos);
}

TEST_CASE("diff compares an efficiency over worm speed and load torque") {
  const ResultFolder folder;
  const auto efficiency = [&](const std::string& name, const std::vector<std::string>& options) {
    std::vector<std::string> words{"efficiency", "s.toml", "--max-speed", "10", "--max-load", "1", "-q", "-o", name};
    words.insert(words.end(), options.begin(), options.end());
    folder.make(words);
  };
  efficiency("a.h5", {"--points", "2"});
  efficiency("other.h5", {"--points", "2", "--set", "mesh.friction=0.2"});
  efficiency("finer.h5", {"--points", "3"});
  const Outcome same = folder.diff("a.h5", "a.h5");
  CHECK(same.exit == 0);
  CHECK(same.out.ends_with("the results agree: 0 events and 16 rows compared\n"));
  const Outcome other = folder.diff("a.h5", "other.h5");
  CHECK(other.exit == 1);
  CHECK(line_of(other.out, "efficiency/motor_torque").ends_with("DIFFERS"));
  const Outcome finer = folder.diff("a.h5", "finer.h5");
  CHECK(finer.exit == 1);
  CHECK(tells(finer, "efficiency: 4 rows compared; 12 in a.h5 only, 32 in finer.h5 only"));

  // a row in the middle, told by both of its columns
  folder.copy("a.h5", "changed.h5");
  folder.change("changed.h5", "efficiency/loss", 5, std::numeric_limits<double>::quiet_NaN());
  const nlohmann::json loss = signal_in(folder.diff("a.h5", "changed.h5", {"--json"}), "efficiency/loss");
  CHECK(loss.at("differs") == true);
  CHECK(loss.at("at") == nlohmann::json{folder.value("a.h5", "efficiency/worm_speed", 5),
                                        folder.value("a.h5", "efficiency/load_torque", 5)});
  check_every_column(folder, "a.h5", {"efficiency"});
}

TEST_CASE("diff compares the tables of a diagnosis, their texts too") {
  const ResultFolder folder;
  folder.write("b.csv", break_in_csv(0.25, 0.03, 3));
  folder.write("other.csv", break_in_csv(0.25, 0.03, 4));
  for (const std::string data : {"b", "other"})
    folder.make({"diagnose", shipped("fig07_break_in_07cm_forward.toml"), data + ".csv", "--set", "mesh.friction=0.2",
                 "-o", data, "-q", "--no-pictures"});
  folder.copy("b/diagnosis.h5", "a.h5");
  folder.copy("a.h5", "changed.h5");
  const Outcome same = folder.diff("a.h5", "changed.h5", {"--relative", "0"});
  INFO(same.out << same.err);
  CHECK(same.exit == 0);
  const Outcome other = folder.diff("a.h5", "other/diagnosis.h5");
  CHECK(other.exit == 1);
  CHECK(line_of(other.out, "residual/before").ends_with("DIFFERS"));
  CHECK(line_of(other.out, "torques/measured").ends_with("DIFFERS"));

  folder.change_attribute("changed.h5", "/", "sentence", std::string("all is well"));
  const Outcome sentence = folder.diff("a.h5", "changed.h5");
  CHECK(sentence.exit == 1);
  CHECK(sentence.out.find("' in the first result, 'all is well' in the second\n") != std::string::npos);
  folder.copy("a.h5", "changed.h5");
  {
    const Hdf5Handle file = reopen_hdf5(folder / "changed.h5"), ranking = open_object(file, "ranking");
    std::vector<std::string> outcomes(read_column(file, "ranking/delta_bic").size(), "another outcome");
    check_hdf5(H5Ldelete(ranking, "outcome", H5P_DEFAULT), "cannot change");
    write_texts(ranking, "outcome", "named, or why not", outcomes);
  }
  const Outcome texts = folder.diff("a.h5", "changed.h5");
  CHECK(texts.exit == 1);
  CHECK(texts.out.find(" in the first result, 'another outcome' in the second\n") != std::string::npos);
  check_every_column(folder, "a.h5", {"residual", "torques", "prediction", "ranking", "certificate"});
}

TEST_CASE("diff compares what happens at an event, and what a controller achieves") {
  const ResultFolder folder;
  folder.make({"run", shipped("fig10_sliding_014rad_bare.toml"), "--set", "run.duration_s=0.1", "--set",
               "metrics.from_s=0", "-q", "-o", "a.h5"});
  REQUIRE_FALSE(read_column(open_hdf5(folder / "a.h5"), "events/time").empty());
  CHECK(folder.diff("a.h5", "a.h5", {"--relative", "0", "--time", "0"}).exit == 0);
  folder.copy("a.h5", "changed.h5");
  const double torque = folder.value("a.h5", "events/motor_torque_after", 0);
  folder.change("changed.h5", "events/motor_torque_after", 0, torque + 1.0);
  const Outcome event = folder.diff("a.h5", "changed.h5");
  CHECK(event.exit == 1);
  CHECK(line_of(event.out, "events/motor_torque_after").ends_with("DIFFERS"));
  folder.copy("a.h5", "changed.h5");
  folder.change_attribute("changed.h5", "controller", "error_rms", 1.0);
  const Outcome metric = folder.diff("a.h5", "changed.h5");
  CHECK(metric.exit == 1);
  CHECK(line_of(metric.out, "error_rms of controller").find(" at - ") != std::string::npos);
  CHECK(line_of(metric.out, "error_rms of controller").ends_with("DIFFERS"));
}

TEST_CASE("results of different kinds are not compared") {
  const ResultFolder folder;
  folder.make({"run", "s.toml", "-q", "-o", "run.h5"});
  folder.make({"statics", "s.toml", "-q", "-o", "statics.h5"});
  const Outcome kinds = folder.diff("run.h5", "statics.h5");
  CHECK(kinds.exit == 2);
  CHECK(kinds.out.empty());
  CHECK(kinds.err ==
        "statics.h5: error: it is a result of 'statics', but run.h5 is one of 'run'; diff compares results of one "
        "kind\n");
}

}  // namespace wormdrive::test::cli_diff
