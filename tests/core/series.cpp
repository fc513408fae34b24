#include "core/series.hpp"

#include <cmath>

#include "catch.hpp"
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

TEST_CASE("the sign just after now is that of the first coefficient that outlasts an instant") {
  const double instant = 1e-11;
  REQUIRE(sign_just_after(with({-1e-3, 1.0}), instant) == -1);
  REQUIRE(sign_just_after(with({0.0, -2.0, 5.0}), instant) == -1);
  REQUIRE(sign_just_after(with({0.0, 0.0, 3.0}), instant) == 1);
  REQUIRE(sign_just_after(with({0.0, 0.0, 0.0, -3.0}), instant) == -1);
}

TEST_CASE("rounding left over from an event does not decide the sign just after it") {
  const double instant = 1e-11;
  // a value of 1e-17 that falls at 1 per second is gone after 1e-17 s, long before anything mechanical happens
  REQUIRE(sign_just_after(with({1e-17, -1.0}), instant) == -1);
  REQUIRE(sign_just_after(with({-1e-17, 1.0}), instant) == 1);
  REQUIRE(sign_just_after(with({1e-10, -1.0}), instant) == 1);
  // a touch: value and rate are rounding, the curvature decides
  REQUIRE(sign_just_after(with({-1e-24, 1e-16, -4.0}), instant) == -1);
}

TEST_CASE("a series that is zero to its last term has no sign, one with nothing but its last term has that one's") {
  REQUIRE(sign_just_after(Flow(0.0), 1e-11) == 0);
  Flow last;
  last[order] = -1e-30;
  REQUIRE(sign_just_after(last, 1e-11) == -1);
}

}  // namespace wormdrive::test::core_series
