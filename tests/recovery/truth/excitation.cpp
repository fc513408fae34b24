#include "recovery/truth/excitation.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "recovery/truth/size.hpp"

namespace truth {
namespace {

constexpr double turn = 2.0 * std::numbers::pi;

/// One after the other in time; `until` and `to` are shares of the duration and the centre reached then [rad].
struct Stage {
  enum class Kind { sweep, multisine, steps, sine, holds, fast } kind;
  double until, to;
};
constexpr Stage plan[] = {{Stage::Kind::sweep, 4. / 24, 1.0},   {Stage::Kind::multisine, 8. / 24, 2.4},
                          {Stage::Kind::steps, 12. / 24, -0.5}, {Stage::Kind::sine, 15. / 24, -2.4},
                          {Stage::Kind::fast, 17. / 24, -0.8},  {Stage::Kind::holds, 20. / 24, 0.0},
                          {Stage::Kind::sweep, 1.0, 1.0}};

struct Sine {
  double frequency, amplitude, phase;
};

/// 0 outside, 1 inside, smooth over 0.2 s at both ends.
double window(double t, double from, double to) {
  const double edge = std::clamp(std::min(t - from, to - t) / 0.2, 0.0, 1.0);
  return edge * edge * (3.0 - 2.0 * edge);
}

/// What is asked for before it is smoothed, angle at a share s of a stage that starts at `from`.
double centre(const Stage& stage, double from, double s, double step) {
  double path = from + s * (stage.to - from);
  if (stage.kind == Stage::Kind::steps) path += step;
  if (stage.kind == Stage::Kind::holds) {
    // still for 0.2 s, 0.4 s and 0.9 s of 3 s, ramps both ways between: share of the time, share of the way
    constexpr double points[][2] = {{0, 0},      {0.1, 0.8}, {0.16, 0.8}, {0.3, 0.1},
                                    {0.44, 0.1}, {0.6, 0.9}, {0.91, 0.9}, {1, 1}};
    std::size_t k = 1;
    while (s > points[k][0] && k + 1 < std::size(points)) ++k;
    const double passed = (s - points[k - 1][0]) / (points[k][0] - points[k - 1][0]);
    path = from + (points[k - 1][1] + passed * (points[k][1] - points[k - 1][1])) * (stage.to - from);
  }
  return path;
}

std::vector<Sine> sines(Stage::Kind kind, std::mt19937_64& generator) {
  std::uniform_real_distribution<double> phase(0.0, turn);
  std::vector<Sine> all;
  const auto add = [&](double frequency, double acceleration) {
    all.push_back({frequency, acceleration / std::pow(turn * frequency, 2), phase(generator)});
  };
  switch (kind) {
    case Stage::Kind::multisine:
      for (const double f : {0.7, 1.3, 2.9, 5.1, 8.7, 13.0}) add(f, f < 1.0 ? 3.0 : 6.0);
      break;
    case Stage::Kind::sine: add(1.5, usual_acceleration); break;
    case Stage::Kind::fast:
      for (const double f : {3.7, 11.0, 20.0, 27.0}) add(f, 14.0);
      break;
    case Stage::Kind::sweep:
    case Stage::Kind::steps:
    case Stage::Kind::holds: break;
  }
  return all;
}

/// The controller as a law of time and seen angle.
class Pilot {
 public:
  Pilot(EventSequence course, const Sheet& sheet) : course_(std::move(course)) {
    const Geometry& g = sheet.geometry;
    with_load_ = torque_ratio(g, -sheet.friction);
    against_load_ = torque_ratio(g, sheet.friction);
    weight_ = g.mass * g.gravity * g.arm;
    worm_ = g.worm_inertia * g.ratio;
    gear_ = g.gear_inertia + g.mass * g.arm * g.arm;
    limit_ = 0.25 * times_usual(Dimension::worm_torque, sheet);
    filter_ = std::min(250.0, 0.5 / course_.period);
    bandwidth_ = 0.1 * filter_;
  }
  double operator()(double t, double seen) {
    const std::size_t k = std::min(static_cast<std::size_t>(std::lround(t / course_.period)), course_.angle.size() - 1);
    if (!started_) angle_ = seen;
    started_ = true;
    // a second-order filter follows the encoder and knows its speed
    const double T = course_.period, error = seen - angle_;
    angle_ += T * (speed_ + 2.0 * filter_ * error);
    speed_ += T * filter_ * filter_ * error;
    const double load = weight_ * std::cos(course_.angle[k]), wanted = course_.acceleration[k];
    // friction is fed forward with the direction that is asked for, not at all where a rest is asked for
    const double way = std::clamp(course_.speed[k] / 0.03, -1.0, 1.0) * (load - gear_ * wanted >= 0.0 ? 1.0 : -1.0);
    const double C = 0.5 * (against_load_ + with_load_) - 0.5 * way * (against_load_ - with_load_);
    const double M = worm_ + C * gear_;
    const double law =
        wanted + 2.0 * bandwidth_ * (course_.speed[k] - speed_) + bandwidth_ * bandwidth_ * (course_.angle[k] - angle_);
    return std::clamp(M * law - C * load, -limit_, limit_);
  }

 private:
  EventSequence course_;
  double with_load_, against_load_, weight_, worm_, gear_;
  double limit_;               ///< [N m]
  double bandwidth_, filter_;  ///< [rad/s]
  double angle_ = 0.0, speed_ = 0.0;
  bool started_ = false;
};

}  // namespace

EventSequence rich_course(std::uint64_t seed, double duration, double period) {
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> either(-0.25, 0.25);
  EventSequence course;
  constexpr double smoothing = 40.0;  ///< [rad/s], twice critically damped
  const double T = period;
  double x = 0.0, v = 0.0, x2 = 0.0, v2 = 0.0;
  double begin = 0.0, from = 0.0;
  const long samples = std::lround(duration / T);
  std::size_t stage = 0;
  std::vector<Sine> waves = sines(plan[0].kind, generator);
  double step = 0.0, next_step = 0.0;
  for (long k = 0; k < samples; ++k) {
    const double t = static_cast<double>(k) * T;
    while (stage + 1 < std::size(plan) && t >= plan[stage].until * duration) {
      begin = plan[stage].until * duration;
      from = plan[stage].to;
      waves = sines(plan[++stage].kind, generator);
      next_step = t;
    }
    const double end = plan[stage].until * duration;
    if (t >= next_step) {
      step = either(generator);
      next_step = t + 0.3;
    }
    const double asked = centre(plan[stage], from, (t - begin) / (end - begin), step);
    const double a = smoothing * smoothing * (asked - x) - 2.0 * smoothing * v;
    v += T * a;
    x += T * v;
    const double a2 = smoothing * smoothing * (x - x2) - 2.0 * smoothing * v2;
    v2 += T * a2;
    x2 += T * v2;
    const double share = window(t, begin, end);
    double angle = x2;
    for (const Sine& wave : waves) angle += share * wave.amplitude * std::sin(turn * wave.frequency * t + wave.phase);
    course.angle.push_back(angle);
  }
  return course_through(std::move(course.angle), period);
}

EventSequence slow_course(double amplitude, double frequency, double duration) {
  std::vector<double> angle;
  const long samples = std::lround(duration / EventSequence{}.period);
  for (long k = 0; k < samples; ++k)
    angle.push_back(amplitude * std::sin(turn * frequency * static_cast<double>(k) * EventSequence{}.period));
  return course_through(std::move(angle));
}

EventSequence course_through(std::vector<double> angle, double period) {
  EventSequence course;
  course.period = period;
  course.angle = std::move(angle);
  const std::vector<double>& x = course.angle;
  const double T = course.period;
  course.speed.resize(x.size());
  course.acceleration.resize(x.size());
  for (std::size_t k = 1; k + 1 < x.size(); ++k) {
    course.speed[k] = (x[k + 1] - x[k - 1]) / (2.0 * T);
    course.acceleration[k] = (x[k + 1] - 2.0 * x[k] + x[k - 1]) / (T * T);
  }
  return course;
}

Law follow(EventSequence course, const Sheet& sheet) {
  return [pilot = Pilot(std::move(course), sheet)](double t, double seen) mutable { return pilot(t, seen); };
}

}  // namespace truth
