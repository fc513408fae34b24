#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "catch.hpp"
#include "core/signal.hpp"

namespace wormdrive::test::core_signals {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// The value just before t: the piece that ended there, followed up to it.
double left_limit(const Signal& signal, double t) {
  double last_knot = -1e6;
  for (double k = signal.next_knot(last_knot); k < t; k = signal.next_knot(k)) last_knot = k;
  return signal.piece(last_knot)(t);
}
double value(const Signal& signal, double t) { return signal.piece(t)(t); }

std::vector<double> knots(const Signal& signal, double from, double to) {
  std::vector<double> found;
  for (double k = signal.next_knot(from); k <= to; k = signal.next_knot(k)) found.push_back(k);
  return found;
}

}  // namespace

TEST_CASE("a signal without terms is zero and never changes") {
  REQUIRE(value(Signal{}, 3.0) == 0.0);
  REQUIRE(Signal{}.next_knot(-5.0) == never);
}

TEST_CASE("a constant has one value and no knot") {
  const Signal signal{{Constant{-0.3}}};
  REQUIRE(value(signal, -7.0) == -0.3);
  REQUIRE(signal.next_knot(0.0) == never);
}

TEST_CASE("a sinusoid runs in absolute time, whichever moment its piece was taken at") {
  const Signal signal{{Sinusoid{.amplitude = 0.05, .frequency = 1.5, .phase = std::numbers::pi / 2}}};
  REQUIRE(signal.next_knot(0.0) == never);
  for (double t : {0.0, 0.37, 1.9}) {
    const double expected = 0.05 * std::cos(3.0 * std::numbers::pi * t + std::numbers::pi / 2);
    REQUIRE(std::abs(value(signal, t) - expected) <= 1e-16);
    REQUIRE(signal.piece(0.0)(t) == signal.piece(1.1)(t));
  }
  REQUIRE(signal.piece(0.0).fastest() == 2.0 * std::numbers::pi * 1.5);
}

TEST_CASE("a step belongs to its own instant: zero to its left, the torque from it on") {
  const Signal signal{{Step{.torque = 2.0, .time = 0.3}}};
  REQUIRE(left_limit(signal, 0.3) == 0.0);
  REQUIRE(value(signal, 0.3) == 2.0);
  REQUIRE(value(signal, std::nextafter(0.3, 0.0)) == 0.0);
  REQUIRE(knots(signal, -1.0, 9.0) == std::vector<double>{0.3});
}

TEST_CASE("a ramp is continuous at both of its ends and is held where it ends") {
  const Signal signal{{Ramp{.rate = -4.0, .start = 0.1, .end = 0.7}}};
  REQUIRE(knots(signal, 0.0, 9.0) == std::vector<double>{0.1, 0.7});
  REQUIRE(value(signal, 0.0) == 0.0);
  REQUIRE(value(signal, 0.1) == 0.0);
  REQUIRE(std::abs(value(signal, 0.4) - -1.2) <= 1e-15);
  REQUIRE(std::abs(left_limit(signal, 0.7) - value(signal, 0.7)) <= 1e-15);
  REQUIRE(value(signal, 50.0) == -4.0 * (0.7 - 0.1));
}

TEST_CASE("a ramp without an end goes on, one that ends before it starts never leaves zero") {
  const Signal endless{{Ramp{.rate = 2.0}}};
  REQUIRE(endless.next_knot(0.0) == never);
  REQUIRE(value(endless, 1e6) == 2e6);
  const Signal reversed{{Ramp{.rate = 2.0, .start = 1.0, .end = 0.5}}};
  for (double t : {0.0, 0.7, 1.0, 2.0}) REQUIRE(value(reversed, t) == 0.0);
}

TEST_CASE("a piece of a ramp may be followed past its end, where the signal itself is held") {
  const Signal signal{{Ramp{.rate = 1.0, .start = 0.0, .end = 1.0}}};
  REQUIRE(signal.piece(0.5)(3.0) == 3.0);
  REQUIRE(value(signal, 3.0) == 1.0);
}

TEST_CASE("a staircase climbs once per knot though multiples of its interval round: 3 * 0.1 is not 0.3") {
  // floor(t/interval) at t = k interval is k or k - 1, as rounding falls; each of these intervals has such k.
  for (double interval : {0.1, 0.3, 0.7, 1.0 / 3.0, 1e-3, 0.0017})
    for (double start : {0.0, 0.1, -0.35}) {
      const Signal signal{{Staircase{.rise = 0.25, .interval = interval, .start = start}}};
      double before = start - interval;
      int wrong = 0;
      for (int k = 0; k < 3000; ++k) {
        const double knot = signal.next_knot(before);
        if (knot != start + k * interval) ++wrong;
        if (value(signal, knot) != 0.25 * (k + 1)) ++wrong;
        if (signal.piece(before)(knot) != 0.25 * k) ++wrong;
        if (value(signal, std::nextafter(knot, -never)) != 0.25 * k) ++wrong;
        before = knot;
      }
      REQUIRE(wrong == 0);
    }
}

TEST_CASE("a staircase of n steps has n knots and then holds") {
  const Signal signal{{Staircase{.rise = 1.0, .interval = 0.1, .start = 0.2, .steps = 3}}};
  REQUIRE(knots(signal, 0.0, 10.0) == std::vector<double>{0.2, 0.2 + 0.1, 0.2 + 2 * 0.1});
  REQUIRE(value(signal, 10.0) == 3.0);
  REQUIRE(Signal{{Staircase{.rise = 1.0, .interval = 0.1, .steps = 0}}}.next_knot(-1.0) == never);
}

TEST_CASE("held samples jump at their times and both ends are held") {
  const Signal signal{{Samples{.times = {0.0, 0.1, 0.4}, .values = {1.0, -2.0, 5.0}}}};
  REQUIRE(knots(signal, -1.0, 9.0) == std::vector<double>{0.0, 0.1, 0.4});
  REQUIRE(value(signal, -3.0) == 1.0);
  REQUIRE(left_limit(signal, 0.1) == 1.0);
  REQUIRE(value(signal, 0.1) == -2.0);
  REQUIRE(value(signal, 0.39) == -2.0);
  REQUIRE(left_limit(signal, 0.4) == -2.0);
  REQUIRE(value(signal, 8.0) == 5.0);
}

TEST_CASE("interpolated samples pass through every sample from both sides") {
  const Signal signal{
      {Samples{.times = {0.0, 0.1, 0.4}, .values = {1.0, -2.0, 5.0}, .interpolation = Interpolation::linear}}};
  REQUIRE(value(signal, 0.0) == 1.0);
  REQUIRE(std::abs(value(signal, 0.05) - -0.5) <= 1e-15);
  REQUIRE(std::abs(left_limit(signal, 0.1) - -2.0) <= 1e-15);
  REQUIRE(value(signal, 0.1) == -2.0);
  REQUIRE(std::abs(left_limit(signal, 0.4) - 5.0) <= 1e-14);
  REQUIRE(value(signal, 0.4) == 5.0);
  REQUIRE(value(signal, -1.0) == 1.0);
  REQUIRE(value(signal, 7.0) == 5.0);
}

TEST_CASE("a sum has the values of its terms and the knots of all of them, shared ones once") {
  const Signal signal{{Constant{0.5}, Ramp{.rate = 2.0, .start = 0.2, .end = 0.6}, Step{.torque = -1.0, .time = 0.6},
                       Sinusoid{.amplitude = 0.1, .frequency = 2.0}, Sinusoid{.amplitude = 0.2, .frequency = 7.0}}};
  REQUIRE(knots(signal, 0.0, 9.0) == std::vector<double>{0.2, 0.6});
  const auto waves = [](double t) {
    return 0.1 * std::cos(4.0 * std::numbers::pi * t) + 0.2 * std::cos(14.0 * std::numbers::pi * t);
  };
  REQUIRE(std::abs(value(signal, 0.0) - (0.5 + waves(0.0))) <= 1e-15);
  REQUIRE(std::abs(left_limit(signal, 0.6) - (0.5 + 0.8 + waves(0.6))) <= 1e-15);
  REQUIRE(std::abs(value(signal, 0.6) - (0.5 + 0.8 - 1.0 + waves(0.6))) <= 1e-15);
  REQUIRE(signal.piece(0.0).fastest() == 2.0 * std::numbers::pi * 7.0);
}

}  // namespace wormdrive::test::core_signals
