// What FMI 2.0 has for every kind of FMU: making, initialising and freeing an instance, its variables, kept states.
#include <fstream>
#include <iterator>
#include <new>
#include <stdexcept>

#include "bindings/fmi/boundary.hpp"
#include "bindings/fmi/plant_json.hpp"

using namespace wormdrive;

namespace {

int digit(char c) {
  const std::string_view digits = "0123456789abcdef";
  const auto at = digits.find(static_cast<char>(c | 0x20));
  return at == std::string_view::npos ? -1 : static_cast<int>(at);
}

/// The path of a URI "file:///a%20b", "file:/a" or of a plain path.
std::string path_of(std::string_view uri) {
  for (const std::string_view scheme : {"file://localhost/", "file:///", "file:/"})
    if (uri.starts_with(scheme)) {
      uri.remove_prefix(scheme.size() - 1);
      break;
    }
  std::string path;
  for (std::size_t k = 0; k < uri.size(); ++k) {
    if (uri[k] == '%' && k + 2 < uri.size() && digit(uri[k + 1]) >= 0 && digit(uri[k + 2]) >= 0) {
      path += static_cast<char>(16 * digit(uri[k + 1]) + digit(uri[k + 2]));
      k += 2;
    } else {
      path += uri[k];
    }
  }
  return path;
}

Scenario read_plant(std::string_view resources, std::string_view guid) {
  const std::string path = path_of(resources) + "/plant.json";
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read " + path);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  if (guid_of(text) != guid) throw std::runtime_error("the GUID " + std::string(guid) + " is not that of " + path);
  return plant_from_json(text);
}

template <class Value, class Get>
fmi2Status each(fmi2Component c, const fmi2ValueReference references[], size_t count, Value values[], Get&& act) {
  return guarded(c, [&](FmuInstance& instance) {
    for (size_t k = 0; k < count; ++k) act(instance, references[k], values[k]);
  });
}
/// There are no variables of this type.
fmi2Status none(fmi2Component c, size_t count, const char* type) { return count == 0 ? fmi2OK : unsupported(c, type); }

}  // namespace

const char* fmi2GetTypesPlatform() { return "default"; }
const char* fmi2GetVersion() { return "2.0"; }
fmi2Status fmi2SetDebugLogging(fmi2Component, fmi2Boolean, size_t, const fmi2String[]) { return fmi2OK; }

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions* callbacks, fmi2Boolean, fmi2Boolean) {
  if (!callbacks || !name) return nullptr;
  try {
    if (type != fmi2ModelExchange) throw std::logic_error("this FMU is one for model exchange");
    if (!guid || !resources) throw std::logic_error("GUID or location of the resources is missing");
    return new Component{name, *callbacks, FmuInstance(read_plant(resources, guid))};
  } catch (const std::exception& fault) {
    log(*callbacks, name, fmi2Error, fault.what());
    return nullptr;
  }
}
void fmi2FreeInstance(fmi2Component c) { delete static_cast<Component*>(c); }

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean, fmi2Real, fmi2Real start, fmi2Boolean, fmi2Real) {
  return guarded(c, [&](FmuInstance& instance) { instance.start_at(start); });
}
fmi2Status fmi2EnterInitializationMode(fmi2Component c) {
  return guarded(c, [](FmuInstance& instance) { instance.enter_initialization(); });
}
fmi2Status fmi2ExitInitializationMode(fmi2Component c) {
  return guarded(c, [](FmuInstance& instance) { instance.exit_initialization(); });
}
fmi2Status fmi2Terminate(fmi2Component c) {
  return guarded(c, [](FmuInstance& instance) { instance.enter(Phase::terminated); });
}
fmi2Status fmi2Reset(fmi2Component c) {
  return guarded(c, [](FmuInstance& instance) { instance.reset(); });
}

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference r[], size_t count, fmi2Real values[]) {
  return each(c, r, count, values, [](FmuInstance& of, unsigned ref, double& value) { value = of.real(ref); });
}
fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference r[], size_t count, fmi2Integer values[]) {
  return each(c, r, count, values, [](FmuInstance& of, unsigned ref, int& value) { value = of.integer(ref); });
}
fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference[], size_t count, fmi2Boolean[]) {
  return none(c, count, "a truth value");
}
fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference[], size_t count, fmi2String[]) {
  return none(c, count, "a string");
}
fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference r[], size_t count, const fmi2Real values[]) {
  return each(c, r, count, values, [](FmuInstance& of, unsigned ref, double value) { of.set_real(ref, value); });
}
fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference r[], size_t count, const fmi2Integer values[]) {
  return each(c, r, count, values, [](FmuInstance& of, unsigned ref, int) { of.set_integer(ref); });
}
fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference[], size_t count, const fmi2Boolean[]) {
  return none(c, count, "a truth value");
}
fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference[], size_t count, const fmi2String[]) {
  return none(c, count, "a string");
}

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate* state) {
  return guarded(c, [&](FmuInstance& instance) {
    if (*state)
      *static_cast<FmuInstance::Kept*>(*state) = instance.keep();
    else
      *state = new FmuInstance::Kept(instance.keep());
  });
}
fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state) {
  return guarded(c, [&](FmuInstance& instance) {
    if (!state) throw std::invalid_argument("no state to go back to");
    instance.restore(*static_cast<FmuInstance::Kept*>(state));
  });
}
fmi2Status fmi2FreeFMUstate(fmi2Component, fmi2FMUstate* state) {
  if (!state) return fmi2OK;
  delete static_cast<FmuInstance::Kept*>(*state);
  *state = nullptr;
  return fmi2OK;
}
