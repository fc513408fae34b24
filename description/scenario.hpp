#pragma once
#include <array>
#include <limits>
#include <string>
#include <tuple>
#include <variant>

#include "core/axis.hpp"
#include "core/effects.hpp"
#include "core/field.hpp"
#include "core/initial_state.hpp"
#include "core/load.hpp"
#include "core/mesh.hpp"
#include "core/signal.hpp"
#include "description/control_scenario.hpp"
#include "description/experiment_limits.hpp"
#include "description/recorded_columns.hpp"
#include "description/tolerances.hpp"
#include "events/solver_settings.hpp"

namespace wormdrive {

/// How long and how exactly a scenario is simulated, and how often a row is written.
struct RunSettings {
  double duration{};                        ///< [s]
  std::optional<double> report_interval{};  ///< [s]; a thousandth of the duration if not stated
  double relative_tolerance{1e-10};
  std::optional<double> absolute_tolerance{};  ///< [rad and rad/s]; a hundredth of the relative one if not stated
  double max_step{std::numeric_limits<double>::infinity()};  ///< [s]
  SolverKind solver = SolverKind::cvode;
  Method method = Method::bdf;

  static constexpr auto fields() {
    using P = RunSettings;
    return std::tuple{
        Field{&P::duration, "duration", unit::second, bounds::positive, "simulated time"},
        Field{&P::report_interval, "report_interval", unit::second, bounds::positive,
              "time between two rows of the result; duration / 1000 if not stated", Presence::optional},
        Field{&P::relative_tolerance, "relative_tolerance", unit::none, bounds::between(1e-14, 1e-2),
              "relative error allowed in one step; of taylor, in a second", Presence::optional},
        Field{
            &P::absolute_tolerance, "absolute_tolerance", unit::none, bounds::positive,
            "absolute error allowed in one step, of taylor in a second, in rad and rad/s; relative_tolerance / 100 if "
            "not stated",
            Presence::optional},
        Field{&P::max_step, "max_step", unit::second, bounds::positive, "longest step of the solver",
              Presence::optional}};
  }
  static constexpr auto choices() {
    using P = RunSettings;
    using Words = std::array<std::string_view, 2>;
    return std::tuple{
        Choice{&P::solver, "solver", Words{"cvode", "taylor"}, "taylor is fast but supports rigid teeth only"},
        Choice{&P::method, "method", Words{"bdf", "adams"}, "integration method of cvode"}};
  }

  double rows_every() const { return report_interval.value_or(duration / 1000.0); }
  SolverSettings solver_settings() const {
    return {solver, method, relative_tolerance, absolute_tolerance.value_or(0.01 * relative_tolerance), max_step};
  }
};

/// Everything that defines a run, in SI; plain data.
struct Scenario {
  std::string title;
  Axis axis = Axis::rotary;
  std::variant<MeshParameters<double>, SingleInertia<double>> mesh;
  LoadParameters load = Signal{};
  Effects<double> effects;
  Signal motor;
  InitialState<double> initial;
  RunSettings run;
  std::optional<ControlScenario> control;  ///< nothing: the motor's signal alone
  std::optional<Tolerances> tolerance;     ///< nothing: not stated, the defaults
  std::optional<ExperimentLimits> limits;  ///< nothing: not stated
  ColumnNames columns;                     ///< of recordings, where they have other names than usual
};

}  // namespace wormdrive
