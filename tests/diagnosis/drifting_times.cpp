#include <cmath>
#include <numbers>
#include <stdexcept>

#include "catch.hpp"
#include "description/diagnostics.hpp"
#include "diagnosis/diagnose.hpp"
#include "diagnosis/fitting/hypothesis.hpp"
#include "diagnosis/sheet.hpp"

// Sample times whose steps are even among neighbours but drift: a clock is no worse for being slow.

namespace wormdrive::test::diagnosis_drifting_times {

namespace {

constexpr double pi = std::numbers::pi;

/// The sound recording with other times, as a clock would give them that is off by `off` seconds now and then.
Recording with_clock(double off, double turns) {
  Sheet sheet = sound();
  sheet.each(0, [&](double t, std::size_t) { return t + off * std::sin(2.0 * pi * turns * t / 8.0); });
  return read(Folder(), sheet);
}

/// A wheel of 0.01 kg m^2 whose torque is held from sample to sample, at steps that swing by a share about 1 ms.
Recording wheel(double share) {
  Recording r;
  r.period = 1e-3;
  double t = 0.0, angle = 0.0, speed = 0.0;
  for (std::size_t k = 0; k < 4000; ++k) {
    const double step = 1e-3 * (1.0 + share * std::sin(2.0 * pi * static_cast<double>(k) / 4000.0));
    const double torque = 0.05 * std::sin(2.0 * pi * 1.3 * t) + 0.02 * std::cos(2.0 * pi * 7.0 * t);
    r.times.push_back(t);
    r.motor_torque.push_back(torque);
    r.gear_angle.push_back(angle);
    angle += speed * step + 0.5 * torque / 0.01 * step * step;
    speed += torque / 0.01 * step;
    t += step;
  }
  r.valid.assign(r.samples(), 1);
  return r;
}

std::string said(const Sheet& sheet) {
  const Folder folder;
  try {
    read(folder, sheet);
  } catch (const InputFault& fault) {
    return std::string(fault.what()).substr((folder / "").size());
  }
  return "it was taken";
}
double rms_innovation(const Recording& recording) {
  Scenario scenario;
  scenario.mesh = SingleInertia<double>{0.01};
  const Evaluation evaluation(scenario, InnovationLayout({prepared(recording, 0)}), 1);
  Hypothesis h;
  REQUIRE(evaluate(evaluation, h));
  double sum = 0.0;
  for (std::size_t k = 500; k < h.innovations.size(); ++k) sum += h.innovations[k] * h.innovations[k];
  return std::sqrt(sum / static_cast<double>(h.innovations.size() - 500));
}

}  // namespace

TEST_CASE("a clock that drifts by most of a step over seconds is followed, though every step is almost the same") {
  const Recording r = with_clock(0.86e-3, 1.0);
  REQUIRE(r.samples() == 8000);
  REQUIRE(r.times.size() == 8000);
  CHECK(r.times.front() == 0.0);
  CHECK(std::abs(r.period - 1e-3) < 1e-6);
  double worst = 0.0;
  for (std::size_t k = 0; k < r.samples(); ++k) {
    const double t = 1e-3 * static_cast<double>(k);
    worst = std::max(worst, std::abs(r.start + r.time(k) - (t + 0.86e-3 * std::sin(2.0 * pi * t / 8.0))));
  }
  CHECK(worst < 0.01e-3);
  REQUIRE(r.remarks.size() == 1);
  CHECK(r.remarks[0].starts_with("the steps drift between 0.00099932"));
  CHECK(r.remarks[0].ends_with(" s off an even grid; followed as they are"));
}

TEST_CASE("even times stay even, and what they miss by jitter is told and not followed") {
  CHECK(with_clock(0.0, 1.0).times.empty());
  CHECK(with_clock(0.0, 1.0).remarks.empty());
  CHECK(with_clock(1e-6, 1.0).times.empty());
  const Recording jittered = with_clock(0.05e-3, 1234.5);
  CHECK(jittered.times.empty());
  REQUIRE(jittered.remarks.size() == 1);
  CHECK(jittered.remarks[0] == "the sample times miss even steps by up to 5 % of a step; taken for even");
}

TEST_CASE("the prediction runs from stamp to stamp") {
  Recording recording = wheel(0.05);
  const double followed = rms_innovation(recording);
  recording.times.clear();
  CHECK(followed < 0.01 * rms_innovation(recording));
  CHECK(followed < 10.0 * rms_innovation(wheel(0.0)));
}

TEST_CASE("what a recording must have at least is one rule, for a file and for data in memory") {
  Recording short_one = wheel(0.0);
  short_one.times.clear();
  for (auto* values : {&short_one.motor_torque, &short_one.gear_angle}) values->resize(2999);
  short_one.valid.resize(2999);
  Scenario scenario;
  scenario.mesh = SingleInertia<double>{0.01};
  try {
    diagnose(scenario, {short_one});
    FAIL("it was taken");
  } catch (const std::invalid_argument& fault) {
    CHECK(fault.what() == std::string("a diagnosis needs recordings of at least 3 s and 1000 samples"));
  }
  Sheet sheet = sound();
  sheet.rows.resize(2999);
  CHECK(said(sheet).ends_with("a diagnosis needs at least 3 s"));
}

}  // namespace wormdrive::test::diagnosis_drifting_times
