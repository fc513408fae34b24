#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "catch.hpp"
#include "support.hpp"

// LossyGear of the Modelica Standard Library 4.1.0, computed by Dymola: gears with two efficiencies and bearing
// friction. A worm gear with mu < mu_w is the same element: C2 = 1/(i eta_mf1), C1 = eta_mf2/i, and the columns of
// bearing friction are two Coulomb torques, tau_a = (tau_bf1 - tau_bf2)/(eta_mf1 - 1/eta_mf2) on the worm and
// tau_b = i (tau_bf1 - eta_mf1 tau_a) on the gear.

namespace wormdrive::test::reference_lossy_gear {

namespace {

struct LossyGear {
  double ratio, eta_mf1, eta_mf2, tau_bf1, tau_bf2, J1, J2;

  /// Lead angle 45 degrees and no pressure angle: C = lw/lg (1 - m)/(1 + m).
  MeshParameters<double> mesh() const {
    const double C1 = eta_mf2 / ratio, C2 = 1.0 / (ratio * eta_mf1), root = std::sqrt(C1 / C2);
    return {.i = ratio,
            .lambda = 45 * unit::degree,
            .phi_n = 0.0,
            .lw = std::sqrt(C1 * C2),
            .lg = 1.0,
            .mu = (1.0 - root) / (1.0 + root),
            .Jw = J1,
            .Jg = J2};
  }
  Effects<double> bearings() const {
    const double tau_a = (tau_bf1 - tau_bf2) / (eta_mf1 - 1.0 / eta_mf2);
    return effects(WormCoulomb<double>{tau_a}, GearCoulomb<double>{ratio * (tau_bf1 - eta_mf1 * tau_a)});
  }
};

constexpr double report_interval = 0.0005;  // Dymola's [s]

/// Dymola holds a gear for stuck until its speed has passed 5e-11 rad/s and writes two rows then, before and after the
/// event. Within this time of one [s] modes may differ.
constexpr double detection = 1e-9;

constexpr double speed_tolerance = 1e-6;  // [rad/s]
/// Where a speed known to 1e-6 rad/s passes zero, with the 1 rad/s^2 and more of these gears [s].
constexpr double event_tolerance = 1e-6;

struct DymolaEvent {
  double t;
  int before, after;
};
std::vector<DymolaEvent> events_of(const Table& dymola) {
  std::vector<DymolaEvent> events;
  for (std::size_t row = 1; row < dymola.size(); ++row) {
    const int before = std::stoi(dymola.text("gear.mode", row - 1)), after = std::stoi(dymola.text("gear.mode", row));
    if (before != after) events.push_back({dymola.number("time", row), before, after});
  }
  return events;
}

/// Compares a run with a file of Dymola's: the speed in every row, the mode in every row but those within the detection
/// time of an event, and the events themselves. Both files have one such row that is not of an event's own pair, the
/// start of the first and the row at 0.02 s of the second, where the gear stops 2e-12 s before Dymola sees it.
template <class Drive>
void compare(const Drive& drive, const typename Drive::Instant& start, const Table& dymola, double end) {
  const auto ours = run(drive, Timetable(0, end, report_interval), start);
  std::map<long, typename Drive::Instant> reports;  // right limits
  for (const auto& row : ours.rows) {
    const long k = std::lround(row.now.t / report_interval);
    if (std::abs(row.now.t - static_cast<double>(k) * report_interval) <= 1e-12) reports[k] = row.now;
  }
  const std::vector<DymolaEvent> theirs = events_of(dymola);
  Deviation speed, event_time;
  int modes_differ = 0, exempt = 0;
  for (std::size_t row = 0; row < dymola.size(); ++row) {
    const double t = dymola.number("time", row);
    const long k = std::lround(t / report_interval);
    const bool reported = std::abs(t - static_cast<double>(k) * report_interval) <= 1e-15;
    // between the reports the state is the end of a run to this very time
    const auto now = reported ? reports.at(k) : run(drive, Timetable(0, t, report_interval), start).end;
    speed.add(now.x[1] - dymola.number("Inertia2.w", row));
    const bool at_event =
        std::any_of(theirs.begin(), theirs.end(), [&](const DymolaEvent& e) { return std::abs(e.t - t) <= detection; });
    if (at_event)
      ++exempt;
    else if (sign(now.mode.motion) != std::stoi(dymola.text("gear.mode", row)))
      ++modes_differ;
  }
  REQUIRE(speed <= speed_tolerance);
  REQUIRE(modes_differ == 0);
  REQUIRE(exempt == 2 * static_cast<int>(theirs.size()) + 1);

  std::vector<DymolaEvent> found;
  const Mode first = ours.rows.front().now.mode;
  if (start.x[1] == 0.0 && first.motion != Motion::stuck) found.push_back({start.t, 0, sign(first.motion)});
  for (const auto& e : ours.events) {
    const int before = sign(e.before.mode.motion), after = sign(e.after.mode.motion);
    if (before != after) found.push_back({e.after.t, before, after});  // the flank is not in Dymola's file
  }
  REQUIRE(found.size() == theirs.size());
  for (std::size_t k = 0; k < theirs.size(); ++k) {
    REQUIRE((found[k].before == theirs[k].before && found[k].after == theirs[k].after));
    event_time.add(found[k].t - theirs[k].t);
  }
  REQUIRE(event_time <= event_tolerance);
}

}  // namespace

TEST_CASE("a lossy gear's efficiencies and bearing columns are the coefficients of a worm gear") {
  const LossyGear gear{1.0, 0.25, 0.25, 0.625, 2.5, 0.001, 0.001};
  const GearMesh<double> mesh(gear.mesh());
  REQUIRE(std::abs(mesh.C1() - 0.25) <= 1e-15);
  REQUIRE(std::abs(mesh.C2() - 4.0) <= 1e-14);
  REQUIRE(std::abs(mesh.mu - 0.6) <= 1e-15);
  REQUIRE(std::abs(std::get<std::optional<WormCoulomb<double>>>(gear.bearings().list)->torque - 0.5) <= 1e-15);
  REQUIRE(std::abs(std::get<std::optional<GearCoulomb<double>>>(gear.bearings().list)->torque - 0.5) <= 1e-15);
}

TEST_CASE("LossyGearDemo1 reverses and sticks as in Dymola, with the same speeds and modes", "[reference]") {
  const auto dymola = reference("modelica/LossyGearDemo1.csv");
  if (!dymola) return;
  const LossyGear gear{2.0, 0.5, 0.5, 0.0, 0.0, 1.0, 1.5};
  const Signal motor{{Sinusoid{.amplitude = 10.0, .frequency = 1.0, .phase = -90 * unit::degree}}};
  const Signal load{{Constant{-10.0}, Ramp{.rate = 2.5}}};
  compare(drive(gear.mesh(), load, motor, gear.bearings()), {}, *dymola, 0.5);
}

TEST_CASE("LossyGearDemo3 is braked to a stop and held by its bearings as in Dymola", "[reference]") {
  const auto dymola = reference("modelica/LossyGearDemo3.csv");
  if (!dymola) return;
  const LossyGear gear{1.0, 0.25, 0.25, 0.625, 2.5, 0.001, 0.001};
  compare(drive(gear.mesh(), Signal{{Step{.torque = 1.0, .time = 0.5}}}, constant(0.0), gear.bearings()),
          {0.0, {0.0, 10.0}, {}}, *dymola, 1.0);
}

}  // namespace wormdrive::test::reference_lossy_gear
