// FMI 3.0, function by function: those that have something to do here. fmi3_unsupported.cpp has the others.
#include "bindings/fmi/fmi3.h"

#include "bindings/fmi/component.hpp"
#include "bindings/fmi/serial_state.hpp"

using namespace wormdrive;

namespace {

fmi3Status as_fmi3(Status status) { return static_cast<fmi3Status>(status); }

/// What an importer of this version agrees on for co-simulation, beside the instance.
struct Component3 : Component {
  fmi3InstanceEnvironment environment = nullptr;
  fmi3IntermediateUpdateCallback look = nullptr;
  bool may_return_early = false;
};

fmi3Status too_few_values(fmi3Instance c, const char* function) {
  return as_fmi3(call(c, function, whole_life,
                      [](FmuInstance&) { throw std::invalid_argument("there are fewer values than variables"); }));
}
template <class Use>
fmi3Status call3(fmi3Instance c, const char* function, Phases allowed, Use&& use) {
  return as_fmi3(call(c, function, allowed, std::forward<Use>(use)));
}

Component* made(fmi3String name, fmi3String token, fmi3String resources, InterfaceType type,
                fmi3InstanceEnvironment environment, fmi3LogMessageCallback message) {
  Component::Log log;
  if (message)
    log = [environment, message](Status status, const char* category, const std::string& text) {
      message(environment, as_fmi3(status), category, text.c_str());
    };
  return instantiate<Component3>(name, token, resources, type, std::move(log));
}

/// Lets the importer look at an event, if it wants to, and ask for an earlier end of the step: when it is to end [s].
double end_of_step(const Component3& component, FmuInstance& instance, double t) {
  constexpr double never = std::numeric_limits<double>::infinity();
  const bool stops = component.may_return_early && instance.uses_event_mode();
  if (!component.look) return stops ? t : never;
  fmi3Boolean requested = fmi3Boolean{false};
  fmi3Float64 until = t;
  const Phase before = instance.phase();
  instance.enter(Phase::intermediate);
  component.look(component.environment, t, false, true, true, component.may_return_early, &requested, &until);
  instance.enter(before);
  return stops ? t : requested && component.may_return_early ? std::max(t, until) : never;
}

}  // namespace

const char* fmi3GetVersion() { return "3.0"; }
fmi3Status fmi3SetDebugLogging(fmi3Instance c, fmi3Boolean on, size_t count, const fmi3String categories[]) {
  return call3(c, __func__, whole_life,
               [&](FmuInstance&) { switch_messages(*static_cast<Component*>(c), on, count, categories); });
}

// ---- life -----------------------------------------------------------------------------------------------------------

fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean,
                                          fmi3Boolean, fmi3InstanceEnvironment environment,
                                          fmi3LogMessageCallback message) {
  return made(name, token, resources, InterfaceType::model_exchange, environment, message);
}
fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean,
                                         fmi3Boolean, fmi3Boolean event_mode, fmi3Boolean early_return,
                                         const fmi3ValueReference[], size_t, fmi3InstanceEnvironment environment,
                                         fmi3LogMessageCallback message, fmi3IntermediateUpdateCallback look) {
  Component* const component = made(name, token, resources, InterfaceType::co_simulation, environment, message);
  if (!component) return nullptr;
  auto& c = static_cast<Component3&>(*component);
  c.environment = environment;
  c.look = look;
  c.may_return_early = early_return;
  if (event_mode) c.instance.use_event_mode();
  return component;
}
fmi3Instance fmi3InstantiateScheduledExecution(fmi3String, fmi3String, fmi3String, fmi3Boolean, fmi3Boolean,
                                               fmi3InstanceEnvironment environment, fmi3LogMessageCallback message,
                                               fmi3ClockUpdateCallback, fmi3LockPreemptionCallback,
                                               fmi3UnlockPreemptionCallback) {
  if (message) message(environment, fmi3Error, log_categories[1].data(), "this FMU has no scheduled execution");
  return nullptr;
}
void fmi3FreeInstance(fmi3Instance c) { delete static_cast<Component3*>(static_cast<Component*>(c)); }

fmi3Status fmi3EnterInitializationMode(fmi3Instance c, fmi3Boolean has_tolerance, fmi3Float64 tolerance,
                                       fmi3Float64 start, fmi3Boolean has_stop, fmi3Float64 stop) {
  return call3(c, __func__, Phase::instantiated, [&](FmuInstance& instance) {
    FmuInstance::Experiment experiment{start};
    if (has_stop) experiment.stop = stop;
    if (has_tolerance) experiment.tolerance = tolerance;
    instance.set_up(experiment);
    instance.enter_initialization();
  });
}
fmi3Status fmi3ExitInitializationMode(fmi3Instance c) {
  return call3(c, __func__, Phase::initialization, [](FmuInstance& instance) { instance.exit_initialization(); });
}
fmi3Status fmi3EnterEventMode(fmi3Instance c) {
  return call3(c, __func__, Phase::continuous | Phase::step,
               [](FmuInstance& instance) { instance.enter_event_mode(); });
}
fmi3Status fmi3Terminate(fmi3Instance c) {
  return call3(c, __func__, any_mode, [](FmuInstance& instance) { instance.enter(Phase::terminated); });
}
fmi3Status fmi3Reset(fmi3Instance c) {
  return call3(c, __func__, outside_step, [](FmuInstance& instance) { instance.reset(); });
}

// ---- variables ------------------------------------------------------------------------------------------------------

fmi3Status fmi3GetFloat64(fmi3Instance c, const fmi3ValueReference r[], size_t count, fmi3Float64 values[],
                          size_t size) {
  return size < count ? too_few_values(c, __func__) : as_fmi3(get_reals(c, __func__, r, count, values));
}
fmi3Status fmi3GetInt32(fmi3Instance c, const fmi3ValueReference r[], size_t count, fmi3Int32 values[], size_t size) {
  return size < count ? too_few_values(c, __func__) : as_fmi3(get_integers(c, __func__, r, count, values));
}
fmi3Status fmi3SetFloat64(fmi3Instance c, const fmi3ValueReference r[], size_t count, const fmi3Float64 values[],
                          size_t size) {
  return size < count ? too_few_values(c, __func__) : as_fmi3(set_reals(c, __func__, r, count, values));
}
fmi3Status fmi3SetInt32(fmi3Instance c, const fmi3ValueReference r[], size_t count, const fmi3Int32[], size_t) {
  return as_fmi3(set_integers(c, __func__, r, count));
}

fmi3Status fmi3GetDirectionalDerivative(fmi3Instance c, const fmi3ValueReference unknowns[], size_t rows,
                                        const fmi3ValueReference knowns[], size_t columns, const fmi3Float64 seed[],
                                        size_t seeds, fmi3Float64 result[], size_t results) {
  if (seeds < columns || results < rows) return too_few_values(c, __func__);
  return as_fmi3(directional_derivative(c, __func__, {unknowns, rows}, {knowns, columns}, seed, result));
}
fmi3Status fmi3GetAdjointDerivative(fmi3Instance c, const fmi3ValueReference unknowns[], size_t rows,
                                    const fmi3ValueReference knowns[], size_t columns, const fmi3Float64 seed[],
                                    size_t seeds, fmi3Float64 result[], size_t results) {
  if (seeds < rows || results < columns) return too_few_values(c, __func__);
  return as_fmi3(adjoint_derivative(c, __func__, {unknowns, rows}, {knowns, columns}, seed, result));
}

// ---- kept states ----------------------------------------------------------------------------------------------------

fmi3Status fmi3GetFMUState(fmi3Instance c, fmi3FMUState* state) { return as_fmi3(keep_state(c, __func__, state)); }
fmi3Status fmi3SetFMUState(fmi3Instance c, fmi3FMUState state) { return as_fmi3(restore_state(c, __func__, state)); }
fmi3Status fmi3FreeFMUState(fmi3Instance c, fmi3FMUState* state) { return as_fmi3(free_state(c, __func__, state)); }
fmi3Status fmi3SerializedFMUStateSize(fmi3Instance c, fmi3FMUState state, size_t* size) {
  return as_fmi3(serialized_size(c, __func__, state, size));
}
fmi3Status fmi3SerializeFMUState(fmi3Instance c, fmi3FMUState state, fmi3Byte bytes[], size_t size) {
  return as_fmi3(serialize(c, __func__, state, bytes, size));
}
fmi3Status fmi3DeserializeFMUState(fmi3Instance c, const fmi3Byte bytes[], size_t size, fmi3FMUState* state) {
  return as_fmi3(deserialize(c, __func__, bytes, size, state));
}

// ---- events ---------------------------------------------------------------------------------------------------------

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance c, fmi3Boolean* need_update, fmi3Boolean* terminate,
                                    fmi3Boolean* nominals_changed, fmi3Boolean* values_changed,
                                    fmi3Boolean* next_defined, fmi3Float64* next) {
  return call3(c, __func__, Phase::event, [&](FmuInstance& instance) {
    for (const void* place :
         {static_cast<void*>(need_update), static_cast<void*>(terminate), static_cast<void*>(nominals_changed),
          static_cast<void*>(values_changed), static_cast<void*>(next_defined), static_cast<void*>(next)})
      need(place, "the place of what the event changes");
    const double due = instance.pass_events();
    *need_update = *terminate = *nominals_changed = false;
    *values_changed = instance.type() == InterfaceType::model_exchange;  // as in FMI 2.0: solvers are to start anew
    *next_defined = std::isfinite(due);
    *next = *next_defined ? due : 0.0;
  });
}

// ---- model exchange -------------------------------------------------------------------------------------------------

fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance c) {
  return call3(c, __func__, Phase::event,
               [](FmuInstance& instance) { instance.leave_event_mode(InterfaceType::model_exchange); });
}
fmi3Status fmi3CompletedIntegratorStep(fmi3Instance c, fmi3Boolean, fmi3Boolean* enter_event_mode,
                                       fmi3Boolean* terminate) {
  return call3(c, __func__, Phase::continuous, [&](FmuInstance&) {
    need(enter_event_mode, "the place of enterEventMode");
    need(terminate, "the place of terminateSimulation");
    *enter_event_mode = *terminate = false;
  });
}
fmi3Status fmi3SetTime(fmi3Instance c, fmi3Float64 t) {
  return call3(c, __func__, Phase::event | Phase::continuous, [&](FmuInstance& instance) { instance.set_time(t); });
}
fmi3Status fmi3SetContinuousStates(fmi3Instance c, const fmi3Float64 x[], size_t count) {
  return as_fmi3(set_states(c, __func__, x, count));
}
fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance c, fmi3Float64 rates[], size_t count) {
  return as_fmi3(get_list(c, __func__, rates, count, "derivatives", rates_of));
}
fmi3Status fmi3GetEventIndicators(fmi3Instance c, fmi3Float64 z[], size_t count) {
  return as_fmi3(get_list(c, __func__, z, count, "event indicators", indicators_of));
}
fmi3Status fmi3GetContinuousStates(fmi3Instance c, fmi3Float64 x[], size_t count) {
  return as_fmi3(get_list(c, __func__, x, count, "states", states_of));
}
fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance c, fmi3Float64 nominals[], size_t count) {
  return as_fmi3(get_list(c, __func__, nominals, count, "states", nominals_of));
}
fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance c, size_t* count) {
  return call3(c, __func__, outside_step, [&](FmuInstance& instance) {
    need(count, "the place of the number");
    *count = instance.ports().indicators.size();
  });
}
fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance c, size_t* count) {
  return call3(c, __func__, outside_step, [&](FmuInstance& instance) {
    need(count, "the place of the number");
    *count = instance.ports().states.size();
  });
}

// ---- co-simulation --------------------------------------------------------------------------------------------------

fmi3Status fmi3EnterStepMode(fmi3Instance c) {
  return call3(c, __func__, Phase::event,
               [](FmuInstance& instance) { instance.leave_event_mode(InterfaceType::co_simulation); });
}
fmi3Status fmi3GetOutputDerivatives(fmi3Instance c, const fmi3ValueReference r[], size_t count,
                                    const fmi3Int32 orders[], fmi3Float64 values[], size_t size) {
  return size < count ? too_few_values(c, __func__)
                      : as_fmi3(output_derivatives(c, __func__, r, count, orders, values));
}
fmi3Status fmi3DoStep(fmi3Instance c, fmi3Float64 now, fmi3Float64 step, fmi3Boolean, fmi3Boolean* event,
                      fmi3Boolean* terminate, fmi3Boolean* early, fmi3Float64* reached) {
  return call3(c, __func__, Phase::step, [&](FmuInstance& instance) {
    for (const void* place : {static_cast<void*>(event), static_cast<void*>(terminate), static_cast<void*>(early),
                              static_cast<void*>(reached)})
      need(place, "the place of how the step ended");
    const auto& component = static_cast<Component3&>(*static_cast<Component*>(c));
    double end = now + step, event_at = std::numeric_limits<double>::quiet_NaN();
    *event = *terminate = *early = false;
    *reached = instance.time();
    try {
      instance.step(now, step, [&](double t) {
        event_at = t;
        return end = std::min(end, end_of_step(component, instance, t));
      });
    } catch (const StepHalted&) {
      *terminate = true;
      *reached = instance.time();
      throw;
    }
    *reached = instance.time();
    *early = end < now + step;
    *event = instance.uses_event_mode() && component.may_return_early && event_at == *reached;
  });
}

// The C++ library in an FMU keeps memory for exceptions, 73 KB, until its process ends; a process that loads and
// unloads FMUs would lose as much with each. It goes with the FMU.
#ifdef __GLIBCXX__
namespace __gnu_cxx {
void __freeres();
}

namespace {
[[gnu::destructor]] void free_memory_for_exceptions() { __gnu_cxx::__freeres(); }
}  // namespace
#endif
