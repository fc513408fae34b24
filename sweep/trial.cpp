#include "sweep/trial.hpp"

#include <algorithm>
#include <limits>
#include <regex>

#include <fmt/format.h>

#include "events/halt.hpp"
#include "scenarios/build_control.hpp"
#include "scenarios/refusal.hpp"
#include "scenarios/table_reader.hpp"

namespace wormdrive {

std::string_view name(TrialStatus status) {
  switch (status) {
    case TrialStatus::done: return "done";
    case TrialStatus::refused: return "refused";
    case TrialStatus::halted: return "halted";
  }
  return "";
}

Trials::Trials(const Study& study)
    : study_(study), design_(study.design, study.parameters.size(), study.seed), scenario_(study.scenario) {
  const std::vector<Variable> all = variables(scenario_);
  for (const UncertainParameter& parameter : study.parameters)
    variables_.push_back(
        *std::find_if(all.begin(), all.end(), [&](const Variable& v) { return v.spelling.key == parameter.path; }));
}

std::string Trials::set_up(Trial& trial, std::vector<double> u) {
  study_.copula.apply(u);
  std::string refusal;
  for (std::size_t k = 0; k < u.size(); ++k) {
    const Variable& variable = variables_[k];
    const double stated = quantile(study_.parameters[k].distribution, u[k]);
    const double si = stated * variable.spelling.unit.si;
    variable.set(stated);
    trial.parameters.push_back(si);
    if (refusal.empty() && !variable.bounds.contain(si))
      refusal = fmt::format("{} = {} {}", variable.spelling.key, quantity(si, variable.spelling.unit),
                            rule(variable.bounds, variable.spelling.unit));
  }
  return refusal;
}

void Trials::run(Trial& trial) {
  const Outcome outcome{run_scenario(scenario_), lemma1_conditions(scenario_)};
  for (std::size_t k = 0; k < study_.metrics.size(); ++k) trial.metrics[k] = study_.metrics[k].of(outcome);
}

Trial Trials::operator()(std::uint64_t index) { return made(index, design_.point(index)); }
Trial Trials::at(const std::vector<double>& point) { return made(0, point); }

Trial Trials::made(std::uint64_t index, std::vector<double> point) {
  Trial trial{index, {}, std::vector<double>(study_.metrics.size(), std::numeric_limits<double>::quiet_NaN()), {}, {}};
  trial.reason = set_up(trial, std::move(point));
  if (trial.reason.empty()) trial.reason = why_it_cannot_run(scenario_).value_or("");
  trial.status = trial.reason.empty() ? TrialStatus::done : TrialStatus::refused;
  if (trial.status == TrialStatus::done) try {
      run(trial);
    } catch (const Halt& halt) {
      trial.status = TrialStatus::halted;
      trial.reason = halt.what();
    } catch (const SolverFault& fault) {  // before the run began
      trial.status = TrialStatus::halted;
      trial.reason = fault.what();
    }
  return trial;
}

const Scenario& Trials::scenario(std::uint64_t index) {
  Trial trial{index, {}, {}, {}, {}};
  set_up(trial, design_.point(index));
  return scenario_;
}

std::string kind_of_reason(const std::string& reason) {
  static const std::regex halted("^cannot go on at t = .*: "), numbers("(= |^|[ (])-?[0-9][0-9.e+-]*");
  std::string kind = std::regex_replace(reason, halted, "", std::regex_constants::format_first_only);
  return std::regex_replace(kind, numbers, "$1...");
}

}  // namespace wormdrive
