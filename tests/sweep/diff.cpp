// What `diff` says of two sweeps and of two estimates: which trials, which columns, beyond what is allowed.
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "cli/changed_results.hpp"
#include "sweep/studies.hpp"

namespace wormdrive::test::sweep_diff {

namespace {

/// Changes values of a column of a sweep.
void change(const StudyFolder& folder, const std::string& file, const std::string& column,
            const std::vector<std::pair<std::size_t, double>>& values) {
  const Hdf5Handle sweep = reopen_hdf5(folder / file);
  const Hdf5Handle dataset(H5Dopen2(sweep, ("trials/" + column).c_str(), H5P_DEFAULT), H5Dclose, "no column");
  std::vector<double> all = read_column(sweep, "trials/" + column);
  for (const auto& [row, value] : values) all[row] = value;
  check_hdf5(H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, all.data()), "cannot change");
}

/// The line of what was printed that has a text.
std::string line_with(const std::string& out, const std::string& text) {
  const std::size_t at = out.find(text);
  if (at == std::string::npos) return "";
  const std::size_t begin = out.rfind('\n', at) + 1;
  return out.substr(begin, out.find('\n', at) - begin);
}

}  // namespace

TEST_CASE("diff of two sweeps names the columns and the trials that differ", "[sweep]") {
  const StudyFolder folder;
  REQUIRE(folder.sweep({"-o", "a.h5"}).exit == 0);
  for (const char* copy : {"same.h5", "other.h5", "failed.h5"})
    std::filesystem::copy_file(folder / "a.h5", folder / copy);
  const Outcome same = folder.run({"diff", "a.h5", "same.h5", "--relative", "0"});
  INFO(same.out << same.err);
  CHECK(same.exit == 0);
  CHECK(same.out.ends_with("the results agree: 200 trials compared\n"));

  const std::vector<double> speed = folder.column("a.h5", "final_gear_speed");
  change(folder, "other.h5", "final_gear_speed", {{7, speed[7] + 0.5}, {150, speed[150] - 0.25}});
  const Outcome other = folder.run({"diff", "a.h5", "other.h5"});
  CHECK(other.exit == 1);
  CHECK(line_with(other.out, "trials/final_gear_speed").find(" 0.5 in trial 7 ") != std::string::npos);
  CHECK(line_with(other.out, "trials/final_gear_speed").ends_with("DIFFERS in 2 trials: 7, 150"));
  CHECK(line_with(other.out, "trials/mesh.friction").find("DIFFERS") == std::string::npos);
  CHECK(other.out.ends_with("the results differ: 200 trials compared\n"));
  CHECK(folder.run({"diff", "a.h5", "other.h5", "--absolute", "0.5000001"}).exit == 0);
  CHECK(folder.run({"diff", "a.h5", "other.h5", "--absolute", "0.3", "-q"}).out.empty());
  const auto json = nlohmann::json::parse(folder.run({"diff", "a.h5", "other.h5", "--absolute", "0.3", "--json"}).out);
  CHECK(json.at("agree") == false);
  for (const auto& signal : json.at("signals"))
    CHECK(signal.at("trials") ==
          (signal.at("signal") == "trials/final_gear_speed" ? std::vector<int>{7} : std::vector<int>{}));

  // not a number is another value than any number, and the same as not a number
  const double none = std::numeric_limits<double>::quiet_NaN();
  change(folder, "other.h5", "final_gear_speed", {{7, none}, {150, speed[150]}});
  CHECK(folder.run({"diff", "a.h5", "other.h5", "--absolute", "1e9"}).exit == 1);
  std::filesystem::copy_file(folder / "other.h5", folder / "nan.h5");
  CHECK(folder.run({"diff", "nan.h5", "other.h5"}).exit == 0);

  change(folder, "failed.h5", "status", {{3, 2.0}, {4, 3.0}});
  const Outcome failed = folder.run({"diff", "a.h5", "failed.h5"});
  CHECK(failed.exit == 1);
  CHECK(failed.out.find(
            "  2 trials ended differently: 3, 4; trial 3: done in the first result, refused in the second\n") !=
        std::string::npos);
}

TEST_CASE("diff of two sweeps names trials and columns that one of them lacks, and other differences", "[sweep]") {
  const StudyFolder folder;
  REQUIRE(folder.sweep({"-o", "whole.h5"}).exit == 0);
  REQUIRE(folder.sweep({"-o", "shard.h5", "--shard", "2/4"}).exit == 0);
  const Outcome shard = folder.run({"diff", "whole.h5", "shard.h5"});
  INFO(shard.out << shard.err);
  CHECK(shard.exit == 1);
  CHECK(shard.out.find("  150 trials in whole.h5 only: 0 to 49, 100 to 199\n") != std::string::npos);
  CHECK(shard.out.ends_with("the results differ: 50 trials compared\n"));

  // another order of the kinds of reasons is no difference
  const StudyFolder failures(R"(scenario = "s.toml"
set = ["run.solver=taylor"]
[sweep]
design = "monte_carlo"
trials = 40
seed = 1
[[parameter]]
path = "mesh.friction"
distribution = "discrete"
values = [0.25, -0.1, 20]
weights = [60, 20, 20]
)");
  REQUIRE(failures.sweep({"-o", "a.h5"}).exit == 0);
  REQUIRE(failures.sweep({"-o", "second.h5", "--shard", "2/2"}).exit == 0);
  const Outcome half = failures.run({"diff", "second.h5", "a.h5"});
  CHECK(half.out.find("failed for another reason") == std::string::npos);
  CHECK(half.out.find("  20 trials in a.h5 only: 0 to 19\n") != std::string::npos);

  folder.write("study.toml", study_but("seed = 3", "seed = 4"));
  REQUIRE(folder.sweep({"-o", "seed.h5"}).exit == 0);
  const Outcome seed = folder.run({"diff", "whole.h5", "seed.h5"});
  CHECK(seed.exit == 1);
  CHECK(seed.out.find("  note: the study differs in sweep.seed: 3, then 4\n") != std::string::npos);
  CHECK(line_with(seed.out, "trials/mesh.friction").find("DIFFERS in 200 trials: 0, 1, 2, 3, 4, ...") !=
        std::string::npos);
  REQUIRE(folder.run({"run", "s.toml", "-o", "run.h5"}).exit == 0);
  const Outcome kinds = folder.run({"diff", "whole.h5", "run.h5"});
  CHECK(kinds.exit == 2);
  CHECK(kinds.err ==
        "run.h5: error: it is a result of 'run', but whole.h5 is one of 'sweep'; diff compares results of one kind\n");
}

TEST_CASE("diff compares all of an estimate of rare misses, and no infinite value allows another one", "[sweep]") {
  constexpr double infinite = std::numeric_limits<double>::infinity(), none = std::numeric_limits<double>::quiet_NaN();
  const ResultFolder folder;
  const std::string study = study_but("below_rad_per_s = -2.5", "below_rad_per_s = -0.31");
  folder.write("study.toml", study);
  folder.make({"rare", "study.toml", "-o", "a.h5", "--per-level", "100", "--samples", "100"});
  folder.write("study.toml", edited(study, "seed = 3", "seed = 4"));
  folder.make({"rare", "study.toml", "-o", "seed.h5", "--per-level", "100", "--samples", "100"});
  CHECK(folder.diff("a.h5", "a.h5", {"--relative", "0"}).exit == 0);
  const Outcome seed = folder.diff("a.h5", "seed.h5");
  CHECK(seed.exit == 1);
  CHECK(seed.out.starts_with("  note: the study differs in sweep.seed: 3, then 4\n"));
  CHECK(line_of(seed.out, "runs/mesh.friction").ends_with("DIFFERS"));
  check_every_column(folder, "a.h5", {"estimates", "levels", "design_point", "runs"});

  const auto changed = [&](const std::string& object, const std::string& name, auto value) {
    folder.copy("a.h5", "changed.h5");
    folder.change_attribute("changed.h5", object, name, value);
    return folder.diff("a.h5", "changed.h5");
  };
  CHECK(line_of(changed("estimates", "limit", -0.3099).out, "limit of estimates").ends_with("DIFFERS"));
  CHECK(changed("estimates", "above", std::int64_t{1}).exit == 1);
  CHECK(changed("design_point", "beta", 9.0).exit == 1);
  CHECK(changed("design_point", "converged", std::int64_t{0}).exit == 1);
  CHECK(tells(changed("estimates", "metric", std::string("other")),
              "metric of estimates: 'final_gear_speed' in the first result, 'other' in the second"));
  const Outcome settings = changed("/", "settings", std::string("others"));
  CHECK(settings.exit == 0);
  CHECK(settings.out.find("  note: the settings differ: --metric final_gear_speed --per-level 100 --samples 100, then "
                          "others\n") != std::string::npos);

  for (const auto& [column, value] : {std::pair{"estimates/probability", infinite}, {"estimates/variation", none}}) {
    folder.copy("a.h5", "changed.h5");
    folder.change("changed.h5", column, 0, value);
    folder.copy("changed.h5", "same.h5");
    INFO(column);
    CHECK(folder.diff("a.h5", "changed.h5", {"--relative", "1e300", "--absolute", "1e300"}).exit == 1);
    CHECK(folder.diff("changed.h5", "a.h5").exit == 1);
    CHECK(folder.diff("changed.h5", "same.h5", {"--relative", "0"}).exit == 0);
    // the other estimate counts
    const nlohmann::json signal = signal_in(folder.diff("changed.h5", "a.h5", {"--json"}), column);
    CHECK(signal.at("allowed").get<double>() < 1e-5);
    CHECK(signal.at("largest").is_null());
  }
  folder.change("changed.h5", "levels/distance", 0, infinite);
  folder.copy("changed.h5", "same.h5");
  folder.change("same.h5", "levels/distance", 0, -infinite);
  CHECK(folder.diff("changed.h5", "same.h5").exit == 1);
}

}  // namespace wormdrive::test::sweep_diff
