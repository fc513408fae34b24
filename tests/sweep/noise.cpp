// The noise of a sweep's trials: each its own, however the sweep is made, unless the study asks for one that all have.
#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "catch.hpp"
#include "sweep/studies.hpp"
#include "sweep/study/load_study.hpp"
#include "sweep/trial.hpp"

namespace wormdrive::test::sweep_noise {

namespace {

/// Drives that differ in nothing but their noise.
std::string noisy(const std::string& noise, const std::string& sweep = "") {
  return R"(scenario = ")" + shipped("fig10_sliding_014deg_bare.toml") + R"("
set = ["run.solver=taylor", "run.duration_s=0.3", "run.report_interval_s=0.3", "metrics.from_s=0.1", ")" +
         noise + R"("]
metrics = ["error_max", "torque_rms"]
[sweep]
design = "monte_carlo"
trials = 20
seed = 1
)" + sweep +
         R"([[parameter]]
path = "mesh.friction"
distribution = "uniform"
low = 0.25
high = 0.2500000001
)";
}
const char* const sensor = "sensor.noise_rad=2e-5";
const char* const disturbance = "disturbance.deviation_Nm=0.001";

/// How far the values of a metric are apart, in units of the least.
double spread(const std::vector<double>& values) {
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  return (*greatest - *least) / *least;
}
std::vector<double> errors(const std::string& study) {
  const StudyFolder folder(study);
  REQUIRE(folder.sweep({"-o", "o.h5", "--referee", "0"}).exit == 0);
  return folder.column("o.h5", "torque_rms");
}

}  // namespace

TEST_CASE("every trial has its own noise, or all have the same if the study asks for it", "[sweep]") {
  for (const char* noise : {sensor, disturbance}) {
    INFO(noise);
    CHECK(spread(errors(noisy(noise))) > 1e-3);
    CHECK(spread(errors(noisy(noise, "common_random_numbers = true\n"))) < 1e-6);
  }
  CHECK(errors(noisy(sensor)) != errors(edited(noisy(sensor), "seed = 1", "seed = 2")));
}

TEST_CASE("encoders whose zero is off to either side are swept, with an index mark", "[sweep]") {
  const std::string marked = noisy("sensor.index_mark_rad=0.1");
  const std::string off = edited(edited(marked, "mesh.friction", "sensor.zero_error_rad"),
                                 "low = 0.25\nhigh = 0.2500000001", "low = -0.01\nhigh = 0.01");
  CHECK(spread(errors(off)) > 0.01);
}

TEST_CASE("the noise of a trial is the same in threads, shards and replays", "[sweep][slow]") {
  for (const char* noise : {sensor, disturbance}) {
    const StudyFolder folder(noisy(noise));
    REQUIRE(folder.sweep({"-o", "1.h5", "--threads", "1"}).exit == 0);
    REQUIRE(folder.sweep({"-o", "8.h5", "--threads", "8"}).exit == 0);
    CHECK(folder.rows("1.h5") == folder.rows("8.h5"));
    for (const char* shard : {"1/3", "2/3", "3/3"})
      REQUIRE(folder.sweep({"-o", std::string(1, shard[0]) + "_3.h5", "--shard", shard}).exit == 0);
    REQUIRE(folder.run({"merge", "1_3.h5", "2_3.h5", "3_3.h5", "-o", "m.h5"}).exit == 0);
    CHECK(folder.rows("m.h5") == folder.rows("1.h5"));

    const Outcome replayed = folder.run({"replay", "1.h5", "--trial", "13", "-o", "trial.h5"});
    CHECK(replayed.err.empty());
    REQUIRE(replayed.exit == 0);
    // the file of a trial holds its scenario, noise included
    REQUIRE(folder.run({"run", "trial.h5", "-o", "again.h5"}).exit == 0);
    CHECK(read_column(open_hdf5(folder / "again.h5"), "controller/measured_angle") ==
          read_column(open_hdf5(folder / "trial.h5"), "controller/measured_angle"));
    // the search goes on from the worst trial with the noise of it
    const Outcome worst = folder.run({"worst", "1.h5", "-o", "w.h5", "--evaluations", "4", "--tail", "1e-12"});
    INFO(worst.out << worst.err);
    REQUIRE(worst.exit == 0);
    const std::vector<double> largest = read_column(open_hdf5(folder / "1.h5"), "summary/worst/value");
    CHECK(worst.out.find(fmt::format("  worst    error_max {:.6g} rad after 4 runs", largest[0])) != std::string::npos);
  }
}

TEST_CASE("a study that varies the noise seed determines the noise of each trial", "[sweep]") {
  const std::string study =
      edited(noisy(sensor), "path = \"mesh.friction\"\ndistribution = \"uniform\"\nlow = 0.25\nhigh = 0.2500000001",
             "path = \"sensor.seed\"\ndistribution = \"discrete\"\nvalues = [1, 2]");
  const std::vector<double> found = errors(study);
  CHECK(std::set<double>(found.begin(), found.end()).size() == 2);
}

TEST_CASE("trials that differ by parameters alone have the same noise", "[sweep]") {
  CHECK(noise_of(Saltelli{4}, 3, 0) == 0);
  CHECK(noise_of(Saltelli{4}, 3, 1) == 1);
  for (const std::uint64_t row : {2, 3, 4}) CHECK(noise_of(Saltelli{4}, 3, 5 + row) == 5);
  for (const std::uint64_t row : {2, 3, 4}) CHECK(noise_of(Saltelli{4, true}, 3, 8 + row) == 8);
  for (const std::uint64_t row : {1, 5, 6, 7}) CHECK(noise_of(Saltelli{4, true}, 3, 8 + row) == 9);
  for (const std::uint64_t row : {0, 1, 2, 3}) CHECK(noise_of(Shapley{4, {}}, 3, 8 + row) == 8);
  CHECK(noise_of(MonteCarlo{40}, 3, 7) == 7);
}

}  // namespace wormdrive::test::sweep_noise
