#pragma once
#include <array>

#include "bench/hybrid_by_hand.hpp"
#include "bench/plant.hpp"

namespace bench {

/// What all are measured against: power series of a high order in 128-bit numbers over steps so short that a sign
/// change of a root between their ends shows every event of these cases.
template <class Plant, int order>
class SeriesInQuad {
 public:
  using State = typename Plant::State;

  SeriesInQuad(Plant& plant, double step) : plant_(plant), step_(step) {}

  void restart(Quad t, const State& y, Quad) {
    State g{};
    plant_.roots(t, y.data(), g.data());
    for (int k : {0, 1}) armed_[k] = g[k] > 1e-25;  // what stands at zero has just fired
  }

  int advance(Quad& t, State& y, Quad end) {
    while (t < end) {
      const bool last = end - t <= step_;
      Quad h = last ? end - t : step_;
      expand(t, y);
      int fired = -1;
      for (int k : {0, 1}) {
        const Quad g = root(k, t, h);
        if (armed_[k] && g < 0) {
          h = bisect(k, t, h);
          fired = k;
        }
        armed_[k] = armed_[k] || g > 0;
      }
      y = {at(theta_, h), at(omega_, h)};
      t = last && fired < 0 ? end : t + h;
      if (fired >= 0) return fired;
    }
    return -1;
  }

 private:
  using Coefficients = std::array<Quad, order + 2>;

  void expand(Quad t, const State& y) {
    constexpr Case in = Plant::given;
    theta_[0] = y[0];
    omega_[0] = y[1];
    Quad sine = sin(y[0]), cosine = cos(y[0]);
    Coefficients sines{sine}, cosines{cosine};
    // successive derivatives of the motor torque over k!, of its cosine and its sine side by side
    Quad wave = plant_.motor_torque(t) - plant_.held;
    Quad quadrature = in.motor == 0.0 ? Quad(0) : Quad(in.motor) * sin(Quad(in.omega) * t + Quad(in.phase));
    for (int k = 0; k <= order; ++k) {
      if (k > 0) {
        sine = cosine = 0;
        for (int j = 0; j < k; ++j) {
          sine += omega_[j] * cosines[k - 1 - j];
          cosine -= omega_[j] * sines[k - 1 - j];
        }
        sines[k] = sine / k;
        cosines[k] = cosine / k;
        const Quad next = -in.omega * quadrature / k;
        quadrature = in.omega * wave / k;
        wave = next;
      }
      const Quad load = in.load_cosine * cosines[k] + in.load_sine * sines[k];
      theta_[k + 1] = omega_[k] / (k + 1);
      omega_[k + 1] = plant_.acceleration(plant_.mode, k == 0 ? wave + plant_.held : wave, load) / (k + 1);
    }
    ++plant_.evaluations;
  }
  static Quad at(const Coefficients& c, Quad s) {
    Quad sum = 0;
    for (int k = order + 1; k >= 0; --k) sum = sum * s + c[k];
    return sum;
  }
  Quad root(int k, Quad t, Quad s) const {
    const State y{at(theta_, s), at(omega_, s)};
    State g{};
    plant_.roots(t + s, y.data(), g.data());
    return g[k];
  }
  Quad bisect(int k, Quad t, Quad h) const {
    Quad low = 0, high = h;
    for (int halving = 0; halving < 110; ++halving) {
      const Quad middle = (low + high) / 2;
      (root(k, t, middle) > 0 ? low : high) = middle;
    }
    return high;
  }

  Plant& plant_;
  Quad step_;
  Coefficients theta_{}, omega_{};
  std::array<bool, 2> armed_{};
};

template <Case inputs, int order>
using InQuad = HybridByHand<Plant<inputs, Quad>, SeriesInQuad<Plant<inputs, Quad>, order>>;

}  // namespace bench
