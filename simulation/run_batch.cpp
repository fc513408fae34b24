#include "simulation/run_batch.hpp"

#include <array>
#include <limits>
#include <memory>
#include <optional>

#include "control/lanes/batch.hpp"
#include "events/simulation_failure.hpp"
#include "events/taylor/tapes/leap.hpp"
#include "simulation/lanes/lane_run.hpp"

namespace wormdrive {
namespace {

/// Why an action cannot be done; nothing if it is done.
template <class Action>
std::optional<std::string> fault_of(Action&& action) {
  try {
    action();
  } catch (const SimulationFailure& halt) {
    return halt.what();
  } catch (const SolverFault& fault) {  // before the run began
    return fault.what();
  }
  return std::nullopt;
}

/// Runs that take their samples together.
class LaneGroup {
 public:
  LaneGroup(LaneKind kind, std::vector<std::unique_ptr<LaneRun>> runs)
      : kind_(kind), width_(lanes_of(kind, runs.front()->variant())), runs_(std::move(runs)), results_(runs_.size()) {}

  /// first: any of their scenarios.
  std::vector<BatchResult> run(const Scenario& first) {
    bool aligned = true, rough = false, late = false, noisy = false, disturbed = false;
    LaneVariant variant = runs_.front()->variant();
    const LaneTapes tapes = make_tapes();
    for (int lane = 0; lane < lanes(); ++lane) {
      alive_[lane / width_] |= bit(lane);
      aligned = aligned && runs_[lane]->estimate_is_aligned();
      rough = rough || runs_[lane]->is_rough();
      late = late || runs_[lane]->is_late();
      noisy = noisy || runs_[lane]->is_noisy();
      disturbed = disturbed || runs_[lane]->is_disturbed();
      variant.ideal = variant.ideal && runs_[lane]->variant().ideal;
      attempt(lane, [&] { runs_[lane]->start(place(lane)); });
    }
    const auto numbers = static_cast<std::size_t>(portion * registers() * width_);
    if (noisy) noise_.assign(numbers, 0.0);
    if (disturbed) disturbance_.assign(numbers, 0.0);
    const LaneBatch batch{.trials = memory_.data(),
                          .registers = registers(),
                          .alive = alive_.data(),
                          .accuracy = TaylorAccuracy(first.run.solver_settings()),
                          .estimate_is_aligned = aligned,
                          .variant = variant,
                          .is_delayed = first.control->sampling.delay > 0.5,
                          .is_rough = rough,
                          .is_late = late,
                          .noise = noisy ? noise_.data() : nullptr,
                          .disturbance = disturbed ? disturbance_.data() : nullptr,
                          .tapes = tapes,
                          .owner = this,
                          .go_on = go_on,
                          .note = note,
                          .sine_and_cosine = [](double angle) { return wormdrive::sine_and_cosine(angle); }};
    const long counted = take_all_samples(first, batch);
    for (int lane = 0; lane < lanes(); ++lane)
      attempt(lane, [&] { results_[lane] = runs_[lane]->finish(place(lane), counted); });
    return std::move(results_);
  }

 private:
  static constexpr long portion = 512;  ///< of samples

  /// Memory for the tapes of all registers, and every run's place in it.
  LaneTapes make_tapes() {
    const TapeCode* const code = runs_.front()->tape();
    if (code == nullptr) return {};
    const std::size_t series = TapeSeriesOf<double>::room(*code);
    const auto width = static_cast<std::size_t>(width_);
    const std::size_t room = (series + TapeSeriesOf<double>::numbers(*code)) * width;
    tapes_.assign(room * static_cast<std::size_t>(registers()) / std::size(Line{}.of) + 1, Line{});
    double* const memory = tapes_.front().of;
    for (int lane = 0; lane < lanes(); ++lane) {
      double* const own = memory + static_cast<std::size_t>(lane / width_) * room + lane % width_;
      runs_[lane]->use_tape(*code, own, own + series * width, width_);
    }
    return {.code = code, .memory = memory, .room = room, .section = section, .exp = [](double x) {
              return portable::exp(x);
            }};
  }

  /// Returns how many of them metrics are taken of.
  long take_all_samples(const Scenario& first, const LaneBatch& batch) {
    const ControlScenario& control = *first.control;
    const Timetable timetable(0.0, first.run.duration, std::numeric_limits<double>::infinity(),
                              {control.sampling.period, control.sampling.offset});
    const double end = first.run.duration;
    long counted = 0;
    std::vector<LaneSample> samples;
    double next = timetable.sample_time(0);
    for (long k = 0; next < end;) {
      samples.clear();
      for (; next < end && samples.size() < portion; ++k) {
        const double t = next;
        next = timetable.sample_time(k + 1);
        // what lies behind the last sample every run finds alone
        const bool alone = next >= end || next - t > first.run.max_step;
        const bool counts = control.window.contains(t);
        counted += counts;
        samples.push_back({k, t, k == 0 ? 0.0 : control.sampling.period,
                           alone ? std::numeric_limits<double>::quiet_NaN() : next - t, next, counts,
                           control.reference.at(t)});
      }
      draw(samples.front().number, k, static_cast<std::size_t>(batch.registers) * static_cast<std::size_t>(width_));
      take_samples(kind_, batch, samples);
    }
    return counted;
  }
  /// What is random at samples in [first, end), for runs that go on.
  void draw(long first, long end, std::size_t stride) {
    if (noise_.empty() && disturbance_.empty()) return;
    for (int lane = 0; lane < lanes(); ++lane)
      if (is_alive(lane))
        runs_[lane]->draw(first, end, stride, noise_.empty() ? nullptr : noise_.data() + lane,
                          disturbance_.empty() ? nullptr : disturbance_.data() + lane);
  }

  int lanes() const { return static_cast<int>(runs_.size()); }
  int registers() const { return (lanes() + width_ - 1) / width_; }
  unsigned bit(int lane) const { return 1U << lane % width_; }
  bool is_alive(int lane) const { return (alive_[lane / width_] & bit(lane)) != 0U; }
  Lane place(int lane) { return {memory_.data() + lane / width_ * width_ * lane_fields, width_, lane % width_}; }
  /// What stops one run stops no other.
  template <class Action>
  void attempt(int lane, Action&& action) {
    if (!is_alive(lane)) return;
    if (auto fault = fault_of(action)) {
      results_[lane] = *fault;
      alive_[lane / width_] &= ~bit(lane);
    }
  }
  static void go_on(void* owner, int lane, const LaneSample& sample, double torque, double disturbance) {
    auto& group = *static_cast<LaneGroup*>(owner);
    group.attempt(lane,
                  [&] { group.runs_[lane]->go_on(group.place(lane), sample.number, sample.t, torque, disturbance); });
  }
  static void note(void* owner, int lane, const ControlRecord& record) {
    auto& group = *static_cast<LaneGroup*>(owner);
    group.runs_[lane]->note(group.place(lane), record);
  }

  static SectionOf<double> section(void* owner, int lane, int table, double x) {
    return static_cast<LaneGroup*>(owner)->runs_[lane]->section(table, x);
  }

  /// Numbers as a register is aligned.
  struct alignas(64) Line {
    double of[8];
  };

  LaneKind kind_;
  int width_;
  std::vector<std::unique_ptr<LaneRun>> runs_;
  std::vector<BatchResult> results_;
  std::array<unsigned, LaneBatch::most> alive_{};
  alignas(64) std::array<double, LaneBatch::most * lane_fields> memory_{};
  std::vector<Line> tapes_;
  std::vector<double> noise_, disturbance_;  ///< of a portion of samples, of all lanes; empty where there are none
};

/// Whether one kernel can take both.
bool share_a_kernel(LaneRun& a, LaneRun& b) {
  LaneVariant of_a = a.variant();
  of_a.ideal = b.variant().ideal;
  return of_a == b.variant() && (!of_a.taped || *a.tape() == *b.tape());
}

}  // namespace

BatchResult run_alone(const Scenario& scenario, const RunListeners& listeners) {
  BatchResult result;
  if (const auto fault = fault_of([&] { result = run_scenario(scenario, listeners); })) result = *fault;
  return result;
}

int runs_together(const Scenario& scenario) { return fits_lane(scenario) ? LaneBatch::most : 1; }

std::vector<BatchResult> run_batch(std::span<const Scenario> scenarios, LaneKind kind) {
  std::vector<BatchResult> results(scenarios.size());
  run_batch(
      scenarios, [&](std::size_t place, BatchResult result) { results[place] = std::move(result); }, kind);
  return results;
}

void run_batch(std::span<const Scenario> scenarios, const std::function<void(std::size_t, BatchResult)>& take,
               LaneKind kind) {
  std::vector<bool> taken(scenarios.size());
  for (std::size_t first = 0; first < scenarios.size(); ++first) {
    if (taken[first]) continue;
    std::vector<std::unique_ptr<LaneRun>> runs;
    std::vector<std::size_t> places;
    for (std::size_t k = first; k < scenarios.size() && runs.size() < LaneBatch::most; ++k) {
      if (taken[k] || (k > first && !share_samples(scenarios[first], scenarios[k]))) continue;
      auto run = lane_run(scenarios[k]);
      if (!run && k == first) break;
      if (!run || (k > first && !share_a_kernel(*run, *runs.front()))) continue;
      runs.push_back(std::move(run));
      places.push_back(k);
      taken[k] = true;
    }
    if (runs.empty()) {
      take(first, run_alone(scenarios[first]));
      continue;
    }
    std::vector<BatchResult> found = LaneGroup(kind, std::move(runs)).run(scenarios[first]);
    for (std::size_t k = 0; k < places.size(); ++k) take(places[k], std::move(found[k]));
  }
}

}  // namespace wormdrive
