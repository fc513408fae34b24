#include <algorithm>
#include <cmath>
#include <iostream>

#include "catch.hpp"
#include "recovery/truth/excitation.hpp"
#include "recovery/truth/hidden.hpp"
#include "simulation/run_scenario.hpp"
#include "support.hpp"

// The ground truth of the recovery tests against what is known without it, and in its rigid limit against the program.

namespace wormdrive::test::recovery_ground_truth {

namespace {

/// Nothing that is drawn: no noise, no rounding.
truth::Drive quiet() {
  truth::Drive drive;
  drive.sensor = {.counts = 0, .noise = 0};
  drive.noise = {.white = 0};
  return drive;
}

truth::Law follow(std::uint64_t seed, double duration) {
  return truth::follow(truth::rich_course(seed, duration), truth::Sheet{});
}

Scenario sheet(const truth::Geometry& g, double friction) {
  Scenario s;
  s.mesh = MeshParameters<double>{.i = g.ratio,
                                  .lambda = g.lead_angle,
                                  .phi_n = g.pressure_angle,
                                  .lw = g.worm_radius,
                                  .lg = g.gear_radius,
                                  .mu = friction,
                                  .Jw = g.worm_inertia,
                                  .Jg = g.gear_inertia};
  GravityArm arm;
  arm.mass = g.mass;
  arm.arm = g.arm;
  s.load = arm;
  return s;
}

/// The largest deviation of the gear angle over a quarter of a second between a recording and its replay [rad].
Deviation replayed(const truth::Recording& r, std::size_t from, Scenario scenario) {
  constexpr std::size_t length = 250;
  Samples torque;
  for (std::size_t k = 0; k < length; ++k) {
    torque.times.push_back(r.time[k]);
    torque.values.push_back(r.motor_torque[from + k]);
  }
  scenario.motor = {{torque}};
  scenario.initial = {r.true_angle[from], r.true_speed[from]};
  scenario.run.duration = r.time[length];
  scenario.run.report_interval = r.time[1];
  Deviation worst;
  std::size_t k = 0;
  for (const Row& row : simulate_scenario(scenario).rows)
    if (k <= length && std::abs(row.t - r.time[k]) < 1e-9) worst.add(row.at.theta_g - r.true_angle[from + k++]);
  REQUIRE(k == length + 1);
  return worst;
}

}  // namespace

TEST_CASE("with hard teeth and a short step the ground truth is the rigid drive within 2e-6 rad over 0.25 s") {
  truth::Drive drive = quiet();
  drive.teeth.stiffness = 2e10;
  drive.teeth.damping_ratio = 1.0;
  const auto r = truth::record(drive, follow(7, 4.0), {.duration = 4.0, .step = 1e-6});
  Deviation worst;
  double slowest = 1e9, fastest = 0.0;
  for (std::size_t from = 100; from + 250 < r.time.size(); from += 250) {
    worst.add(replayed(r, from, sheet(drive.geometry, 0.25)).size);
    slowest = std::min(slowest, r.true_angle[from]);
    fastest = std::max(fastest, std::abs(r.true_speed[from]));
  }
  std::cout << "ground truth: " << worst << " rad from the rigid drive over 0.25 s\n";
  REQUIRE(worst <= 2e-6);
  REQUIRE(fastest > 1.0);   // it moves
  REQUIRE(slowest < -1.6);  // to where the load has changed its sign
}

TEST_CASE("teeth that bend and bounce take the recordings no more than 4e-4 rad from the rigid drive over 0.25 s") {
  const auto r = truth::record(quiet(), follow(7, 24.0), {});
  Deviation worst;
  for (std::size_t from = 100; from + 250 < r.time.size(); from += 250)
    worst.add(replayed(r, from, sheet({}, 0.25)).size);
  std::cout << "ground truth: " << worst << " rad with the teeth as they are\n";
  REQUIRE(worst <= 4e-4);
  REQUIRE(worst.size > 1e-5);  // they are no copies of it
}

TEST_CASE("the ground truth loses energy by friction and damping only") {
  truth::Drive drive = quiet();
  truth::Geometry& g = drive.geometry;
  g.lead_angle = std::atan(g.gear_radius / (g.ratio * g.worm_radius));  // the geometry closes
  drive.friction.level = 0.0;
  drive.teeth.damping_ratio = 0.0;
  const truth::Law nothing = [](double, double) { return 0.0; };
  const auto energies = [&] { return truth::record(drive, nothing, {.duration = 2.0}).mechanical_energy; };
  const auto free = energies();
  const auto [low, high] = std::minmax_element(free.begin(), free.end());
  REQUIRE(*high - *low < 1e-5);  // of 1.4 J that change hands
  drive.friction.level = 0.02;   // not self-locking: the arm swings down and comes to rest
  drive.teeth.damping_ratio = 0.15;
  const auto rubbed = energies();
  for (std::size_t k = 1; k < rubbed.size(); ++k) REQUIRE(rubbed[k] < rubbed[k - 1] + 1e-6);
  REQUIRE(rubbed.back() < rubbed.front() - 0.1);
}

TEST_CASE("the ground truth breaks in at the torques of the paper") {
  // C1 = -0.0471 and C2 = 0.0837 of the paper's table, to its three digits; the load is m g d
  const truth::Drive drive = quiet();
  const double load = 0.6867;
  for (const double way : {1.0, -1.0}) {
    const auto r =
        truth::record(drive, [&](double t, double) { return way * 0.02 * t; }, {.duration = 4.0, .start_angle = 0.0});
    const auto moving =
        std::find_if(r.true_speed.begin() + 100, r.true_speed.end(), [](double v) { return std::abs(v) > 1e-3; });
    const double torque = r.motor_torque[static_cast<std::size_t>(moving - r.true_speed.begin())];
    CHECK(close(torque, way > 0 ? 0.0471 * load : -0.0837 * load, 0.01));
  }
}

TEST_CASE("every hidden effect changes the recording, the more the larger it is", "[slow]") {
  const auto torques = [](const truth::Drive& drive, double duration) {
    return truth::record(drive, follow(3, duration), {.duration = duration}).motor_torque;
  };
  // a mass is lost in the middle of the usual time
  for (const auto& [list, duration] : {std::pair{truth::catalogue(), 8.0}, {truth::outside(), 24.0}}) {
    const std::vector<double> nominal = torques({}, duration);
    const auto change = [&, &time = duration](const truth::Secret& secret, truth::Size size) {
      truth::Drive drive;
      truth::Generator generator(11);
      secret.hide(drive, secret.amount(size), generator);
      const std::vector<double> torque = torques(drive, time);
      double sum = 0.0;
      for (std::size_t k = 0; k < torque.size(); ++k) sum += std::pow(torque[k] - nominal[k], 2);
      return std::sqrt(sum / static_cast<double>(torque.size()));
    };
    for (const truth::Secret& secret : list) {
      const double small = change(secret, truth::Size::small), large = change(secret, truth::Size::large);
      INFO(secret.effect << ": " << small << " and " << large << " N m of torque");
      CHECK(small > 1e-6);
      if (secret.small != secret.large) CHECK(large > small);
    }
  }
}

TEST_CASE("the same seed gives the same recording, another one another") {
  truth::Drive drive;
  drive.noise.coloured = 5e-4;
  drive.sensor.worm_counts = 4096;
  const truth::RecordingSettings settings{.duration = 1.0, .seed = 4};
  const auto first = truth::record(drive, follow(3, 1.0), settings),
             again = truth::record(drive, follow(3, 1.0), settings);
  CHECK(first.gear_angle == again.gear_angle);
  CHECK(first.worm_angle == again.worm_angle);
  CHECK(first.gear_angle != truth::record(drive, follow(3, 1.0), {.duration = 1.0, .seed = 5}).gear_angle);
}

}  // namespace wormdrive::test::recovery_ground_truth
