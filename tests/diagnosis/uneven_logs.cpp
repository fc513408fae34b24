#include <algorithm>
#include <cmath>
#include <numbers>

#include "catch.hpp"
#include "description/diagnostics.hpp"
#include "diagnosis/fitting/hypothesis.hpp"
#include "diagnosis/logger.hpp"
#include "diagnosis/servo_logs.hpp"
#include "numbers.hpp"
#include "support.hpp"

// Logs of which rows are missing, or whose times are not even: what is read of them, and how they are predicted.

namespace wormdrive::test::diagnosis_uneven_logs {

namespace {

constexpr double pi = std::numbers::pi;
constexpr std::size_t u = 1, y = 2;  ///< columns

void erase(Sheet& sheet, std::size_t from, std::size_t to) {
  sheet.rows.erase(sheet.rows.begin() + static_cast<std::ptrdiff_t>(from),
                   sheet.rows.begin() + static_cast<std::ptrdiff_t>(to));
}

/// A wheel of 0.01 kg m^2 whose torque is held from sample to sample.
Recording wheel(double period = 1e-3) {
  Recording r;
  r.period = period;
  double angle = 0.0, speed = 0.0;
  for (std::size_t k = 0; static_cast<double>(k) * period < 4.0; ++k) {
    const double t = static_cast<double>(k) * period;
    const double torque = 0.05 * std::sin(2.0 * pi * 1.3 * t) + 0.02 * std::cos(2.0 * pi * 7.0 * t);
    r.motor_torque.push_back(torque);
    r.gear_angle.push_back(angle);
    angle += speed * period + 0.5 * torque / 0.01 * period * period;
    speed += torque / 0.01 * period;
  }
  r.valid.assign(r.samples(), 1);
  return r;
}

/// The same as an encoder with such steps sees it.
Recording counted(Recording r, double step) {
  for (double& angle : r.gear_angle) angle = step * std::round(angle / step);
  r.gear_resolution = step;
  return r;
}

std::vector<double> innovations(const Recording& recording) {
  Scenario scenario;
  scenario.mesh = SingleInertia<double>{0.01};
  const Evaluation evaluation(scenario, InnovationLayout({prepared(recording, 0)}), 1);
  Hypothesis h;
  REQUIRE(evaluate(evaluation, h));
  return h.innovations;
}

double largest(const std::vector<double>& e, std::size_t from, std::size_t to) {
  double most = 0.0;
  for (std::size_t k = from; k < to; ++k) most = std::max(most, std::abs(e[k]));
  return most;
}

}  // namespace

TEST_CASE("rows that a logger has lost are put in where they were, and count for nothing") {
  const Folder folder;
  Sheet sheet = sound();
  erase(sheet, 5000, 5001);
  erase(sheet, 2000, 2003);
  const Recording r = read(folder, sheet);
  CHECK(r.remarks == std::vector<std::string>{
                         "4 of 8000 rows are missing, the first after 1.999 s (line 2002); 4 of them are bridged"});
  REQUIRE(r.samples() == 8000);
  CHECK(r.times.empty());
  CHECK(r.restarts.empty());
  CHECK(std::abs(r.period - 1e-3) < 1e-12);
  for (const std::size_t k : {2000u, 2001u, 2002u, 5000u}) CHECK(r.valid[k] == 0);
  CHECK(std::count(r.valid.begin(), r.valid.end(), 0) == 4);
  CHECK(r.gear_angle[5001] == sound().number(5001, y));
  CHECK(std::abs(r.motor_torque[5000] - 0.5 * (sound().number(4999, u) + sound().number(5001, u))) < 1e-12);
  const PreparedRecording p = prepared(r, 0);
  CHECK(p.used[1999] == 1);
  CHECK(p.used[2001] == 0);
  CHECK(p.used[2003] == 1);
}

TEST_CASE("after a pause, whose torque nobody knows, the recording starts anew, lines and times as in the file") {
  const Folder folder;
  Sheet sheet = sound();
  sheet.put(6000, u, -3.0);
  erase(sheet, 2000, 2120);
  const Recording r = read(folder, sheet);
  CHECK(
      r.remarks ==
      std::vector<std::string>{
          "120 of 8000 rows are missing, the first after 1.999 s (line 2002); the prediction starts anew after 120 of "
          "them in a pause",
          "left out: motor_torque_Nm = -3 at 6 s (line 5882), which no measurement can have given"});
  REQUIRE(r.samples() == 7880);
  CHECK(r.restarts == std::vector<std::size_t>{2000});
  CHECK(std::abs(r.time(1999) - 1.999) < 1e-9);
  CHECK(std::abs(r.time(2000) - 2.12) < 1e-9);
  const PreparedRecording p = prepared(r, 0);
  CHECK(p.used[1999] == 1);
  CHECK(p.used[2000] == 0);
  CHECK(p.used[2098] == 0);  // 0.1 s, as at the first start
  CHECK(p.used[2102] == 1);
}

TEST_CASE("rows that are put in hide no encoder's steps and are no standstill") {
  for (const double counts : {1000.0, 4000.0, 16384.0, 65536.0})
    for (const std::size_t run : {1u, 6u, 11u}) {
      CAPTURE(counts, run);
      truth::Drive drive;
      drive.sensor.counts = counts;
      Sheet sheet = Logger{.duration = 6.0}.write(drive);
      lose(sheet, 0.2, run);
      const Recording r = read(Folder(), sheet);
      CHECK(close(r.gear_resolution, 2.0 * pi / counts, 1e-4));
      CHECK(r.remarks.size() == 1);  // of the rows that are missing
    }
}

TEST_CASE("times to which the readings belong are followed, also where the rate changes") {
  const Folder folder;
  const Sheet sheet = Logger{.jitter = 0.2, .duration = 4.0}.write({});
  const Recording r = read(folder, sheet);
  REQUIRE(r.times.size() == sheet.rows.size());
  double off = 0.0;
  for (std::size_t k = 0; k < r.samples(); ++k) off = std::max(off, std::abs(r.start + r.time(k) - sheet.number(k, 0)));
  CHECK(off < 1e-9);
  REQUIRE(r.remarks.size() == 1);
  CHECK(r.remarks[0].ends_with("; followed as they are"));
  Sheet slower = sound();
  slower.each(0, [](double t, std::size_t) { return t < 4.0 ? t : 4.0 + 1.1 * (t - 4.0); });
  const Recording changed = read(folder, slower);
  REQUIRE(changed.samples() == 8000);
  CHECK(std::abs(changed.start + changed.time(7999) - 8.3989) < 1e-4);
}

TEST_CASE("a prediction goes on over missing rows without comparing them, and anew after a pause") {
  const Recording whole = wheel();
  Recording lossy = whole;
  for (std::size_t k = 1000; k < 1006; ++k) {
    lossy.gear_angle[k] = 7.0;
    lossy.valid[k] = 0;
  }
  const std::vector<double> e = innovations(lossy);
  CHECK(largest(e, 1000, 1006) == 0.0);
  CHECK(largest(e, 1006, 4000) < 1e-9);

  Recording paused = whole;
  const auto cut = [](std::vector<double>& values) { values.erase(values.begin() + 1000, values.begin() + 1700); };
  for (std::size_t k = 0; k < whole.samples(); ++k) paused.times.push_back(whole.time(k));
  for (auto* values : {&paused.times, &paused.motor_torque, &paused.gear_angle}) cut(*values);
  paused.valid.resize(paused.samples());
  CHECK(largest(innovations(paused), 1000, 1100) > 0.1);
  paused.restarts = {1000};
  CHECK(largest(innovations(paused), 1000, 1025) < 1e-3);
  CHECK(largest(innovations(paused), 1025, 3300) < 1e-4);
}

TEST_CASE("the gains of uneven samples become those of even ones as the steps do") {
  Recording r = wheel();
  const ProcessNoise noise{.white = 0.02, .coloured = 0.005};
  REQUIRE(observer_gains(noise, prepared(r, 0)).size() == 1);
  for (std::size_t k = 0; k < r.samples(); ++k) r.times.push_back(static_cast<double>(k) * r.period);
  CHECK(observer_gains(noise, prepared(r, 0)).size() == 1);
  r.valid[500] = 0;
  const std::vector<ObserverGains> gains = observer_gains(noise, prepared(r, 0));
  const ObserverGains steady = observer_gains(noise, r.period);
  REQUIRE(gains.size() == r.samples());
  CHECK(gains[500].angle == 0.0);
  CHECK(gains[501].angle > 1.01 * steady.angle);
  CHECK(std::abs(gains[499].angle / steady.angle - 1.0) < 1e-4);
  CHECK(std::abs(gains[499].speed / steady.speed - 1.0) < 1e-4);
  CHECK(std::abs(gains[499].torque / steady.torque - 1.0) < 1e-4);
}

TEST_CASE("readings that are closer than a step of the encoder count as one together, and fast ones wholly") {
  const Recording r = wheel();
  const std::vector<double> speed = prepared(r, 0).speed;
  const double longest = *std::max_element(speed.begin(), speed.end()) * r.period;
  CHECK(prepared(r, 0).shares.empty());
  CHECK(prepared(counted(r, 0.01 * longest), 0).shares.empty());
  const PreparedRecording coarse = prepared(counted(r, longest), 0);
  REQUIRE(coarse.shares.size() == r.samples());
  for (std::size_t k = 0; k < r.samples(); ++k) {
    const double steps = std::abs(coarse.speed[k]) * r.period / longest;
    CHECK(close(coarse.share(k), std::clamp(steps / 0.75, r.period / 0.02, 1.0), 1e-12));
  }

  // a reading of a quarter is one with noise of twice the size
  PreparedRecording quarter = prepared(wheel(), 0);
  quarter.shares.assign(quarter.samples(), 0.25);
  const ObserverGains steady = observer_gains({.white = 0.01, .coloured = 0.0025}, quarter.data.period);
  const ObserverGains last = observer_gains({.white = 0.02, .coloured = 0.005}, quarter).back();
  CHECK(close(last.angle, steady.angle, 1e-6));
  CHECK(close(last.speed, steady.speed, 1e-6));
  CHECK(close(last.torque, steady.torque, 1e-6));
}

TEST_CASE("one process noise serves recordings of different rates: their filters forget equally fast") {
  // a tracking index T^2 sigma_a/sigma_y of small size gives gains of (2 index)^(1/2): Kalata 1984
  const ProcessNoise at_1ms{.white = 1e-4, .coloured = 0.0, .period = 1e-3};
  const double fast = observer_gains(at_1ms, 1e-3).angle, slow = observer_gains(at_1ms, 4e-3).angle;
  CHECK(std::abs(slow / fast - std::sqrt(8.0)) < 0.02 * std::sqrt(8.0));
  CHECK(observer_gains(at_1ms, 1.01e-3).angle == fast);
}

TEST_CASE("times that show no rate, and more rows missing than there, are refused") {
  const Folder folder;
  const auto said = [&](const Sheet& sheet) {
    try {
      read(folder, sheet);
    } catch (const InputFault& fault) {
      return std::string(fault.what()).substr((folder / "").size());
    }
    return std::string("it was taken");
  };
  Sheet random = sound();
  random.each(0, [](double t, std::size_t k) { return t + 0.48e-3 * std::sin(1.7 * static_cast<double>(k)); });
  CHECK(said(random).starts_with("r.csv: error: time_s shows no rate: only "));
  Sheet mostly_lost = sound();
  erase(mostly_lost, 1500, 6500);
  CHECK(
      said(mostly_lost) ==
      "r.csv:1502: error: 5000 rows of 0.001 s are missing, more than the 3000 that are there; the first after time_s "
      "= 1.499");
}

TEST_CASE("the logs of a servo are read as they were written", "[reference]") {
  for (const char* gain : {"kp100", "kp400"})
    for (const std::string& name : servo_logs(gain)) {
      const auto log = reference(name);
      if (!log) return;
      INFO(name);
      const Recording r = *servo_recording(name, pendulum());
      CHECK(std::count(r.valid.begin(), r.valid.end(), 1) == static_cast<long>(log->size()));
      CHECK(r.restarts.empty());
      REQUIRE(r.times.size() == r.samples());
      CHECK(std::abs(r.start + r.times.back() - log->number("time_s", log->size() - 1)) < 1e-9);
      REQUIRE_FALSE(r.remarks.empty());
      CHECK(r.remarks.back().ends_with("; followed as they are"));
      CHECK_NOTHROW(servo_recording(name, geared_pendulum()));  // its motor is off for most of two logs
    }
}

}  // namespace wormdrive::test::diagnosis_uneven_logs
