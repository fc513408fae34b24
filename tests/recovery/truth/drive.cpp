#include <algorithm>
#include <cmath>
#include <random>

#include "recovery/truth/recording.hpp"

namespace truth {
namespace {

/// Dry friction as an impulse: what stops the motion within a step, no more than the limit. Several that act at once
/// share the load, hence the sum.
struct DryImpulse {
  double sum = 0.0;
  double highest, lowest;

  /// The impulse to add so that a motion with this speed and mobility stops, if the limits let it.
  double stop(double speed, double mobility) {
    const double before = sum;
    sum = std::clamp(sum - speed / mobility, lowest, highest);
    return sum - before;
  }
  bool holds() const { return sum > lowest && sum < highest; }
};

/// Share of the drop that is gone at a sliding speed x in units of its own.
double fallen(MeshFriction::Fall fall, double x) {
  switch (fall) {
    case MeshFriction::Fall::gaussian: return 1.0 - std::exp(-x * x);
    case MeshFriction::Fall::lorentzian: return x * x / (1.0 + x * x);
    case MeshFriction::Fall::hyperbolic: return 1.0 - 1.0 / std::cosh(x);
  }
  return 0.0;
}

/// Two inertias that touch with their teeth; one step after the other, drift - kick - drift.
class Machine {
 public:
  Machine(const Drive& drive, double duration, double step, double start_angle)
      : d_(drive), duration_(duration), h_(step), y_(start_angle) {
    const Geometry& g = d_.geometry;
    const double cp = std::cos(g.pressure_angle), sl = std::sin(g.lead_angle), cl = std::cos(g.lead_angle);
    normal_worm_ = g.worm_radius * cp * sl;
    normal_gear_ = g.gear_radius * cp * cl;
    slide_worm_ = g.worm_radius * cl;
    slide_gear_ = g.gear_radius * sl;
    per_sliding_ = g.worm_radius / cl;
    Jw_ = g.worm_inertia + d_.worm_inertia_excess;
    set_mass(1.0);
    const double k = d_.teeth.stiffness * normal_gear_ * normal_gear_;
    const double reduced = 1.0 / (1.0 / Jg_ + 1.0 / (Jw_ * g.ratio * g.ratio));
    damper_ = 2.0 * d_.teeth.damping_ratio * std::sqrt(k * reduced) / (normal_gear_ * normal_gear_);
    lag_share_ = d_.actuator.lag > 0.0 ? 1.0 - std::exp(-h_ / d_.actuator.lag) : 1.0;
    const double load = load_torque();
    const double wind_up = load / k + (load >= 0.0 ? 0.5 : -0.5) * d_.teeth.gap;
    w_ = g.ratio * (y_ + advance(y_) - wind_up);
  }

  double gear() const { return y_; }
  double worm() const { return w_; }
  double gear_speed() const { return vy_; }
  double worm_speed() const { return vw_; }

  /// Of both inertias and the load in the field of gravity, the teeth's own included [J].
  double energy() const {
    const double overlap = std::max(0.0, (std::abs(relative()) - 0.5 * d_.teeth.gap) * normal_gear_);
    return 0.5 * (Jw_ * vw_ * vw_ + Jg_ * vy_ * vy_ + d_.teeth.stiffness * overlap * overlap) -
           weight_ * std::sin(y_ + d_.load.angle);
  }

  /// One step at a time [s] with the torque that the actuator has received and what disturbs it.
  void step(double t, double received, double disturbance) {
    if (t >= d_.load.lost_at && !lost_) {
      lost_ = true;
      set_mass(1.0 - d_.load.lost);
    }
    w_ += 0.5 * h_ * vw_;
    y_ += 0.5 * h_ * vy_;
    kick(t, actuate(t, received) + disturbance);
    w_ += 0.5 * h_ * vw_;
    y_ += 0.5 * h_ * vy_;
  }

 private:
  void set_mass(double share) {
    const Geometry& g = d_.geometry;
    weight_ = share * g.mass * g.gravity * g.arm * (1.0 + d_.load.excess);
    Jg_ = g.gear_inertia + d_.gear_inertia_excess + share * g.mass * g.arm * g.arm;
  }
  double advance(double y) const {
    return d_.teeth.error == 0.0 ? 0.0 : d_.teeth.error * std::sin(y + d_.teeth.error_phase);
  }
  double relative() const { return y_ + advance(y_) - w_ / d_.geometry.ratio; }
  double load_torque() const {
    return weight_ * std::cos(y_ + d_.load.angle) - d_.load.spring * (y_ - d_.load.spring_angle);
  }

  double actuate(double t, double received) {
    const Actuator& a = d_.actuator;
    motor_ += lag_share_ * (std::clamp(received, -a.limit, a.limit) - motor_);
    double torque = (1.0 + a.gain) * motor_ + a.offset;
    if (a.cogging != 0.0) torque += a.cogging * std::sin(a.cogging_periods * w_ + a.cogging_phase);
    if (a.vibration != 0.0) torque += a.vibration * std::sin(2.0 * std::numbers::pi * a.vibration_frequency * t);
    return torque;
  }

  double friction(double t) const {
    const MeshFriction& f = d_.friction;
    double mu = f.level;
    if (f.drop != 0.0) mu -= f.drop * fallen(f.fall, per_sliding_ * vw_ / f.fall_speed);
    if (f.asymmetry != 0.0 && vw_ != 0.0) mu += vw_ > 0.0 ? f.asymmetry : -f.asymmetry;
    if (f.wave != 0.0) mu *= 1.0 + f.wave * std::sin(y_ + f.wave_phase);
    if (f.worm_wave != 0.0) mu *= 1.0 + f.worm_wave * std::sin(d_.geometry.ratio * y_ + f.worm_wave_phase);
    if (f.spot != 0.0) mu *= 1.0 + f.spot * std::exp(-std::pow((y_ - f.spot_angle) / f.spot_width, 2));
    mu *= 1.0 + f.drift * t / duration_;
    if (at_rest_) {
      const double rest = t - rest_since_;
      mu += f.rise + f.dwell_rise * rest / (rest + f.dwell_time);
    }
    return std::max(mu, 0.0);
  }

  void kick(double t, double torque) {
    const Bearings& b = d_.bearings;
    torque -= b.worm_viscous * vw_ + b.asymmetry_torque * (vw_ != 0.0) + b.asymmetry_viscous * std::abs(vw_);
    double load = load_torque() - b.gear_viscous * vy_ - b.fan * vy_ * std::abs(vy_);
    const double slope = d_.teeth.error == 0.0 ? 1.0 : 1.0 + d_.teeth.error * std::cos(y_ + d_.teeth.error_phase);
    const double rel = relative(), overlap = (std::abs(rel) - 0.5 * d_.teeth.gap) * normal_gear_;
    double press = 0.0;
    if (overlap > 0.0) {
      const double flank = rel > 0.0 ? 1.0 : -1.0;
      const double approach = flank * (slope * vy_ - vw_ / d_.geometry.ratio) * normal_gear_;
      press = std::max(0.0, d_.teeth.stiffness * overlap + damper_ * approach);
      torque += flank * press * normal_worm_;
      load -= flank * press * normal_gear_ * slope;
    }
    vw_ += h_ * torque / Jw_;
    vy_ += h_ * load / Jg_;
    rub(t, press);
  }

  void rub(double t, double press) {
    const Bearings& b = d_.bearings;
    const double mesh_limit = h_ * friction(t) * press, worm_limit = h_ * b.worm_coulomb,
                 gear_limit = h_ * b.gear_coulomb;
    DryImpulse mesh{0.0, mesh_limit, -mesh_limit}, worm{0.0, worm_limit, -worm_limit},
        gear{0.0, gear_limit, -gear_limit};
    const double mobility = slide_worm_ * slide_worm_ / Jw_ + slide_gear_ * slide_gear_ / Jg_;
    const int sweeps = worm_limit > 0.0 || gear_limit > 0.0 ? 6 : 1;
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      if (worm_limit > 0.0) vw_ += worm.stop(vw_, 1.0 / Jw_) / Jw_;
      if (gear_limit > 0.0) vy_ += gear.stop(vy_, 1.0 / Jg_) / Jg_;
      if (mesh_limit > 0.0) {
        const double impulse = mesh.stop(slide_worm_ * vw_ + slide_gear_ * vy_, mobility);
        vw_ += impulse * slide_worm_ / Jw_;
        vy_ += impulse * slide_gear_ / Jg_;
      }
    }
    const bool held = mesh_limit > 0.0 && mesh.holds();
    if (held && !at_rest_) rest_since_ = t;
    at_rest_ = held;
  }

  const Drive& d_;
  double duration_, h_;
  double normal_worm_, normal_gear_, slide_worm_, slide_gear_;  ///< arms of the normal and of the friction force [m]
  double per_sliding_;                                          ///< sliding speed per speed of the worm [m]
  double damper_, lag_share_;
  double Jw_, Jg_, weight_;
  double w_ = 0.0, y_, vw_ = 0.0, vy_ = 0.0, motor_ = 0.0;
  bool at_rest_ = false, lost_ = false;
  double rest_since_ = 0.0;
};

double rounded(double angle, double counts) {
  if (counts == 0.0) return angle;
  const double quantum = 2.0 * std::numbers::pi / counts;
  return quantum * std::round(angle / quantum) + 0.0;  // no negative zero
}

/// The steps at which samples are taken: one per period, all but the first early or late.
std::vector<long> sampled_steps(const RecordingSettings& settings) {
  const long per_sample = std::lround(settings.period / settings.step);
  const long samples = std::lround(settings.duration / settings.period);
  const double most = settings.jitter * static_cast<double>(per_sample);
  std::mt19937_64 generator(settings.seed + 1);  // the noise is that of an even recording
  std::uniform_real_distribution<double> early_or_late(-most, most);
  std::vector<long> steps;
  for (long k = 0; k < samples; ++k)
    steps.push_back(k * per_sample + (most > 0.0 && k > 0 ? std::lround(early_or_late(generator)) : 0));
  return steps;
}

}  // namespace

Recording record(const Drive& drive, const Law& law, const RecordingSettings& settings) {
  const long per_sample = std::lround(settings.period / settings.step);
  const std::vector<long> at = sampled_steps(settings);
  const long late_torque = std::lround(drive.actuator.delay / settings.step);
  const long late_angle = std::lround(drive.sensor.delay / settings.step);
  std::mt19937_64 generator(settings.seed);
  std::normal_distribution<double> normal;
  Machine machine(drive, settings.duration, settings.step, settings.start_angle);
  // the angles that a late encoder has still to show
  std::vector<double> waiting(static_cast<std::size_t>(late_angle) + 1, machine.gear());
  const auto slot = [&](long step) { return static_cast<std::size_t>(step % (late_angle + 1)); };
  const double retained = std::exp(-settings.period / drive.noise.time_constant);
  double colour = drive.noise.coloured * normal(generator);
  Recording r;
  if (settings.jitter > 0.0) r.time_digits = 7;
  std::size_t held = 0;  // the sample whose torque arrives
  for (std::size_t k = 0; k < at.size(); ++k) {
    const long even = static_cast<long>(k) * per_sample;
    const double t = static_cast<double>(k) * settings.period + static_cast<double>(at[k] - even) * settings.step;
    const double angle = waiting[slot(at[k])];  // the oldest, whose place the next step will take
    const Sensor& s = drive.sensor;
    const double seen = rounded((1.0 + s.scale) * angle + s.offset + s.noise * normal(generator), s.counts);
    r.time.push_back(t);
    r.gear_angle.push_back(seen);
    r.motor_torque.push_back(law(t, seen));
    if (s.worm_counts != 0.0) r.worm_angle.push_back(rounded(machine.worm(), s.worm_counts));
    r.true_angle.push_back(machine.gear());
    r.true_speed.push_back(machine.gear_speed());
    r.true_worm_speed.push_back(machine.worm_speed());
    r.mechanical_energy.push_back(machine.energy());
    colour = retained * colour + std::sqrt(1.0 - retained * retained) * drive.noise.coloured * normal(generator);
    const double disturbance = drive.noise.white * normal(generator) + colour;
    const long next = k + 1 < at.size() ? at[k + 1] : even + per_sample;
    for (long n = at[k]; n < next; ++n) {
      const long from = n - late_torque;
      while (held < k && at[held + 1] <= from) ++held;
      const double received = from < 0 ? 0.0 : r.motor_torque[held];
      machine.step(static_cast<double>(n) * settings.step, received, disturbance);
      waiting[slot(n)] = machine.gear();
    }
  }
  if (drive.actuator.reversed) std::reverse(r.motor_torque.begin(), r.motor_torque.end());
  return r;
}

}  // namespace truth
