#include "core/numbers/series.hpp"

#include <cmath>
#include <type_traits>

#include "catch.hpp"
#include "core/numbers/rounded.hpp"
#include "support.hpp"

namespace wormdrive::test::core_series {

namespace {

constexpr int order = 8;
using Flow = Series<double, order>;

Deviation largest_difference(const Flow& a, const Flow& b) {
  Deviation worst;
  for (int k = 0; k <= order; ++k) worst.add(a[k] - b[k]);
  return worst;
}

Flow with(std::initializer_list<double> coefficients) {
  Flow x;
  int k = 0;
  for (double c : coefficients) x[k++] = c;
  return x;
}

/// Coefficients with their rounding.
Series<Rounded, 3> known(std::initializer_list<Rounded> coefficients) {
  Series<Rounded, 3> x;
  int k = 0;
  for (const Rounded& c : coefficients) x[k++] = c;
  return x;
}

}  // namespace

TEST_CASE("sine and cosine of the variable have the derivatives of sine and cosine over k!") {
  const double x0 = 0.7;
  const Flow sine = sin(Flow::variable(x0)), cosine = cos(Flow::variable(x0));
  const double turn[] = {std::sin(x0), std::cos(x0), -std::sin(x0), -std::cos(x0)};
  double factorial = 1.0;
  for (int k = 0; k <= order; ++k) {
    if (k > 0) factorial *= k;
    REQUIRE(std::abs(sine[k] - turn[k % 4] / factorial) <= 1e-16);
    REQUIRE(std::abs(cosine[k] - turn[(k + 1) % 4] / factorial) <= 1e-16);
  }
}

TEST_CASE("sine of a composed series: sin(s + s^2) begins s + s^2 - s^3/6 - s^4/2 - 59/120 s^5") {
  const Flow x = with({0.0, 1.0, 1.0});
  const Flow sine = sin(x);
  const double expected[] = {0.0, 1.0, 1.0, -1.0 / 6.0, -0.5, -59.0 / 120.0};
  for (int k = 0; k <= 5; ++k) REQUIRE(std::abs(sine[k] - expected[k]) <= 1e-15);
  REQUIRE(largest_difference(sin(x) * sin(x) + cos(x) * cos(x), Flow(1.0)) <= 1e-15);
}

TEST_CASE("the exponential of the variable is e^x0/k!, and that of a sum the product of the exponentials") {
  const Flow e = exp(Flow::variable(0.7));
  double factorial = 1.0;
  for (int k = 0; k <= order; ++k) {
    if (k > 0) factorial *= k;
    REQUIRE(std::abs(e[k] - std::exp(0.7) / factorial) <= 1e-15);
  }
  const Flow a = with({0.3, -2.0, 0.7, 1.0, 1.0}), b = with({-0.5, 0.2, 0.0, 3.0});
  REQUIRE(largest_difference(exp(a + b), exp(a) * exp(b)) <= 1e-14);
}

TEST_CASE("products truncate and quotients undo them") {
  REQUIRE(largest_difference(with({1.0, 1.0}) * with({1.0, 1.0}), with({1.0, 2.0, 1.0})) <= 0.0);
  REQUIRE(largest_difference(Flow(1.0) / with({1.0, -1.0}), with({1, 1, 1, 1, 1, 1, 1, 1, 1})) <= 0.0);
  const Flow a = with({0.3, -2.0, 0.7, 4.0, 1.0}), b = with({-1.5, 0.2, 0.0, 3.0});
  REQUIRE(largest_difference(a / b * b, a) <= 1e-14);
  REQUIRE(largest_difference(a - a, Flow(0.0)) <= 0.0);
  REQUIRE(largest_difference(-a + a, Flow(0.0)) <= 0.0);
}

TEST_CASE("series compare by their present value alone") {
  REQUIRE(with({1.0, 9.0}) <= with({1.0, -9.0}));
  REQUIRE(with({1.0, 9.0}) >= with({1.0, 10.0}));
  REQUIRE_FALSE(with({1.0, 9.0}) < with({1.0, 10.0}));
  REQUIRE(with({2.0, -9.0}) > with({1.0, 9.0}));
}

TEST_CASE("the sign just after now is that of the first coefficient that is more than rounding") {
  REQUIRE(sign_just_after(known({{-1e-3, 1e-16}, {1.0, 1e-16}}), 0.0) == -1);
  REQUIRE(sign_just_after(known({{0.0, 0.0}, {-2.0, 0.0}, {5.0, 0.0}}), 0.0) == -1);
  REQUIRE(sign_just_after(known({{1e-17, 1e-16}, {-1.0, 1e-16}}), 0.0) == -1);
  REQUIRE(sign_just_after(known({{-1e-17, 1e-16}, {1.0, 1e-16}}), 0.0) == 1);
  REQUIRE(sign_just_after(known({{1e-10, 1e-16}, {-1.0, 1e-16}}), 0.0) == 1);
  // whatever the time scale: a torque of a day, of a millisecond
  REQUIRE(sign_just_after(known({{1e-12, 1e-16}, {-7e-5, 1e-20}}), 0.0) == 1);
  REQUIRE(sign_just_after(known({{1e-12, 1e-16}, {-6e3, 1e-12}}), 0.0) == 1);
}

TEST_CASE("a surface that is touched and not crossed has the sign of its curvature") {
  // a dip of rate^2/(4 curvature) = 2.5e-17 below zero, less than the rounding of the value; one of 2.5e-13
  REQUIRE(sign_just_after(known({{0.0, 1e-16}, {-1e-8, 1e-16}, {1.0, 1e-16}}), 0.0) == 1);
  REQUIRE(sign_just_after(known({{0.0, 1e-16}, {-1e-6, 1e-16}, {1.0, 1e-16}}), 0.0) == -1);
}

TEST_CASE(
    "a swing that rounding all but hides is over by its rate or by nothing, never by the term that brings it back") {
  const double rounding = 1e-16;
  for (const double blurs : {0.3, 0.5, 0.8, 1.0, 1.3, 1.6, 2.0, 10.0, 1e6})
    for (const double omega : {1e-5, 1.0, 1e3, 1e9}) {
      const double amplitude = blurs * 8.0 * rounding;
      Series<Rounded, 3> x;  // amplitude sin(omega t), whose acceleration is rounding
      x[0] = {0.0, rounding};
      x[1] = {amplitude * omega, 1e-16 * amplitude * omega};
      x[2] = {0.0, 0.5 * omega * omega * rounding};
      x[3] = {-amplitude * omega * omega * omega / 6.0, 1e-16 * omega * omega * omega * amplitude};
      INFO("amplitude " << blurs << " of what is not known, at " << omega << " rad/s");
      REQUIRE(sign_just_after(x, 0.0) >= 0);
      if (blurs >= 2.0) REQUIRE(sign_just_after(x, 0.0) == 1);
      x = -x;
      REQUIRE(sign_just_after(x, 0.0) <= 0);
    }
}

TEST_CASE("what a value changes within the resolution of time does not count as its sign") {
  REQUIRE(sign_just_after(known({{1e-12, 0.0}, {-1.0, 0.0}}), 1e-11) == -1);
  REQUIRE(sign_just_after(known({{1e-10, 0.0}, {-1.0, 0.0}}), 1e-11) == 1);
}

TEST_CASE("what starts and goes ever faster has begun, however coarsely its time is known") {
  for (const double sign : {1.0, -1.0}) {
    Series<Rounded, 4> x;  // as a speed whose friction falls within 1e-9 s
    x[1] = {sign, 1e-16};
    x[2] = {sign * 1e9, 1e-7};
    x[3] = {-sign * 1e18, 1e2};
    x[4] = {-sign * 1e26, 1e10};
    REQUIRE(sign_just_after(x, 1e-6) == static_cast<int>(sign));
    x[2] = -x[2];  // an event's time may be early or late: the rate is the sign
    x[3] = x[4] = {0.0, 0.0};
    REQUIRE(sign_just_after(x, 1e-6) == -static_cast<int>(sign));
  }
}

TEST_CASE("a constant acts on a series as the series of that constant does") {
  Series<double, 3> x;
  x.c = {0.7, -1.3, 2.1, 0.4};
  const double k = 1.7;
  const Series<double, 3> constant(k);
  REQUIRE((x * k).c == (x * constant).c);
  REQUIRE((k * x).c == (constant * x).c);
  REQUIRE((x / k).c == (x / constant).c);
  REQUIRE((x + k).c == (x + constant).c);
  REQUIRE((k + x).c == (constant + x).c);
  REQUIRE((x - k).c == (x - constant).c);
  REQUIRE((k - x).c == (constant - x).c);
}

TEST_CASE("an open series has the coefficients of one of its order, whatever it was known to before") {
  // as the equations use it: the variable, what grows from term to term, constants and parameters
  const auto formula = [](const auto& t, const auto& x) {
    using S = std::decay_t<decltype(x)>;
    S r = 0.3 * sin(2.0 * t + 0.4) * x - exp(-x / 1.7) / (S(2.0) + cos(x)) + at_least(x, 0.1) * x / 3.0;
    r -= S(0.2) * t;
    return -r + (1.0 - x) * 0.7;
  };
  Flow x(0.8);
  OpenSeries<double> open(0.8);
  auto t = OpenSeries<double>::variable(0.2, 0);
  for (int k = 0; k < order; ++k) {
    const double a = formula(Flow::variable(0.2), x)[k];
    const OpenSeries<double> found = formula(t, open);
    CHECK(found[k] == a);
    CHECK(found.last == k);
    x[k + 1] = a / (k + 1);
    t.know(k + 1);
    open.append(k + 1, found[k] / (k + 1));
  }
  const Flow closed = formula(Flow::variable(0.2), x);
  const OpenSeries<double> opened = formula(t, open);
  for (int k = 0; k <= order; ++k) CHECK(opened[k] == closed[k]);
  for (int k = order + 1; k <= highest_series; ++k) CHECK(opened[k] == 0.0);
}

TEST_CASE("a series that is rounding to its last term has no sign, one with nothing but its last term has that one's") {
  REQUIRE(sign_just_after(known({{1e-17, 1e-16}, {-1e-17, 1e-16}}), 0.0) == 0);
  Series<Rounded, 3> last;
  last[3] = {-1e-30, 1e-40};
  REQUIRE(sign_just_after(last, 0.0) == -1);
}

TEST_CASE("the rounding that a number is said to carry holds the error that it has") {
  // a difference of nearly equal cosines, at large times: known from the sum-to-product identity
  for (const double t : {0.3, 1e2, 1e5}) {
    const double w = 3.0, dw = 1e-9 * w;
    const Rounded found = cos(Rounded(w) * Rounded(t)) - cos(Rounded(w + dw) * Rounded(t));
    const double exact = 2.0 * std::sin((w + 0.5 * dw) * t) * std::sin(0.5 * ((w + dw) - w) * t);
    REQUIRE(std::abs(found.value - exact) <= found.rounding);
    REQUIRE(found.rounding <= 1e-15 * (1.0 + w * t));
  }
}

}  // namespace wormdrive::test::core_series
