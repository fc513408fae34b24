#pragma once
#include <cmath>
#include <utility>

#include "core/elastic/compliant_energy.hpp"
#include "core/energy.hpp"
#include "events/growth.hpp"
#include "events/implicit_step.hpp"
#include "events/segment_start.hpp"

namespace wormdrive {

/// Steps of an integration that shares no code with the solvers, with the work of motor, load and losses alongside [J]:
/// the classical Runge-Kutta method of order 4, or an implicit one of order 5 where that is stiff.
template <class System>
class FineSteps {
 public:
  using Instant = typename System::Instant;
  static constexpr int finer = 20;  ///< how many times shorter than a step of the solver they are meant to be

  explicit FineSteps(const System& system) : system_(system) {}

  /// One step in as many parts as what settles or swings fastest takes, for the method has no Jacobian of its own.
  /// What settles within much less than a step of the solver has settled: there an implicit step goes on, halved until
  /// its equations are solved.
  void advance(Instant& now, double h, Power& work) const {
    constexpr double dear_as_implicit = 200.0;  // parts that cost about as much as an implicit step and more than that
    const auto [J, parts] = stiffest(now, h);
    if (parts <= dear_as_implicit) {
      for (double k = 0.0; k < parts; ++k) step(now, h / parts, work);
      return;
    }
    Power added = work;
    const auto add = [&](const Instant& at, double weight) { integrate(at, weight, added); };
    if (const auto x = implicit_step(system_, now, h, J, add)) {
      now.x = *x;
      now.t += h;
      work = added;
    } else {
      advance(now, h / 2, work);
      advance(now, h / 2, work);
    }
  }

 private:
  /// The Jacobian of a step from now on that takes most parts, and how many. With states of effects the equations may
  /// bend within the step, and be stiff behind that alone: one looks ahead.
  std::pair<typename System::Jacobian, double> stiffest(const Instant& now, double h) const {
    constexpr bool has_states = System::state_size > 2 * shaft_count<System>();
    // The method is stable up to 2.8; what effects remember it is to follow as well.
    constexpr double rate_in_a_part = has_states ? 1.0 / finer : 0.5;
    std::pair<typename System::Jacobian, double> most{system_.jacobian(now.t, now.x, now.mode), 1.0};
    const auto look = [&](const typename System::Jacobian& J) {
      // no eigenvalue is larger than the largest sum of a row, which costs next to nothing
      if (!J.allFinite() || h * J.cwiseAbs().rowwise().sum().maxCoeff() <= rate_in_a_part) return;
      const double parts = std::ceil(h * (has_states ? rate_of(J) : fastest_rate(J)) / rate_in_a_part);
      if (parts > most.second) most = {J, parts};
    };
    look(most.first);
    if constexpr (has_states) {
      const typename System::State rate = system_.derivative(now.t, now.x, now.mode);
      for (const double ahead : {0.5 * h, 1.1 * h}) {
        const typename System::State x = now.x + ahead * rate;
        if (x.allFinite()) look(system_.jacobian(now.t + ahead, x, now.mode));
      }
    }
    return most;
  }
  /// The fastest rate of a Jacobian [1/s]; that of the one before where they hardly differ, for eigenvalues cost more
  /// than a step.
  double rate_of(const typename System::Jacobian& J) const {
    constexpr double alike = 0.01;
    if (((J - rated_).array().abs() <= alike * rated_.array().abs()).all()) return rate_;
    rated_ = J;
    return rate_ = fastest_rate(J);
  }
  void integrate(const Instant& at, double weight, Power& work) const {
    const Power p = power(system_, at);
    work.motor += weight * p.motor;
    work.load += weight * p.load;
    work.loss += weight * p.loss;
  }

  /// One Runge-Kutta step.
  void step(Instant& now, double h, Power& work) const {
    const auto at = [&](double dt, const typename System::State& x) { return Instant{now.t + dt, x, now.mode}; };
    const auto f = [&](const Instant& i) { return system_.derivative(i.t, i.x, i.mode); };
    const Instant a = now;
    const typename System::State fa = f(a);
    const Instant b = at(h / 2, now.x + h / 2 * fa);
    const typename System::State fb = f(b);
    const Instant c = at(h / 2, now.x + h / 2 * fb);
    const typename System::State fc = f(c);
    const Instant d = at(h, now.x + h * fc);
    for (const auto& [instant, weight] : {std::pair{a, h / 6}, {b, h / 3}, {c, h / 3}, {d, h / 6}})
      integrate(instant, weight, work);
    now.x += h / 6 * (fa + 2 * fb + 2 * fc + f(d));
    now.t += h;
  }

  const System& system_;
  mutable typename System::Jacobian rated_ = System::Jacobian::Zero();  ///< the latest one whose eigenvalues were asked
  mutable double rate_ = 0.0;
};

}  // namespace wormdrive
