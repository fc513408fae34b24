#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "simulation/run_batch.hpp"
#include "sweep/study/study.hpp"
#include "sweep/study/variable.hpp"
#include "sweep/trial_range.hpp"

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
  /// lanes: in which trials run that fit; rows do not depend on it.
  explicit Trials(const Study& study, LaneKind lanes = widest_lanes());
  Trials(const Trials&) = delete;  // variables point into the scenarios
  Trials& operator=(const Trials&) = delete;

  /// How many trials gain from being made together; 1 where each has a register to itself.
  std::uint64_t together() const { return scenarios_.size(); }

  /// Makes trials and hands each over as soon as it is done, those that are made together at once.
  void make(TrialRange range, const std::function<void(Trial)>& take);
  Trial operator()(std::uint64_t index) { return std::move((*this)({index, index + 1}).front()); }
  std::vector<Trial> operator()(TrialRange range);
  /// A trial at another point of the unit cube than those of the design, with the noise of one of its trials and under
  /// the index of that one. Correlations come on top of the point.
  Trial at(std::vector<double> point, std::uint64_t index);
  /// The point of the unit cube, less the correlations, at which the design puts a trial.
  std::vector<double> point(std::uint64_t index);
  /// The scenario of a trial; why it cannot run is told by the trial.
  const Scenario& scenario(std::uint64_t index);
  /// The scenario of the latest trial that was asked for alone.
  const Scenario& scenario() const { return scenarios_.front(); }

 private:
  Trial row(std::uint64_t index) const;
  /// The probabilities below the values of a trial, correlations included.
  std::vector<double> probabilities(std::uint64_t index);
  /// Puts the values above probabilities into a scenario and the trial; returns what bounds say against them.
  std::string set_up(std::size_t place, Trial& trial, const std::vector<double>& u);
  /// Gives a scenario the noise of a trial.
  void draw_noise(std::size_t place, std::uint64_t index);
  /// Sets a trial up with its noise; whether it can run.
  bool prepare(std::size_t place, Trial& trial, const std::vector<double>& u);
  /// Runs trials whose scenarios have been set up, one after the other from the first place on, and hands them over.
  void run(std::vector<Trial>& prepared, const std::function<void(Trial)>& take);

  const Study& study_;
  Design design_;
  std::vector<std::size_t> drawn_with_;  ///< of each parameter
  LaneKind lanes_;
  std::vector<Scenario> scenarios_;               ///< of trials that are made together
  std::vector<std::vector<Variable>> variables_;  ///< of each scenario, of each parameter
};

}  // namespace wormdrive
