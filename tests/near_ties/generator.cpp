#include "near_ties/generator.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "judge/judge.hpp"
#include "near_ties/random_drive.hpp"

namespace wormdrive::test::near_ties {

namespace {

using judge::constant, judge::ramp, judge::sinusoid, judge::step;

/// A case in the making.
struct Maker {
  Dice dice;
  Scale scale;
  Case made;
  double beyond;  ///< the factor by which what touches goes too far

  judge::Drive& drive() { return made.drive; }
  double frequency() const { return 1.0 / scale.time; }
  double phase() { return dice.chance(0.5) ? 0.5 * std::numbers::pi * dice.below(4) : dice.between(-3, 3); }
  int direction() { return dice.chance(0.5) ? 1 : -1; }
  double load() { return scale.load * dice.sign() * (dice.chance(0.3) ? 1.0 : dice.between(0.2, 1.0)); }
  /// A motor torque that matters [N m]: where C1 = 0 one of the break-in torques is nothing but rounding.
  double torque(double at_load) const {
    return std::max(std::abs(break_in(made.drive, 1, at_load)), std::abs(break_in(made.drive, -1, at_load)));
  }
  /// A break-in torque, or where it is rounding one that matters.
  double matters(double to, double at_load) {
    const double size = torque(at_load);
    return std::abs(to) > 1e-6 * size ? to : size * dice.sign();
  }
  bool follows_angle() const {
    const judge::Drive& d = made.drive;
    return !d.teeth || d.Jw * d.i > 0.01 * scale.load * scale.time * scale.time / d.i;
  }
  /// What is the same in every drive: a load, over time or of an arm, that is this one at the start.
  double hold(double torque) {
    if (!made.elastic && follows_angle() && dice.chance(0.3)) {
      const double offset = dice.between(-1.2, 1.2), amplitude = torque / std::cos(offset);
      drive().arm = judge::GravityArm{amplitude, offset, dice.chance(0.5) ? 0.0 : 0.3 * drive().Jg};
      if (drive().teeth) drive().Jg *= 0.7;
    } else {
      drive().load = {constant(torque)};
    }
    return torque;
  }
};

/// The factor 1 + excess for an excess of 0, an ulp, or 1e-15 ... 1e-6, to either side.
double some_factor(Dice& dice) {
  const double side = dice.sign();
  switch (dice.below(4)) {
    case 0: return 1.0;
    case 1: return std::nextafter(1.0, side > 0.0 ? 2.0 : 0.0);
    default: return 1.0 + side * std::pow(10.0, -6 - dice.below(10));
  }
}

void torque_touches_break_in(Maker& m) {
  const int direction = m.direction();
  const double load = m.hold(m.load()), to = break_in(m.drive(), direction, load), size = m.torque(load);
  const bool alone = m.dice.chance(0.4) && std::abs(to) > 1e-6 * size;
  const double level = alone ? 0.0 : to - direction * size * m.dice.between(0.01, 1.5);
  m.drive().motor = {constant(level), sinusoid((to - level) * m.beyond, m.frequency(), m.phase())};
}

void load_touches_break_in(Maker& m) {
  const double most = m.load(), level = most * (m.dice.chance(0.3) ? 0.0 : m.dice.between(-1, 0.9));
  m.drive().motor = {constant(break_in(m.drive(), m.direction(), most))};
  m.drive().load = {constant(level), sinusoid((most - level) * m.beyond, m.frequency(), m.phase())};
}

void motor_steps_to_break_in(Maker& m) {
  const double load = m.hold(m.load()), to = break_in(m.drive(), m.direction(), load), T = m.scale.time;
  const double size = m.torque(load), from = size * m.dice.between(-0.5, 0.9), then = size * m.dice.between(-2.0, 2.0);
  m.drive().motor = {constant(from), step((to - from) * m.beyond, T * m.dice.between(0.1, 1)),
                     step(then - to, T * m.dice.between(1.5, 3))};
}

void ramp_ends_at_break_in(Maker& m) {
  const double load = m.hold(m.load()), to = break_in(m.drive(), m.direction(), load) * m.beyond, T = m.scale.time;
  const double begin = m.dice.chance(0.5) ? 0.0 : 0.25 * T, end = begin + T * (m.dice.chance(0.5) ? 1.0 : 0.37);
  const double further = m.dice.between(-1, 1) * m.torque(load);
  m.drive().motor = {ramp(to / (end - begin), begin, end), step(further, T * m.dice.between(1.5, 3))};
}

void starts_on_the_boundary(Maker& m) {
  const double load = m.hold(m.load()), T = m.scale.time, size = m.torque(load);
  m.drive().motor = {constant(break_in(m.drive(), m.direction(), load) * m.beyond)};
  switch (m.dice.below(3)) {
    case 0: m.drive().motor.push_back(ramp(size / T * m.dice.sign() * m.dice.decades(1e-12, 1), 0.0, 2.0 * T)); break;
    case 1:
      m.drive().motor.push_back(
          sinusoid(size * m.dice.sign() * m.dice.decades(1e-12, 1), m.frequency(), -std::numbers::pi / 2));
      break;
    case 2: break;
  }
  if (m.dice.chance(0.3)) m.drive().motor.push_back(step(size * m.dice.between(-0.5, 0.5), T));
}

void surface_is_touched(Maker& m) {
  judge::Drive& d = m.drive();
  if (!d.teeth) return torque_touches_break_in(m);
  const int direction = m.direction();
  d.worm_viscous.reset();
  d.gear_viscous.reset();
  const double load = m.load(), to = surface(d, direction, load) * m.beyond, level = to * m.dice.between(-0.5, 0.9);
  d.load = {constant(load)};
  d.motor = {constant(level), sinusoid(to - level, m.frequency(), m.phase())};
  d.omega = direction * m.dice.decades(0.01, 10.0) / m.scale.time;
}

void zero_together(Maker& m) {
  const double phase = m.dice.chance(0.5) ? -std::numbers::pi / 2 : m.dice.between(-3, 3), load = m.load();
  const double kappa = m.dice.chance(0.5) ? m.dice.between(-3, 3) : break_in(m.drive(), m.direction(), load) / load;
  m.drive().motor = {sinusoid(kappa * load * m.beyond, m.frequency(), phase)};
  m.drive().load = {sinusoid(load, m.frequency(), phase)};
}

/// Pulses of a thousandth part and less of the time in which everything else changes.
void pulses_on_slow_inputs(Maker& m) {
  const double T = m.scale.time, load = m.load(), small = m.dice.decades(1e-9, 0.3);
  m.drive().load = {constant(load), sinusoid(small * load, m.frequency() * m.dice.decades(1e-3, 1.0), m.phase())};
  const double level = m.matters(break_in(m.drive(), m.direction(), load), load);
  m.drive().motor = {constant(level * m.dice.between(-0.5, 0.99))};
  double t = T * m.dice.between(0.05, 0.3);
  for (int k = m.dice.below(3); k >= 0; --k) {
    const double width = T * m.dice.decades(1e-9, 1e-2), pulse = level * m.dice.sign() * m.dice.between(0.5, 4.0);
    m.drive().motor.push_back(step(pulse, t));
    m.drive().motor.push_back(step(-pulse, t + width));
    t += width + T * m.dice.decades(1e-4, 0.3);
  }
}

void random_inputs(Maker& m) {
  judge::Drive& d = m.drive();
  const double T = m.scale.time, load = m.hold(m.load()), level = m.matters(break_in(d, m.direction(), load), load);
  d.motor = {constant(level * m.dice.between(-0.5, 1.2)),
             sinusoid(level * m.dice.between(0.1, 3), m.frequency(), m.phase())};
  if (m.dice.chance(0.4)) d.motor.push_back(step(level * m.dice.between(-2, 2), T * m.dice.between(0.1, 2)));
  if (m.dice.chance(0.3)) d.motor.push_back(ramp(level / T * m.dice.between(-2, 2), 0.3 * T, T));
  if (m.dice.chance(0.3)) d.motor.push_back(sinusoid(level * m.dice.between(0, 1), 3.1 * m.frequency(), m.phase()));
  if (!d.arm && m.dice.chance(0.4))
    d.load.push_back(sinusoid(load * m.dice.between(0, 2), 0.7 * m.frequency(), m.phase()));
  if (m.dice.chance(0.5)) d.omega = m.dice.sign() * m.dice.decades(1e-3, 1.0) / T;
}

using Extended = judge::Judge<long double>;
std::vector<judge::Mode> modes_of(const judge::Drive& drive) {
  Extended judge(drive);
  std::vector<judge::Mode> sequence;
  for (const auto& event : judge.run()) sequence.push_back(event.after);
  sequence.push_back(judge.start);
  return sequence;
}

/// Random inputs of which one number is where the sequence of events changes: speed, surface, break-in, or two of them.
void sequence_changes(Maker& m) {
  random_inputs(m);
  judge::Drive& d = m.drive();
  double& number = d.omega != 0.0 && m.dice.chance(0.5) ? d.omega : d.motor[m.dice.below(2)].size;
  double low = number, high = number;
  try {
    const auto here = modes_of(d);
    for (int k = 0; k < 8 && modes_of(d) == here; ++k) number = high = low * (1.0 + 0.02 * (k + 1) * (k + 1));
    for (int k = 0; k < 60; ++k) {
      const double middle = low + 0.5 * (high - low);
      if (middle == low || middle == high) break;
      number = middle;
      (modes_of(d) == here ? low : high) = middle;
    }
  } catch (const judge::GivesUp&) {
  }
  number = low * m.beyond;
}

/// Random inputs where a report, a sample or a knot falls on an event.
void event_meets(Maker& m) {
  random_inputs(m);
  judge::Drive& d = m.drive();
  double t = m.scale.time;
  try {
    Extended judge(d);
    const auto& events = judge.run();
    if (!events.empty()) t = events[m.dice.below(static_cast<int>(events.size()))].t;
  } catch (const judge::GivesUp&) {
  }
  t *= m.beyond;
  switch (m.dice.below(3)) {
    case 0: m.made.report = std::max(t, 1e-3 * d.end) / (1 + m.dice.below(3)); break;
    case 1: m.made.sample = std::max(t, 1e-3 * d.end) / (1 + m.dice.below(3)); break;
    case 2: d.motor.push_back(step(d.motor[0].size * m.dice.between(-1, 1), t)); break;
  }
}

struct Tie {
  const char* name;
  void (*place)(Maker&);
  double share;
};
constexpr Tie ties[] = {{"torque touches break-in", torque_touches_break_in, 3},
                        {"load touches break-in", load_touches_break_in, 2},
                        {"motor steps to break-in", motor_steps_to_break_in, 1},
                        {"ramp ends at break-in", ramp_ends_at_break_in, 1},
                        {"starts on the boundary", starts_on_the_boundary, 2},
                        {"surface is touched", surface_is_touched, 2},
                        {"zero together", zero_together, 2},
                        {"pulses on slow inputs", pulses_on_slow_inputs, 2},
                        {"sequence changes", sequence_changes, 4},
                        {"event meets report, sample or knot", event_meets, 3}};

}  // namespace

Case make_case(std::uint64_t seed, std::uint64_t index) {
  Dice dice(seed, index);
  const bool elastic = dice.chance(0.08);
  Maker m{
      dice, {elastic ? dice.decades(1e-3, 0.1) : dice.decades(1e-4, 1e6), dice.decades(0.01, 10.0), elastic}, {}, 1.0};
  m.beyond = some_factor(m.dice);
  m.drive() = random_drive(m.dice, m.scale);
  m.drive().end = m.scale.time * m.dice.between(1.5, 4.0);
  m.made.report = m.drive().end / (1 + m.dice.below(40));
  if (elastic) {
    const judge::Drive& d = m.drive();
    const double stiffness = m.scale.load / d.lg * m.dice.decades(1e3, 1e5);
    m.made.elastic = Elastic{stiffness, stiffness * m.scale.time * m.dice.decades(1e-4, 1e-2),
                             m.dice.chance(0.3) ? 0.0 : m.dice.decades(1e-5, 1e-2)};
  }
  double total = 0.0;
  for (const Tie& tie : ties) total += tie.share;
  double left = m.dice.between(0, total);
  const Tie* chosen = ties;
  while (left >= chosen->share) left -= (chosen++)->share;
  m.made.tie = chosen->name;
  m.made.excess = m.beyond - 1.0;
  chosen->place(m);
  return m.made;
}

}  // namespace wormdrive::test::near_ties
