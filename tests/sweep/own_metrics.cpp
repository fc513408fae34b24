// Metrics that a study makes of columns: against closed forms of the motion, and of courses made of straight lines.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "numbers.hpp"
#include "sweep/metrics/course.hpp"
#include "sweep/studies.hpp"

namespace wormdrive::test::sweep_own_metrics {

namespace {

/// A flywheel under cos(2 pi t) for 2 s: its speed is sin(2 pi t)/(2 pi J).
const std::string flywheel = R"([mesh]
kind = "none"
inertia_kgm2 = 1
[[motor.torque]]
kind = "sinusoid"
amplitude_Nm = 1
frequency_Hz = 1
[run]
duration_s = 2
report_interval_s = 0.0005
solver = "taylor"
)";
const std::string study = R"(scenario = "flywheel.toml"
[sweep]
design = "grid"
levels = 3
[[parameter]]
path = "mesh.inertia_kgm2"
distribution = "uniform"
low = 0.5
high = 2
)";

/// The metrics of a sweep whose study makes some of its own.
struct Swept {
  explicit Swept(const std::string& metrics) : folder(study + metrics) { folder.write("flywheel.toml", flywheel); }

  StudyFolder folder;
};

std::string metric(const std::string& name, const std::string& kind, const std::string& more,
                   const std::string& column = "gear_speed") {
  return fmt::format("[[metric]]\nname = \"{}\"\ncolumn = \"{}\"\nkind = \"{}\"\n{}\n", name, column, kind, more);
}

}  // namespace

TEST_CASE("what straight lines and jumps come to is exact", "[sweep]") {
  // up from 0 to 4 in 2 s, a jump to 1, 1 s of rest, down to -1 in 1 s
  const Course course{{{0.0, 0.0}, {2.0, 4.0}, {2.0, 1.0}, {3.0, 1.0}, {4.0, -1.0}}};
  CHECK(course.at(1.0) == 2.0);
  CHECK(course.at(2.0) == 1.0);
  CHECK(course.at(4.0) == -1.0);
  CHECK(course.least() == -1.0);
  CHECK(course.greatest() == 4.0);
  CHECK(course.integral() == 4.0 + 1.0 + 0.0);
  CHECK(course.mean() == 1.25);
  CHECK(close(course.root_mean_square(), std::sqrt((32.0 / 3 + 1.0 + 1.0 / 3) / 4.0), 1e-15));
  // below 1/2 for a quarter of a second of the rise and three quarters of the fall; at 1 for a second
  CHECK(close(course.quantile(0.25), 0.5, 1e-12));
  CHECK(close(course.quantile(0.5), 1.0, 1e-12));
  CHECK(close(course.quantile(0.75), 2.0, 1e-12));
  CHECK(course.quantile(0.0) == -1.0);
  CHECK(course.quantile(1.0) == 4.0);
  CHECK(course.crossing(3.0, true, false, 1) == 1.5);
  CHECK(course.crossing(3.0, true, true, 2) == 2.0);
  CHECK(course.crossing(0.0, false, true, 1) == 3.5);
  CHECK(std::isnan(course.crossing(0.0, true, false, 1)));
  CHECK(std::isnan(course.crossing(3.0, true, true, 3)));
  CHECK(course.settling(-1.0, 0.5) == 3.75);
  CHECK(course.settling(1.0, 2.0) == 2.0);
  CHECK(course.settling(0.0, 5.0) == 0.0);
  CHECK(std::isnan(course.settling(1.0, 0.5)));
  const Course part = course.between(1.0, 2.5);
  CHECK(part.begin() == 1.0);
  CHECK(part.duration() == 1.5);
  CHECK(part.integral() == 3.0 + 0.5);
  CHECK(course.between(0.0, 2.0).points.back().y == 4.0);
  CHECK(course.between(2.0, 3.0).greatest() == 1.0);
  CHECK(course.between(5.0, 6.0).empty());
  CHECK(course.between(0.0, 9.0).points.size() == 5);
}

TEST_CASE("a share of the time that is met but for rounding is met", "[sweep]") {
  Course steps;  // 1000 steps of a thousandth, each higher than the one before
  for (int k = 0; k < 1000; ++k)
    for (const int end : {k, k + 1}) steps.points.push_back({end * 0.001, static_cast<double>(k)});
  for (int share = 1; share < 100; ++share) CHECK(close(steps.quantile(share / 100.0), share * 10.0 - 1.0, 1e-9));
}

TEST_CASE("metrics of columns have the values of the motion's closed form", "[sweep]") {
  const Swept swept(metric("swing", "peak_to_peak", "") + metric("effort", "rms", "", "motor_torque") +
                    metric("way", "integral", "to_s = 0.5") + metric("most", "maximum", "from_s = 0.5\nto_s = 0.7") +
                    metric("low", "minimum", "") + metric("typical", "quantile", "time_percent = 75") +
                    metric("later", "value", "at_s = 0.6") + metric("average", "mean", "to_s = 0.5") +
                    metric("down", "crossing_time", "level_rad_per_s = 0.05\ndirection = \"falling\"\nnumber = 2") +
                    metric("calm", "settling_time", "band_rad_per_s = 0.12\ntarget_rad_per_s = 0") +
                    metric("fast", "crossing_time", "level_rad_per_s = 0.2\ndirection = \"rising\"") +
                    "[[threshold]]\nmetric = \"fast\"\nbelow_s = 1\n[[threshold]]\nmetric = \"swing\"\n"
                    "above_rad_per_s = 0.3\n");
  const Outcome sweep = swept.folder.sweep({"-o", "o.h5"});
  INFO(sweep.err);
  REQUIRE(sweep.exit == 0);
  constexpr double pi = std::numbers::pi;
  const auto column = [&](const std::string& name) { return swept.folder.column("o.h5", name); };
  const std::vector<double> inertia = column("mesh.inertia");
  REQUIRE(inertia.size() == 3);
  for (std::size_t k = 0; k < 3; ++k) {
    const double top = 1.0 / (2.0 * pi * inertia[k]);  // speed = top sin(2 pi t)
    INFO("inertia " << inertia[k] << ", top " << top);
    CHECK(close(column("swing")[k], 2.0 * top, 1e-5));
    CHECK(close(column("effort")[k], std::sqrt(0.5), 1e-5));
    CHECK(close(column("way")[k], 2.0 * top / (2.0 * pi), 1e-5));
    CHECK(std::abs(column("most")[k]) < 1e-12);
    CHECK(close(column("low")[k], -top, 1e-5));
    CHECK(close(column("typical")[k], top * std::sqrt(0.5), 1e-5));
    CHECK(close(column("later")[k], top * std::sin(1.2 * pi), 1e-5));
    CHECK(close(column("average")[k], 2.0 * top / pi, 1e-5));
    CHECK(close(column("down")[k], 1.0 + 0.5 - std::asin(0.05 / top) / (2.0 * pi), 1e-5));
    // the last way out of the band is in the second period
    if (top > 0.12) CHECK(close(column("calm")[k], 2.0 - std::asin(0.12 / top) / (2.0 * pi), 1e-5));
    if (top < 0.12) CHECK(column("calm")[k] == 0.0);
    if (top > 0.2) CHECK(close(column("fast")[k], std::asin(0.2 / top) / (2.0 * pi), 1e-5));
    if (top < 0.2) CHECK(std::isnan(column("fast")[k]));
  }
  // what never happens is later than any limit
  const nlohmann::json summary =
      nlohmann::json::parse(swept.folder.run({"summary", "o.h5", "--json"}).out)["thresholds"];
  CHECK(summary[1]["metric"] == "fast");
  CHECK(summary[1]["missed"] == 1);
  CHECK(summary[0]["missed"] == 1);
  // a replay has the same bits, and the metrics stand in the export with their units
  CHECK(swept.folder.run({"replay", "o.h5", "--trial", "1", "-o", "t.h5"}).exit == 0);
  const std::string csv = swept.folder.run({"export", "o.h5"}).out;
  for (const char* name : {"swing_rad_per_s", "effort_Nm", "way_rad", "down_s"})
    CHECK(csv.find(fmt::format(",{}", name)) != std::string::npos);
}

TEST_CASE("a column that jumps at an event counts with both its sides", "[sweep]") {
  // dry friction stops the flywheel after 2 s J, within a report interval: its acceleration comes to the lost speed
  const StudyFolder folder(study + metric("lost", "integral", "", "gear_acceleration") +
                           metric("braked", "crossing_time", "level_rad_per_s2 = -0.01", "gear_acceleration"));
  folder.write("flywheel.toml", R"([mesh]
kind = "none"
inertia_kgm2 = 1
[effect.gear_coulomb]
torque_Nm = 0.5
[initial]
gear_speed_rad_per_s = 1
[run]
duration_s = 5
report_interval_s = 0.7
)");
  const Outcome sweep = folder.sweep({"-o", "o.h5"});
  INFO(sweep.err);
  REQUIRE(sweep.exit == 0);
  const std::vector<double> inertia = folder.column("o.h5", "mesh.inertia"), lost = folder.column("o.h5", "lost"),
                            braked = folder.column("o.h5", "braked");
  for (std::size_t k = 0; k < inertia.size(); ++k) {
    CHECK(close(lost[k], -1.0, 1e-9));
    CHECK(close(braked[k], 2.0 * inertia[k], 1e-9));
  }
}

TEST_CASE("a column of the controller is held from sample to sample", "[sweep]") {
  const std::string scenario = shipped("fig10_sliding_014deg_bare.toml");
  const StudyFolder folder(fmt::format(R"(scenario = "{}"
set = ["run.solver=taylor", "run.duration_s=0.5", "metrics.from_s=0.1"]
[sweep]
design = "monte_carlo"
trials = 6
[[parameter]]
path = "effect.mesh_friction.change"
distribution = "uniform"
low = -0.02
high = 0.02
)",
                                       scenario) +
                           "[[metric]]\nname = \"effort\"\ntable = \"controller\"\ncolumn = \"applied_torque\"\n"
                           "kind = \"rms\"\nfrom_s = 0.1\n"
                           "[[metric]]\nname = \"peak\"\ntable = \"controller\"\ncolumn = \"applied_torque\"\n"
                           "kind = \"maximum\"\nfrom_s = 0.1\n");
  REQUIRE(folder.sweep({"-o", "a.h5", "--threads", "2", "--referee", "1"}).exit == 0);
  REQUIRE(folder.sweep({"-o", "b.h5", "--threads", "1", "--shard", "1/1", "--referee", "1"}).exit == 0);
  CHECK(folder.rows("a.h5") == folder.rows("b.h5"));
  const std::vector<double> effort = folder.column("a.h5", "effort"), rms = folder.column("a.h5", "torque_rms"),
                            peak = folder.column("a.h5", "peak"), most = folder.column("a.h5", "torque_peak");
  for (std::size_t k = 0; k < effort.size(); ++k) {
    CHECK(close(effort[k], rms[k], 1e-2));  // over the samples at both ends of the window
    CHECK(peak[k] <= most[k]);
    CHECK(peak[k] > 0.5 * most[k]);
  }
}

TEST_CASE("a faulty metric of a study gives one line that tells the remedy", "[sweep]") {
  const auto why = [](const std::string& text) {
    const Swept swept(text);
    const Outcome outcome = swept.folder.sweep({"-o", "o.h5"});
    CHECK(outcome.exit == 2);
    CHECK(swept.folder.names() == std::set<std::string>{"flywheel.toml", "s.toml", "study.toml"});
    return outcome.err;
  };
  CHECK(why(metric("final_gear_speed", "mean", "")) ==
        "study.toml:11:8: error: the name 'final_gear_speed' is taken; choose another one\n");
  CHECK(why(metric("status", "mean", "")) ==
        "study.toml:11:8: error: the name 'status' is taken; choose another one\n");
  CHECK(why(metric("", "mean", "")) ==
        "study.toml:11:8: error: '' cannot be the name of a metric; use small letters, digits and _\n");
  CHECK(why(metric("way", "mean", "", "")).starts_with("study.toml:12:10: error: runs have no column ''; "));
  CHECK(why(metric("way", "mean", "to_s = 3")) ==
        "study.toml:14:8: error: metric[0].to_s = 3 s must be at most the duration of the run, 2 s\n");
  CHECK(why(metric("Way", "mean", "")) ==
        "study.toml:11:8: error: 'Way' cannot be the name of a metric; use small letters, digits and _\n");
  CHECK(why(metric("way", "mean", "", "gear_sped")) ==
        "study.toml:12:10: error: runs have no column 'gear_sped'; did you mean 'gear_speed'?\n");
  CHECK(why(metric("way", "mean", "table = \"controller\"", "torque")) ==
        "study.toml:14:9: error: the scenario has no controller; its runs have the columns of the trajectory alone\n");
  CHECK(why(metric("way", "average", "")) ==
        "study.toml:13:8: error: metric[0].kind = \"average\" must be one of \"value\", \"minimum\", \"maximum\", "
        "\"peak_to_peak\", \"mean\", \"rms\", \"integral\", \"quantile\", \"crossing_time\", \"settling_time\"\n");
  CHECK(why(metric("way", "mean", "from_s = 2")) ==
        "study.toml:14:10: error: metric[0].from_s = 2 s must be less than the duration of the run, 2 s\n");
  CHECK(why(metric("way", "mean", "from_s = 1\nto_s = 0.5")) ==
        "study.toml:14:10: error: metric[0].from_s = 1 s must be less than to_s = 0.5 s\n");
  CHECK(why(metric("way", "value", "at_s = 3")) ==
        "study.toml:14:8: error: metric[0].at_s = 3 s is not within what counts, 0 s to 2 s\n");
  // a fault of one metric neither hides those of others nor makes its limits faults
  CHECK(why(metric("way", "value", "at_s = 3") + metric("other", "value", "at_s = 4") +
            "[[threshold]]\nmetric = \"way\"\nabove_rad_per_s = 1\n") ==
        "study.toml:14:8: error: metric[0].at_s = 3 s is not within what counts, 0 s to 2 s\n"
        "study.toml:19:8: error: metric[1].at_s = 4 s is not within what counts, 0 s to 2 s\n");
  CHECK(why(metric("way", "mean", "") + "[[threshold]]\nmetric = \"way\"\nabove_s = 1\n") ==
        "study.toml:16:10: error: a threshold states either above_rad_per_s or below_rad_per_s\n");
  CHECK(why(metric("way", "settling_time", "band_rad = 1")).find("did you mean 'band_rad_per_s'?") !=
        std::string::npos);
}

}  // namespace wormdrive::test::sweep_own_metrics
