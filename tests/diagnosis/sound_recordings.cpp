#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "catch.hpp"
#include "description/diagnostics.hpp"
#include "diagnosis/sheet.hpp"
#include "output/hdf5/stored_column.hpp"
#include "scenario_texts.hpp"
#include "simulation/load_scenario.hpp"
#include "support.hpp"

// What is taken for a recording, and what is left out of it.

namespace wormdrive::test::diagnosis_sound_recordings {

namespace {
constexpr std::size_t u = 1, y = 2;  ///< columns
}

TEST_CASE("a sound recording is taken as it is") {
  const Folder folder;
  const Recording r = read(folder, sound());
  CHECK(r.name == "r.csv");
  CHECK(r.remarks.empty());
  CHECK(r.samples() == 8000);
  CHECK(std::abs(r.period - 1e-3) < 1e-12);
  CHECK(std::abs(r.start) < 1e-9);
  CHECK(std::abs(r.gear_resolution - 2 * std::numbers::pi / 16384) < 1e-8);
  CHECK(r.gear_angle[4321] == sound().number(4321, y));
  CHECK(r.motor_torque[4321] == sound().number(4321, u));
  CHECK(std::count(r.valid.begin(), r.valid.end(), 1) == 8000);
  CHECK_FALSE(r.has_worm_encoder());
}

TEST_CASE("single samples that no measurement can have given are left out, the rest is taken") {
  const Folder folder;
  Sheet sheet = sound();
  sheet.put(0, u, 12.0);
  sheet.put(3, y, -7.0);
  sheet.put(1234, y, 2.0);
  for (const std::size_t k : {5000u, 5001u, 5002u}) sheet.put(k, y, 0.0);
  sheet.put(6000, u, -3.0);
  sheet.put(7999, y, 40.0);
  const Recording r = read(folder, sheet);
  CHECK(r.remarks ==
        std::vector<std::string>{
            "left out: motor_torque_Nm = 12 at 0 s (line 2), which no measurement can have given",
            "left out: motor_torque_Nm = -3 at 6 s (line 6002), which no measurement can have given",
            "left out: gear_angle_rad = -7 at 0.003 s (line 5), which no measurement can have given",
            "left out: gear_angle_rad = 2 at 1.234 s (line 1236), which no measurement can have given",
            "left out: gear_angle_rad from 5 s to 5.002 s (line 5002), 3 samples that no measurement can have given",
            "left out: gear_angle_rad = 40 at 7.999 s (line 8001), which no measurement can have given"});
  for (const std::size_t k : {0u, 3u, 1234u, 5000u, 5001u, 5002u, 6000u, 7999u}) CHECK(r.valid[k] == 0);
  CHECK(std::count(r.valid.begin(), r.valid.end(), 0) == 8);
  Deviation off;
  for (std::size_t k = 0; k < r.samples(); ++k) off.add(r.gear_angle[k] - sound().number(k, y));
  CHECK(off <= 0.01);  // what stands in their place continues the path
}

TEST_CASE("columns may be called otherwise, angles may be in degrees") {
  const Folder folder;
  Sheet sheet = sound();
  sheet.names = {"t", "u", "q"};
  Scenario scenario = nominal_arm();
  scenario.columns = {{"time_s", "t"}, {"motor_torque_Nm", "u"}, {"gear_angle_rad", "q"}};
  CHECK(read(folder, sheet, scenario).gear_angle[4321] == sound().number(4321, y));
  sheet = sound();
  sheet.names[y] = "gear_angle_deg";
  sheet.each(y, [](double v, std::size_t) { return v / unit::degree; });
  CHECK(std::abs(read(folder, sheet).gear_angle[4321] - sound().number(4321, y)) < 1e-8);
}

TEST_CASE("a run of the program is a recording: the samples of its controller, or its rows at even intervals") {
  const Folder folder;
  folder.write("s.toml", mesh_of_the_paper + R"([load]
kind = "gravity_arm"
mass_kg = 1
arm_m = 0.07
[motor.torque]
kind = "sinusoid"
amplitude_Nm = 0.08
frequency_Hz = 1
[run]
duration_s = 4
report_interval_s = 0.002
)");
  REQUIRE(folder.run({"run", "s.toml"}).exit == 0);
  const Recording open = read_recording(folder / "s.h5", nominal_arm());
  CHECK(open.samples() == 2001);
  CHECK(std::abs(open.period - 0.002) < 1e-12);
  CHECK(std::abs(open.motor_torque[125] - 0.08 * std::cos(0.5 * std::numbers::pi)) < 1e-12);
  folder.write("none.h5", "");
  CHECK_THROWS_AS(read_recording(folder / "none.h5", nominal_arm()), InputFault);
}

TEST_CASE("the commands of a controlled run are recorded from when the motor had them") {
  const Folder folder;
  const std::string shipped = std::string(WORMDRIVE_SCENARIOS) + "/fig10_pid_014rad_bare.toml";
  for (const char* const limit : {"1e3", "0.08"})  // whether the motor follows or is at its limit
    for (const char* const format : {"h5", "mat"}) {
      CAPTURE(limit, format);
      for (const int delay : {0, 1}) {
        REQUIRE(
            folder
                .run({"run", shipped, "--set", "run.duration_s=3.1", "--set", "controller.anti_windup=back_calculation",
                      "--set", "metrics.from_s=0", "--set", fmt::format("controller.delay_samples={}", delay), "--set",
                      fmt::format("effect.torque_saturation.limit_Nm={}", limit), "-o", "c.h5", "--force"})
                .exit == 0);
        if (std::string(format) == "mat") REQUIRE(folder.run({"export", "c.h5", "--mat", "--force"}).exit == 0);
        const Recording r = read_recording(folder / (std::string("c.") + format), nominal_arm());
        const std::vector<double> decided = read_column(open_hdf5(folder / "c.h5"), "controller/torque");
        REQUIRE(r.motor_torque.size() == decided.size());
        bool same = delay == 0 || r.motor_torque.front() == 0.0;
        for (std::size_t k = delay; k < decided.size(); ++k) same = same && r.motor_torque[k] == decided[k - delay];
        CHECK(same);
      }
    }
}

TEST_CASE("a controlled run whose encoder sits on the worm is no recording of the gear") {
  const Folder folder;
  const std::string shipped = std::string(WORMDRIVE_SCENARIOS) + "/fig10_pid_014rad_bare.toml";
  REQUIRE(folder
              .run({"run", shipped, "--set", "run.duration_s=0.5", "--set", "metrics.from_s=0", "--set",
                    "sensor.shaft=worm", "-o", "c.h5"})
              .exit == 0);
  REQUIRE(folder.run({"export", "c.h5", "--mat"}).exit == 0);
  for (const char* const file : {"c.h5", "c.mat"})
    CHECK(folder.run({"diagnose", shipped, file, "-o", "d"}).err ==
          fmt::format("{}: error: shows the worm's angle only (sensor.shaft = \"worm\"); a diagnosis needs that of the "
                      "gear\n",
                      file));
}

TEST_CASE("the recording that is shipped is one") {
  const std::string folder = WORMDRIVE_SCENARIOS;
  const Recording r =
      read_recording(folder + "/example_bench.csv", load_scenario(folder + "/example_bench.toml", {}, Purpose::look));
  CHECK(r.samples() == 8000);
  CHECK(r.remarks.empty());
  CHECK(std::abs(r.gear_resolution - 2 * std::numbers::pi / 16384) < 1e-6);
}

TEST_CASE("the measured servo axis is taken for a recording", "[reference]") {
  const auto path = reference_path("emps/data_emps.csv");
  if (!path) return;
  Scenario axis;
  axis.axis = Axis::linear;
  axis.mesh = SingleInertia<double>{95.1};
  const Recording r = read_recording(*path, axis);
  CHECK(r.samples() == 24841);
  CHECK(std::abs(r.period - 1e-3) < 1e-9);
  CHECK(r.remarks.empty());
}

}  // namespace wormdrive::test::diagnosis_sound_recordings
