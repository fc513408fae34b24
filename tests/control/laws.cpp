#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "control/controller.hpp"
#include "support.hpp"

// The three laws at single samples, and the gains of the PID.

namespace wormdrive::test::control_laws {

namespace {

const GearMesh<double> mesh(table1());
NominalModel nominal(double load = 0.0196) { return {mesh.C1(), mesh.C2(), mesh.Jw * 60, mesh.Jg, load, 0.0, 0.0}; }

SlidingParameters parameters() {
  SlidingParameters p;
  p.lambda_c = 50.0;
  p.Phi = 0.3;
  p.eta = 30.0;
  p.beta1 = 2.0;
  p.beta2 = 2.5;
  p.D1 = 3.0;
  p.D2 = 4.0;
  p.E1 = 0.1;
  p.E2 = 0.2;
  p.epsilon = 0.01;
  return p;
}

ControlSignals first_sample(const SlidingParameters& p, double load, double angle, double speed,
                            ReferencePoint desired) {
  return SlidingController(p, nominal(load), {})(Measurement{0.0, angle, speed, 0.0, desired});
}

/// Eq. 22-24 for the first sample, whose integral is 0, with the branches' constants chosen by the caller.
double u_by_hand(const SlidingParameters& p, double load, double angle, double speed, ReferencePoint desired,
                 bool forward) {
  const double e = angle - desired.angle, rate = speed - desired.speed, s = rate + 2 * p.lambda_c * e;
  const double u_hat = -load / mesh.Jg + desired.acceleration - 2 * p.lambda_c * rate - p.lambda_c * p.lambda_c * e;
  const double gain1 = p.beta1 * (*p.D1 * std::abs(load) + *p.E1 + p.eta) + (p.beta1 - 1) * std::abs(u_hat);
  const double gain2 = p.beta2 * (*p.D2 * std::abs(load) + *p.E2 + p.eta) + (p.beta2 - 1) * std::abs(u_hat);
  const double I1 = mesh.Jw * 60 + mesh.C1() * mesh.Jg, I2 = mesh.Jw * 60 + mesh.C2() * mesh.Jg;
  // forward the left flank (s > 0) has C1, backward it has C2 [eq. 18-19]
  const double above = forward ? I1 * (u_hat - gain1) : I2 * (u_hat - gain2);
  const double below = forward ? I2 * (u_hat + gain2) : I1 * (u_hat + gain1);
  if (s >= p.Phi) return above;
  if (s <= -p.Phi) return below;
  return (above - below) * s / (2 * p.Phi) + (above + below) / 2;
}

}  // namespace

TEST_CASE("the sliding law is eq. 22-24 above, below and inside its layer, in both directions") {
  const SlidingParameters p = parameters();
  const ReferencePoint desired{0.1, 0.4, -3.0};
  for (const double speed : {0.7, -0.7})
    for (const double s : {-2.0, -0.3, -0.1, 0.0, 0.2, 0.3, 5.0}) {
      const double angle = desired.angle + (s - (speed - desired.speed)) / (2 * p.lambda_c);
      const double load = 0.0196 * std::cos(angle);
      const ControlSignals out = first_sample(p, 0.0196, angle, speed, desired);
      INFO("speed " << speed << ", s " << s);
      REQUIRE(std::abs(out.s - s) <= 1e-12);
      REQUIRE(std::abs(out.u - u_by_hand(p, load, angle, speed, desired, speed > 0)) <= 1e-12);
      REQUIRE(out.compensation == 0.0);
      REQUIRE(std::abs(out.torque - out.u - mesh.Jw * 60 / mesh.Jg * load) <= 1e-14);
    }
}

TEST_CASE("at zero speed the branch is that of the reference's direction") {
  SlidingParameters p = parameters();
  p.epsilon = 0.0;  // only at rest itself
  for (const double towards : {0.4, -0.4}) {
    const ReferencePoint desired{0.1, towards, -3.0};
    const double angle = 0.13, load = 0.0196 * std::cos(angle);
    REQUIRE(std::abs(first_sample(p, 0.0196, angle, 0.0, desired).u -
                     u_by_hand(p, load, angle, 0.0, desired, towards > 0)) <= 1e-12);
  }
  REQUIRE(goes_forward(0.0, 0.0));
  REQUIRE(!goes_forward(-1e-300, 1.0));
}

TEST_CASE("the break-in compensation leads to the edge of motion in the wanted direction, for loads of either sign") {
  // statics, eq. 9-10: motion starts forward above the larger of -C1 tau_l, -C2 tau_l, backward below the smaller
  for (const double load : {0.5, -0.5, 0.01, -0.01}) {
    const double a = -mesh.C1() * load, b = -mesh.C2() * load;
    REQUIRE(break_in_compensation(nominal(), load, 0.004, 0.3, 0.005) == std::max(a, b));
    REQUIRE(break_in_compensation(nominal(), load, -0.005, -0.3, 0.005) == std::min(a, b));
    REQUIRE(break_in_compensation(nominal(), load, 0.0051, 0.3, 0.005) == 0.0);
    REQUIRE(break_in_compensation(nominal(), load, 0.0, 0.3, 0.0) == std::max(a, b));
  }
  // as the paper prints it, for a positive load
  REQUIRE(break_in_compensation(nominal(), 0.5, 0.0, 1.0, 0.01) == -mesh.C1() * 0.5);
  REQUIRE(break_in_compensation(nominal(), 0.5, 0.0, -1.0, 0.01) == -mesh.C2() * 0.5);
  REQUIRE(first_sample(parameters(), -0.5, 0.0, 0.0, {0.0, 1.0, 0.0}).compensation == mesh.C2() * 0.5);
}

TEST_CASE("the integral counts what has happened, from the second sample on") {
  SlidingController law(parameters(), nominal(), {});
  const ReferencePoint desired{};
  REQUIRE(law({0.0, 1e-3, 0.02, 0.0, desired}).s == 0.02 + 100 * 1e-3);
  REQUIRE(std::abs(law({0.1, 2e-3, 0.02, 0.1, desired}).s - (0.02 + 100 * 2e-3 + 2500 * 2e-4)) <= 1e-15);
}

TEST_CASE("one weight alone puts the PID's poles on Butterworth's circle") {
  for (const double p : {10.0, 94.2, 350.0, 1000.0, 1e5})
    for (const double M : {1.5e-3, 0.02, 3.0}) {
      const PidGains by_integral = lqr_gains({.integral_weight = M * M * std::pow(p, 6)}, M);
      // (s + p)(s^2 + p s + p^2) = s^3 + 2 p s^2 + 2 p^2 s + p^3
      INFO("p " << p << ", M " << M);
      REQUIRE(close(by_integral.Kd, 2 * p * M, 1e-10));
      REQUIRE(close(by_integral.Kp, 2 * p * p * M, 1e-10));
      REQUIRE(close(by_integral.Ki, p * p * p * M, 1e-10));
    }
}

TEST_CASE("the gains of the PID solve the Riccati equation") {
  for (const PidParameters& w :
       {PidParameters{.integral_weight = 2e6, .angle_weight = 300, .speed_weight = 0.02},
        PidParameters{.integral_weight = 1, .angle_weight = 1, .speed_weight = 1},
        PidParameters{.integral_weight = 1e-3, .angle_weight = 1e4, .speed_weight = 0, .torque_weight = 7},
        PidParameters{.integral_weight = 1e9, .angle_weight = 0, .speed_weight = 50, .torque_weight = 0.1}}) {
    const double M = 1.53e-3, r = w.torque_weight;
    const PidGains g = lqr_gains(w, M);
    // A'P + PA - PB B'P/r + Q = 0 for the chain integral, angle, speed; K = B'P/r gives P's last column, the equation
    // its other entries from the top right on
    const double p13 = r * M * g.Ki, p23 = r * M * g.Kp, p33 = r * M * g.Kd;
    const double p12 = r * g.Ki * g.Kd;                                // (1,3): p12 - p13 p33/(r M^2) = 0
    const double p22 = r * g.Kp * g.Kd - p13;                          // (2,3): p13 + p22 - p23 p33/(r M^2) = 0
    const double p11 = r * g.Ki * g.Kp;                                // (1,2): p11 - p13 p23/(r M^2) = 0
    REQUIRE(close(p13 * p13 / (r * M * M), w.integral_weight, 1e-9));  // (1,1)
    REQUIRE(std::abs(2 * p12 - p23 * p23 / (r * M * M) + w.angle_weight) <= 1e-9 * (2 * p12));  // (2,2)
    REQUIRE(std::abs(2 * p23 - p33 * p33 / (r * M * M) + w.speed_weight) <= 1e-9 * (2 * p23));  // (3,3)
    // and P is positive definite: of all solutions the one that stabilises
    REQUIRE(p11 > 0);
    REQUIRE(p11 * p22 - p12 * p12 > 0);
    REQUIRE(p11 * (p22 * p33 - p23 * p23) - p12 * (p12 * p33 - p13 * p23) + p13 * (p12 * p23 - p13 * p22) > 0);
    REQUIRE(stabilises(g, M));
  }
}

TEST_CASE("the PID is its gains times errors, with the compensation, and feeds its share of the acceleration forward") {
  PidParameters p{.integral_weight = 1e6, .angle_weight = 10, .speed_weight = 0.1, .feedforward = 1, .epsilon = 0.005};
  const NominalModel n = nominal();
  const double M = 0.5 * ((n.Jw_i + n.C1 * n.Jg) + (n.Jw_i + n.C2 * n.Jg));
  const PidGains g = lqr_gains(p, M);
  PidController law(p, n);
  const ReferencePoint desired{0.1, 0.4, -3.0};
  REQUIRE(close(law({0.0, 0.11, 0.5, 0.0, desired}).torque, -(g.Kp * 0.01 + g.Kd * 0.1) - 3.0 * M, 1e-12));
  const double by_hand =
      -(g.Ki * 0.02 * 1e-3 + g.Kp * 0.02 + g.Kd * (0.004 - 0.4)) - 3.0 * M - n.C1 * 0.0196 * std::cos(0.12);
  REQUIRE(close(law({1e-3, 0.12, 0.004, 1e-3, desired}).torque, by_hand, 1e-12));
}

TEST_CASE("open loop holds the torque over time at the sample") {
  const OpenLoopController law(Signal{{Ramp{.rate = 2.0, .start = 0.1}, Constant{0.5}}});
  REQUIRE(law({0.05, 9.0, 9.0, 1e-3, {}}).torque == 0.5);
  REQUIRE(close(law({0.35, 9.0, 9.0, 1e-3, {}}).torque, 1.0, 1e-14));
}

}  // namespace wormdrive::test::control_laws
