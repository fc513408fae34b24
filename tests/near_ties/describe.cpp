#include <fmt/format.h>

#include "near_ties/verdict.hpp"

namespace wormdrive::test::near_ties {

namespace {

std::string describe(const judge::Torque& torque) {
  using Kind = judge::Term::Kind;
  std::string text;
  for (const judge::Term& term : torque) switch (term.kind) {
      case Kind::constant: text += fmt::format(" {:.17g}", term.size); break;
      case Kind::step: text += fmt::format(" + {:.17g} from {:.17g} s", term.size, term.begin); break;
      case Kind::ramp:
        text += fmt::format(" + {:.17g} N m/s from {:.17g} to {:.17g} s", term.size, term.begin, term.end);
        break;
      case Kind::sinusoid:
        text += fmt::format(" + {:.17g} cos(2 pi {:.17g} t + {:.17g})", term.size, term.frequency, term.phase);
        break;
    }
  return text;
}

}  // namespace

std::string describe(const Case& tie) {
  const judge::Drive& d = tie.drive;
  std::string text = fmt::format("{}, excess {:.3g}; {:.6g} s, report {:.17g}, sample {:.17g}\n", tie.tie, tie.excess,
                                 d.end, tie.report, tie.sample);
  if (d.teeth)
    text += fmt::format("  i {} lambda {:.17g} phi_n {:.17g} lw {:.17g} lg {:.17g} mu {:.17g} Jw {:.17g} Jg {:.17g}\n",
                        d.i, d.lambda, d.phi_n, d.lw, d.lg, d.mu, d.Jw, d.Jg);
  else
    text += fmt::format("  no teeth, J {:.17g}\n", d.Jg);
  text += fmt::format("  start {:.17g} rad {:.17g} rad/s\n  motor{}\n  load{}\n ", d.theta, d.omega, describe(d.motor),
                      describe(d.load));
  if (d.arm)
    text += fmt::format(" arm {:.17g} offset {:.17g} J {:.17g}", d.arm->amplitude, d.arm->offset, d.arm->inertia);
  const auto effect = [&](const char* name, const std::optional<double>& e) {
    if (e) text += fmt::format(" {} {:.17g}", name, *e);
  };
  effect("torque_gain", d.torque_gain);
  effect("torque_offset", d.torque_offset);
  effect("worm_coulomb", d.worm_coulomb);
  effect("worm_viscous", d.worm_viscous);
  effect("gear_coulomb", d.gear_coulomb);
  effect("gear_viscous", d.gear_viscous);
  effect("friction_asymmetry", d.friction_asymmetry);
  if (const auto& e = d.cogging) text += fmt::format(" cogging {:.17g} {} {:.17g}", e->amplitude, e->periods, e->phase);
  if (const auto& e = d.bearing_asymmetry)
    text += fmt::format(" bearing_asymmetry {:.17g} {:.17g}", e->torque, e->coefficient);
  if (const auto& e = d.stribeck) text += fmt::format(" stribeck {:.17g} {:.17g}", e->drop, e->speed);
  if (const auto& e = d.static_friction)
    text += fmt::format(" static_friction {:.17g} {:.17g}", e->rise, e->growth_time);
  if (const auto& e = d.load_spring) text += fmt::format(" load_spring {:.17g} {:.17g}", e->stiffness, e->angle);
  if (const auto& e = d.transmission_error)
    text += fmt::format(" transmission_error {:.17g} {:.17g}", e->amplitude, e->phase);
  if (const auto& e = tie.elastic)
    text += fmt::format(" elastic {:.17g} {:.17g} gap {:.17g}", e->stiffness, e->damping, e->gap);
  return text + "\n";
}

std::string describe(const ProgramRun& run) {
  std::string text = fmt::format("  ({},{},{})", run.start[0], run.start[1], run.start[2]);
  constexpr std::size_t most = 24;
  for (std::size_t k = 0; k < run.changes.size() && k < most; ++k) {
    const Change& change = run.changes[k];
    text += fmt::format(" {:.15g}: ({},{},{})", change.t, change.after[0], change.after[1], change.after[2]);
  }
  if (run.changes.size() > most) text += fmt::format(" ... {} in all", run.changes.size());
  return text + fmt::format(" ends at {:.12g} rad, {:.6g} rad/s\n", run.theta, run.omega);
}

}  // namespace wormdrive::test::near_ties
