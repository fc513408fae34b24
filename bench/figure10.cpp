// Every reading of the paper's figure 10: the sliding controller, and the PID over two decades of bandwidth.
// Prints the tables of docs/figure10.md and writes the curves to the CSV file named on the command line.
#include <complex>
#include <cstdio>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "description/build_control.hpp"
#include "events/simulation_failure.hpp"
#include "simulation/load_scenario.hpp"
#include "simulation/run_scenario.hpp"

using namespace wormdrive;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double lost = std::numeric_limits<double>::infinity();  ///< error of a run that leaves the reference for good

/// One way to read the paper [YehWu2009, fig. 10].
struct Reading {
  std::string name;
  double amplitude;  ///< of the reference [rad]
  bool sine;         ///< the load: actual 0.0176 sin, or nominal 0.0196 cos
  double inertia;    ///< of the load [kg m^2]
};

std::vector<Reading> readings() {
  std::vector<Reading> list;
  for (const auto& [inertia, J] : {std::pair{"bare", 0.0}, std::pair{"loaded", 0.013861}})
    for (const auto& [angle, amplitude] : {std::pair{"0.14 rad", 0.14}, std::pair{"0.14°", 0.14 * unit::degree}})
      for (const bool sine : {false, true})
        list.push_back({fmt::format("{}, {}, {}", angle, sine ? "sine" : "cosine", inertia), amplitude, sine, J});
  return list;
}

/// The shipped scenario in another reading.
Scenario scenario_of(const Reading& reading) {
  Scenario s = load_scenario(WORMDRIVE_SCENARIOS "/fig10_sliding_014rad_bare.toml", {}, Purpose::run);
  auto& arm = std::get<GravityArm>(s.load);
  arm.amplitude = reading.sine ? 0.0176 : 0.0196;
  arm.offset = reading.sine ? -90.0 * unit::degree : 0.0;
  arm.own_inertia = reading.inertia;
  std::get<SinusoidReference>(s.control->reference.terms.front()).amplitude = reading.amplitude;
  return s;
}

Metrics track(const Scenario& scenario) {
  Metrics failed{};
  failed.error_peak_to_peak = failed.error_rms = failed.torque_peak = failed.torque_rms = lost;
  try {
    const Metrics m = run_scenario(scenario).control->metrics;
    return m.error_peak_to_peak < 1.0 ? m : failed;
  } catch (const SimulationFailure&) {
    return failed;
  }
}

/// Integral weight alone puts the poles on a circle of this radius (Butterworth).
PidParameters pid(double radius, double M, double feedforward) {
  PidParameters p;
  p.integral_weight = M * M * std::pow(radius, 6);
  p.feedforward = feedforward;
  return p;
}

/// Least phase margin [deg] of the sampled loop around M s^2: exact for hold, backward difference, filter and sum.
double phase_margin(const PidGains& g, double M, double period, double filter) {
  const double gain = 1.0 - std::exp(-2.0 * pi * filter * period);
  const auto loop = [&](double w) {
    const std::complex<double> z = std::exp(std::complex<double>(0.0, w * period)), back = 1.0 / z;
    const std::complex<double> speed = gain * (1.0 - back) / period / (1.0 - (1.0 - gain) * back);
    const std::complex<double> plant = period * period * (z + 1.0) / (2.0 * M * (z - 1.0) * (z - 1.0));
    return (g.Ki * period / (1.0 - back) + g.Kp + g.Kd * speed) * plant;
  };
  double least = 180.0;
  std::complex<double> before = loop(0.1);
  for (double w = 0.1; w < 0.999 * pi / period; w *= 1.0005) {
    const std::complex<double> now = loop(w);
    if ((std::abs(before) > 1.0) != (std::abs(now) > 1.0)) {
      const double margin = 180.0 + std::arg(now) / unit::degree;
      least = std::min(least, margin > 180.0 ? margin - 360.0 : margin);
    }
    before = now;
  }
  return least;
}

class Table {
 public:
  explicit Table(const char* path) : csv_(path) {
    csv_ << "reading,controller,radius_rad_per_s,error_peak_to_peak_rad,error_rms_rad,torque_rms_Nm,torque_peak_Nm,"
            "phase_margin_deg\n";
  }
  void line(const Reading& r, const std::string& controller, double radius, const Metrics& m, double margin) {
    csv_ << fmt::format("\"{}\",{},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g},{:.3g}\n", r.name, controller, radius,
                        m.error_peak_to_peak, m.error_rms, m.torque_rms, m.torque_peak, margin);
  }

 private:
  std::ofstream csv_;
};

/// Sweeps the PID and prints a row for each bandwidth, with the error of the sliding controller over that of the PID.
void sweep(const Reading& reading, const Metrics& sliding, double feedforward, Table& table) {
  Scenario s = scenario_of(reading);
  const NominalModel nominal = make_nominal(s);
  const double M = mean_inertia(nominal);
  const std::string name = feedforward > 0.0 ? "pid_feedforward" : "pid";
  fmt::print(
      "\n{}, {}\n\n| p [rad/s] | margin | error p-p [rad] | rms [rad] | torque rms [N m] | peak [N m] | sliding/PID |\n"
      "|---|---|---|---|---|---|---|\n",
      reading.name, name);
  double before = 0.0, before_radius = 0.0;
  for (int k = 0; k <= 24; ++k) {
    const double radius = 10.0 * std::pow(10.0, k / 12.0);
    const PidParameters p = pid(radius, M, feedforward);
    s.control->law = p;
    const double margin = phase_margin(lqr_gains(p, M), M, s.control->sampling.period, s.control->sensor.filter_cutoff);
    const Metrics m = track(s);
    table.line(reading, name, radius, m, margin);
    const double share = 100.0 * sliding.error_peak_to_peak / m.error_peak_to_peak;
    if (m.error_peak_to_peak < lost)
      fmt::print("| {:.0f} | {:.0f}° | {:.3g} | {:.3g} | {:.3g} | {:.3g} | {:.0f} % |\n", radius, margin,
                 m.error_peak_to_peak, m.error_rms, m.torque_rms, m.torque_peak, share);
    else
      fmt::print("| {:.0f} | {:.0f}° | lost | | | | |\n", radius, margin);
    if (before > 0.0 && (before - 30.0) * (share - 30.0) < 0.0)
      fmt::print("<!-- 30 % at {:.0f} rad/s -->\n",
                 before_radius * std::pow(radius / before_radius, std::log(30.0 / before) / std::log(share / before)));
    before = share;
    before_radius = radius;
  }
}

}  // namespace

int main(int argc, char** argv) {
  Table table(argc > 1 ? argv[1] : "figure10.csv");
  for (const Reading& reading : readings()) {
    const Metrics s = track(scenario_of(reading));
    table.line(reading, "sliding", 30.0 * pi, s, 0.0);
    fmt::print(
        "\n## {}\n\nsliding: error p-p {:.3g}, rms {:.3g} rad; torque rms {:.3g}, peak {:.3g} N m; {:g} flank changes, "
        "{:g} reversals in 2 s, {:.3g} s stuck, {:.3g} s outside the layer\n",
        reading.name, s.error_peak_to_peak, s.error_rms, s.torque_rms, s.torque_peak, s.flank_changes, s.reversals,
        s.time_stuck, s.time_outside_layer);
    for (const double feedforward : {0.0, 1.0}) sweep(reading, s, feedforward, table);
  }
}
