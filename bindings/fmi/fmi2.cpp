// FMI 2.0, function by function: every one that the standard has, as thin as C and C++ are apart.
#include "bindings/fmi/fmi2.h"

#include "bindings/fmi/component.hpp"
#include "bindings/fmi/serial_state.hpp"

using namespace wormdrive;

namespace {

fmi2Status as_fmi2(Status status) { return static_cast<fmi2Status>(status); }

template <class Use>
fmi2Status call2(fmi2Component c, const char* function, Phases allowed, Use&& use) {
  return as_fmi2(call(c, function, allowed, std::forward<Use>(use)));
}

/// What an importer asks about a step that is no longer under way.
template <class Value, class Answer>
fmi2Status answer(fmi2Component c, const char* function, Value* value, Answer&& give) {
  bool known = false;
  const fmi2Status status = call2(c, function, Phase::step | Phase::terminated, [&](FmuInstance& instance) {
    need(value, "the place of the status");
    known = give(instance);
  });
  return status == fmi2OK && !known ? fmi2Discard : status;
}

}  // namespace

const char* fmi2GetTypesPlatform() { return "default"; }
const char* fmi2GetVersion() { return "2.0"; }
fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t count, const fmi2String categories[]) {
  return call2(c, __func__, whole_life,
               [&](FmuInstance&) { switch_messages(*static_cast<Component*>(c), on != fmi2False, count, categories); });
}

// ---- life -----------------------------------------------------------------------------------------------------------

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions* callbacks, fmi2Boolean, fmi2Boolean) {
  if (!callbacks) return nullptr;
  Component::Log log;
  if (callbacks->logger)
    log = [callbacks = *callbacks, name = std::string(name ? name : "")](Status status, const char* category,
                                                                         const std::string& text) {
      callbacks.logger(callbacks.componentEnvironment, name.c_str(), as_fmi2(status), category, "%s", text.c_str());
    };
  if (type != fmi2ModelExchange && type != fmi2CoSimulation) {
    if (log) log(Status::error, log_categories[1].data(), "this is no type of an FMU");
    return nullptr;
  }
  const auto how = type == fmi2CoSimulation ? InterfaceType::co_simulation : InterfaceType::model_exchange;
  return instantiate(name, guid, resources, how, std::move(log));
}
void fmi2FreeInstance(fmi2Component c) { delete static_cast<Component*>(c); }

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean has_tolerance, fmi2Real tolerance, fmi2Real start,
                               fmi2Boolean has_stop, fmi2Real stop) {
  return call2(c, __func__, Phase::instantiated, [&](FmuInstance& instance) {
    FmuInstance::Experiment experiment{start};
    if (has_stop) experiment.stop = stop;
    if (has_tolerance) experiment.tolerance = tolerance;
    instance.set_up(experiment);
  });
}
fmi2Status fmi2EnterInitializationMode(fmi2Component c) {
  return call2(c, __func__, Phase::instantiated, [](FmuInstance& instance) { instance.enter_initialization(); });
}
fmi2Status fmi2ExitInitializationMode(fmi2Component c) {
  return call2(c, __func__, Phase::initialization, [](FmuInstance& instance) { instance.exit_initialization(); });
}
fmi2Status fmi2Terminate(fmi2Component c) {
  return call2(c, __func__, any_mode, [](FmuInstance& instance) { instance.enter(Phase::terminated); });
}
fmi2Status fmi2Reset(fmi2Component c) {
  return call2(c, __func__, outside_step, [](FmuInstance& instance) { instance.reset(); });
}

// ---- variables ------------------------------------------------------------------------------------------------------

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference r[], size_t count, fmi2Real values[]) {
  return as_fmi2(get_reals(c, __func__, r, count, values));
}
fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference r[], size_t count, fmi2Integer values[]) {
  return as_fmi2(get_integers(c, __func__, r, count, values));
}
fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference[], size_t count, fmi2Boolean[]) {
  return as_fmi2(no_variables(c, __func__, count));
}
fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference[], size_t count, fmi2String[]) {
  return as_fmi2(no_variables(c, __func__, count));
}
fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference r[], size_t count, const fmi2Real values[]) {
  return as_fmi2(set_reals(c, __func__, r, count, values));
}
fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference r[], size_t count, const fmi2Integer[]) {
  return as_fmi2(set_integers(c, __func__, r, count));
}
fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference[], size_t count, const fmi2Boolean[]) {
  return as_fmi2(no_variables(c, __func__, count));
}
fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference[], size_t count, const fmi2String[]) {
  return as_fmi2(no_variables(c, __func__, count));
}
fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference unknowns[], size_t rows,
                                        const fmi2ValueReference knowns[], size_t columns, const fmi2Real seed[],
                                        fmi2Real result[]) {
  return as_fmi2(directional_derivative(c, __func__, {unknowns, rows}, {knowns, columns}, seed, result));
}

// ---- kept states ----------------------------------------------------------------------------------------------------

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate* state) { return as_fmi2(keep_state(c, __func__, state)); }
fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state) { return as_fmi2(restore_state(c, __func__, state)); }
fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate* state) { return as_fmi2(free_state(c, __func__, state)); }
fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t* size) {
  return as_fmi2(serialized_size(c, __func__, state, size));
}
fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size) {
  return as_fmi2(serialize(c, __func__, state, bytes, size));
}
fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate* state) {
  return as_fmi2(deserialize(c, __func__, bytes, size, state));
}

// ---- model exchange -------------------------------------------------------------------------------------------------

fmi2Status fmi2EnterEventMode(fmi2Component c) {
  return call2(c, __func__, Phase::event | Phase::continuous, [](FmuInstance& i) { i.enter_event_mode(); });
}
fmi2Status fmi2NewDiscreteStates(fmi2Component c, fmi2EventInfo* info) {
  return call2(c, __func__, Phase::event, [&](FmuInstance& instance) {
    need(info, "the place of what the event changes");
    const double next = instance.pass_events();
    const fmi2Boolean defined = std::isfinite(next) ? fmi2True : fmi2False;
    // Rates bend or jump at every event. The standard has no word for that, and an importer that keeps its solver's
    // history across one goes wrong without a sign of it: it is told to take the states anew.
    *info = {fmi2False, fmi2False, fmi2False, fmi2True, defined, defined ? next : 0.0};
  });
}
fmi2Status fmi2EnterContinuousTimeMode(fmi2Component c) {
  return call2(c, __func__, Phase::event,
               [](FmuInstance& instance) { instance.leave_event_mode(InterfaceType::model_exchange); });
}
fmi2Status fmi2CompletedIntegratorStep(fmi2Component c, fmi2Boolean, fmi2Boolean* enter_event_mode,
                                       fmi2Boolean* terminate) {
  return call2(c, __func__, Phase::continuous, [&](FmuInstance&) {
    need(enter_event_mode, "the place of enterEventMode");
    need(terminate, "the place of terminateSimulation");
    *enter_event_mode = *terminate = fmi2False;
  });
}
fmi2Status fmi2SetTime(fmi2Component c, fmi2Real t) {
  return call2(c, __func__, Phase::event | Phase::continuous, [&](FmuInstance& instance) { instance.set_time(t); });
}
fmi2Status fmi2SetContinuousStates(fmi2Component c, const fmi2Real x[], size_t count) {
  return as_fmi2(set_states(c, __func__, x, count));
}
fmi2Status fmi2GetDerivatives(fmi2Component c, fmi2Real rates[], size_t count) {
  return as_fmi2(get_list(c, __func__, rates, count, "derivatives", rates_of));
}
fmi2Status fmi2GetEventIndicators(fmi2Component c, fmi2Real z[], size_t count) {
  return as_fmi2(get_list(c, __func__, z, count, "event indicators", indicators_of));
}
fmi2Status fmi2GetContinuousStates(fmi2Component c, fmi2Real x[], size_t count) {
  return as_fmi2(get_list(c, __func__, x, count, "states", states_of));
}
fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component c, fmi2Real nominals[], size_t count) {
  return as_fmi2(get_list(c, __func__, nominals, count, "states", nominals_of));
}

// ---- co-simulation --------------------------------------------------------------------------------------------------

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference[], size_t, const fmi2Integer[],
                                       const fmi2Real[]) {
  return as_fmi2(unsupported(c, __func__));
}
fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference r[], size_t count,
                                        const fmi2Integer orders[], fmi2Real values[]) {
  return as_fmi2(output_derivatives(c, __func__, r, count, orders, values));
}
fmi2Status fmi2DoStep(fmi2Component c, fmi2Real now, fmi2Real step, fmi2Boolean) {
  return call2(c, __func__, Phase::step, [&](FmuInstance& instance) {
    instance.step(now, step, [](double) { return std::numeric_limits<double>::infinity(); });
  });
}
fmi2Status fmi2CancelStep(fmi2Component c) {
  return call2(c, __func__, whole_life, [](FmuInstance&) { throw std::logic_error("there is no step to cancel"); });
}
fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind, fmi2Status* status) {
  return answer(c, __func__, status, [](FmuInstance&) { return false; });  // no step is ever pending
}
fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real* value) {
  return answer(c, __func__, value, [&](FmuInstance& instance) {
    if (kind == fmi2LastSuccessfulTime) *value = instance.time();
    return kind == fmi2LastSuccessfulTime;
  });
}
fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind, fmi2Integer* value) {
  return answer(c, __func__, value, [](FmuInstance&) { return false; });
}
fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean* value) {
  return answer(c, __func__, value, [&](FmuInstance& instance) {
    if (kind == fmi2Terminated) *value = instance.halted() ? fmi2True : fmi2False;
    return kind == fmi2Terminated;
  });
}
fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind, fmi2String* value) {
  return answer(c, __func__, value, [](FmuInstance&) { return false; });
}
