#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>

#include <fmt/format.h>

#include "core/elastic/compliant_drive.hpp"
#include "core/elastic/compliant_start.hpp"
#include "core/elastic/elastic_teeth.hpp"
#include "description/build.hpp"
#include "events/simulate.hpp"
#include "events/solvers.hpp"
#include "near_ties/case.hpp"

namespace wormdrive::test::near_ties {

namespace {

Signal signal(const judge::Torque& torque) {
  using Kind = judge::Term::Kind;
  Signal sum;
  for (const judge::Term& term : torque) switch (term.kind) {
      case Kind::constant: sum.terms.push_back(Constant{term.size}); break;
      case Kind::step: sum.terms.push_back(Step{term.size, term.begin}); break;
      case Kind::ramp: sum.terms.push_back(Ramp{term.size, term.begin, term.end}); break;
      case Kind::sinusoid: sum.terms.push_back(Sinusoid{term.size, term.frequency, term.phase}); break;
    }
  return sum;
}

Effects<double> effects(const Case& tie) {
  const judge::Drive& d = tie.drive;
  Effects<double> on;
  const auto put = [&]<class Effect>(const Effect& effect) { std::get<std::optional<Effect>>(on.list) = effect; };
  if (const auto& e = d.torque_gain) put(TorqueGain<double>{*e});
  if (const auto& e = d.torque_offset) put(TorqueOffset<double>{*e});
  if (const auto& e = d.cogging) put(Cogging<double>{e->amplitude, e->periods, e->phase});
  if (const auto& e = d.worm_coulomb) put(WormCoulomb<double>{*e});
  if (const auto& e = d.worm_viscous) put(WormViscous<double>{*e});
  if (const auto& e = d.bearing_asymmetry) put(BearingAsymmetry<double>{e->torque, e->coefficient});
  if (const auto& e = d.stribeck) put(Stribeck<double>{e->drop, e->speed});
  if (const auto& e = d.friction_asymmetry) put(FrictionAsymmetry<double>{*e});
  if (const auto& e = d.static_friction) put(StaticFriction<double>{e->rise, e->growth_time});
  if (const auto& e = d.transmission_error) put(TransmissionError<double>{e->amplitude, e->phase});
  if (const auto& e = d.gear_coulomb) put(GearCoulomb<double>{*e});
  if (const auto& e = d.gear_viscous) put(GearViscous<double>{*e});
  if (const auto& e = d.load_spring) put(LoadSpring<double>{e->stiffness, e->angle});
  if (const auto& e = tie.elastic) {
    put(ToothCompliance<double>{e->stiffness, std::nullopt, e->damping});
    put(Backlash<double>{e->gap});
  }
  return on;
}

/// The case as the program's scenario, from which its drives are made.
Scenario scenario(const Case& tie, By by) {
  const judge::Drive& d = tie.drive;
  Scenario s;
  if (d.teeth)
    s.mesh = MeshParameters<double>{d.i, d.lambda, d.phi_n, d.lw, d.lg, d.mu, d.Jw, d.Jg};
  else
    s.mesh = SingleInertia<double>{d.Jg};
  s.effects = effects(tie);
  s.motor = signal(d.motor);
  s.initial = {d.theta, d.omega};
  s.run.duration = d.end;
  s.run.report_interval = tie.report;
  s.run.relative_tolerance = tie.tolerance;
  s.run.absolute_tolerance = absolute_tolerance(tie, by);
  s.run.solver = by == By::taylor ? SolverKind::taylor : SolverKind::cvode;
  s.run.method = by == By::adams ? Method::adams : Method::bdf;
  return s;
}

/// A controller that samples and holds nothing: every sample settles the mode anew.
struct Idle {
  template <class System>
  double sample(const System&, const typename System::Instant&) {
    return 0.0;
  }
};

Modes modes(Mode mode) { return {sign(mode.motion), sign(mode.flank), 0}; }
Modes modes(CompliantMode mode) { return {sign(mode.worm), sign(mode.contact), sign(mode.gear)}; }

/// What the last record of a time says against its own mode, by signs alone; records before it lie on a crossing.
template <class Drive>
std::string broken(const typename Drive::Instant& now) {
  if constexpr (Drive::state_size == 2) {
    const double speed = now.x[1];
    const int motion = sign(now.mode.motion);
    if (motion == 0 ? speed != 0.0 : motion * speed < 0.0 || !std::isfinite(speed))
      return fmt::format("at {:.17g} s motion {} at {:.17g} rad/s", now.t, motion, speed);
  }
  return {};
}

template <class Drive>
ProgramRun run_drive(Drive drive, const Scenario& s, const Case& tie) {
  ProgramRun result;
  Idle idle;
  const Sampling sampling = tie.sample > 0.0 ? Sampling{.period = tie.sample, .offset = tie.sample} : Sampling{};
  typename Drive::Instant start, last;
  bool first = true;
  if constexpr (Drive::state_size == 2) {
    start.x = {s.initial.theta_g, s.initial.omega_g};
  } else {
    drive.enter(0.0);
    start.x = carrying(drive, 0.0, s.initial.theta_g, s.initial.omega_g);
  }
  const auto record = [&](const Drive&, const typename Drive::Instant& now) {
    if (first) {
      result.start = modes(now.mode);
    } else if (last.t == now.t && !(last.mode == now.mode)) {
      result.changes.push_back({now.t, modes(last.mode), modes(now.mode)});
    }
    if (!first && now.t > last.t && result.broken.empty()) result.broken = broken<Drive>(last);
    first = false;
    last = now;
    const double report = now.t / tie.report, whole = std::round(report);
    const auto row = static_cast<std::size_t>(whole);
    if (std::abs(report - whole) > 1e-9) return;
    if (row >= result.reports.size()) result.reports.resize(row + 1);
    result.reports[row].assign(now.x.data(), now.x.data() + now.x.size());
  };
  try {
    with_solver(drive, s.run.solver_settings(), [&](auto& solver) {
      simulate(drive, solver, idle, Timetable(0.0, s.run.duration, s.run.rows_every(), sampling), start, record);
      result.steps = solver.statistics().steps;
    });
  } catch (const SimulationFailure& halt) {
    result.halt = halt.what();
  } catch (const std::exception& error) {
    result.broken = fmt::format("ends in an exception: {}", error.what());
  }
  if (result.halt.empty() && result.broken.empty()) result.broken = broken<Drive>(last);
  constexpr int gear = Drive::state_size - 2;
  result.theta = last.x[gear];
  result.omega = last.x[gear + 1];
  return result;
}

template <class Load>
ProgramRun run_with(const Scenario& s, const Load& load, const Case& tie) {
  if (!tie.elastic) return run_drive(make_drive(s, load, s.effects, s.motor), s, tie);
  return run_drive(CompliantDrive(make_drive(s, sum_of(load), s.effects, s.motor), tooth_contact(s.effects)), s, tie);
}

}  // namespace

double absolute_tolerance(const Case& tie, By by) {
  // a hundredth of the relative one is meant for speeds around 1 rad/s; taylor's is an error per second
  const double slower = std::max(1.0, tie.drive.end);
  return 0.01 * tie.tolerance / (by == By::taylor ? slower * slower : slower);
}

ProgramRun run(const Case& tie, By by) {
  const Scenario s = scenario(tie, by);
  if (!tie.drive.arm) return run_with(s, signal(tie.drive.load), tie);
  GravityArm arm;
  arm.amplitude = tie.drive.arm->amplitude;
  arm.offset = tie.drive.arm->offset;
  arm.own_inertia = tie.drive.arm->inertia;
  return run_with(s, arm, tie);
}

}  // namespace wormdrive::test::near_ties
