// The page that `wormdrive report` writes, without a browser.
#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "cli/bad_input.hpp"
#include "diagnosis/break_in_data.hpp"
#include "numbers.hpp"
#include "output/hdf5/hdf5.hpp"

namespace wormdrive::test::cli_report {

namespace {

/// The data in a page.
nlohmann::json data_in(const std::string& page) {
  const std::string begin = "<script type=\"application/json\" id=\"data\">";
  const std::size_t at = page.find(begin) + begin.size();
  return nlohmann::json::parse(page.substr(at, page.find("</script>", at) - at));
}

/// A table of a page by its title.
nlohmann::json table_in(const nlohmann::json& data, const std::string& title) {
  for (const nlohmann::json& table : data.at("tables"))
    if (table.at("title") == title) return table;
  FAIL("no table '" << title << "'");
  return {};
}

/// Of s.toml, with a lower limit of the speed at the end [rad/s].
std::string study_of_friction(const std::string& limit) {
  return "title = \"Friction\"\nscenario = \"s.toml\"\n[sweep]\ndesign = \"monte_carlo\"\ntrials = 60\nseed = 1\n"
         "[[parameter]]\npath = \"mesh.friction\"\ndistribution = \"uniform\"\nlow = 0.1\nhigh = 0.3\n"
         "[[threshold]]\nmetric = \"final_gear_speed\"\nbelow_rad_per_s = " +
         limit + "\n";
}

constexpr double digits_of_a_page = 1e-6;

}  // namespace

TEST_CASE("a report contains its run and loads nothing from elsewhere") {
  const Folder folder;
  REQUIRE(folder.run({"run", shipped("fig09_switching.toml"), "-q", "--set", "title=\"</script> & <b>\""}).exit == 0);
  REQUIRE(folder.run({"report", "fig09_switching.h5"}).exit == 0);
  const std::string page = folder.read("fig09_switching.html");
  CHECK(folder.names() == std::set<std::string>{"fig09_switching.h5", "fig09_switching.html"});
  CHECK(page.size() < 1'000'000);
  for (const std::string loads : {"<script src", "<link", "<img", "url(http"})
    CHECK(page.find(loads) == std::string::npos);
  CHECK(page.find("<title>&lt;/script&gt; &amp; &lt;b&gt;</title>") != std::string::npos);
  CHECK(page.find("Copyright (c) 2006, 2009, 2011, 2012, 2013, 2017") != std::string::npos);  // of dygraphs
  for (const std::string mark : {"{{page", "{{data", "{{dygraphs", "{{title"})
    CHECK(page.find(mark) == std::string::npos);
  const nlohmann::json data = data_in(page), group = data.at("groups").at(0);
  CHECK(data.at("title") == "</script> & <b>");
  CHECK(data.at("remarks").size() == 1);
  REQUIRE(group.at("events").size() == 12);
  CHECK(group.at("events")[0].at("what") == "break away");
  CHECK(group.at("events")[0].at("before") == "stuck");
  CHECK(group.at("panels").size() == 5);
  for (const nlohmann::json& panel : group.at("panels")) CHECK(panel.at("over").size() == panel.at("rows"));
  CHECK(group.at("bands").at(0).at(2) == "stuck");
  CHECK(table_in(data, "Parameters").at("rows").size() > 10);
}

TEST_CASE("a long run is thinned without losing an extreme") {
  const Folder folder;
  REQUIRE(folder
              .run({"run", shipped("fig09_switching.toml"), "-q", "-o", "a.h5", "--set", "run.report_interval_s=2e-5",
                    "--set", "run.solver=taylor"})
              .exit == 0);
  REQUIRE(folder.run({"report", "a.h5"}).exit == 0);
  const Hdf5Handle file = open_hdf5(folder / "a.h5");
  const nlohmann::json data = data_in(folder.read("a.html"));
  for (const nlohmann::json& panel : data.at("groups").at(0).at("panels")) {
    CHECK(panel.at("rows").get<int>() > 100000);
    CHECK(panel.at("over").size() < 9000);
    for (const nlohmann::json& series : panel.at("series")) {
      const std::vector<double> all = read_column(file, "trajectory/" + series.at("name").get<std::string>());
      const auto shown = series.at("values").get<std::vector<double>>();
      INFO(series.at("name"));
      CHECK(std::abs(*std::max_element(shown.begin(), shown.end()) - *std::max_element(all.begin(), all.end())) < 1e-6);
      CHECK(std::abs(*std::min_element(shown.begin(), shown.end()) - *std::min_element(all.begin(), all.end())) < 1e-6);
    }
  }
}

TEST_CASE("a report of statics shows the region of rest") {
  const Folder folder;
  REQUIRE(folder.run({"statics", shipped("fig07_break_in_07cm_forward.toml"), "-q", "-o", "map.h5"}).exit == 0);
  REQUIRE(folder.run({"report", "map.h5", "-o", "map.html"}).exit == 0);
  const nlohmann::json data = data_in(folder.read("map.html")), panel = data.at("groups").at(0).at("panels").at(0);
  CHECK(panel.at("filled") == true);
  CHECK(panel.at("series").size() == 3);
  CHECK(table_in(data, "Break-in torques").at("rows").size() == 11);
}

TEST_CASE("a report of steady motion shows the model and the measurements") {
  const Folder folder;
  folder.write("s.toml", good_scenario);
  REQUIRE(folder.run({"steady", "s.toml", "-q", "-o", "curve.h5"}).exit == 0);
  REQUIRE(folder.run({"report", "curve.h5"}).exit == 0);
  const nlohmann::json alone = data_in(folder.read("curve.html")).at("groups").at(0);
  CHECK(alone.at("units") == "rad/s");
  CHECK(alone.at("panels").size() == 1);
  const auto speed = alone.at("panels")[0].at("over").get<std::vector<double>>();
  CHECK(std::is_sorted(speed.begin(), speed.end()));
  const std::size_t still = static_cast<std::size_t>(std::find(speed.begin(), speed.end(), 0.0) - speed.begin());
  REQUIRE(still < speed.size());
  CHECK(alone.at("panels")[0].at("series")[0].at("values")[still].is_null());

  std::string csv = "record,worm_speed_rad_per_s,motor_torque_Nm\n";
  for (const std::string row : {"down,-20,-0.01\n", "up,20,0.03\n", "up,20,0.05\n"}) csv += row;
  folder.write("data.csv", csv);
  const Outcome steady = folder.run({"steady", "s.toml", "--data", "data.csv", "-q", "-o", "both.h5"});
  INFO(steady.err);
  REQUIRE(steady.exit == 0);
  REQUIRE(folder.run({"report", "both.h5"}).exit == 0);
  const nlohmann::json data = data_in(folder.read("both.html")), records = table_in(data, "Records").at("rows");
  REQUIRE(records.size() == 2);
  CHECK(records[0][0] == "down");
  CHECK(records[1][2].get<double>() == Catch::Approx(0.04));
  CHECK(records[1][4].get<double>() == Catch::Approx(0.04 - records[1][3].get<double>()));
  CHECK(data.at("verdict").get<std::string>().starts_with("The model differs from the mean torques of 2 records ("));
  CHECK(data.at("groups")[0].at("panels").size() == 2);
  const nlohmann::json panel = data.at("groups")[0].at("panels")[0];
  const auto over = panel.at("over").get<std::vector<double>>();
  const std::size_t up = static_cast<std::size_t>(std::find(over.begin(), over.end(), 20.0) - over.begin());
  REQUIRE(up < over.size());
  CHECK(panel.at("series")[0].at("values")[up].get<double>() == Catch::Approx(0.04));
}

TEST_CASE("a report of a run with many events says how many it leaves out") {
  const Folder folder;
  REQUIRE(
      folder
          .run({"run", shipped("fig09_switching.toml"), "-q", "-o", "a.h5", "--set", "motor.torque.frequency_Hz=900",
                "--set", "motor.torque.amplitude_Nm=5", "--set", "run.solver=taylor"})
          .exit == 0);
  REQUIRE(folder.run({"report", "a.h5"}).exit == 0);
  const nlohmann::json data = data_in(folder.read("a.html")), group = data.at("groups").at(0);
  const std::size_t all = read_column(open_hdf5(folder / "a.h5"), "events/time").size();
  REQUIRE(all > 2000);
  CHECK(group.at("events").size() == 2000);
  CHECK(group.at("all_events") == all);
  CHECK(data.at("summary").get<std::string>().ends_with(" (the first 2000 are shown)"));
}

TEST_CASE("a report of a sweep shows spread, influence and the worst drives") {
  const Folder folder;
  folder.write("s.toml", good_scenario);
  folder.write("study.toml", study_of_friction("-0.1"));
  const Outcome sweep = folder.run({"sweep", "study.toml", "-q", "-o", "sweep.h5"});
  INFO(sweep.err);
  REQUIRE(sweep.exit == 0);
  REQUIRE(folder.run({"report", "sweep.h5"}).exit == 0);
  const nlohmann::json data = data_in(folder.read("sweep.html"));
  const nlohmann::json& groups = data.at("groups");
  REQUIRE(groups.size() == 2);
  const nlohmann::json spread = groups[0].at("panels")[0], cloud = groups[1].at("panels")[0];
  CHECK(spread.at("series")[0].at("name") == "final_gear_speed");
  CHECK(spread.at("over").size() == 60);
  CHECK(spread.at("limits").at(0) == -0.1);
  const auto values = spread.at("series")[0].at("values").get<std::vector<double>>();
  CHECK(std::is_sorted(values.begin(), values.end()));
  CHECK(groups[1].at("over") == "mesh.friction");
  CHECK(cloud.at("series").size() == 3);
  CHECK(table_in(data, "Worst drives").at("rows").size() == 10);
  CHECK(data.at("verdict").get<std::string>().find(" of 60 drives have final gear speed below -0.1 rad/s (") !=
        std::string::npos);
}

TEST_CASE("a report of an estimate of rare misses shows both estimates, the levels and the likely drive") {
  const Folder folder;
  folder.write("s.toml", good_scenario);
  folder.write("study.toml", study_of_friction("-0.3165"));
  const Outcome rare =
      folder.run({"rare", "study.toml", "-o", "rare.h5", "--per-level", "200", "--samples", "200", "--json"});
  INFO(rare.err);
  REQUIRE(rare.exit == 0);
  const nlohmann::json made = nlohmann::json::parse(rare.out);
  REQUIRE(folder.run({"report", "rare.h5"}).exit == 0);
  const nlohmann::json data = data_in(folder.read("rare.html"));
  CHECK(data.at("verdict").get<std::string>().starts_with(
      "A drive has final gear speed below -0.3165 rad/s with probability "));
  const nlohmann::json estimates = table_in(data, "Estimates").at("rows"), panel = data.at("groups")[0].at("panels")[0];
  REQUIRE(estimates.size() == 2);
  CHECK(close(estimates[0][1], made.at("subset_simulation").at("probability"), digits_of_a_page));
  CHECK(close(estimates[1][1], made.at("importance_sampling").at("probability"), digits_of_a_page));
  CHECK(table_in(data, "Estimates").at("note") == "Check: the two intervals overlap.");
  CHECK(made.at("agrees") == true);
  CHECK(table_in(data, "Levels of the subset simulation").at("rows").size() == made.at("levels").size());
  CHECK(close(table_in(data, "The drive that misses most likely").at("rows")[0][1],
              made.at("design_point").at("mesh.friction").at("value"), digits_of_a_page));
  REQUIRE(panel.at("over").size() == made.at("levels").size());
  const double probability = made.at("subset_simulation").at("probability"),
               low = made.at("subset_simulation").at("low");
  CHECK(close(panel.at("series")[2].at("values")[0], std::log10(probability), digits_of_a_page));
  CHECK(close(panel.at("series")[0].at("values")[0], std::log10(low), digits_of_a_page));
  {
    const Hdf5Handle file = reopen_hdf5(folder / "rare.h5");
    const double runs[] = {-1.0, 1.0};
    H5Dwrite(open_object(file, "estimates/runs"), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, runs);
  }
  const Outcome damaged = folder.run({"report", "rare.h5"});
  CHECK(damaged.exit == 2);
  CHECK(damaged.err == "rare.h5: error: its column 'estimates/runs' contains -1\n");
  {
    const Hdf5Handle file = reopen_hdf5(folder / "rare.h5");
    H5Ldelete(file, "estimates", H5P_DEFAULT);
  }
  REQUIRE(folder.run({"report", "rare.h5"}).exit == 0);
  CHECK(data_in(folder.read("rare.html")).at("verdict") ==
        "The estimate is not complete; continue it with wormdrive rare --resume.");
}

TEST_CASE("a report of a diagnosis has the verdict and its evidence", "[slow]") {
  const Folder folder;
  folder.write("b.csv", break_in_csv(0.25, 0.03, 3));
  REQUIRE(folder
              .run({"diagnose", shipped("fig07_break_in_07cm_forward.toml"), "b.csv", "--set", "mesh.friction=0.2",
                    "-o", "out", "-q", "--no-pictures"})
              .exit == 0);
  REQUIRE(folder.run({"report", "out"}).exit == 0);
  const nlohmann::json data = data_in(folder.read("out/report.html"));
  const nlohmann::json findings = nlohmann::json::parse(folder.read("out/diagnosis.json"));
  CHECK(data.at("verdict") == findings.at("sentence"));
  CHECK(data.at("summary").get<std::string>().starts_with("Diagnosis of a break-in table, b.csv. Verdict " +
                                                          findings.at("verdict").get<std::string>() + ": "));
  CHECK(table_in(data, "Evidence: every effect that was examined").at("rows").size() == findings.at("ranking").size());
  CHECK(table_in(data, "What these data can show").at("rows").size() == findings.at("certificate").size());
  CHECK(data.at("groups")[0].at("panels")[0].at("series").size() == 3);
  std::filesystem::remove(folder / "out/diagnosis.json");
  const Outcome alone = folder.run({"report", "out"});
  CHECK(alone.exit == 2);
  CHECK(alone.err == "out/diagnosis.json: error: cannot be read; wormdrive diagnose writes it next to diagnosis.h5\n");
}

TEST_CASE("files that are not results, or damaged ones, get no report") {
  const Folder folder;
  folder.write("s.toml", good_scenario);
  write_attribute(create_hdf5(folder / "other.h5"), "kind", "something");
  check_rejected(
      folder,
      {{"a result of another kind",
        "",
        "other.h5: error: its kind 'something' is none of run, statics, steady, efficiency, sweep, rare and diagnosis",
        {"report", "other.h5"},
        true},
       {"a scenario", "", "s.toml: error: not an HDF5 file; wormdrive run writes one", {"report", "s.toml"}, true},
       {"nothing", "", "no.h5: error: cannot be read: No such file or directory", {"report", "no.h5"}, true},
       {"a folder of something else",
        "",
        ".: error: contains no diagnosis.h5; wormdrive diagnose -o writes one",
        {"report", "."},
        true}});
}

}  // namespace wormdrive::test::cli_report
