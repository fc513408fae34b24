#include <cmath>
#include <random>

#include <fmt/format.h>

#include "catch.hpp"
#include "core/statics.hpp"
#include "description/build.hpp"
#include "description/diagnostics.hpp"
#include "description/toml/parse_scenario.hpp"
#include "description/toml/write_scenario.hpp"
#include "support.hpp"

// Gears stated by teeth and efficiencies, judged by what a gear's pitch circles and a trapezoidal thread say.

namespace wormdrive::test::scenarios_data_sheet {

namespace {

std::string sheet(const std::string& keys) {
  return "[mesh]\nkind = \"data_sheet\"\n" + keys +
         "worm_inertia_kgm2 = 3.7e-5\ngear_inertia_kgm2 = 1e-3\n"
         "[load]\nkind = \"constant\"\ntorque_Nm = 0.01\n[run]\nduration_s = 1\n";
}
MeshParameters<double> parsed(const std::string& keys) {
  return std::get<MeshParameters<double>>(parse_scenario(sheet(keys), "sheet", {}, Purpose::look).mesh);
}
std::string rejection(const std::string& keys) {
  try {
    parsed(keys);
  } catch (const InputFault& fault) {
    return fault.what();
  }
  return "accepted";
}

/// Efficiencies of a thread whose flanks stand at an angle to its axis.
struct Thread {
  double t, cosine, mu;
  double forward() const { return t * (cosine - mu * t) / (cosine * t + mu); }
  double backward() const { return (cosine * t - mu) / (t * (cosine + mu * t)); }
};

}  // namespace

TEST_CASE("a data sheet's teeth give a gear whose pitch circles touch and whose thread advances by its lead") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int k = 0; k < 200; ++k) {
    const int starts = 1 + static_cast<int>(random() % 6), teeth = 20 + static_cast<int>(random() % 100);
    const double module = std::exp(std::log(2e-4) + 4.0 * share(random)), pressure = 10.0 + 20.0 * share(random);
    const double worm = module * starts * (0.6 + 8.0 * share(random)), gear = 0.5 * module * teeth;
    const double efficiency = 0.02 + 0.95 * share(random);
    const bool driven = k % 2 == 0;
    const MeshParameters<double> mesh = parsed(fmt::format(
        "ratio = {}\nstarts = {}\nmodule_m = {}\ncentre_distance_m = {}\npressure_angle_deg = {}\n{} = {}\n",
        static_cast<double>(teeth) / starts, starts, module, worm + gear, pressure,
        driven ? "forward_efficiency" : "backward_efficiency", efficiency));
    CAPTURE(k, starts, teeth, module, worm, pressure, efficiency);
    CHECK(close(mesh.lg, gear, 1e-12));
    CHECK(close(mesh.lw, worm, 1e-9));
    CHECK(close(2.0 * std::numbers::pi * mesh.lw * std::tan(mesh.lambda), std::numbers::pi * module * starts, 1e-12));
    const Thread thread{std::tan(mesh.lambda), std::cos(pressure * unit::degree), mesh.mu};
    CHECK(close(driven ? thread.forward() : thread.backward(), efficiency, 1e-11));
    CHECK(close(GearMesh<double>(mesh).closing_ratio(), mesh.i, 1e-12));
  }
}

TEST_CASE("both efficiencies of a data sheet give lead angle and friction back") {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int k = 0; k < 200; ++k) {
    const double lead = (1.0 + 43.0 * share(random)) * unit::degree, pressure = 30.0 * share(random);
    Thread thread{std::tan(lead), std::cos(pressure * unit::degree), 0.0};
    const double locks = thread.cosine * std::min(thread.t * 3.0, 1.0 / thread.t);
    thread.mu = locks * (0.01 + 0.95 * share(random));
    const double ratio = 5.0 + 90.0 * share(random);
    const MeshParameters<double> mesh =
        parsed(fmt::format("ratio = {}\ncentre_distance_m = 0.07\npressure_angle_deg = {}\nforward_efficiency = {}\n"
                           "backward_efficiency = {}\n",
                           ratio, pressure, thread.forward(), thread.backward()));
    CAPTURE(k, lead, thread.mu, pressure);
    CHECK(std::abs(mesh.lambda - lead) < 1e-9);
    CHECK(std::abs(mesh.mu - thread.mu) < 1e-9);
    CHECK(close(mesh.lw + mesh.lg, 0.07, 1e-14));
    const GearMesh<double> gear(mesh);
    CHECK(close(gear.closing_ratio(), ratio, 1e-12));
    CHECK(close(forward_efficiency(gear), thread.forward(), 1e-11));
    CHECK(close(backward_efficiency(gear), thread.backward(), 1e-10));
  }
}

TEST_CASE("a data sheet is written as the gear that it describes") {
  const Scenario s = parse_scenario(
      sheet("ratio = 30\nstarts = 2\nmodule_m = 0.002\ncentre_distance_m = 0.08\npressure_angle_deg = 20\n"
            "forward_efficiency = 0.7\n"),
      "sheet", {}, Purpose::run);
  const std::string text = to_toml(s);
  CHECK(text.find("data_sheet") == std::string::npos);
  const Scenario read = parse_scenario(text, "again", {}, Purpose::run);
  CHECK(close(std::get<MeshParameters<double>>(read.mesh).mu, std::get<MeshParameters<double>>(s.mesh).mu, 1e-15));
  CHECK(to_toml(read) == text);
}

TEST_CASE("a data sheet that cannot be is rejected with the number and its limit") {
  const std::string teeth = "ratio = 30\nstarts = 2\nmodule_m = 0.002\npressure_angle_deg = 20\n",
                    gear = teeth + "centre_distance_m = 0.08\n",
                    none = "ratio = 30\ncentre_distance_m = 0.08\npressure_angle_deg = 20\n";
  CHECK(rejection(gear + "friction = 0.05\n") == "accepted");
  CHECK(rejection(gear) ==
        "sheet:1:1: error: with mesh.starts and mesh.module_m, state one of mesh.friction, mesh.forward_efficiency and "
        "mesh.backward_efficiency; 0 are stated");
  CHECK(
      rejection(gear + "friction = 0.05\nforward_efficiency = 0.7\n") ==
      "sheet:8:12: error: with mesh.starts and mesh.module_m, state one of mesh.friction, mesh.forward_efficiency and "
      "mesh.backward_efficiency; 2 are stated");
  CHECK(rejection(none + "forward_efficiency = 0.7\n") ==
        "sheet:1:1: error: state mesh.starts and mesh.module_m with one of mesh.friction, mesh.forward_efficiency and "
        "mesh.backward_efficiency, or both efficiencies alone");
  CHECK(rejection(none + "forward_efficiency = 0.7\nbackward_efficiency = 0.5\n") ==
        "sheet:7:23: error: mesh.backward_efficiency = 0.5 must be greater than 0.571429, 2 - "
        "1/mesh.forward_efficiency, and at most 0.7, mesh.forward_efficiency");
  CHECK(rejection(none + "forward_efficiency = 0.7\nbackward_efficiency = 0.75\n") ==
        "sheet:7:23: error: mesh.backward_efficiency = 0.75 must be greater than 0.571429, 2 - "
        "1/mesh.forward_efficiency, and at most 0.7, mesh.forward_efficiency");
  CHECK(rejection(teeth + "centre_distance_m = 0.05\nfriction = 0.05\n") ==
        "sheet:7:21: error: mesh.centre_distance_m = 0.05 must be greater than 0.06 m, the pitch radius of a gear with "
        "60 teeth and mesh.module_m = 0.002");
  CHECK(rejection(teeth + "centre_distance_m = 0.0615\nfriction = 0.05\n") ==
        "sheet:7:21: error: the lead angle of the worm is 53.13 deg; it must be at most 45 deg");
  CHECK(rejection("ratio = 30.3\nstarts = 1.5\nmodule_m = 0.002\npressure_angle_deg = 20\ncentre_distance_m = 0.08\n"
                  "friction = 0.05\n") == "sheet:4:10: error: mesh.starts = 1.5 must be a whole number");
  CHECK(rejection(gear + "backward_efficiency = -200\n") ==
        "sheet:8:23: error: mesh.backward_efficiency = -200 must be greater than -100, which infinite friction has");
  CHECK(rejection(gear + "forward_efficiency = 1.2\n") ==
        "sheet:8:22: error: mesh.forward_efficiency = 1.2 must be greater than 0 and less than 1");
  CHECK(rejection("starts = 2\nmodule_m = 0.002\n") ==
        "sheet:1:1: error: [mesh] lacks 'ratio' (transmission ratio, worm angle over gear angle)\n"
        "sheet:1:1: error: [mesh] lacks 'pressure_angle_deg' (normal pressure angle)\n"
        "sheet:1:1: error: [mesh] lacks 'centre_distance_m' (distance of the axes of worm and gear)");
}

}  // namespace wormdrive::test::scenarios_data_sheet
