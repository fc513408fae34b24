#pragma once

namespace wormdrive::test {

/// x a step of h later, by the method of Runge and Kutta of order 4 with fixed steps; rates(t, x) is x'.
template <class State, class Rates>
State runge_kutta(const Rates& rates, double t, const State& x, double h) {
  const State a = rates(t, x), b = rates(t + 0.5 * h, x + 0.5 * h * a), c = rates(t + 0.5 * h, x + 0.5 * h * b),
              d = rates(t + h, x + h * c);
  return x + h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
}

}  // namespace wormdrive::test
