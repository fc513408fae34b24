#pragma once
#include <exception>
#include <memory>
#include <string>

#include "bindings/fmi/fmi2.h"
#include "bindings/fmi/instance.hpp"

namespace wormdrive {

/// What a fmi2Component points to: an instance with its name and its importer's logger.
struct Component {
  std::string name;
  fmi2CallbackFunctions callbacks;
  FmuInstance instance;
};

/// Tells the importer what went wrong; the text is an argument, never a format.
inline void log(const fmi2CallbackFunctions& callbacks, const std::string& name, fmi2Status status,
                const std::string& text) {
  if (callbacks.logger)
    callbacks.logger(callbacks.componentEnvironment, name.c_str(), status, "logStatusError", "%s", text.c_str());
}

/// Calls use(instance); no exception passes the C interface, each becomes fmi2Error with its text in the log.
template <class Use>
fmi2Status guarded(fmi2Component component, Use&& use) {
  if (!component) return fmi2Error;
  auto& c = *static_cast<Component*>(component);
  try {
    use(c.instance);
    return fmi2OK;
  } catch (const std::exception& fault) {
    log(c.callbacks, c.name, fmi2Error, fault.what());
    return fmi2Error;
  }
}

/// Says that a function is there for the linker only.
inline fmi2Status unsupported(fmi2Component component, const char* what) {
  return guarded(component, [&](FmuInstance&) { throw std::logic_error(std::string(what) + " is not supported"); });
}

}  // namespace wormdrive
