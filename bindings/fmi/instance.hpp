#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

#include "bindings/fmi/phase.hpp"
#include "bindings/fmi/plant_run.hpp"
#include "bindings/fmi/step_run.hpp"
#include "description/build.hpp"

namespace wormdrive {

/// Every drive that an FMU may be: with rigid teeth, with states of effects or without, and with elastic ones; moved
/// from outside or by a solver inside, which has formulas for some loads.
template <class Loads>
struct FmuRuns;
template <class... Parameters>
struct FmuRuns<std::variant<Parameters...>> {
  template <class P>
  using Load = decltype(make_load(std::declval<const P&>()));
  using DriveWithStates = WormDrive<double, SummedLoad, true>;
  using type = std::variant<PlantRun<WormDrive<double, SummedLoad>>, PlantRun<CompliantDrive<double, SummedLoad>>,
                            PlantRun<DriveWithStates>, StepRun<DriveWithStates>,
#ifdef WORMDRIVE_FMU_CVODE
                            StepRun<CompliantDrive<double, SummedLoad>>,
#endif
                            StepRun<WormDrive<double, Load<Parameters>>>...>;
};

/// Runs that the importer moves, unlike those with a solver of their own.
template <class Run>
concept MovedFromOutside = requires(Run& run) {
  run.set_time(0.0);
};

/// A step that could not be made whole: the drive stands where it halted.
struct StepHalted : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// One instance of the model of an FMU, without the C interface around it. Diagnostics are thrown as std::exception.
class FmuInstance {
 public:
  /// model: as the FMU states it.
  FmuInstance(FmuModel model, InterfaceType type);

  InterfaceType type() const { return type_; }
  Phase phase() const { return state_.phase; }
  void enter(Phase phase) { state_.phase = phase; }

  // ---- life ------------------------------------------------------------------------------------------------------

  /// The states and event indicators of the drive.
  InterfaceNames ports() const { return InterfaceNames(stated_.scenario.effects); }

  /// What an importer states before the initialization, in seconds.
  struct Experiment {
    double start = 0.0;
    std::optional<double> stop{}, tolerance{};
  };
  void set_up(const Experiment& experiment);
  void enter_initialization();
  void exit_initialization();
  void reset();

  // ---- variables -------------------------------------------------------------------------------------------------

  double real(unsigned reference);
  int integer(unsigned reference);
  /// All or none.
  void set_reals(std::span<const unsigned> references, std::span<const double> values);
  /// Sets the start value of a whole number, of which there are none to set.
  [[noreturn]] void set_integer(unsigned reference);

  // ---- events ----------------------------------------------------------------------------------------------------

  void enter_event_mode();
  /// Into the mode in which time goes on; mode: the interface type that has it.
  void leave_event_mode(InterfaceType mode);
  /// Passes the events that are due; when the next is known to be [s], infinity where none is.
  double pass_events();

  // ---- model exchange --------------------------------------------------------------------------------------------

  void set_time(double t);
  /// Calls use(run) with the drive that the importer moves.
  template <class Use>
  void with_moved_run(Use&& use) {
    with_run([&]<class Run>(Run& run) {
      if constexpr (MovedFromOutside<Run>)
        use(run);
      else
        throw std::logic_error("this is an instance for co-simulation");
    });
  }

  /// Derivatives of outputs, rates and event indicators by states and motor torque in the present mode, row by row.
  std::vector<double> jacobian(std::span<const unsigned> unknowns, std::span<const unsigned> knowns);

  // ---- co-simulation ---------------------------------------------------------------------------------------------

  /// Told of every event in a step; when the step ends [s], infinity where that is no matter of the event's.
  using AtEvent = std::function<double(double t)>;
  /// An importer with event mode: outputs keep their left limits at an event that ends a step, until pass_events().
  void use_event_mode() { state_.uses_event_mode = true; }
  bool uses_event_mode() const { return type_ == InterfaceType::model_exchange || state_.uses_event_mode; }
  /// Goes on from a communication point by a step [s]. Throws StepHalted where the drive cannot go on.
  void step(double from, double size, const AtEvent& at_event);
  double time() const { return state_.time; }

  /// Interval and offset of the clock that ticks with the controller's samples. Throws where there is no such clock.
  const SamplingSettings& sample_clock(unsigned reference) const;
  /// Takes the sample that is due now; the clock is then active until pass_events(). Throws StepHalted as step().
  void take_sample(unsigned reference);
  bool takes_sample() const { return state_.takes_sample; }
  /// Rate of a continuous output along the motion, in its unit per second.
  double output_rate(unsigned reference);
  /// Why the drive cannot go on, if it cannot.
  const std::optional<std::string>& halted() const { return state_.halted; }

  // ---- kept states -----------------------------------------------------------------------------------------------

  /// All that changes while an instance lives, for a copy to come back to.
  struct State {
    Phase phase = Phase::instantiated;
    Experiment experiment{};
    double time = 0.0, torque = 0.0;
    bool uses_event_mode = false;
    bool takes_sample = false;  ///< the clock of the controller's samples is active
    std::optional<std::string> halted{};
    std::optional<FmuRuns<LoadParameters>::type> run{};
  };
  struct Kept {
    State state;
    Scenario set;
    InterfaceType type;
  };
  Kept keep() const { return {state_, model_.scenario, type_}; }
  void restore(const Kept& kept);
  /// A kept state as numbers, and back: in another instance of this FMU, in this process or another one. Both throw
  /// where that cannot be.
  std::vector<double> to_numbers(const Kept& kept) const;
  Kept from_numbers(std::span<const double> numbers) const;

  /// Calls use(run) with the drive that runs.
  template <class Use>
  decltype(auto) with_run(Use&& use) {
    if (stale_) begin();
    if (!state_.run) throw std::logic_error("the instance is not initialized");
    return std::visit(std::forward<Use>(use), *state_.run);
  }

 private:
  void begin();
  /// Lets a drive go on by use(); where it halts, it stands from then on.
  template <class Run, class Use>
  void go_on(Run& run, Use&& use);
  ReferencePoint reference_point(unsigned reference) const;
  void reject_absent_state(unsigned reference) const;
  void reject_unsettable(unsigned reference, double value);

  FmuModel stated_, model_;  ///< as exported; with the parameters that the importer has set
  InterfaceType type_;
  State state_;
  bool stale_ = false;  ///< something was set after the run was built
};

}  // namespace wormdrive
