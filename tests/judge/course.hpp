#pragma once
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "judge/equations.hpp"
#include "judge/zeros.hpp"

namespace judge {

/// A case that takes the judge too many steps to be judged.
struct GivesUp : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The motion of a drive in a given mode as power series: everything but the decisions.
template <class Real>
class EventSequence {
 public:
  using Polynomial = std::vector<Real>;

  double entered = 0.0;                 ///< from when on the present inputs hold [s]
  Real t = 0, theta, omega, since = 0;  ///< since: when the gear came to rest [s]

  explicit EventSequence(const Drive& drive, long most_steps = 6000)
      : theta(drive.theta),
        omega(drive.omega),
        drive_(drive),
        equations_(drive),
        exact_(drive),
        most_steps_(most_steps) {
    for (int sigma : {1, -1})
      for (int flank : {1, -1}) {
        auto& moving = moving_[sigma > 0][flank > 0];
        auto& resting = resting_[sigma > 0][flank > 0];
        write(moving, sigma, flank, false);
        write(resting, sigma, flank, true);
      }
  }

  /// Inputs are those behind their knots at entered, until the next one.
  void enter(double at) { entered = at; }
  double next_knot() const {
    return std::min(judge::next_knot(drive_.motor, entered), judge::next_knot(drive_.load, entered));
  }

  /// The motion from now on: speed, distance from the switching surface, and for how long they hold.
  struct Ahead {
    Polynomial theta, omega, beyond;
    Real step;
  };
  Ahead ahead(Mode mode, Real longest) {
    Expression& e = moving_[mode.motion > 0][mode.flank >= 0];
    take_inputs(e);
    auto &angle = e.tape[e.theta], &speed = e.tape[e.omega];
    angle[0] = theta;
    speed[0] = omega;
    for (int k = 0; k <= order; ++k) {
      e.tape.expand(k);
      if (k == order) break;
      angle[k + 1] = speed[k] / (k + 1);
      speed[k + 1] = e.tape[e.acceleration][k] / (k + 1);
    }
    Ahead found{list(angle), list(speed), list(e.tape[e.beyond]), longest};
    shorten(found.step, found.omega);
    if (drive_.teeth) shorten(found.step, found.beyond);
    keep_small_exponentials(e, found.step);
    count();
    return found;
  }

  /// At rest: what would pull the gear in a direction, on each flank; it starts where both have the direction's sign.
  struct Resting {
    Polynomial pull[2];
    Real step;
  };
  Resting resting(int sigma, Real longest) {
    Resting found{{}, longest};
    for (int flank : {1, -1}) {
      Expression& e = resting_[sigma > 0][flank > 0];
      take_inputs(e);
      e.tape[e.theta][0] = theta;
      e.tape[e.rest][0] = t - since;
      e.tape[e.rest][1] = 1;
      for (int k = 0; k <= order; ++k) e.tape.expand(k);
      found.pull[flank > 0] = list(e.tape[e.pull]);
      shorten(found.step, found.pull[flank > 0]);
    }
    count();
    return found;
  }

  /// What the torques come to now, with the sizes of what they are made of.
  Outcome<Sized> now(int sigma, int flank, bool at_rest, Real angle, Real speed) const {
    Circumstances<Sized> at{sized(drive_.motor), sized(drive_.load), Sized(angle), Sized(speed)};
    if (at_rest) at.rest = Sized(Quad(t - since));
    return exact_(at, sigma, flank);
  }

  const Drive& drive() const { return drive_; }

 private:
  static constexpr int order = Tape<Real>::order;
  using Value = typename Tape<Real>::Value;
  struct Expression {
    Tape<Real> tape;
    Value motor{}, load{}, theta{}, omega{}, rest{}, pull{}, beyond{}, acceleration{};
  };

  void write(Expression& e, int sigma, int flank, bool at_rest) {
    e.motor = e.tape.input();
    e.load = e.tape.input();
    e.theta = e.tape.input();
    e.omega = e.tape.input();
    e.rest = e.tape.input();
    Circumstances<Value> at{e.motor, e.load, e.theta, e.omega};
    if (at_rest) at.rest = e.rest;
    const Outcome<Value> outcome = equations_(at, sigma, flank);
    e.pull = outcome.pull;
    e.beyond = outcome.beyond;
    e.acceleration = outcome.pull / outcome.inertia;
  }
  void take_inputs(Expression& e) const {
    fill(e.tape[e.motor], drive_.motor);
    fill(e.tape[e.load], drive_.load);
  }
  /// A sinusoid's frequency and phase are the doubles that are given, and so is every knot.
  void fill(typename Tape<Real>::Series& series, const Torque& torque) const {
    series.fill(Real(0));
    for (const Term& term : torque) {
      const Real size = term.size, begin = term.begin, end = term.end;
      switch (term.kind) {
        case Term::Kind::constant: series[0] += size; break;
        case Term::Kind::step:
          if (entered >= term.begin) series[0] += size;
          break;
        case Term::Kind::ramp:
          if (entered < term.begin) break;
          if (entered >= term.end) {
            series[0] += size * (end - begin);
          } else {
            series[0] += size * (t - begin);
            series[1] += size;
          }
          break;
        case Term::Kind::sinusoid: {
          const Real rate = term.rate(), at = rate * t + Real(term.phase), even = cos(at), odd = -sin(at);
          Real factor = size;
          for (int k = 0; k <= order; ++k) {
            series[k] += factor * (k % 2 == 0 ? even : odd) * (k % 4 < 2 ? 1 : -1);
            factor = factor * rate / (k + 1);
          }
          break;
        }
      }
    }
  }
  Sized sized(const Torque& torque) const {
    Sized sum(0);
    for (const Term& term : torque) {
      const Quad size = term.size, begin = term.begin, end = term.end, at = t;
      const double seconds = std::abs(static_cast<double>(t)) + std::abs(term.begin);
      switch (term.kind) {
        case Term::Kind::constant: sum = sum + Sized(size); break;
        case Term::Kind::step:
          if (entered >= term.begin) sum = sum + Sized(size);
          break;
        case Term::Kind::ramp:
          if (entered < term.begin) break;
          sum = sum + (entered >= term.end ? Sized(size * (end - begin))
                                           : Sized(size * (at - begin), std::abs(term.size) * seconds));
          break;
        case Term::Kind::sinusoid:
          sum = sum + Sized(size * cos(Quad(term.rate()) * at + Quad(term.phase)),
                            std::abs(term.size) * (1.0 + std::abs(term.rate()) * seconds + std::abs(term.phase)));
          break;
      }
    }
    return sum;
  }

  static Polynomial list(const typename Tape<Real>::Series& series) { return {series.begin(), series.end()}; }
  /// Until where the rest of a series is nothing beside it.
  static void shorten(Real& step, const Polynomial& c) {
    const auto rest = [&](Real h) {
      Real power = 1;
      for (int k = 0; k < order - 1; ++k) power *= h;
      return (abs(c[order - 1]) + abs(c[order]) * h) * power > Real(Precision<Real>::rest) * bound(c, h);
    };
    while (rest(step)) step *= Real(0.7);
  }
  /// An exponential that is too small to show in the sums above has either to stay so or to be followed itself.
  static void keep_small_exponentials(const Expression& e, Real& step) {
    for (const auto& [value, of] : e.tape.exponentials()) {
      const Polynomial x = list(e.tape[of]);
      const auto grows = [&](Real h) { return x[0] - abs(x[0]) + bound(x, h) > Real(-80); };
      Real followed = e.tape[value][0] > 0 ? step : Real(0), unseen = step;  // 0 where it is below all numbers
      shorten(followed, list(e.tape[value]));
      while (followed < unseen && grows(unseen)) unseen *= Real(0.7);
      step = std::max(followed, unseen);
    }
  }
  void count() {
    if (++steps_ > most_steps_) throw GivesUp("too many steps");
  }

  Drive drive_;
  Equations<Real> equations_;
  Equations<Quad> exact_;
  Expression moving_[2][2], resting_[2][2];
  long steps_ = 0, most_steps_;
};

}  // namespace judge
