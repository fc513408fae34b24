// Parameters that are drawn together, by rows of a CSV file.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <utility>

#include "catch.hpp"
#include "sweep/studies.hpp"

namespace wormdrive::test::sweep_rows_of_files {

namespace {

const std::string study = R"(title = "Rows"
scenario = "s.toml"
set = ["run.solver=taylor", "run.duration_s=0.02"]
metrics = ["final_gear_angle"]
[sweep]
design = "latin_hypercube"
trials = 8
seed = 4
[[parameter]]
path = "mesh.friction"
distribution = "row"
file = "draws.csv"
[[parameter]]
path = "load.torque_Nm"
distribution = "uniform"
low = 0.1
high = 0.3
[[parameter]]
path = "effect.worm_coulomb.torque_Nm"
distribution = "row"
file = "./draws.csv"
column = "bearing"
[[threshold]]
metric = "final_gear_angle"
above_rad = 0
)";
const std::string rows_alone =
    edited(study, "[[parameter]]\npath = \"load.torque_Nm\"\ndistribution = \"uniform\"\nlow = 0.1\nhigh = 0.3\n", "");
const std::string draws = "bearing,mesh.friction\n0.001,0.3\n0.004,0.25\n0.002,0.2\n0.003,0.3\n";

using Pair = std::pair<double, double>;

std::vector<Pair> drawn(const StudyFolder& folder, const std::string& file) {
  const std::vector<double> friction = folder.column(file, "mesh.friction"),
                            torque = folder.column(file, "effect.worm_coulomb.torque");
  std::vector<Pair> pairs;
  for (std::size_t k = 0; k < friction.size(); ++k) pairs.emplace_back(friction[k], torque[k]);
  return pairs;
}

}  // namespace

TEST_CASE("parameters of one file have the values of one row, in every design that draws", "[sweep]") {
  const std::set<Pair> rows{{0.3, 0.001}, {0.25, 0.004}, {0.2, 0.002}, {0.3, 0.003}};
  for (const std::string design : {"latin_hypercube", "monte_carlo", "sobol"}) {
    const StudyFolder folder(edited(rows_alone, "latin_hypercube\"\ntrials = 8", design + "\"\ntrials = 200"));
    folder.write("draws.csv", draws);
    const Outcome outcome = folder.sweep({"-o", "o.h5"});
    INFO(design << outcome.out << outcome.err);
    REQUIRE(outcome.exit == 0);
    const std::vector<Pair> pairs = drawn(folder, "o.h5");
    REQUIRE(pairs.size() == 200);
    for (const Pair& row : rows) {
      const auto times = std::count(pairs.begin(), pairs.end(), row);
      INFO(row.first << ' ' << row.second << ": " << times);
      if (design == "monte_carlo")
        CHECK(std::abs(static_cast<double>(times) - 50.0) < 5.0 * std::sqrt(200.0 * 0.25 * 0.75));
      else
        CHECK(times == 50);
    }
    const Outcome summary = folder.run({"summary", "o.h5"});
    CHECK(summary.out.find("interval") != std::string::npos);  // a sample, unlike a table
    std::filesystem::remove(folder / "draws.csv");
    CHECK(folder.run({"replay", "o.h5", "--trial", "3", "-o", "r.h5"}).exit == 0);
  }
}

TEST_CASE("what is drawn beside the rows of a file is independent of them", "[sweep]") {
  const StudyFolder folder(edited(study, "trials = 8", "trials = 400"));
  folder.write("draws.csv", draws);
  const Outcome outcome = folder.sweep({"-o", "o.h5"});
  INFO(outcome.out << outcome.err);
  REQUIRE(outcome.exit == 0);
  const std::vector<double> load = folder.column("o.h5", "load.torque"),
                            friction = folder.column("o.h5", "mesh.friction");
  double sum = 0.0;
  for (std::size_t k = 0; k < load.size(); ++k) sum += (load[k] - 0.2) / 0.0577 * (friction[k] - 0.2625) / 0.0415;
  CHECK(std::abs(sum / 400.0) < 4.0 / std::sqrt(400.0));
}

TEST_CASE("what rows of a file cannot be asked for is rejected", "[sweep]") {
  const std::vector<BadStudy> cases{
      {"\"latin_hypercube\"\ntrials = 8", "\"grid\"",
       "study.toml:6:10: error: sweep.design = \"grid\" needs parameters that can change one by one, but "
       "'mesh.friction' "
       "is drawn by rows of a file; use \"monte_carlo\", \"latin_hypercube\" or \"sobol\""},
      {"\"latin_hypercube\"\ntrials = 8", "\"shapley\"\npermutations = 8",
       "study.toml:6:10: error: sweep.design = \"shapley\" needs parameters that can change one by one, but "
       "'mesh.friction' is drawn by rows of a file; use \"monte_carlo\", \"latin_hypercube\" or \"sobol\""},
      {"[[threshold]]",
       "[[correlation]]\nbetween = [\"mesh.friction\", \"load.torque_Nm\"]\ncoefficient = 0.5\n"
       "[[threshold]]",
       "study.toml:24:11: error: correlation[0].between names 'mesh.friction', which is drawn by rows of a file; the "
       "rows have its correlations"},
      {"column = \"bearing\"", "column = \"bearings\"",
       "./draws.csv:1: error: no column 'bearings'; the header line names bearing, mesh.friction (parameter[2].file at "
       "study.toml:21:8)"},
      {"file = \"./draws.csv\"\ncolumn", "column",
       "study.toml:18:1: error: parameter[2] lacks 'file' (a CSV file, relative to the folder of the study)"},
      {"[[threshold]]", "[data.\"./draws.csv\"]\nbearing = [0.001, 0.002]\n[[threshold]]",
       "study.toml:21:8: error: parameter[2].file = \"./draws.csv\": column 'bearing' has 2 rows but another one has "
       "4; "
       "remove [data] to have the file read again"}};
  check_rejected(study, cases, {"draws.csv", draws});

  const StudyFolder folder(rows_alone);
  folder.write("draws.csv", draws);
  REQUIRE(folder.sweep({"-o", "o.h5"}).exit == 0);
  CHECK(folder.run({"worst", "o.h5", "-o", "w.h5"}).err ==
        "o.h5: error: draws 'mesh.friction' by rows of a file, between which there is nothing to search; sweep a study "
        "with distributions\n");
  CHECK(folder.run({"rare", "study.toml", "-o", "rare.h5"}).err ==
        "study.toml: error: draws 'mesh.friction' by rows of a file, between which there is nothing to search; an "
        "estimate of rare misses needs distributions\n");
}

}  // namespace wormdrive::test::sweep_rows_of_files
