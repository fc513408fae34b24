#include "sweep/trial.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "description/build_control.hpp"
#include "description/rejection.hpp"
#include "description/toml/table_reader.hpp"
#include "sweep/study/random.hpp"

namespace wormdrive {

std::string_view name(TrialStatus status) {
  switch (status) {
    case TrialStatus::done: return "done";
    case TrialStatus::refused: return "refused";
    case TrialStatus::halted: return "halted";
  }
  return "";
}

Trials::Trials(const Study& study, LaneKind lanes)
    : study_(study),
      design_(study.design, study.parameters.size(), study.seed, study.strata),
      drawn_with_(study.drawn_with()),
      lanes_(lanes),
      scenarios_(study.own_metrics.empty() ? runs_together(study.scenario) : 1, study.scenario) {
  for (Scenario& scenario : scenarios_) {
    const std::vector<Variable> all = variables(scenario);
    std::vector<Variable>& chosen = variables_.emplace_back();
    for (const UncertainParameter& parameter : study.parameters)
      chosen.push_back(
          *std::find_if(all.begin(), all.end(), [&](const Variable& v) { return v.spelling.key == parameter.path; }));
  }
}

Trial Trials::row(std::uint64_t index) const {
  return {index, {}, std::vector<double>(study_.metrics.size(), std::numeric_limits<double>::quiet_NaN()), {}, {}};
}

std::vector<double> Trials::probabilities(std::uint64_t index) {
  std::vector<double> u = design_.point(index);
  if (!study_.has_correlated_points()) study_.copula.apply(u);
  for (std::size_t k = 0; k < u.size(); ++k) u[k] = u[drawn_with_[k]];
  return u;
}

std::vector<double> Trials::point(std::uint64_t index) {
  std::vector<double> u = design_.point(index);
  if (study_.has_correlated_points()) study_.copula.undo(u);
  return u;
}

std::string Trials::set_up(std::size_t place, Trial& trial, const std::vector<double>& u) {
  std::string refusal;
  for (std::size_t k = 0; k < u.size(); ++k) {
    const Variable& variable = variables_[place][k];
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

void Trials::draw_noise(std::size_t place, std::uint64_t index) {
  if (!study_.scenario.control || study_.common_random_numbers) return;
  const ControlScenario& stated = *study_.scenario.control;
  ControlScenario& control = *scenarios_[place].control;
  const std::uint64_t trial = noise_of(study_.design, study_.parameters.size(), index);
  // whoever varies a seed says himself which noise a trial has
  if (!study_.varies("sensor.seed")) control.sensor.seed = noise_seed(stated.sensor.seed, study_.seed, trial);
  if (!study_.varies("disturbance.seed"))
    control.disturbance.seed = noise_seed(stated.disturbance.seed, study_.seed, trial);
}

bool Trials::prepare(std::size_t place, Trial& trial, const std::vector<double>& u) {
  draw_noise(place, trial.index);
  trial.reason = set_up(place, trial, u);
  if (trial.reason.empty()) trial.reason = why_it_cannot_run(scenarios_[place]).value_or("");
  if (!trial.reason.empty()) trial.status = TrialStatus::refused;
  return trial.reason.empty();
}

void Trials::run(std::vector<Trial>& prepared, const std::function<void(Trial)>& take) {
  const auto finish = [&](std::size_t place, BatchResult result, std::vector<double> own = {}) {
    Trial& trial = prepared[place];
    if (auto* const summary = std::get_if<RunSummary>(&result)) {
      trial.status = TrialStatus::done;
      const Outcome outcome{std::move(*summary), lemma1_conditions(scenarios_[place]), std::move(own)};
      for (std::size_t k = 0; k < study_.metrics.size(); ++k) trial.metrics[k] = study_.metrics[k].of(outcome);
    } else {
      trial.status = TrialStatus::halted;
      trial.reason = std::get<std::string>(result);
    }
    take(std::move(trial));
  };
  if (study_.own_metrics.empty()) {
    run_batch(std::span(scenarios_).first(prepared.size()), finish, lanes_);
  } else {  // one after the other, for rows are asked for
    for (std::size_t place = 0; place < prepared.size(); ++place) {
      OwnMeters meters(study_.own_metrics, scenarios_[place]);
      BatchResult result = run_alone(scenarios_[place], meters.listeners());
      finish(place, std::move(result), meters.values());
    }
  }
  prepared.clear();
}

void Trials::make(TrialRange range, const std::function<void(Trial)>& take) {
  std::vector<Trial> prepared;
  for (std::uint64_t index = range.first; index < range.end; ++index) {
    Trial trial = row(index);
    if (prepare(prepared.size(), trial, probabilities(index)))
      prepared.push_back(std::move(trial));
    else
      take(std::move(trial));
    if (prepared.size() == scenarios_.size()) run(prepared, take);
  }
  run(prepared, take);
}

std::vector<Trial> Trials::operator()(TrialRange range) {
  std::vector<Trial> trials(range.size());
  make(range, [&](Trial trial) { trials[trial.index - range.first] = std::move(trial); });
  return trials;
}

Trial Trials::at(std::vector<double> point, std::uint64_t index) {
  study_.copula.apply(point);
  Trial trial = row(index);
  if (!prepare(0, trial, point)) return trial;
  std::vector<Trial> prepared{trial};
  run(prepared, [&](Trial made) { trial = std::move(made); });
  return trial;
}

const Scenario& Trials::scenario(std::uint64_t index) {
  Trial trial = row(index);
  draw_noise(0, index);
  set_up(0, trial, probabilities(index));
  return scenarios_.front();
}

}  // namespace wormdrive
