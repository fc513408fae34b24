#include <algorithm>
#include <array>
#include <cmath>
#include <exception>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "catch.hpp"
#include "core/states/starting_state.hpp"
#include "description/build.hpp"
#include "events/taylor/series.hpp"
#include "numbers.hpp"
#include "scenarios/random_effects.hpp"
#include "support.hpp"

// Equations that are recorded where a step begins have the series that they have with a series for a scalar.

namespace wormdrive::test::scenarios_traced_motion {

namespace {

using System = SumDriveWithStates;
using Motion = SeriesFlow<System>::Motion;
constexpr int order = 14;

/// What became of the moments of many runs.
struct Compared {
  long moments = 0, ties = 0, remain = 0, branches = 0;
  Deviation apart, away;
};

/// What a quantity is made of that changes over h [s]: of what cancels in it and in its rate, whose rounding the terms
/// of a decay by a rate [1/s] make greater.
double made_of(const Series<Rounded, 1>& x, double h, double decay) {
  return std::max(x[0].rounding, x[1].rounding * h) / Rounded::unit * std::exp(decay * h);
}

/// Adds the largest deviation of two series over h [s], as a share of their largest term, or of their parts.
template <class Found, class Expected>
void compare(Deviation& apart, const Found& found, const Expected& expected, double h, double parts) {
  double size = 0.0, most = 0.0, power = 1.0;
  for (int k = 0; k <= order; ++k, power *= h) {
    size = std::max(size, std::abs(expected[k]) * power);
    most = std::max(most, std::abs(found[k] - expected[k]) * power);
  }
  if (most > 0.0) apart.add(most / std::max(size, parts));
}

/// The largest deviation of the equations themselves from a series on its way over h [s], beyond what the tolerances
/// let pass, as a share of what they are made of.
Deviation deviation(const System& drive, const System::Instant& now, const Motion& e,
                    const MomentOfEffects<Series<Rounded, 1>>& rounded, double h, const TaylorAccuracy& accuracy) {
  Deviation away;
  const auto add = [&](double found, const Coefficients& c, const Series<Rounded, 1>& start, double s) {
    double rate = 0.0;
    const double size = start[1].rounding / Rounded::unit;
    for (int k = order; k >= 1; --k) rate = rate * s + k * c[k];
    const double excess = std::abs(found - rate) - accuracy.allowed(c[0]);
    if (!(excess <= 0.0)) away.add(excess / std::max(size, std::abs(found)));
  };
  for (int k = 1; k <= 16; ++k) {
    const double s = h * k / 16;
    System::Instant then = now;
    then.t = now.t + s;
    then.x = SeriesFlow<System>::state_after(e, s);
    const auto at = drive.moment(then);
    const auto rates = drive.state_rates(at, now.mode);
    add(drive.acceleration(at, now.mode), e.omega, rounded.omega_g, s);
    for (std::size_t j = 0; j < rates.size(); ++j) add(rates[j], e.states[j], rounded.states[j], s);
  }
  return away;
}

void look(Compared& all, const System& drive, const System::Instant& now, const TaylorAccuracy& accuracy) {
  TracedMotion<System> traced;
  ++all.moments;
  if (!traced.begin(drive, now)) {
    ++all.ties;
    return;
  }
  Motion e;
  traced.extend(8, e);
  traced.extend(order, e);
  const double h = 0.5 * accuracy.step(e, 1.0);  // in the middle of which nothing but a branch fails
  const auto at = drive.ahead(now, order + 1);
  const auto rounded = drive.ahead<1, Rounded>(now);
  const auto guards = drive.guards(at, now.mode);
  const auto rounded_guards = drive.guards(rounded, now.mode);
  const double fastest = drive.jacobian(now.t, now.x, now.mode).diagonal().cwiseAbs().maxCoeff();
  const auto parts = [&](const Series<Rounded, 1>& x) { return made_of(x, h, fastest); };
  compare(all.apart, e.theta, at.theta_g, h, std::max(parts(rounded.theta_g), parts(rounded.omega_g) * h));
  compare(all.apart, e.omega, at.omega_g, h, parts(rounded.omega_g));
  for (std::size_t k = 0; k < e.states.size(); ++k)
    compare(all.apart, e.states[k], at.states[k], h, parts(rounded.states[k]));
  for (std::size_t g = 0; g < e.guards.size(); ++g)
    compare(all.apart, e.guards[g], guards[g], h, parts(rounded_guards[g]));

  const Deviation away = deviation(drive, now, e, rounded, h, accuracy);
  if (traced.remain(h)) {
    ++all.remain;
    all.away.add(away.size);
  } else if (!(away <= 1e-6)) {
    ++all.branches;
  }
}

}  // namespace

TEST_CASE("traced equations have the series of core, and know where no branch of theirs is met") {
  const TaylorAccuracy accuracy({.relative_tolerance = 1e-10, .absolute_tolerance = 1e-12});
  Compared all;
  for (std::uint64_t trial = 0; trial < 60; ++trial) {
    near_ties::Dice dice(20261129, trial);
    const DrawnDrive drawn = draw_effects(dice);
    INFO(trial << ": " << fmt::format("{}", fmt::join(drawn.words, " ")));
    const auto scenario = unless_it_jams(drawn, {"run.solver=taylor"});
    if (!scenario) continue;
    auto drive = make_drive<true>(*scenario);
    drive.enter(0.0);
    System::Instant start;
    start.x = starting_state(drive, scenario->initial, 0.0);
    TaylorSolver<System> solver(drive, scenario->run.solver_settings());
    simulate(drive, solver, Timetable(0.0, scenario->run.duration, scenario->run.duration / 40.0), start,
             [&](const System& d, const System::Instant& now) { look(all, d, now, accuracy); });
  }
  INFO(all.moments << " moments, " << all.ties << " ties, " << all.remain << " remain, " << all.branches
                   << " branches, apart " << all.apart << ", away " << all.away);
  CHECK(all.apart <= 1e-13);
  CHECK(all.away <= 1e-9);
  CHECK(all.ties < all.moments / 20);
  CHECK(all.remain > all.moments / 4);
  CHECK(all.branches > 50);
}

}  // namespace wormdrive::test::scenarios_traced_motion
