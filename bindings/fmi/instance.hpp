#pragma once
#include <memory>
#include <string>
#include <utility>
#include <variant>

#include "bindings/fmi/plant_run.hpp"
#include "description/build.hpp"

namespace wormdrive {

/// What an instance of an FMU may do at present [FMI 2.0.4, section 3.2.3].
enum class Phase { instantiated, initialization, event, continuous, terminated };

/// Every drive that a plant may be: each load with rigid and with elastic teeth.
template <class Loads>
struct PlantRuns;
template <class... Parameters>
struct PlantRuns<std::variant<Parameters...>> {
  template <class P>
  using Load = decltype(make_load(std::declval<const P&>()));
  using type = std::variant<PlantRun<WormDrive<double, Load<Parameters>>>...,
                            PlantRun<CompliantDrive<double, Load<Parameters>>>...>;
};

/// One instance of the model of an FMU, without the C interface around it. Diagnostics are thrown as std::exception.
class FmuInstance {
 public:
  /// plant: as the FMU states it.
  explicit FmuInstance(Scenario plant) : stated_(std::move(plant)), set_(stated_) {}

  Phase phase() const { return state_.phase; }
  void enter(Phase phase) { state_.phase = phase; }
  void start_at(double t) { state_.time = t; }
  void enter_initialization();
  void exit_initialization();
  void reset();

  double real(unsigned reference);
  int integer(unsigned reference);
  void set_real(unsigned reference, double value);
  /// Sets the start value of a whole number, of which there are none to set.
  [[noreturn]] void set_integer(unsigned reference);

  void set_time(double t);
  /// Calls use(run) with the drive that runs.
  template <class Use>
  decltype(auto) with_run(Use&& use) {
    if (stale_) begin();
    if (!state_.run) throw std::logic_error("the instance is not initialized");
    return std::visit(std::forward<Use>(use), *state_.run);
  }

  /// All that changes while an instance lives, for a copy to come back to.
  struct State {
    Phase phase = Phase::instantiated;
    double time = 0.0, torque = 0.0;
    std::optional<PlantRuns<LoadParameters>::type> run;
  };
  struct Kept {
    State state;
    Scenario set;
  };
  Kept keep() const { return {state_, set_}; }
  void restore(const Kept& kept);

 private:
  void begin();
  double parameter(unsigned k) const;
  void set_parameter(unsigned k, double value);

  Scenario stated_, set_;  ///< as exported; with the parameters that the importer has set
  State state_;
  bool stale_ = false;  ///< something was set after the run was built
};

}  // namespace wormdrive
