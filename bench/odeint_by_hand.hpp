#pragma once
#include <algorithm>
#include <array>
#include <cmath>

#include <boost/numeric/odeint.hpp>

#include "bench/sundials_by_hand.hpp"

namespace bench {

/// Boost.odeint's controlled steps, with events found by repeating the step in which a root changes sign.
template <class Plant, template <class...> class Formula>
class OdeintByHand {
 public:
  using State = typename Plant::State;

  OdeintByHand(Plant& plant, double tolerance)
      : plant_(plant),
        controlled_(boost::numeric::odeint::make_controlled<Stepper>(absolute_part * tolerance, tolerance)) {}

  void restart(double t, const State& y, double) {
    forget(controlled_);
    plant_.roots(t, y.data(), g_.data());
  }

  int advance(double& t, State& y, double end) {
    while (t < end) {
      const State from = y;
      const std::array<double, 2> before = g_;
      const double begin = t, left = end - t;
      bool last = step_ >= left;
      double h = last ? left : step_;
      while (controlled_.try_step(rate(), y, t, h) == boost::numeric::odeint::fail) last = false;
      step_ = last ? std::max(step_, h) : h;
      if (last) t = end;
      plant_.roots(t, y.data(), g_.data());
      int fired = -1;
      for (int k : {0, 1}) {
        if (before[k] <= 0.0 || g_[k] >= 0.0) continue;
        step_to_root(k, begin, from, before[k], t, y);
        plant_.roots(t, y.data(), g_.data());
        fired = k;
      }
      if (fired >= 0) return fired;
    }
    return -1;
  }

 private:
  using Stepper = Formula<State>;
  using Controlled = typename boost::numeric::odeint::result_of::make_controlled<Stepper>::type;

  auto rate() {
    return [this](const State& y, State& out, double t) { plant_.derivative(t, y.data(), out.data()); };
  }
  /// What a formula keeps of its last step, some do.
  template <class S>
  static void forget(S& stepper) {
    if constexpr (requires { stepper.reset(); }) stepper.reset();
  }

  /// Replaces the step from begin to t by the shorter one that ends behind the root (regula falsi, Illinois).
  void step_to_root(int k, double begin, const State& from, double at_begin, double& t, State& y) {
    std::array<double, 2> g{};
    plant_.roots(t, y.data(), g.data());
    double a = 0.0, ga = at_begin, b = t - begin, gb = g[k];
    State then = y;
    for (int side = 0; gb != 0.0 && b - a > 1e-15;) {
      double c = (a * gb - b * ga) / (gb - ga);
      if (c <= a || c >= b) c = 0.5 * (a + b);
      forget(formula_);
      formula_.do_step(rate(), from, begin, then, c);
      plant_.roots(begin + c, then.data(), g.data());
      if (g[k] > 0.0) {
        a = c, ga = g[k];
        if (side > 0) gb *= 0.5;
        side = 1;
      } else {
        b = c, gb = g[k], y = then;
        if (side < 0) ga *= 0.5;
        side = -1;
      }
    }
    t = begin + b;
  }

  Plant& plant_;
  Controlled controlled_;
  Stepper formula_;
  double step_ = 1e-3;
  std::array<double, 2> g_{};
};

}  // namespace bench
