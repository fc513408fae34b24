// What FMI 2.0 has for model exchange: the importer integrates, the model tells rates, indicators and events.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "bindings/fmi/boundary.hpp"

using namespace wormdrive;

namespace {

/// Calls use(run), where count must be the number that the importer was told.
template <class Count, class Use>
fmi2Status with_run(fmi2Component c, size_t count, Count&& wanted, Use&& use) {
  return guarded(c, [&](FmuInstance& instance) {
    instance.with_run([&](auto& run) {
      if (count != wanted(run)) throw std::invalid_argument("a number of states or indicators that the model has not");
      use(run);
    });
  });
}
constexpr auto state_count = []<class Run>(const Run&) { return Run::state_size; };
constexpr auto indicator_count = []<class Run>(const Run&) { return Run::indicator_count; };

}  // namespace

fmi2Status fmi2EnterEventMode(fmi2Component c) {
  return guarded(c, [](FmuInstance& instance) { instance.enter(Phase::event); });
}
fmi2Status fmi2NewDiscreteStates(fmi2Component c, fmi2EventInfo* info) {
  return guarded(c, [&](FmuInstance& instance) {
    instance.with_run([&](auto& run) {
      run.pass_events();
      const double next = run.next_event_time();
      // Rates bend or jump at every event. The standard has no word for that, and an importer that keeps its solver's
      // history across one goes wrong without a sign of it: it is told to take the states anew.
      *info = {fmi2False,
               fmi2False,
               fmi2False,
               fmi2True,
               std::isfinite(next) ? fmi2True : fmi2False,
               std::isfinite(next) ? next : 0.0};
    });
  });
}
fmi2Status fmi2EnterContinuousTimeMode(fmi2Component c) {
  return guarded(c, [](FmuInstance& instance) { instance.enter(Phase::continuous); });
}
fmi2Status fmi2CompletedIntegratorStep(fmi2Component c, fmi2Boolean, fmi2Boolean* enter_event_mode,
                                       fmi2Boolean* terminate) {
  return guarded(c, [&](FmuInstance&) { *enter_event_mode = *terminate = fmi2False; });
}
fmi2Status fmi2SetTime(fmi2Component c, fmi2Real t) {
  return guarded(c, [&](FmuInstance& instance) { instance.set_time(t); });
}
fmi2Status fmi2SetContinuousStates(fmi2Component c, const fmi2Real x[], size_t count) {
  return with_run(c, count, state_count, [&](auto& run) { run.set_state(x); });
}
fmi2Status fmi2GetDerivatives(fmi2Component c, fmi2Real rates[], size_t count) {
  return with_run(c, count, state_count, [&](auto& run) { run.rates(rates); });
}
fmi2Status fmi2GetEventIndicators(fmi2Component c, fmi2Real z[], size_t count) {
  return with_run(c, count, indicator_count, [&](auto& run) { run.indicators(z); });
}
fmi2Status fmi2GetContinuousStates(fmi2Component c, fmi2Real x[], size_t count) {
  return with_run(c, count, state_count, [&](auto& run) { run.state(x); });
}
fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component c, fmi2Real nominals[], size_t count) {
  return with_run(c, count, state_count, [&](auto&) { std::fill_n(nominals, count, 1.0); });
}
