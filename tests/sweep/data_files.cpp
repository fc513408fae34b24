// CSV files that a study names: what they give, what is said about bad ones, and that a sweep no longer needs them.
#include <filesystem>

#include "catch.hpp"
#include "sweep/studies.hpp"

namespace wormdrive::test::sweep_data_files {

namespace {

const std::string empirical_study =
    study_but("distribution = \"truncated_normal\"\nmean = 0.25\ndeviation = 0.05\nlow = 0.1",
              "distribution = \"empirical\"\nfile = \"measured.csv\"\ncolumn = \"friction\"");

}  // namespace

TEST_CASE("an empirical distribution is a column of a CSV file, and the sweep keeps it", "[sweep]") {
  const StudyFolder folder(edited(empirical_study, "\"monte_carlo\"\ntrials = 200", "\"latin_hypercube\"\ntrials = 8"));
  folder.write("measured.csv", "sample,friction\n1,0.3\n2,0.2\n3,0.25\n4,0.21\n");
  const Outcome outcome = folder.sweep({"-o", "o.h5", "--referee", "1"});
  INFO(outcome.out << outcome.err);
  REQUIRE(outcome.exit == 0);
  std::vector<double> friction = folder.column("o.h5", "mesh.friction");
  std::sort(friction.begin(), friction.end());
  CHECK(friction == std::vector<double>{0.2, 0.2, 0.21, 0.21, 0.25, 0.25, 0.3, 0.3});

  folder.write("measured.csv", "sample,friction\n1,0.3\n2,0.2\n3,0.5\n4,0.21\n");
  CHECK(folder.sweep({"-o", "o.h5", "--resume"}).err ==
        "o.h5: error: cannot be resumed: the study differs in data.measured.csv.friction[2]: 0.25, then 0.5; undo the "
        "change, or delete the file to start again\n");
  std::filesystem::remove(folder / "measured.csv");
  CHECK(folder.run({"summary", "o.h5"}).exit == 0);
  CHECK(folder.run({"replay", "o.h5", "--trial", "3", "-o", "r.h5"}).exit == 0);
}

TEST_CASE("of a bad data file every fault is one line", "[sweep]") {
  struct BadFile {
    std::string content, message;
  };
  const std::string named = " (parameter[0].file at study.toml:11:8)\n";
  const std::vector<BadFile> cases{
      {"friction\n0.2\nnan\n", "measured.csv:3: error: friction = 'nan' is not a finite number" + named},
      {"friction\n0.2\ninf\n", "measured.csv:3: error: friction = 'inf' is not a finite number" + named},
      {"friction,b\n,2\n", "measured.csv:2: error: friction = '' is not a finite number" + named},
      {"Friction,b\n1,2\n", "measured.csv:1: error: no column 'friction'; the header line names Friction, b" + named},
      {"friction\n", "study.toml:11:8: error: parameter[0].file = \"measured.csv\" has no row below its header line\n"},
      {"", "measured.csv:1: error: no header line with column names" + named}};
  const StudyFolder folder(empirical_study);
  CHECK(folder.sweep({}).err ==
        "study.toml:11:8: error: parameter[0].file = \"measured.csv\" cannot be read: No such file or directory\n");
  for (const BadFile& bad : cases) {
    folder.write("measured.csv", bad.content);
    const std::set<std::string> before = folder.names();
    const Outcome outcome = folder.sweep({});
    INFO("expected:\n" << bad.message << "\nfound:\n" << outcome.err);
    CHECK(outcome.err == bad.message);
    CHECK(outcome.exit == 2);
    CHECK(folder.names() == before);
  }
  const StudyFolder lacking(edited(empirical_study, "\ncolumn = \"friction\"", ""));
  lacking.write("measured.csv", "friction\n0.2\n");
  CHECK(lacking.sweep({}).err ==
        "study.toml:8:1: error: parameter[0] lacks 'column' (the column of the file with the values)\n");
}

namespace {

const std::string table_study = R"(title = "A table"
scenario = "s.toml"
set = ["run.solver=taylor", "run.report_interval_s=0.01"]
[sweep]
design = "table"
file = "points.csv"
[[parameter]]
path = "mesh.friction"
[[parameter]]
path = "effect.worm_coulomb.torque_Nm"
column = "bearing"
[[threshold]]
metric = "final_gear_speed"
below_rad_per_s = -2.5
)";

}  // namespace

TEST_CASE("a design that is a table takes every row once, in its order, and has no intervals", "[sweep]") {
  const StudyFolder folder(table_study);
  folder.write("points.csv", "run,bearing,mesh.friction\na,0.001,0.3\nb,0.004,0.25\nc,0.002,0.3\n");
  const Outcome outcome = folder.sweep({"-o", "o.h5"});
  INFO(outcome.out << outcome.err);
  REQUIRE(outcome.exit == 0);
  CHECK(outcome.out.find("study    table of 2 parameters, 3 trials, seed 0") != std::string::npos);
  CHECK(folder.column("o.h5", "mesh.friction") == std::vector<double>{0.3, 0.25, 0.3});
  CHECK(folder.column("o.h5", "effect.worm_coulomb.torque") == std::vector<double>{0.001, 0.004, 0.002});
  const Outcome summary = folder.run({"summary", "o.h5"});
  CHECK(summary.out.find("interval") == std::string::npos);
  CHECK(folder.sweep({"--shard", "2/2", "-o", "part.h5"}).exit == 0);
  CHECK(folder.run({"worst", "o.h5", "-o", "w.h5"}).err ==
        "o.h5: error: comes from a table of points, which states no distributions to search; sweep a study with "
        "distributions\n");
  CHECK(folder.run({"rare", "study.toml"}).err ==
        "study.toml: error: comes from a table of points, which states no distributions to search; an estimate of rare "
        "misses needs distributions\n");

  // an exported sweep is a table of points
  CHECK(folder.run({"export", "o.h5", "-o", "points.csv", "--force"}).exit == 0);
  folder.write("study.toml", edited(table_study, "column = \"bearing\"\n", ""));
  CHECK(folder.sweep({"-o", "again.h5"}).exit == 0);
  CHECK(folder.rows("again.h5") == folder.rows("o.h5"));
}

TEST_CASE("what a table of points cannot have is rejected", "[sweep]") {
  const std::vector<BadStudy> cases{
      {"file = \"points.csv\"\n", "",
       "study.toml:4:1: error: [sweep] lacks 'file' (a CSV file with a column for each parameter, relative to the "
       "folder "
       "of the study)"},
      {"column = \"bearing\"", "column = \"bearings\"",
       "points.csv:1: error: no column 'bearings'; the header line names mesh.friction, bearing (sweep.file at "
       "study.toml:6:8)"},
      {"\"points.csv\"", "\"point.csv\"",
       "study.toml:6:8: error: sweep.file = \"point.csv\" cannot be read: No such file or directory"},
      {"column = \"bearing\"", "column = \"bearing\"\ndistribution = \"uniform\"\nlow = 0\nhigh = 1",
       "study.toml:12:16: error: parameter[1].distribution is stated, but sweep.design = \"table\" takes the values of "
       "a "
       "parameter from its file; remove it"},
      {"column = \"bearing\"", "column = \"bearing\"\nlevels = 3",
       "study.toml:12:1: error: unknown key 'levels' in parameter[1]; valid keys: path, column"},
      {"[[threshold]]",
       "[[correlation]]\nbetween = [\"mesh.friction\", \"effect.worm_coulomb.torque_Nm\"]\ncoefficient = 0.9\n"
       "[[threshold]]",
       "study.toml:5:10: error: sweep.design = \"table\" needs independent parameters, but there is a [[correlation]]; "
       "remove it or use \"monte_carlo\", \"latin_hypercube\" or \"sobol\""}};
  check_rejected(table_study, cases, {"points.csv", "mesh.friction,bearing\n0.3,0.001\n"});
}

}  // namespace wormdrive::test::sweep_data_files
