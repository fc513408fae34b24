#include <cmath>

#include "catch.hpp"
#include "cli/program.hpp"
#include "compliant_drives.hpp"
#include "near_ties/dice.hpp"
#include "simulation/load_scenario.hpp"
#include "simulation/run_scenario.hpp"

// What elastic teeth may err by: a share of how far they give way, not of the angles by which the shafts have turned.

namespace wormdrive::test::events_elastic_tolerance {

namespace {

/// Two shafts that turn together while their teeth swing about what the load bends them by, without friction:
/// the penetration is mean (1 + share cos(omega t)), and the teeth never part.
struct SwingingTeeth {
  double Jw, Jg, stiffness, load, share, turned, speed;

  double omega() const { return std::sqrt(stiffness * (1.0 / Jw + 1.0 / Jg)); }
  double mean() const { return load / stiffness; }
  ElasticDrive drive() const {
    return compliant(unit_arms(Jw, Jg), constant(load), constant(-load), {HuntCrossley<double>{stiffness, 0.0}, 0.0});
  }
  ElasticDrive::Instant start() const {
    CompliantMode mode;
    mode.worm = mode.gear = Motion::forward;
    mode.contact = Flank::left;
    return {0.0, {turned - mean() * (1.0 + share), speed, turned, speed}, mode};
  }
};

std::vector<EventKind> kinds(const Trajectory& of) {
  std::vector<EventKind> list;
  for (const Event& event : of.events) list.push_back(event.kind());
  return list;
}

}  // namespace

TEST_CASE("teeth swing as far as they do, however far the shafts have turned and however loose the tolerance") {
  for (unsigned n = 0; n < 40; ++n) {
    near_ties::Dice dice(11, n);
    const double stiffness = dice.decades(1e4, 1e8), load = stiffness * dice.decades(1e-8, 1e-5);
    const SwingingTeeth of{dice.decades(1e-3, 1e2),
                           dice.decades(1e-3, 1e2),
                           stiffness,
                           load,
                           dice.between(0.2, 0.6),
                           dice.sign() * dice.decades(0.1, 300.0),
                           dice.sign() * dice.decades(1e-2, 30.0)};
    const double swings = 5.0, end = swings * 2.0 * std::numbers::pi / of.omega();
    for (const By method : {bdf, adams})
      for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-8}) {
        INFO("drive " << n << ", tolerance " << tolerance << ", share " << of.share);
        const auto r = run(of.drive(), Timetable(0, end, end), of.start(), tight(method, tolerance));
        CHECK(r.events.empty());
        const double penetration = r.end.x[2] - r.end.x[0];
        const double rounding = 1e-16 * (std::abs(of.turned) + std::abs(of.speed) * end) / of.mean();
        const auto steps = static_cast<double>(r.statistics.steps);  // each of which may err by as much
        CHECK(std::abs(penetration / of.mean() - 1.0 - of.share) <= steps * (2.0 * tolerance + 50.0 * rounding));
      }
  }
}

TEST_CASE("a loose tolerance has the impacts of a tight one") {
  for (const std::string name : {"fig09_backlash.toml", "jam.toml"}) {
    const auto with = [&](const std::string& method, const std::string& tolerance) {
      return kinds(simulate_scenario(
          load_scenario(shipped(name), {"run.method=" + method, "run.relative_tolerance=" + tolerance}, Purpose::run)));
    };
    const std::vector<EventKind> expected = with("bdf", "1e-11");
    REQUIRE(expected.size() > 40);
    for (const std::string method : {"bdf", "adams"})
      for (const std::string tolerance : {"1e-4", "1e-6", "1e-8"}) CHECK(with(method, tolerance) == expected);
  }
}

}  // namespace wormdrive::test::events_elastic_tolerance
