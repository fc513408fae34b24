// Where the events of fig. 9 lie, to twenty digits: the paper's drive in 128-bit arithmetic. tests/events/taylor.cpp
// compares with these numbers. Takes no arguments.
#include <cstdio>

#include <quadmath.h>

namespace wormdrive::test {
inline __float128 sine(__float128 x) { return sinq(x); }
inline __float128 cosine(__float128 x) { return cosq(x); }
}  // namespace wormdrive::test

#include "tests/reference/extended_drive.hpp"

int main() {
  wormdrive::test::ExtendedDrive<__float128> drive(0.0196, 0.0);
  drive.wave = 0.05;
  drive.rate = 2 * 3.14159265358979323846 * 1.5;
  drive.phase = 90 * (3.14159265358979323846 / 180);
  drive.settle();
  drive.advance(2);
  const auto print = [](const char* label, __float128 x) {
    char text[64];
    quadmath_snprintf(text, sizeof text, "%.20Qg", x);
    std::printf("%s %s\n", label, text);
  };
  for (const auto& event : drive.events) print("event", event.t);
  print("theta_g", drive.theta);
  print("theta_g'", drive.omega);
}
