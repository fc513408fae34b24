#include <cmath>
#include <numbers>
#include <string>

#include "catch.hpp"
#include "core/numbers/sine_cosine.hpp"
#include "events/taylor/series_step.hpp"
#include "support.hpp"

// The solver of power series against 128-bit arithmetic, and where its series must not be believed.

namespace wormdrive::test::events_taylor {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

// From bench/fig09_reference.cpp: the same equations in 128-bit arithmetic.
constexpr double event_times[] = {0.0034812139114724669663, 0.36127299758543927605, 0.59519501265649604358,
                                  0.70156168737894434193,   0.73446789466525049751, 0.92654625731499095359,
                                  1.2469025128552435424,    1.4124534692991002631,  1.4134879342934340843,
                                  1.646950892655164793,     1.9134994319656890925,  1.9383624501092304682};
constexpr double end_angle = -5.4068889175374453849, end_speed = 1.0836146975023261689;

auto fig9(double tolerance, double report_interval = never) {
  return run(drive(table1(), fig9_load(), fig9_motor()), Timetable(0, 2, report_interval), {},
             tight(taylor, tolerance));
}

/// A load that a series cannot follow: its torque changes its law at theta_g = bend.
struct BentLoad {
  double bend, jump;

  double inertia() const { return 0.0; }
  void enter(double) {}
  double next_knot(double) const { return never; }
  double fastest() const { return 0.0; }
  double ripple() const { return 0.0; }
  template <class S>
  S torque(const Moment<S>& at) const {
    if (at.theta_g > S(bend)) return S(jump) - 0.01 * (at.theta_g - bend);
    return S(0.0);
  }
};

}  // namespace

TEST_CASE("power series end fig. 9 within 1e-12 of 128-bit arithmetic and find its events within 1e-13 s") {
  for (double report_interval : {never, 0.001}) {
    const auto r = fig9(1e-15, report_interval);
    REQUIRE(r.events.size() == std::size(event_times));
    Deviation times;
    for (std::size_t k = 0; k < std::size(event_times); ++k) times.add(r.events[k].after.t - event_times[k]);
    REQUIRE(times <= 1e-13);
    REQUIRE(std::abs(r.end.x[0] - end_angle) <= 1e-12);
    REQUIRE(std::abs(r.end.x[1] - end_speed) <= 1e-12);
  }
}

TEST_CASE("reports do not change a bit of what power series compute") {
  const auto with = fig9(1e-12, 0.001), without = fig9(1e-12);
  REQUIRE(with.end.x == without.end.x);
  REQUIRE(with.statistics.steps == without.statistics.steps);
  // and with held torques, where most steps are taken without a search for events
  Samples held;
  for (int k = 0; k < 200; ++k) {
    held.times.push_back(0.005 * k);
    held.values.push_back(0.02 * std::sin(0.3 * k));
  }
  const auto d = drive(table1(), fig9_load(), {{held}});
  const auto often = run(d, Timetable(0, 1, 1e-3 * std::numbers::sqrt2), {}, tight(taylor)),
             never_asked = run(d, Timetable(0, 1, never), {}, tight(taylor));
  REQUIRE(often.end.x == never_asked.end.x);
  REQUIRE(often.modes() == never_asked.modes());
  // and where they fall on the arrivals of delayed torques, but for the rounding of both times
  for (const double delay : {0.0002, 0.0013, 0.0031}) {
    const auto late = drive(table1(), fig9_load(), {{held}}, effects(ActuatorDelay<double>{delay}));
    REQUIRE(run(late, Timetable(0, 1, 1e-4), {}, tight(taylor)).end.x ==
            run(late, Timetable(0, 1, never), {}, tight(taylor)).end.x);
  }
}

TEST_CASE("the error of power series follows the tolerance, which bounds it per second") {
  for (int digits = 5; digits <= 14; ++digits) {
    const double tolerance = std::pow(10.0, -digits);
    const auto r = fig9(tolerance);
    REQUIRE(r.events.size() == 12);
    REQUIRE(std::abs(r.end.x[1] - end_speed) <= 20.0 * tolerance);
  }
}

TEST_CASE("the equations of core, instantiated with a series, move a drive as its own formulas do") {
  // the same load under another type, which the formulas do not know
  struct ForeignLoad : GravityLoad {
    explicit ForeignLoad(const GravityArm& arm) : GravityLoad(arm) {}
  };
  const auto known = run(drive(table1(), fig9_load(), fig9_motor()), Timetable(0, 2, 0.1), {}, tight(taylor, 1e-14));
  const auto foreign =
      run(WormDrive<double, ForeignLoad>(GearMesh<double>(table1()), ForeignLoad(fig9_load()), {}, fig9_motor()),
          Timetable(0, 2, 0.1), {}, tight(taylor, 1e-14));
  REQUIRE(NominalFlow<WormDrive<double, GravityLoad>>::known);
  REQUIRE(!NominalFlow<WormDrive<double, ForeignLoad>>::known);
  REQUIRE(foreign.modes() == known.modes());
  Deviation states;
  for (std::size_t k = 0; k < known.rows.size(); ++k)
    states.add((known.rows[k].now.x - foreign.rows[k].now.x).cwiseAbs().maxCoeff());
  REQUIRE(states <= 1e-12);
}

TEST_CASE("a table of torques over the angle is followed from piece to piece, in both directions") {
  std::vector<double> angles, torques;
  for (int k = -8; k <= 8; ++k) {
    angles.push_back(0.4 * k);
    torques.push_back(0.02 * std::cos(1.1 * k));
  }
  const AngleTable table(angles, torques);
  for (double start : {0.0, 3.0, -3.0}) {
    const Timetable timetable(0, 2, 0.05);
    const auto by_series =
        run(drive(table1(), LoadSum{{table}}, fig9_motor()), timetable, {0, {0, start}, {}}, tight(taylor));
    const auto by_cvode =
        run(drive(table1(), LoadSum{{table}}, fig9_motor()), timetable, {0, {0, start}, {}}, tight(adams));
    REQUIRE(by_series.modes() == by_cvode.modes());
    REQUIRE((by_series.end.x - by_cvode.end.x).cwiseAbs().maxCoeff() <= 1e-9);
  }
}

TEST_CASE("under held torques no event is leapt over that a changing load makes, alone or in a sum") {
  Samples held;
  held.interpolation = Interpolation::hold;
  for (int k = 0; k < 400; ++k) {
    held.times.push_back(0.005 * k);
    held.values.push_back(0.06 * std::sin(0.1 * k));
  }
  for (const double frequency : {1.0, 4.0, 10.0}) {
    const Sinusoid swell{.amplitude = 0.2, .frequency = frequency};
    const auto compare = [&](const auto& load) {
      const auto by = [&](double tolerance) {
        return run(drive(table1(), load, Signal{{held}}, effects(GearViscous<double>{1e-4})), Timetable(0, 2, 0.05),
                   {0, {0.2, 0.5}, {}}, tight(taylor, tolerance));
      };
      const auto exact = by(1e-13);
      for (const double tolerance : {1e-6, 1e-8}) {
        const auto loose = by(tolerance);
        CAPTURE(frequency, tolerance);
        CHECK(loose.modes() == exact.modes());
        CHECK((loose.end.x - exact.end.x).cwiseAbs().maxCoeff() <= tolerance);
      }
    };
    compare(Signal{{swell}});
    compare(LoadSum{{swell}});
  }
}

TEST_CASE("a load whose law changes within a step is not stepped over") {
  for (double jump : {0.0, -0.05}) {
    const WormDrive<double, BentLoad> bent(GearMesh<double>(table1()), BentLoad{0.3, jump}, {}, constant(0.01));
    const auto r = run(bent, Timetable(0, 1, never), {0, {0, 1.0}, {}}, tight(taylor, 1e-12));
    // a parabola up to the bend, an oscillator or an exponential behind it
    const MeshParameters<double> p = table1();
    const Branch in(p, {Motion::forward, Flank::right});
    const double a = 0.01 / in.M, until = (std::sqrt(1.0 + 2.0 * a * 0.3) - 1.0) / a, v = 1.0 + a * until;
    const double stiff = 0.01 * in.C / in.M, push = (0.01 + in.C * jump) / in.M, s = 1.0 - until;
    const double w = std::sqrt(std::abs(stiff));
    const double x = stiff > 0.0 ? push / stiff * (1.0 - std::cos(w * s)) + v / w * std::sin(w * s)
                                 : -push / stiff * (std::cosh(w * s) - 1.0) + v / w * std::sinh(w * s);
    REQUIRE(r.events.empty());
    REQUIRE(r.end.mode == Mode{Motion::forward, Flank::right});
    REQUIRE(std::abs(r.end.x[0] - (0.3 + x)) <= 1e-9);
  }
}

TEST_CASE("the longest step ends where a law ends first, though the law holds again at the end") {
  REQUIRE(close(longest(1.0, [](double s) { return s <= 0.3 || s >= 0.9; }), 0.3, 1e-15));
  REQUIRE(longest(0.7, [](double) { return true; }) == 0.7);
  REQUIRE(longest(0.7, [](double) { return false; }) == 0.0);
}

TEST_CASE("a load whose law changes within a step and changes back is not stepped over") {
  // thrown against a constant torque, the wheel goes 0.125 rad beyond the bend and comes back
  const WormDrive<double, BentLoad> bent(GearMesh<double>::without_teeth(2.0), BentLoad{0.3, -3.0}, {},
                                         constant(-10.0));
  const auto end = [&](By by) { return run(bent, Timetable(0, 1, never), {0, {0.2, 1.5}, {}}, tight(by)).end.x; };
  REQUIRE((end(taylor) - end(adams)).cwiseAbs().maxCoeff() <= 1e-9);
}

TEST_CASE("friction after the standard's table is followed from piece to piece, through every reversal") {
  const auto by = [](By solver) {
    return run(drive(table1(), fig9_load(), fig9_motor(), effects(Agma<double>{})), Timetable(0, 2, never), {},
               tight(solver));
  };
  const auto series = by(taylor), cvode = by(adams);
  REQUIRE(series.modes() == cvode.modes());
  REQUIRE(series.events.size() == 12);
  for (std::size_t k = 0; k < series.events.size(); ++k)
    REQUIRE(std::abs(series.events[k].after.t - cvode.events[k].after.t) <= 1e-10);
  REQUIRE((series.end.x - cvode.end.x).cwiseAbs().maxCoeff() <= 1e-9);
}

TEST_CASE("short steps and late times leave the equations of core their rounding, and the run goes on") {
  const auto d = drive(table1(), fig9_load(), fig9_motor(), effects(TorqueGain<double>{0.1}));
  const auto free = run(d, Timetable(0, 2, never), {}, tight(taylor));
  SolverSettings short_steps = tight(taylor);
  short_steps.max_step = 1e-4;
  const auto short_ones = run(d, Timetable(0, 2, never), {}, short_steps);
  REQUIRE(short_ones.modes() == free.modes());
  REQUIRE((short_ones.end.x - free.end.x).cwiseAbs().maxCoeff() <= 1e-10);
  // 1500 periods later the phase is known to 1e-12 only
  const auto late = run(d, Timetable(1000, 1002, never), {1000.0, {0.0, 0.0}, {}}, tight(taylor, 1e-14));
  REQUIRE(late.modes() == free.modes());
  REQUIRE((late.end.x - free.end.x).cwiseAbs().maxCoeff() <= 1e-9);
}

/// How far a double is from the exact number, in units of its last place.
double units_off(double found, long double exact) {
  return static_cast<double>((found - exact) / (std::nextafter(std::abs(found), 2.0) - std::abs(found)));
}

TEST_CASE("sine and cosine are within one unit in the last place, whatever the angle and its quarter turn") {
  Deviation ulps;
  for (int k = 0; k < 200'000; ++k) {
    const double near = k % 7 == 0 ? (k % 4001) * (std::numbers::pi / 2) : 0.0;
    const double x = near + std::ldexp((k % 1999) - 999.5, k % 23 - 20);
    const auto [sine, cosine] = sine_and_cosine(x);
    ulps.add(units_off(sine, std::sin(static_cast<long double>(x))));
    ulps.add(units_off(cosine, std::cos(static_cast<long double>(x))));
  }
  REQUIRE(ulps <= 1.0);
}

TEST_CASE("sine and cosine of turns are within two units in the last place after any number of turns") {
  Deviation ulps;
  for (int k = 0; k < 200'000; ++k) {
    const double turns = std::ldexp((k % 1999) - 999.5, k % 43 - 23) + (k % 5) * 0.25;
    const auto [sine, cosine] = sine_and_cosine_of_turns(turns);
    const double quarters = std::round(4.0 * turns);
    const long double left = 0.5L * std::numbers::pi_v<long double> * (4.0 * turns - quarters);
    const int quarter = static_cast<int>(quarters - 4.0 * std::floor(0.25 * quarters));
    const std::array exact{std::sin(left), std::cos(left), -std::sin(left), -std::cos(left)};
    ulps.add(units_off(sine, exact[quarter]));
    ulps.add(units_off(cosine, exact[(quarter + 1) % 4]));
  }
  REQUIRE(ulps <= 2.0);
  for (int quarter = -4; quarter <= 4; ++quarter) {  // the axes are hit exactly
    const auto [sine, cosine] = sine_and_cosine_of_turns(0.25 * quarter + 1e9);
    REQUIRE(std::array{sine, cosine} == std::array{quarter % 2 == 0         ? 0.0
                                                   : (quarter + 4) % 4 == 1 ? 1.0
                                                                            : -1.0,
                                                   quarter % 2 != 0   ? 0.0
                                                   : quarter % 4 == 0 ? 1.0
                                                                      : -1.0});
  }
}

TEST_CASE("a polynomial falls through its root unless rounding decides between falling and touching") {
  const double falls[] = {0.3, -1.0, 0.5}, rises[] = {-0.02, 0.3, -1.0}, touches[] = {0.25 - 1e-17, -1.0, 1.0};
  REQUIRE(falls_through(falls, 1.0 - std::sqrt(0.4), 0.0, 0.0));
  REQUIRE(!falls_through(falls, 1.0 - std::sqrt(0.4), 1.0, 0.0));
  REQUIRE(!falls_through(rises, 0.1, 0.0, 0.0));
  REQUIRE(!falls_through(touches, 0.5 - 3e-9, 0.0, 0.0));
}

TEST_CASE("the first root of a polynomial is found where others follow, and none where it only comes near") {
  RootSearch search;
  const double both[] = {0.02, -0.3, 1.0};  // (s - 0.1)(s - 0.2)
  REQUIRE(std::abs(*search.first_root(both, 1.0) - 0.1) <= 1e-16);
  REQUIRE(!search.first_root(both, 0.09));
  const double near[] = {0.0225 + 1e-12, -0.3, 1.0};
  REQUIRE(!search.first_root(near, 1.0));
  // from the start root at 0 on it is positive, and falls through zero at 0.5
  const double leaves[] = {0.0, 0.5, -1.0};
  const auto later = search.first_fall(leaves, 1.0, false);
  REQUIRE((later.armed && std::abs(*later.at - 0.5) <= 1e-16));
  // below zero from the start: it counts only once it has been positive
  const double rises[] = {-0.02, 0.3, -1.0};
  const auto risen = search.first_fall(rises, 1.0, false);
  REQUIRE((risen.armed && std::abs(*risen.at - 0.2) <= 1e-15));
  const double below[] = {-1.0, 0.1};
  REQUIRE((!search.first_fall(below, 1.0, false).armed && !search.first_fall(below, 1.0, false).at));
}

}  // namespace wormdrive::test::events_taylor
