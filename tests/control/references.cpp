#include <cmath>
#include <numbers>

#include "catch.hpp"
#include "control/reference.hpp"
#include "support.hpp"

// Reference trajectories: speed and acceleration are the derivatives of the angle, and the angle is what was asked for.

namespace wormdrive::test::control_references {

namespace {

constexpr double pi = std::numbers::pi;

/// Largest deviation of speed and acceleration from central differences, relative to their size, between two times.
template <class Term>
Deviation derivatives(const Term& term, double from, double to) {
  const Reference reference{{term}};
  const double h = 1e-5;
  Deviation worst;
  for (int k = 1; k < 500; ++k) {
    const double t = from + (to - from) * k / 500.0;
    const ReferencePoint before = reference.at(t - h), now = reference.at(t), after = reference.at(t + h);
    worst.add((now.speed - (after.angle - before.angle) / (2.0 * h)) / (1.0 + std::abs(now.speed)));
    worst.add((now.acceleration - (after.speed - before.speed) / (2.0 * h)) / (1.0 + std::abs(now.acceleration)));
  }
  return worst;
}

}  // namespace

TEST_CASE("speed and acceleration of every smooth reference are the derivatives of its angle") {
  REQUIRE(derivatives(SinusoidReference{0.14, 2.0, 0.3}, 0.0, 1.0) <= 1e-6);
  REQUIRE(derivatives(ChirpReference{0.2, 0.5, 4.0, 2.0}, 0.01, 1.99) <= 1e-6);
  REQUIRE(derivatives(ChirpReference{0.2, 0.5, 4.0, 2.0}, 2.01, 3.0) <= 1e-6);
  REQUIRE(derivatives(MultisineReference{0.05, 0.5, 6.0, 9}, 0.0, 3.0) <= 1e-5);
  const CubicTable table({0.0, 0.4, 1.0, 1.7, 2.0}, {0.0, 0.3, 0.1, -0.2, 0.0});
  for (std::size_t k = 1; k < table.points().size(); ++k)
    REQUIRE(derivatives(TableReference{table}, table.points()[k - 1] + 1e-4, table.points()[k] - 1e-4) <= 1e-5);
}

TEST_CASE("a sinusoid and a chirp of constant frequency are the same sine") {
  const SinusoidReference sine{0.14, 2.0, 0.0};
  const ChirpReference chirp{0.14, 2.0, 2.0, 0.7};
  for (const double t : {0.0, 0.1, 0.5, 0.7, 1.9}) {
    REQUIRE(std::abs(sine.at(t).angle - 0.14 * std::sin(4.0 * pi * t)) <= 1e-15);
    REQUIRE(std::abs(chirp.at(t).angle - sine.at(t).angle) <= 1e-14);
    REQUIRE(std::abs(chirp.at(t).acceleration - sine.at(t).acceleration) <= 1e-12);
  }
}

TEST_CASE("a chirp passes through its frequencies linearly and continues with the last without a jump") {
  const ChirpReference chirp{1.0, 1.0, 3.0, 4.0};
  // phase 2 pi (f0 t + (f1 - f0) t^2 / (2 T))
  for (const double t : {0.3, 1.0, 2.2, 4.0})
    REQUIRE(std::abs(chirp.at(t).angle - std::sin(2.0 * pi * (t + t * t / 4.0))) <= 1e-12);
  REQUIRE(std::abs(chirp.at(4.5).angle - std::sin(2.0 * pi * (4.0 + 4.0 + 3.0 * 0.5))) <= 1e-12);
}

TEST_CASE("a trapezoid covers its angle with its speed and acceleration, forward and back, long or short") {
  // 1 rad at 2 rad/s and 8 rad/s^2: ramps of 0.25 s and 0.25 rad, 0.25 s of cruise
  const TrapezoidReference up{1.0, 2.0, 8.0, 0.5}, down{-1.0, 2.0, 8.0, 0.5};
  const double times[] = {0.5, 0.625, 0.75, 0.875, 1.0, 1.125, 1.25, 2.0},
               angles[] = {0.0, 0.0625, 0.25, 0.5, 0.75, 0.9375, 1.0, 1.0};
  for (std::size_t k = 0; k < std::size(times); ++k) {
    REQUIRE(std::abs(up.at(times[k]).angle - angles[k]) <= 1e-14);
    REQUIRE(std::abs(down.at(times[k]).angle + angles[k]) <= 1e-14);
  }
  REQUIRE(up.at(0.9).speed == 2.0);
  REQUIRE(down.at(0.6).acceleration == -8.0);
  REQUIRE(up.at(1.2).acceleration == -8.0);
  const TrapezoidReference shorter{0.02, 2.0, 8.0, 0.0};  // a triangle: 0.05 s up, 0.05 s down, 0.4 rad/s at most
  REQUIRE(std::abs(shorter.at(0.05).angle - 0.01) <= 1e-15);
  REQUIRE(std::abs(shorter.at(0.05).speed - 0.4) <= 1e-14);
  REQUIRE(shorter.at(0.11).angle == 0.02);
  REQUIRE(TrapezoidReference{0.0, 2.0, 8.0, 0.0}.at(1.0).angle == 0.0);
}

TEST_CASE("steps hold from their time on, random steps within their amplitude, the same for the same seed") {
  REQUIRE(StepReference{0.3, 0.5}.at(0.5 - 1e-12).angle == 0.0);
  REQUIRE(StepReference{0.3, 0.5}.at(0.5).angle == 0.3);
  const RandomStepsReference steps{0.2, 0.1, 7};
  double sum = 0.0, squares = 0.0;
  int different = 0;
  for (int k = 0; k < 2000; ++k) {
    const double x = steps.at(0.1 * k + 0.05).angle;
    REQUIRE(std::abs(x) < 0.2);
    REQUIRE(steps.at(0.1 * k + 0.08).angle == x);
    different += RandomStepsReference{0.2, 0.1, 8}.at(0.1 * k + 0.05).angle != x;
    sum += x;
    squares += x * x;
  }
  REQUIRE(different == 2000);
  REQUIRE(std::abs(sum / 2000) <= 4.0 * 0.2 / std::sqrt(3.0 * 2000));
  REQUIRE(std::abs(squares / 2000 - 0.04 / 3.0) <= 0.1 * 0.04 / 3.0);
}

TEST_CASE("equal sines with Schroeder's phases peak far below their sum, and terms of a reference add up") {
  const MultisineReference sines{0.1, 1.0, 16.0, 16};
  double peak = 0.0;
  for (int k = 0; k < 4000; ++k) peak = std::max(peak, std::abs(sines.at(k / 4000.0).angle));
  REQUIRE(peak < 0.5 * 16 * 0.1);
  const Reference sum{{StepReference{0.3, 0.0}, SinusoidReference{0.1, 1.0, 0.0}}};
  REQUIRE(std::abs(sum.at(0.25).angle - 0.4) <= 1e-15);
  REQUIRE(std::abs(sum.at(0.25).acceleration + 0.1 * 4.0 * pi * pi) <= 1e-12);
}

}  // namespace wormdrive::test::control_references
