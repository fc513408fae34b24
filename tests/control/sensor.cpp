#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "catch.hpp"
#include "control/closed_loop.hpp"
#include "support.hpp"

// What reaches the controller and what leaves it: encoder, speed estimate, noise, disturbance, delay.

namespace wormdrive::test::control_sensor {

namespace {

constexpr double pi = std::numbers::pi;

/// The records of a loop whose control is u(t) around an arm at rest on a locked gear, over some samples.
template <class Control>
std::vector<ControlRecord> records(Control control, const SensorSettings& sensor, const SamplingSettings& sampling,
                                   const DisturbanceSettings& disturbance, int samples, Effects<double> on = {}) {
  auto d = entered(table1(), fig9_load(), {}, std::move(on));
  std::vector<ControlRecord> list;
  ClosedLoop loop(control, Reference{}, sensor, sampling, disturbance,
                  [&](const ControlRecord& r) { list.push_back(r); });
  typename std::decay_t<decltype(d)>::Instant now;
  for (int k = 0; k < samples; ++k) {
    now.t = sampling.offset + k * sampling.period;
    now.x[0] = 0.1 * std::sin(7.0 * now.t);
    now.x[1] = 0.7 * std::cos(7.0 * now.t);
    REQUIRE(((loop.sample(d, now) == list.back().applied) || std::isnan(list.back().applied)));
    REQUIRE(d.disturbance() == list.back().disturbance);
  }
  return list;
}

struct Idle {
  ControlSignals operator()(const Measurement&) const { return {}; }
  void visit_memory(const auto&) const {}
};

const auto ramp = [](const Measurement& m) { return ControlSignals{.torque = m.t}; };

}  // namespace

TEST_CASE("an encoder of 16 counts rounds to the nearest sixteenth of a turn, the other way round alike") {
  const Encoder encoder({.counts = 16});
  const double step = 2.0 * pi / 16;
  for (const double turn : {-3.0, -1.4, -0.6, -0.4, 0.0, 0.4, 0.6, 1.4, 31.4}) {
    const double shown = encoder(turn * step, 0);
    REQUIRE(std::abs(shown / step - std::round(turn)) <= 1e-12);
    REQUIRE(std::abs(shown - turn * step) <= 0.5 * step * (1 + 1e-12));
  }
}

TEST_CASE("without counts and noise the encoder is exact, and the offset of the catalogue is what it shows too much") {
  for (const ControlRecord& r : records(ramp, {}, {1e-3}, {}, 50)) REQUIRE(r.measured.angle == r.gear_angle);
  const auto shifted = records(ramp, {}, {1e-3}, {}, 50, effects(EncoderOffset<double>{.angle = 0.01}));
  for (const ControlRecord& r : shifted) REQUIRE(std::abs(r.measured.angle - r.gear_angle - 0.01) <= 1e-16);
}

TEST_CASE("the speed is the backward difference behind a one-pole low-pass with its cut-off") {
  SpeedEstimator plain(0.0, 1e-3);
  plain.start(0.0);
  REQUIRE(plain(0.0) == 0.0);
  REQUIRE(plain(0.002) == 2.0);
  REQUIRE(close(plain(0.003), 1.0, 1e-12));
  // a step of the difference decays as exp(-2 pi f t)
  SpeedEstimator filtered(50.0, 1e-3);
  filtered.start(0.0);
  for (int k = 1; k <= 20; ++k) REQUIRE(close(filtered(1e-3 * k), 1.0 - std::exp(-2.0 * pi * 50.0 * 1e-3 * k), 1e-12));
}

TEST_CASE("the exact speed is the true one, the difference lags half a sample") {
  SensorSettings exact;
  exact.exact_speed = true;
  for (const ControlRecord& r : records(ramp, exact, {1e-3}, {}, 50))
    REQUIRE(r.measured.speed == 0.7 * std::cos(7.0 * r.measured.t));
  const auto lagging = records(ramp, {}, {1e-3}, {}, 50);
  REQUIRE(lagging[0].measured.speed == 0.0);
  for (std::size_t k = 1; k < 50; ++k)
    REQUIRE(std::abs(lagging[k].measured.speed - 0.7 * std::cos(7.0 * (lagging[k].measured.t - 0.5e-3))) <= 2e-6);
}

TEST_CASE("the first sample has no past, later ones one period; a delay holds the torque of one sample before") {
  const auto prompt = records(ramp, {}, {.period = 1e-3, .offset = 0.02}, {}, 4);
  const auto late = records(ramp, {}, {.period = 1e-3, .offset = 0.02, .delay = 1}, {}, 4);
  REQUIRE(prompt[0].measured.period == 0.0);
  REQUIRE(prompt[1].measured.period == 1e-3);
  REQUIRE(late[0].applied == 0.0);
  for (std::size_t k = 0; k < 4; ++k) {
    REQUIRE(prompt[k].applied == prompt[k].measured.t);
    REQUIRE(late[k].decided.torque == prompt[k].decided.torque);
    if (k > 0) REQUIRE(late[k].applied == prompt[k - 1].applied);
  }
}

TEST_CASE("what is applied never exceeds the torque limit, whatever is decided") {
  const auto huge = [](const Measurement& m) { return ControlSignals{.torque = m.t < 0.002 ? 1e300 : -1e300}; };
  for (const ControlRecord& r : records(huge, {}, {1e-3}, {}, 5, effects(TorqueSaturation<double>{.limit = 0.1})))
    REQUIRE(r.applied == (r.measured.t < 0.002 ? 0.1 : -0.1));
}

TEST_CASE("an encoder on the worm shows the worm's angle over the ratio, in counts of the worm's turn") {
  SensorSettings sensor{.counts = 16, .on_worm = true};
  const double step = 2.0 * pi / (16 * 60);
  const auto rounded = records(ramp, sensor, {1e-3}, {}, 50);
  bool between = false;
  for (const ControlRecord& r : rounded) {
    REQUIRE(std::abs(r.measured.angle / step - std::round(r.measured.angle / step)) <= 1e-9);
    REQUIRE(std::abs(r.measured.angle - r.gear_angle) <= 0.5 * step * (1 + 1e-9));
    between = between || std::abs(r.measured.angle - r.gear_angle) > 0.1 * step;
  }
  REQUIRE(between);
  // a gear that is cut off its centre shows; what the encoder's offset adds is added to the gear's angle
  sensor.counts = 0;
  const auto uneven = records(
      ramp, sensor, {1e-3}, {}, 50,
      effects(TransmissionError<double>{.amplitude = 0.02, .phase = 0.3}, EncoderOffset<double>{.angle = 0.01}));
  for (const ControlRecord& r : uneven)
    REQUIRE(std::abs(r.measured.angle - (r.gear_angle + 0.02 * std::sin(r.gear_angle + 0.3) + 0.01)) <= 1e-15);
  sensor.exact_speed = true;
  const auto exact = records(ramp, sensor, {1e-3}, {}, 50, effects(TransmissionError<double>{.amplitude = 0.02}));
  for (const ControlRecord& r : exact)
    REQUIRE(std::abs(r.measured.speed - 0.7 * std::cos(7.0 * r.measured.t) * (1.0 + 0.02 * std::cos(r.gear_angle))) <=
            1e-14);
}

TEST_CASE("an encoder whose zero is off shows it until its index mark passes, then whole turns of its shaft at most") {
  // 0.1 sin(7 t) falls through 0.05 at t = (pi - asin(0.5))/7 for the first time if it starts above it
  for (const double error : {0.02, -1.0, 3.1, -3.2, 7.0}) {
    for (const bool on_worm : {false, true}) {
      const double per = on_worm ? 60.0 : 1.0, whole = 2.0 * pi * std::round(error / (2.0 * pi));
      SensorSettings sensor{.zero_error = error, .index_mark = per * 0.05, .on_worm = on_worm};
      const auto list = records(ramp, sensor, {1e-3, 0.2}, {}, 400);
      const auto exact = records(ramp, {.on_worm = on_worm}, {1e-3, 0.2}, {}, 400);
      int before = 0;
      bool passed = false;
      for (std::size_t k = 0; k < list.size(); ++k) {
        const double angle = list[k].gear_angle;
        // the worm passes a mark in every turn, the gear once
        const auto marks = [&](double a) { return std::floor((a - 0.05) * per / (2.0 * pi)); };
        passed = passed || (k > 0 && marks(angle) != marks(list[k - 1].gear_angle));
        REQUIRE(std::abs(list[k].measured.angle - (angle + (passed ? whole : error) / per)) <= 1e-14);
        REQUIRE(list[k].measured.speed == exact[k].measured.speed);
        before += !passed;
      }
      REQUIRE(before > 10);
      REQUIRE(passed);
    }
  }
  for (const ControlRecord& r : records(ramp, {.zero_error = 0.3}, {1e-3}, {}, 400))  // no mark
    REQUIRE(r.measured.angle == r.gear_angle + 0.3);
}

TEST_CASE("a loop that goes on from its memory finds the index mark where the loop itself does") {
  auto d = entered(table1(), fig9_load(), {}, {});
  std::vector<double> angles;
  const auto loop = [&] {
    return ClosedLoop(Idle{}, Reference{}, {.zero_error = 0.02, .index_mark = 0.05}, {1e-3}, {},
                      [&](const ControlRecord& r) { angles.push_back(r.measured.angle - r.gear_angle); });
  };
  auto whole = loop();
  typename std::decay_t<decltype(d)>::Instant now;
  for (int k = 0; k < 100; ++k) {
    now.t = 1e-3 * k;
    now.x[0] = 1e-3 * k;
    auto other = loop();
    REQUIRE(other.recall(whole.memory()));
    whole.sample(d, now);
    other.sample(d, now);
    REQUIRE(angles[angles.size() - 2] == angles.back());
    REQUIRE(std::abs(angles.back() - (k < 50 ? 0.02 : 0.0)) <= 1e-15);
  }
}

TEST_CASE("the controller is told what the limit left of what it decided at the sample before, and the limit") {
  const auto swing = [](const Measurement& m) { return ControlSignals{.torque = 0.3 * std::sin(900 * m.t)}; };
  for (const double delay : {0.0, 1.0}) {
    const auto list = records(swing, {}, {1e-3, 0.0, delay}, {}, 50, effects(TorqueSaturation<double>{.limit = 0.1}));
    REQUIRE(list[0].measured.applied == 0.0);
    for (std::size_t k = 1; k < list.size(); ++k) {
      REQUIRE(list[k].measured.applied == std::clamp(list[k - 1].decided.torque, -0.1, 0.1));
      REQUIRE(list[k].measured.limit == 0.1);
    }
  }
}

TEST_CASE("encoder noise and torque disturbance have their deviation, their colour, and repeat with their seed") {
  const auto none = [](const Measurement&) { return ControlSignals{}; };
  SensorSettings noisy;
  noisy.noise = 1e-4;
  const int n = 20000;
  const auto white = records(none, noisy, {1e-3}, {.deviation = 0.01}, n);
  const auto coloured = records(none, {}, {1e-3}, {.deviation = 0.01, .time_constant = 0.02}, n);
  double noise = 0.0, torque = 0.0, colour = 0.0, next = 0.0, next_white = 0.0;
  for (std::size_t k = 0; k < white.size(); ++k) {
    noise += std::pow(white[k].measured.angle - white[k].gear_angle, 2) / n;
    torque += std::pow(white[k].disturbance, 2) / n;
    colour += std::pow(coloured[k].disturbance, 2) / n;
    if (k > 0) next += coloured[k].disturbance * coloured[k - 1].disturbance / n;
    if (k > 0) next_white += white[k].disturbance * white[k - 1].disturbance / n;
  }
  REQUIRE(close(std::sqrt(noise), 1e-4, 0.03));
  REQUIRE(close(std::sqrt(torque), 0.01, 0.03));
  REQUIRE(close(std::sqrt(colour), 0.01, 0.15));  // 500 independent values only
  REQUIRE(close(next / colour, std::exp(-1e-3 / 0.02), 0.01));
  REQUIRE(std::abs(next_white / torque) < 0.03);
  const auto again = records(none, noisy, {1e-3}, {.deviation = 0.01}, 100);
  const auto other = records(none, noisy, {1e-3}, {.deviation = 0.01, .seed = 2}, 100);
  for (std::size_t k = 0; k < 100; ++k) {
    REQUIRE(again[k].disturbance == white[k].disturbance);
    REQUIRE(again[k].measured.angle == white[k].measured.angle);
    REQUIRE(other[k].disturbance != white[k].disturbance);
  }
}

}  // namespace wormdrive::test::control_sensor
