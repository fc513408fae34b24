#include "bindings/python/run_result.hpp"

#include <algorithm>
#include <iterator>

#include "description/toml/write_scenario.hpp"
#include "simulation/write_run.hpp"

namespace wormdrive {
namespace {

template <class T>
void take(std::vector<T>& whole, std::vector<T> part) {
  if (whole.capacity() == 0)
    whole = std::move(part);
  else
    whole.insert(whole.end(), std::make_move_iterator(part.begin()), std::make_move_iterator(part.end()));
}

/// Room for what a run leaves at even steps: growing, it would touch new memory again and again, which costs a short
/// run as much as its simulation.
template <class T>
void make_room(std::vector<T>& list, double duration, double step) {
  constexpr double most = 1e6, beside = 64.0;  // events have rows of their own
  list.reserve(static_cast<std::size_t>(std::min(most, duration / step) + beside));
}

}  // namespace

void RunResult::run(std::function<void(double)> time) {
  RunListeners listeners{.rows =
                             [this](Trajectory part) {
                               take(trajectory_.rows, std::move(part.rows));
                               take(trajectory_.events, std::move(part.events));
                             },
                         .time = std::move(time)};
  make_room(trajectory_.rows, scenario_->run.duration, scenario_->run.rows_every());
  if (scenario_->control) {
    make_room(samples_, scenario_->run.duration, scenario_->control->sampling.period);
    listeners.samples = [this](const auto& part) { take(samples_, part); };
  }
  try {
    summary_ = run_scenario(*scenario_, listeners);
  } catch (const SimulationFailure& halt) {
    halted_ = halt.what();
  }
}

RunContents RunResult::contents() const { return contents_of(*scenario_); }

std::map<std::string, double> RunResult::metrics() const {
  std::map<std::string, double> all;
  if (!summary_.control) return all;
  for_each_field<Metrics>([&](const auto& field) {
    if (summary_.control->has(field.member)) all[std::string(field.name)] = summary_.control->metrics.*field.member;
  });
  if (!summary_.control->lemma) return all;
  const Lemma1Monitor& lemma = *summary_.control->lemma;
  all["layer_reached"] = lemma.reached();
  for (const Violation& v : lemma.violations())
    all[std::string(v.name) + "_violations"] = judged_violations(lemma, v, scenario_->run.duration);
  return all;
}

std::map<std::string, long> RunResult::statistics() const {
  const SolverStatistics& s = summary_.statistics;
  return {{"steps", s.steps},
          {"evaluations", s.evaluations},
          {"jacobians", s.jacobians},
          {"error_test_failures", s.error_test_failures},
          {"guard_evaluations", s.guard_evaluations},
          {"restarts", s.restarts}};
}

void RunResult::write(const std::string& path, const std::string& command_line, bool force) const {
  RunFile file(path, {"run", scenario_->title, to_toml(*scenario_), command_line}, scenario_->axis,
               contents_of(*scenario_), force ? Replace::anything : Replace::same_kind);
  write_drive(file.file().file(), *scenario_);
  file.append(trajectory_);
  file.append(samples_);
  if (summary_.control) file.describe(*summary_.control);
  file.finish(describe_solver(scenario_->run), summary_.statistics);
}

}  // namespace wormdrive
