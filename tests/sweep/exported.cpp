// Trials and summary of a sweep as CSV.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "description/toml/csv.hpp"
#include "sweep/studies.hpp"

namespace wormdrive::test::sweep_exported {

TEST_CASE("exported trials are those of the sweep, bit for bit, with reasons of those that failed", "[sweep]") {
  const StudyFolder folder(study_but("distribution = \"truncated_normal\"\nmean = 0.25\ndeviation = 0.05\nlow = 0.1",
                                     "distribution = \"discrete\"\nvalues = [0.25, -0.1, 20]\nweights = [80, 10, 10]"));
  REQUIRE(folder.sweep({"-o", "o.h5", "--referee", "1"}).exit == 0);
  CHECK(folder.run({"export", "o.h5", "-o", "trials.csv"}).out == "  wrote    trials.csv    200 of 200 trials\n");
  const Csv csv = read_csv(folder / "trials.csv");
  CHECK(csv.names == std::vector<std::string>{"index", "status", "reason", "mesh.friction",
                                              "effect.worm_coulomb.torque_Nm", "break_away_events", "stop_events",
                                              "reversal_events", "flank_change_events", "final_gear_angle_rad",
                                              "final_gear_speed_rad_per_s"});
  CHECK(csv.numbers("effect.worm_coulomb.torque_Nm") == folder.column("o.h5", "effect.worm_coulomb.torque"));
  const std::vector<double> status = folder.column("o.h5", "status"), speed = folder.column("o.h5", "final_gear_speed");
  std::size_t refused = 0;
  for (std::size_t k = 0; k < status.size(); ++k) {
    const bool done = status[k] == 1.0;
    refused += !done;
    REQUIRE(csv.texts("status")[k] == (done ? "done" : "refused"));
    REQUIRE(csv.texts("reason")[k].empty() == done);
    REQUIRE(csv.texts("final_gear_speed_rad_per_s")[k] == (done ? fmt::format("{}", speed[k]) : ""));
  }
  CHECK(refused > 10);
  std::ifstream file(folder / "trials.csv");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  CHECK(folder.run({"export", "o.h5"}).out == text);
}

TEST_CASE("an exported summary has the numbers of the summary", "[sweep]") {
  const StudyFolder folder;
  REQUIRE(folder.sweep({"-o", "o.h5", "--referee", "1"}).exit == 0);
  CHECK(folder.run({"export", "o.h5", "--what", "summary", "-o", "s.csv"}).exit == 0);
  const Csv csv = read_csv(folder / "s.csv");
  const nlohmann::json json = nlohmann::json::parse(folder.run({"summary", "o.h5", "--json"}).out);
  const auto value = [&](const std::string& table, const std::string& name, const std::string& quantity,
                         const std::string& column = "value") {
    for (std::size_t k = 0; k < csv.texts("table").size(); ++k)
      if (csv.texts("table")[k] == table && csv.texts("name")[k] == name && csv.texts("quantity")[k] == quantity)
        return csv.texts(column)[k];
    return std::string("missing");
  };
  const nlohmann::json& speed = json["metrics"]["final_gear_speed"];
  CHECK(value("metrics", "final_gear_speed", "mean") == fmt::format("{}", speed["mean"].get<double>()));
  CHECK(value("metrics", "final_gear_speed", "mean", "low").empty());
  CHECK(value("metrics", "final_gear_speed", "mean", "unit") == "rad/s");
  CHECK(value("metrics", "final_gear_speed", "quantile_0.95", "high") ==
        fmt::format("{}", speed["quantiles"]["0.95"]["high"].get<double>()));
  CHECK(value("thresholds", "below -2.5", "share", "low") ==
        fmt::format("{}", json["thresholds"][0]["share"]["low"].get<double>()));
  CHECK(value("influences", "mesh.friction", "rank_correlation") != "missing");
  CHECK(value("trials", "", "done") == "200");
}

TEST_CASE("an export replaces an older one, and anything else only if forced", "[sweep]") {
  const StudyFolder folder(study_but("trials = 200", "trials = 10"));
  REQUIRE(folder.sweep({"-o", "o.h5", "--referee", "1"}).exit == 0);
  folder.write("notes.csv", "index,mine\n1,2\n");
  const Outcome refused = folder.run({"export", "o.h5", "-o", "notes.csv"});
  CHECK(refused.exit == 4);
  CHECK(refused.err.find("notes.csv: it exists and was not written by wormdrive") != std::string::npos);
  CHECK(folder.run({"export", "o.h5", "-o", "notes.csv", "--force"}).exit == 0);
  CHECK(folder.run({"export", "o.h5", "-o", "notes.csv"}).exit == 0);
  CHECK(folder.run({"export", "o.h5", "--what", "summary", "-o", "notes.csv"}).exit == 4);
  CHECK(folder.run({"export", "o.h5", "-o", "o.h5", "--force"}).exit == 2);
  CHECK(folder.run({"export", "s.toml"}).exit == 2);
  CHECK(folder.run({"export", "o.h5", "-o", "none/o.csv"}).exit == 4);
  CHECK_FALSE(folder.names().contains("notes.csv.part"));
}

}  // namespace wormdrive::test::sweep_exported
