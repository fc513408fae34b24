#include "bindings/fmi/instance.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/elastic/elastic_teeth.hpp"
#include "description/rejection.hpp"
#include "events/simulation_failure.hpp"

namespace wormdrive {
namespace {

/// Communication points that importers add up differ from each other by rounding; so much counts as one point.
bool same_point(double a, double b, double step) {
  return std::abs(a - b) <= 1e-9 * std::max({std::abs(a), std::abs(b), step});
}

/// A controller that samples so often within a step has slipped in the unit.
constexpr double most_samples_in_step = 1e9;

}  // namespace

FmuInstance::FmuInstance(FmuModel model, InterfaceType type) : stated_(std::move(model)), model_(stated_), type_(type) {
  const Offered has = offered(stated_);
  if (type == InterfaceType::model_exchange && !has.model_exchange)
    throw std::logic_error("this FMU is one for co-simulation");
  if (type == InterfaceType::co_simulation && !has.co_simulation)
    throw std::logic_error(has_elastic_teeth(stated_.scenario.effects)
                               ? "co-simulation of elastic teeth needs CVODE, which this library does not carry"
                               : "this FMU is one for model exchange");
}

void FmuInstance::begin() {
  stale_ = false;
  state_.run.reset();
  const Scenario& set = model_.scenario;
  if (const auto why = why_it_cannot_run(set)) throw std::invalid_argument(*why);
  if (InterfaceNames(set.effects).states != InterfaceNames(stated_.scenario.effects).states)
    throw std::invalid_argument(
        "with these parameters the effects have other states than the FMU describes; export the scenario with them");
  const auto move_from_outside = [&]<class Drive>(Drive drive) {
    state_.run.emplace(PlantRun<Drive>(std::move(drive), set.initial, state_.time, state_.torque));
  };
  const auto solve_inside = [&]<class Drive>(Drive drive) {
    if constexpr (solved_inside<Drive>) {
      const double tolerance = std::min(state_.experiment.tolerance.value_or(1.0), set.run.relative_tolerance);
      StepRun<Drive> run(std::move(drive), model_, state_.time, state_.torque, tolerance);
      if (state_.uses_event_mode) run.hold_left_limits();
      state_.run.emplace(std::move(run));
    }
  };
  const auto run_as_instantiated = [&]<class Drive>(Drive drive) {
    if (type_ == InterfaceType::model_exchange)
      move_from_outside(std::move(drive));
    else
      solve_inside(std::move(drive));
  };
  if (has_elastic_teeth(set.effects)) {
    run_as_instantiated(CompliantDrive(make_drive(set), tooth_contact(set.effects)));
  } else if (set.effects.have_states()) {
    run_as_instantiated(make_drive<true>(set));
  } else if (type_ == InterfaceType::model_exchange) {
    move_from_outside(make_drive(set));
  } else {
    with_drive_for_runs(set, [&](auto& drive) { solve_inside(std::move(drive)); });
  }
}

void FmuInstance::set_up(const Experiment& experiment) {
  const auto& [start, stop, tolerance] = experiment;
  if (!std::isfinite(start)) throw std::invalid_argument(fmt::format("the start time {} s is not finite", start));
  if (stop && !(*stop > start))
    throw std::invalid_argument(fmt::format("the stop time {} s is not after the start time {} s", *stop, start));
  if (tolerance && !(*tolerance > 0.0 && std::isfinite(*tolerance)))
    throw std::invalid_argument(fmt::format("the tolerance {} is not greater than 0", *tolerance));
  state_.experiment = experiment;
  state_.time = start;
}

void FmuInstance::enter_initialization() {
  begin();
  state_.phase = Phase::initialization;
}

void FmuInstance::exit_initialization() {
  if (stale_ || !state_.run) begin();  // parameters may have been rejected meanwhile
  state_.phase = uses_event_mode() ? Phase::event : Phase::step;
}

void FmuInstance::reset() {
  model_ = stated_;
  const bool event_mode = state_.uses_event_mode;  // as agreed when it was instantiated
  state_ = {};
  state_.uses_event_mode = event_mode;
  stale_ = false;
}

void FmuInstance::restore(const Kept& kept) {
  if (kept.type != type_) throw std::invalid_argument("the state is one of the other interface type");
  state_ = kept.state;
  model_.scenario = kept.set;
  stale_ = false;
}

void FmuInstance::set_time(double t) {
  if (!std::isfinite(t)) throw std::invalid_argument(fmt::format("the time {} s is not finite", t));
  with_moved_run([&](auto& run) { run.set_time(t); });
  state_.time = t;
}

// ---- co-simulation --------------------------------------------------------------------------------------------------

template <class Run, class Use>
void FmuInstance::go_on(Run& run, Use&& use) {
  try {
    use();
  } catch (const SimulationFailure& halt) {
    state_.halted = halt.what();
  }
  state_.time = run.time();
  if (state_.halted) throw StepHalted(*state_.halted);
}

void FmuInstance::step(double from, double size, const AtEvent& at_event) {
  if (!std::isfinite(size) || size <= 0.0)
    throw std::invalid_argument(fmt::format("the communication step {} s must be greater than 0", size));
  if (!same_point(from, state_.time, size))
    throw std::invalid_argument(
        fmt::format("the communication point {} s is not where the instance is, {} s", from, state_.time));
  const double until = std::max(from + size, state_.time);
  if (const auto& stop = state_.experiment.stop; stop && until > *stop && !same_point(until, *stop, size))
    throw std::invalid_argument(fmt::format("the step ends at {} s, after the stop time {} s", until, *stop));
  if (const auto& control = model_.scenario.control; control && size > most_samples_in_step * control->sampling.period)
    throw std::invalid_argument(
        fmt::format("the step {} s has more than {:g} samples of controller.sample_time_s = {} s", size,
                    most_samples_in_step, control->sampling.period));
  if (state_.halted) throw StepHalted(*state_.halted);
  if (until == state_.time) return;  // less than time resolves
  with_run([&]<class Run>(Run& run) {
    if constexpr (!MovedFromOutside<Run>) {
      const auto end = [&](double t) {
        state_.time = t;
        return at_event(t);
      };
      go_on(run, [&] { run.step(until, end); });
    }
  });
}

const SamplingSettings& FmuInstance::sample_clock(unsigned reference) const {
  const auto& control = model_.scenario.control;
  if (!control || static_cast<ScalarVariable>(reference) != ScalarVariable::sample_clock)
    throw std::invalid_argument(fmt::format("there is no clock with the value reference {}", reference));
  return control->sampling;
}

void FmuInstance::take_sample(unsigned reference) {
  const double period = sample_clock(reference).period, now = state_.time;
  if (state_.halted) throw StepHalted(*state_.halted);
  with_run([&]<class Run>(Run& run) {
    if constexpr (!MovedFromOutside<Run>) {
      const std::optional<double> latest = run.latest_sample();
      if (latest && same_point(*latest, now, period)) return;  // rounding put it into the step before
      if (!same_point(run.next_sample(), now, period))
        throw std::invalid_argument(
            fmt::format("the clock ticks at {} s, the controller samples next at {} s", now, run.next_sample()));
      go_on(run, [&] { run.take_sample(); });
    }
  });
  state_.takes_sample = true;
}

// ---- events ---------------------------------------------------------------------------------------------------------

void FmuInstance::enter_event_mode() {
  if (!uses_event_mode()) throw std::logic_error("the instance was made without event mode");
  state_.phase = Phase::event;
}

void FmuInstance::leave_event_mode(InterfaceType mode) {
  if (mode != type_) throw std::logic_error("this mode is one of the other interface type");
  state_.phase = mode == InterfaceType::model_exchange ? Phase::continuous : Phase::step;
}

double FmuInstance::pass_events() {
  state_.takes_sample = false;
  return with_run([](auto& run) {
    run.pass_events();
    return run.next_event_time();
  });
}

}  // namespace wormdrive
