#include "near_ties/verdict.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "judge/shadow.hpp"

namespace wormdrive::test::near_ties {

namespace {

bool same_modes(const ProgramRun& a, const ProgramRun& b) {
  return a.start == b.start &&
         std::equal(a.changes.begin(), a.changes.end(), b.changes.begin(), b.changes.end(),
                    [](const Change& x, const Change& y) { return x.before == y.before && x.after == y.after; });
}

double largest_delay(const ProgramRun& a, const ProgramRun& b) {
  double delay = 0.0;
  for (std::size_t k = 0; k < a.changes.size(); ++k) delay = std::max(delay, std::abs(a.changes[k].t - b.changes[k].t));
  return delay;
}

/// The sizes of a torque's terms together [N m].
double largest(const judge::Torque& torque, double end) {
  double sum = 0.0;
  for (const judge::Term& term : torque) {
    const double per = term.kind == judge::Term::Kind::ramp ? std::min(term.end, end) - term.begin : 1.0;
    sum += std::abs(term.size) * std::max(per, 0.0);
  }
  return sum;
}

/// What the roundings that a judge allows the torques give the gear in a run, at most [rad/s].
double speed_by_roundings(const judge::Drive& drive) {
  const double worm = largest(drive.motor, drive.end) / (drive.i * drive.Jw), gear = largest(drive.load, drive.end);
  return judge::Shadow::rounding * std::max(worm, gear / drive.Jg) * drive.end;
}

/// By how much friction that decreases with speed lets a speed of the worm grow in a run, to first order: a start that
/// only rounding decides comes this far.
double growth_by_friction(const judge::Drive& d) {
  if (!d.stribeck || !d.teeth) return 1.0;
  const double normal_force = largest(d.load, d.end) / (d.lg * std::cos(d.lambda) * std::cos(d.phi_n));
  const double slope = d.stribeck->drop / d.stribeck->speed;  // of friction over the sliding speed, at most
  const double rate = normal_force * slope * d.lw * d.lw / std::cos(d.lambda) - d.worm_viscous.value_or(0.0);
  return std::exp(std::clamp(rate / d.Jw * d.end, 0.0, 100.0));
}

/// The largest difference between two motions of elastic teeth at their reports, of the angles as a share of the way
/// and of the speeds as one of the highest; worm and gear both counted at the gear.
double apart(const ProgramRun& a, const ProgramRun& b, const Case& tie) {
  if (a.reports.size() != b.reports.size()) return 1.0;
  // of angles and of speeds; every step may err by an absolute tolerance, and a thousand of these pass as a thousandth
  const double least = 1e4 * tie.tolerance / std::max(1.0, tie.drive.end);
  const double rounded =
      1e3 * speed_by_roundings(tie.drive) * growth_by_friction(tie.drive);  // as much passes likewise
  std::array<double, 2> size{std::max(least, rounded * tie.drive.end), std::max(least, rounded)}, difference{};
  for (std::size_t row = 0; row < a.reports.size(); ++row)
    for (std::size_t column = 0; column < a.reports[row].size(); ++column) {
      const double per = column < 2 ? tie.drive.i : 1.0, here = a.reports[row][column];
      const auto change = [&](double from) { return std::abs(here - from) / per; };
      size[column % 2] = std::max(size[column % 2], change(a.reports.front()[column]));
      difference[column % 2] = std::max(difference[column % 2], change(b.reports[row][column]));
    }
  double share = 0.0;
  for (const int kind : {0, 1}) share = std::max(share, difference[kind] / size[kind]);
  return share;
}

/// What lies a little beyond what is allowed may be the solver's own error, which falls with its tolerance; a decision
/// that is wrong lies far beyond.
constexpr double a_little = 8.0;
Case finer(Case tie) {
  tie.tolerance *= 0.1;
  return tie;
}

/// Whether two solvers of elastic teeth come closer to each other with a finer tolerance.
bool converge(const Case& tie, double share) {
  const Case fine = finer(tie);
  return apart(run(fine, By::bdf), run(fine, By::adams), fine) < 0.5 * share;
}

judge::Mode rigid(const Modes& modes) { return {modes[0], modes[1]}; }

struct Contradiction {
  std::string what;  ///< empty if there is none
  double excess;     ///< how many times as much as is allowed
};
Contradiction contradiction(const Case& tie, By by, const ProgramRun& run, long most_steps) {
  std::vector<judge::Event> events;
  for (const Change& change : run.changes) events.push_back({change.t, rigid(change.before), rigid(change.after)});
  const double slower = std::max(1.0, tie.drive.end),
               per_second = by == By::taylor ? 10.0 * tie.tolerance * slower : 0.0;
  judge::Exactness exactness{.relative = 1e-9 + per_second, .absolute = 1e-11 / slower};
  // in every step CVODE may err by its absolute tolerance: all there is to an angle that a short motion has left near 0
  if (by != By::taylor) exactness.angle = static_cast<double>(run.steps) * absolute_tolerance(tie, by);
  judge::Shadow shadow(tie.drive, exactness, most_steps);
  const std::string what = shadow.contradiction(rigid(run.start), events);
  return {what, shadow.excess()};
}

}  // namespace

Judgement judgement(const Case& tie, bool judged) {
  std::vector<By> solvers{By::bdf, By::adams};
  if (!tie.elastic) solvers.push_back(By::taylor);
  std::vector<ProgramRun> runs;
  for (const By by : solvers) {
    runs.push_back(run(tie, by));
    if (!runs.back().broken.empty()) return {Verdict::silent, fmt::format("{}: {}", name(by), runs.back().broken)};
  }
  for (std::size_t k = 0; k < runs.size(); ++k)
    if (!runs[k].halt.empty()) return {Verdict::halt, fmt::format("{}: {}", name(solvers[k]), runs[k].halt)};

  const bool same = std::all_of(runs.begin(), runs.end(), [&](const ProgramRun& r) { return same_modes(r, runs[0]); });
  if (tie.elastic) {
    if (same && largest_delay(runs[0], runs[1]) <= 1e-6 * tie.drive.end) return {Verdict::agree};
    // Friction that is only just overcome moves a shaft by nothing, a contact that is missed by a lot. In between lies
    // what a hundred impacts make of a rounding.
    const double share = apart(runs[0], runs[1], tie);
    constexpr double most = 1e-3;
    if (share <= most || (share <= a_little * most && converge(tie, share))) return {Verdict::rounding};
    return {Verdict::silent, fmt::format("elastic teeth: motions differ by {:.3g}", share)};
  }
  if (same && !judged) return {Verdict::not_judged};
  for (std::size_t k = 0; k < runs.size(); ++k) {
    try {
      const long most_steps = same ? 6000 : 200'000;
      const auto [what, excess] = contradiction(tie, solvers[k], runs[k], most_steps);
      if (what.empty()) continue;
      const Case fine = finer(tie);
      if (excess <= a_little) {
        const ProgramRun again = run(fine, solvers[k]);
        const bool sound = again.halt.empty() && again.broken.empty();  // a halted run contradicts nothing behind it
        if (sound && contradiction(fine, solvers[k], again, most_steps).what.empty()) continue;
      }
      return {Verdict::silent, fmt::format("{}: {}", name(solvers[k]), what)};
    } catch (const judge::GivesUp&) {
      if (same) return {Verdict::not_judged};
      return {Verdict::undecided, "lists differ, and the judge would have taken too long"};
    }
  }
  return {same ? Verdict::agree : Verdict::rounding};
}

}  // namespace wormdrive::test::near_ties
