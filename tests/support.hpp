#pragma once
// What the tests share: the paper's drive, one way to run a drive that keeps everything, and the reference data.
#include <cmath>
#include <fstream>
#include <functional>
#include <iomanip>
#include <iostream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "core/load.hpp"
#include "core/unit.hpp"
#include "core/worm_drive.hpp"
#include "events/simulate.hpp"
#include "events/solvers.hpp"
#include "numbers.hpp"

namespace wormdrive::test {

// ---- drives -----------------------------------------------------------------------------------------------------

/// The worm gear of the paper's Table 1 with its identified friction.
inline MeshParameters<double> table1(double mu = 0.25) {
  return {.i = 60,
          .lambda = 4 * unit::degree,
          .phi_n = 20 * unit::degree,
          .lw = 0.011,
          .lg = 0.045,
          .mu = mu,
          .Jw = 2.53e-5,
          .Jg = 7.39e-4};
}

/// The same gear with the lead angle that its ratio needs: only then is the mesh free of energy errors.
inline MeshParameters<double> closing(MeshParameters<double> p) {
  p.lambda = GearMesh<double>(p).closing_lead_angle();
  return p;
}

/// The same gear with another ratio and lead angle, and the pitch radius that these need.
inline MeshParameters<double> closing(MeshParameters<double> p, double i, double lambda) {
  p.i = i;
  p.lambda = lambda;
  p.lg = p.i * p.lw * std::tan(p.lambda);
  return p;
}

inline Signal constant(double torque) { return {{Constant{torque}}}; }

/// The paper's fig. 9: a motor torque 0.05 cos(3 pi t + pi/2) against an almost balanced arm.
inline Signal fig9_motor() { return {{Sinusoid{.amplitude = 0.05, .frequency = 1.5, .phase = 90 * unit::degree}}}; }
inline GravityArm fig9_load() {
  GravityArm arm;
  arm.amplitude = 0.0196;
  return arm;
}

/// The stated effects on, all others absent.
template <class... Effect>
Effects<double> effects(const Effect&... effect) {
  Effects<double> all;
  ((std::get<std::optional<Effect>>(all.list) = effect), ...);
  return all;
}

template <class Load>
auto drive(const MeshParameters<double>& p, const Load& load, const Signal& motor, Effects<double> on = {}) {
  using Made = decltype(make_load(load));
  return WormDrive<double, Made>(GearMesh<double>(p), make_load(load), std::move(on), motor);
}

/// One that carries the states of its effects.
template <class Load>
auto drive_with_states(const GearMesh<double>& mesh, const Load& load, const Signal& motor, const Effects<double>& on) {
  using Made = decltype(make_load(load));
  return WormDrive<double, Made, true>(mesh, make_load(load), on, motor);
}

/// A drive with its inputs frozen at t, ready to be asked for accelerations.
template <class Load>
auto entered(const MeshParameters<double>& p, const Load& load, const Signal& motor, Effects<double> on = {},
             double t = 0.0) {
  auto d = drive(p, load, motor, std::move(on));
  d.enter(t);
  return d;
}

/// The four moving modes of a drive with teeth.
inline constexpr Mode moving_modes[] = {{Motion::forward, Flank::left},
                                        {Motion::forward, Flank::right},
                                        {Motion::backward, Flank::left},
                                        {Motion::backward, Flank::right}};

/// Inertia M and torque ratio C of M theta_g'' = tau_m + C tau_l in a mode.
struct Branch {
  double M, C;

  Branch(const MeshParameters<double>& p, Mode mode) {
    const GearMesh<double> mesh(p);
    C = mesh.C(mode.product() * mesh.mu);
    M = mesh.Jw * mesh.i + C * mesh.Jg;
  }
  double acceleration(double tau_m, double tau_l) const { return (tau_m + C * tau_l) / M; }
};

// ---- runs -------------------------------------------------------------------------------------------------------

template <class System>
struct Run {
  using Instant = typename System::Instant;
  struct Row {
    Instant now;
    Observation seen;
  };
  struct Event {
    Instant before, after;  ///< left and right limit, at one time
  };
  std::vector<Row> rows;      ///< everything that was recorded, both sides of events included
  std::vector<Event> events;  ///< every change of the mode
  Instant end;
  SolverStatistics statistics;

  std::vector<Mode> modes() const {
    std::vector<Mode> sequence{rows.front().now.mode};
    for (const Event& e : events) sequence.push_back(e.after.mode);
    return sequence;
  }
};

/// By which solver a test runs.
struct By {
  SolverKind solver;
  Method method = Method::bdf;
};
inline constexpr By bdf{SolverKind::cvode, Method::bdf}, adams{SolverKind::cvode, Method::adams},
    taylor{SolverKind::taylor};
inline constexpr By every_solver[] = {bdf, adams, taylor};

inline SolverSettings tight(By by = bdf, double relative = 1e-13) {
  return {
      .solver = by.solver, .method = by.method, .relative_tolerance = relative, .absolute_tolerance = 0.01 * relative};
}

/// Whatever samples, behind functions, so that the runs of a drive are compiled once.
template <class System>
struct AnySampler {
  using Instant = typename System::Instant;
  std::function<double(System&, const Instant&)> answer;
  std::function<void(System&, const Instant&)> hold;  ///< at a latch

  template <class Controller>
  static AnySampler of(Controller& controller) {
    AnySampler any{[&](System& s, const Instant& now) { return controller.sample(s, now); }, {}};
    if constexpr (requires(System & s, const Instant& now) { controller.latch(s, now); })
      any.hold = [&](System& s, const Instant& now) { controller.latch(s, now); };
    return any;
  }
  double sample(System& s, const Instant& now) { return answer(s, now); }
  void latch(System& s, const Instant& now) {
    if (hold) hold(s, now);
  }
};

template <class System>
Run<System> run_any(System system, const Timetable& timetable, typename System::Instant from,
                    const SolverSettings& settings, AnySampler<System> controller) {
  Run<System> result;
  with_solver(system, settings, [&](auto& solver) {
    const auto record = [&](const System& s, const typename System::Instant& now) {
      if (!result.rows.empty()) {
        const auto& last = result.rows.back().now;
        if (last.t == now.t && last.mode != now.mode) result.events.push_back({last, now});
      }
      result.rows.push_back({now, s.observe(now)});
    };
    result.end = simulate(system, solver, controller, timetable, from, record);
    result.statistics = solver.statistics();
  });
  return result;
}
template <class System, class Controller>
Run<System> run(System system, const Timetable& timetable, typename System::Instant from,
                const SolverSettings& settings, Controller& controller) {
  return run_any(std::move(system), timetable, from, settings, AnySampler<System>::of(controller));
}
template <class System>
Run<System> run(System system, const Timetable& timetable, typename System::Instant from,
                const SolverSettings& settings = tight()) {
  NoController nobody;
  return run(std::move(system), timetable, from, settings, nobody);
}

// The runs of most tests are compiled once, in support.cpp.
#define WORMDRIVE_TEST_RUN(Drive)                                                                      \
  template Run<Drive> run_any(Drive, const Timetable&, typename Drive::Instant, const SolverSettings&, \
                              AnySampler<Drive>)
using TimedDrive = WormDrive<double, TimedLoad>;
using ArmDrive = WormDrive<double, GravityLoad>;
using SumDrive = WormDrive<double, SummedLoad>;
using TimedDriveWithStates = WormDrive<double, TimedLoad, true>;
using ArmDriveWithStates = WormDrive<double, GravityLoad, true>;
using SumDriveWithStates = WormDrive<double, SummedLoad, true>;
extern WORMDRIVE_TEST_RUN(TimedDrive);
extern WORMDRIVE_TEST_RUN(ArmDrive);
extern WORMDRIVE_TEST_RUN(SumDrive);
extern WORMDRIVE_TEST_RUN(TimedDriveWithStates);
extern WORMDRIVE_TEST_RUN(ArmDriveWithStates);
extern WORMDRIVE_TEST_RUN(SumDriveWithStates);

// ---- reference data ---------------------------------------------------------------------------------------------

/// A CSV file with a header: text by column name and row.
struct Table {
  std::map<std::string, std::vector<std::string>> columns;

  std::size_t size() const { return columns.begin()->second.size(); }
  const std::string& text(const std::string& column, std::size_t row) const { return columns.at(column).at(row); }
  double number(const std::string& column, std::size_t row) const { return std::stod(text(column, row)); }
};

/// Where a file of the reference data is; without the data it says so in the words by which ctest knows a skipped test.
inline std::optional<std::string> reference_path(const std::string& file) {
  std::string path = std::string(WORMDRIVE_REFERENCE_DATA) + "/" + file;
  if (std::ifstream(path)) return path;
  std::cout << "skipped: reference data not found\n";
  return std::nullopt;
}

/// A file of the reference data as a table.
inline std::optional<Table> reference(const std::string& name) {
  const auto path = reference_path(name);
  if (!path) return std::nullopt;
  std::ifstream file(*path);
  const auto cells = [](const std::string& line) {
    std::vector<std::string> found;
    std::istringstream rest(line);
    for (std::string cell; std::getline(rest, cell, ',');) {
      std::erase_if(cell, [](char c) { return c == '"' || c == '\r'; });
      found.push_back(cell);
    }
    return found;
  };
  std::string line;
  std::getline(file, line);
  const std::vector<std::string> names = cells(line);
  Table table;
  while (std::getline(file, line)) {
    const std::vector<std::string> values = cells(line);
    for (std::size_t k = 0; k < names.size(); ++k) table.columns[names[k]].push_back(values.at(k));
  }
  return table;
}

}  // namespace wormdrive::test
