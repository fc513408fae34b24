#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/worm_drive.hpp"
#include "diagnosis/predictor/flight.hpp"
#include "diagnosis/predictor/restitution.hpp"
#include "diagnosis/rules/noise.hpp"
#include "events/rest.hpp"
#include "events/short_step_solver.hpp"
#include "events/simulate.hpp"
#include "events/taylor/nominal/flow.hpp"

namespace wormdrive {

/// A drive as the predictor follows it from sample to sample. In contact it is the rigid one. With backlash the teeth
/// part where the rigid drive would change its flank; then both shafts fly free until the teeth meet again, bounce, and
/// at last stay together.
template <class Load>
class DriveWithBacklash {
 public:
  using Drive = WormDrive<double, Load>;
  using Instant = typename Drive::Instant;

  struct State {
    Instant now;                  ///< of the gear; its mode holds in contact
    Flank contact = Flank::none;  ///< that carries; none in the gap, and always without backlash
    ShaftState worm{};            ///< in the gap [rad, rad/s], counted at the gear: divided by the ratio
    double parts_at = never;      ///< when an impact ends [s]
    double parting{};             ///< speed of the gear against the worm then [rad/s]
  };

  /// gap: backlash [rad]; compliance: of the teeth [m/N].
  DriveWithBacklash(Drive drive, double gap, double compliance, const Restitution& impact)
      : drive_(std::move(drive)),
        half_(0.5 * gap),
        compliance_(compliance),
        bounce_(impact),
        nominal_(drive_),
        solver_(drive_, never) {}
  DriveWithBacklash(const DriveWithBacklash&) = delete;
  DriveWithBacklash& operator=(const DriveWithBacklash&) = delete;

  Drive& drive() { return drive_; }
  const Drive& drive() const { return drive_; }
  /// What the gear's encoder shows [rad]: the gear turns on by what the teeth yield.
  double measured_angle(const State& s) const {
    if (compliance_ == 0.0 || flies(s)) return drive_.measured_angle(s.now);
    return drive_.effects().measured_angle(s.now.x[0] + wind_up(s.now));
  }
  bool at_rest(const State& s) const { return !flies(s) && Drive::at_rest(s.now.mode); }

  /// The worm, counted at the gear.
  ShaftState worm(const State& s) const {
    if (flies(s)) return s.worm;
    const Transmission<double> turned = drive_.effects().transmission(s.now.x[0]);
    return {turned.angle - sign(s.contact) * half_, turned.slope * s.now.x[1]};
  }

  /// The state in which the gear stands here and the worm there; the inputs are those of the time.
  State at(double t, const ShaftState& gear, const ShaftState& worm) const {
    State s;
    s.now.t = t;
    s.now.x = {gear.angle, gear.speed};
    s.worm = worm;
    const double separation = drive_.effects().transmission(gear.angle).angle - worm.angle;
    if (std::abs(separation) >= (1.0 - 1e-9) * half_) s.contact = separation > 0.0 ? Flank::left : Flank::right;
    return s;
  }
  /// The state in contact with the flank that carries; the inputs are those of the time.
  State at(double t, const ShaftState& gear) const {
    State s;
    s.now.t = t;
    s.now.x = {gear.angle, gear.speed};
    s.now.mode = drive_.settle(s.now);
    if (half_ > 0.0) s.contact = carrying(s);
    return s;
  }

  /// Moves both shafts: what an observer finds out.
  void shift(State& s, double angle, double speed) const {
    s.now.x[0] += angle;
    s.now.x[1] += speed;
    s.worm.angle += angle;
    s.worm.speed += speed;
  }

  /// Runs to an end over which inputs that are not known beforehand are held.
  void run(State& s, double end) {
    settle(s);
    int events = 0;
    for (double knot = drive_.next_knot(s.now.t);;) {
      const double stop = std::min({end, knot, s.parts_at});
      if (!already_there(s.now.t, stop) && advance(s, stop)) {
        if (++events > rules::most_events_of_a_sample) throw SolverFault("too many events within one sample");
        continue;
      }
      s.now.t = stop;
      if (stop == s.parts_at) part(s);
      if (stop == end) return;
      drive_.enter(stop);
      knot = drive_.next_knot(stop);
      settle(s);
    }
  }

 private:
  static constexpr double never = std::numeric_limits<double>::infinity();

  bool flies(const State& s) const { return half_ > 0.0 && s.contact == Flank::none; }

  /// The flank that carries, or goes on to: against which gear and worm would accelerate each other without teeth.
  Flank carrying(const State& s) const {
    if (s.now.mode.motion != Motion::stuck) return s.now.mode.flank;
    const double closing = free_flight(drive_, s.now.t, {s.now.x[0], 0.0}, worm(s), 0.0).closing_acceleration();
    return closing > 0.0 ? Flank::left : closing < 0.0 ? Flank::right : s.contact;
  }

  /// How far the teeth yield to what they carry [rad at the gear].
  double wind_up(const Instant& now) const {
    const Observation seen = drive_.observe(now);
    const double side = now.mode.motion == Motion::stuck ? std::copysign(1.0, seen.tau_l) : sign(now.mode.flank);
    return side * seen.normal_force * compliance_ / drive_.mesh().gear_arm(0.0);
  }

  /// The mode after inputs or state were set from outside, or after an event in contact.
  void settle(State& s) {
    if (flies(s)) return;
    if (!goes_on_by_formula(s.now)) s.now.mode = solver_.settle(s.now);
    part_where_another_carries(s);
  }
  void part_where_another_carries(State& s) const {
    if (half_ > 0.0 && s.parts_at == never && carrying(s) != s.contact) part(s);
  }
  /// The teeth leave each other with the speed that an impact has left them.
  void part(State& s) const {
    s.worm = worm(s);
    const Flank flank = std::exchange(s.contact, Flank::none);
    push(s, flank, -sign(flank) * s.parting);
    s.parts_at = never;
    s.parting = 0.0;
  }
  /// Changes the speed of the gear against the worm by an impulse between their teeth, friction taken in [rad/s].
  void push(State& s, Flank flank, double change) const {
    const Motion motion = s.worm.speed == 0.0 ? Motion::stuck : s.worm.speed > 0.0 ? Motion::forward : Motion::backward;
    const auto at = drive_.moment(s.now.t, s.now.x[0], s.now.x[1]);
    const GearMesh<double>& mesh = drive_.mesh();
    const double share = mesh.C(drive_.signed_friction(at, {motion, flank})) * drive_.Jg() / (mesh.Jw * mesh.i);
    s.now.x[1] += change / (1.0 + share);
    s.worm.speed -= share * change / (1.0 + share);
  }

  /// To the next event or to the stop; whether there was an event.
  bool advance(State& s, double stop) {
    if (flies(s)) return fly(s, stop);
    int guard;
    if (Drive::at_rest(s.now.mode)) {
      s.now.x[1] = 0.0;
      guard = rest_until(s.now, stop);
    } else if (leaps(s.now, stop)) {
      return false;
    } else {
      solver_.restart(s.now);
      guard = solver_.advance(s.now, stop, stop);
    }
    if (guard == no_guard) return false;
    s.now = drive_.jump(s.now, guard);
    part_where_another_carries(s);
    return true;
  }

  /// Asks the formulas of the nominal motion, which cost less than short steps; false where there are none.
  template <class Ask>
  bool by_formula(const Instant& now, const Ask& ask) {
    if constexpr (NominalFlow<Drive>::known) {
      if (!nominal_.covers() || now.mode.motion == Motion::stuck) return false;
      nominal_.begin(now);
      return ask(nominal_);
    }
    return false;
  }
  bool goes_on_by_formula(const Instant& now) {
    const bool goes_on = by_formula(now, [&](auto& nominal) { return nominal.goes_on(now); });
    if (goes_on) solver_.forget();
    return goes_on;
  }
  bool leaps(Instant& now, double stop) {
    return by_formula(now, [&](auto& nominal) { return nominal.leap(now, stop, accuracy_); });
  }

  /// Rests until released. A torque that is held is constant, or approaches what is held as its lag decays: margins
  /// that are positive at both ends are so between, and no search in steps of the lag is needed.
  int rest_until(Instant& now, double stop) {
    Instant then = now;
    then.t = stop;
    const auto holds = [this](const Instant& at) {
      const auto margins = drive_.guards(drive_.moment(at), at.mode);
      return std::all_of(margins.begin(), margins.end(), [](double m) { return m > 0.0; });
    };
    if (drive_.load().fastest() > 0.0 || !holds(now) || !holds(then))
      return Rest<Drive>{}.advance(drive_, now, stop, stop);
    now.t = stop;
    return no_guard;
  }

  /// Through the gap to the next impact or to the stop; whether there was an impact.
  bool fly(State& s, double stop) {
    ShaftState gear{s.now.x[0], s.now.x[1]};
    const FreeFlight flight = free_flight(drive_, s.now.t, gear, s.worm, stop - s.now.t);
    const double separation = drive_.effects().transmission(gear.angle).angle - s.worm.angle;
    const auto impact = flight.impact(separation, half_);
    const double h = impact ? impact->after : flight.duration;
    flight.gear.move(gear, h);
    flight.worm.move(s.worm, h);
    s.now.t = impact ? s.now.t + h : stop;
    s.now.x = {gear.angle, gear.speed};
    if (impact) meet(s, *impact, sign(impact->flank) * flight.closing_acceleration());
    return impact.has_value();
  }

  /// The teeth of a flank meet and move on together, until they part again unless what presses them together
  /// [rad/s^2] makes the next bounce a short one.
  void meet(State& s, const Impact& impact, double pressing) {
    const double parting = bounce_.restitution * impact.speed;
    push(s, impact.flank, -sign(impact.flank) * impact.speed);
    s.contact = impact.flank;
    if (2.0 * parting >= rules::shortest_bounce * pressing) {
      s.parting = parting;
      s.parts_at = s.now.t + bounce_.duration;
    }
    settle(s);
  }

  Drive drive_;
  double half_, compliance_;
  Restitution bounce_;
  NominalFlow<Drive> nominal_;
  TaylorAccuracy accuracy_{SolverSettings{.relative_tolerance = rules::predictor_tolerance}};
  ShortStepSolver<Drive> solver_;
};

}  // namespace wormdrive
