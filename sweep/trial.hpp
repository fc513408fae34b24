#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "sweep/study.hpp"
#include "sweep/variable.hpp"

namespace wormdrive {

/// How a trial ended. 0 is none of them, so that a row that was never written cannot pass for one.
enum class TrialStatus : std::int8_t {
  done = 1,  ///< it has metrics
  refused,   ///< its values make no drive that could run
  halted,    ///< the simulation could not go on
};
inline constexpr TrialStatus trial_statuses[] = {TrialStatus::done, TrialStatus::refused, TrialStatus::halted};
std::string_view name(TrialStatus status);

/// One row of a sweep.
struct Trial {
  std::uint64_t index{};
  std::vector<double> parameters;  ///< SI
  std::vector<double> metrics;     ///< SI; not a number unless it is done
  TrialStatus status = TrialStatus::done;
  std::string reason;  ///< why it is not done
};

/// Makes the trials of a study, any of them in any order; a thread has its own.
class Trials {
 public:
  explicit Trials(const Study& study);
  Trials(const Trials&) = delete;  // variables point into the scenario
  Trials& operator=(const Trials&) = delete;

  Trial operator()(std::uint64_t index);
  /// A trial at another point of the unit cube than those of the design; its index stands for nothing.
  Trial at(const std::vector<double>& point);
  /// The point of the unit cube at which the design puts a trial.
  std::vector<double> point(std::uint64_t index) { return design_.point(index); }
  /// The scenario of a trial; why it cannot run is told by the trial.
  const Scenario& scenario(std::uint64_t index);
  /// The scenario of the latest trial.
  const Scenario& scenario() const { return scenario_; }

 private:
  /// Puts the values at a point into the scenario and the trial; returns what bounds say against them.
  std::string set_up(Trial& trial, std::vector<double> point);
  Trial made(std::uint64_t index, std::vector<double> point);
  void run(Trial& trial);

  const Study& study_;
  Design design_;
  Scenario scenario_;
  std::vector<Variable> variables_;  ///< of each parameter
};

/// Reasons that differ in their numbers alone are one kind: the numbers replaced, what led up to a halt cut off.
std::string kind_of_reason(const std::string& reason);

}  // namespace wormdrive
