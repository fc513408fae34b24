#pragma once
#include "bindings/fmi/fmi3.h"
#include "catch.hpp"
#include "fmi/importer.hpp"

namespace wormdrive::test {

/// One instance of FMI 3.0; a call that does not return fmi3OK throws what the FMU logged.
class Instance3 {
 public:
  Instance3(const Fmu& fmu, bool co_simulation, bool event_mode = false, bool early = false,
            fmi3IntermediateUpdateCallback look = nullptr)
      : fmu_(fmu) {
    const std::string resources = fmu.resources().substr(7) + "/";
    instance_ = co_simulation ? function<decltype(fmi3InstantiateCoSimulation)>("fmi3InstantiateCoSimulation")(
                                    "drive", fmu.guid().c_str(), resources.c_str(), false, false, event_mode, early,
                                    nullptr, 0, this, log, look)
                              : function<decltype(fmi3InstantiateModelExchange)>("fmi3InstantiateModelExchange")(
                                    "drive", fmu.guid().c_str(), resources.c_str(), false, false, this, log);
    if (!instance_) throw std::runtime_error(log_);
  }
  Instance3(const Instance3&) = delete;
  Instance3& operator=(const Instance3&) = delete;
  ~Instance3() { function<decltype(fmi3FreeInstance)>("fmi3FreeInstance")(instance_); }

  template <class Function, class... Arguments>
  void call(const char* name, Arguments... arguments) {
    log_.clear();
    if (function<Function>(name)(instance_, arguments...) != fmi3OK) throw std::runtime_error(log_);
  }
  void initialize(double end) {
    call<decltype(fmi3EnterInitializationMode)>("fmi3EnterInitializationMode", false, 0.0, 0.0, true, end);
    call<decltype(fmi3ExitInitializationMode)>("fmi3ExitInitializationMode");
  }
  double real(const std::string& name) {
    const fmi3ValueReference reference = fmu_.reference(name);
    double value;
    call<decltype(fmi3GetFloat64)>("fmi3GetFloat64", &reference, size_t{1}, &value, size_t{1});
    return value;
  }
  int whole(const std::string& name) {
    const fmi3ValueReference reference = fmu_.reference(name);
    fmi3Int32 value;
    call<decltype(fmi3GetInt32)>("fmi3GetInt32", &reference, size_t{1}, &value, size_t{1});
    return value;
  }
  /// The clock of the controller's samples.
  struct Clock {
    double interval = 0.0, shift = 0.0;
    fmi3IntervalQualifier qualifier = fmi3IntervalNotYetKnown;
  };
  Clock clock() {
    const fmi3ValueReference reference = fmu_.reference("controller.sample");
    Clock c;
    call<decltype(fmi3GetIntervalDecimal)>("fmi3GetIntervalDecimal", &reference, size_t{1}, &c.interval, &c.qualifier);
    call<decltype(fmi3GetShiftDecimal)>("fmi3GetShiftDecimal", &reference, size_t{1}, &c.shift);
    return c;
  }
  bool is_ticking() {
    const fmi3ValueReference reference = fmu_.reference("controller.sample");
    fmi3Clock active = false;
    call<decltype(fmi3GetClock)>("fmi3GetClock", &reference, size_t{1}, &active);
    return active;
  }
  void tick(bool active = true) {
    const fmi3ValueReference reference = fmu_.reference("controller.sample");
    call<decltype(fmi3SetClock)>("fmi3SetClock", &reference, size_t{1}, &active);
  }
  void set(const std::string& name, double value) {
    const fmi3ValueReference reference = fmu_.reference(name);
    call<decltype(fmi3SetFloat64)>("fmi3SetFloat64", &reference, size_t{1}, &value, size_t{1});
  }
  bool update() {
    bool need = true, terminate = true, nominals = true, values = false, defined = true;
    double next = 0.0;
    call<decltype(fmi3UpdateDiscreteStates)>("fmi3UpdateDiscreteStates", &need, &terminate, &nominals, &values,
                                             &defined, &next);
    CHECK_FALSE(need);
    CHECK_FALSE(terminate);
    return values;
  }

  struct Step {
    bool event = false, terminate = false, early = false;
    double reached = 0.0;
  };
  Step step(double from, double size) {
    Step s;
    call<decltype(fmi3DoStep)>("fmi3DoStep", from, size, true, &s.event, &s.terminate, &s.early, &s.reached);
    return s;
  }
  std::vector<double> looked{};  ///< times of intermediate updates
  double wanted_end = -1.0;      ///< early return asked for there [s]

 private:
  template <class Function>
  Function* function(const char* name) const {
    if (void* const found = fmu_.symbol(name)) return reinterpret_cast<Function*>(found);
    throw std::runtime_error(std::string("no function ") + name);
  }
  static void log(fmi3InstanceEnvironment self, fmi3Status, fmi3String, fmi3String text) {
    static_cast<Instance3*>(self)->log_ = text;
  }

  const Fmu& fmu_;
  std::string log_;
  fmi3Instance instance_ = nullptr;
};

}  // namespace wormdrive::test
