#include "diagnosis/fitting/evaluation.hpp"

#include <cmath>
#include <utility>

#include "description/build.hpp"
#include "diagnosis/candidates/catalogue.hpp"
#include "diagnosis/data/moved_load.hpp"
#include "diagnosis/faults/mended_recording.hpp"
#include "diagnosis/predictor/drive_with_backlash.hpp"
#include "diagnosis/predictor/drive_with_states.hpp"
#include "diagnosis/predictor/predictor.hpp"
#include "diagnosis/rules/noise.hpp"

namespace wormdrive {

Evaluation::Evaluation(Scenario scenario, InnovationLayout layout, int threads)
    : scenario_(std::move(scenario)), layout_(std::move(layout)), threads_(threads) {
  scenario_.motor = {};  // the recorded command is all there is
  scenario_.control.reset();
  for (const PreparedRecording& r : layout_.recordings)
    shortest_period_ = shortest_period_ == 0.0 ? r.data.period : std::min(shortest_period_, r.data.period);
}

std::span<const double> Evaluation::of_recording(std::span<const double> extra, std::size_t recording) const {
  return extra.empty() ? extra : extra.subspan(layout_.begins[recording], layout_.recordings[recording].samples());
}

std::shared_ptr<const std::vector<ObserverGains>> Evaluation::gains_of(std::size_t recording,
                                                                       const ProcessNoise& noise) const {
  {
    const std::lock_guard lock(knows_gains_);
    for (const KnownGains& known : known_gains_)
      if (known.recording == recording && known.noise.has_torques_of(noise)) return known.gains;
  }
  auto gains = std::make_shared<const std::vector<ObserverGains>>(observer_gains(noise, layout_.recordings[recording]));
  const std::lock_guard lock(knows_gains_);
  known_gains_.push_back({recording, noise, gains});
  if (known_gains_.size() > static_cast<std::size_t>(threads_) * layout_.recordings.size()) known_gains_.pop_front();
  return gains;
}

template <class Use>
void Evaluation::with_predictor(const RecordedDrive& drive, std::size_t recording, const ProcessNoise& noise,
                                std::span<const double> extra, Use&& use) const {
  Effects<double> followed = drive.effects;
  const TakenOut out = take_out(followed);
  const PreparedRecording& as_recorded = layout_.recordings[recording];
  const bool is_wrong = drive.faults.any();
  const PreparedRecording as_it_was = is_wrong ? mended(as_recorded, drive.faults) : PreparedRecording{};
  const PreparedRecording& prepared = is_wrong ? as_it_was : as_recorded;
  const auto gains = drive.faults.of<TimeScale>()  // no other fault has times of its own
                         ? std::make_shared<const std::vector<ObserverGains>>(observer_gains(noise, prepared))
                         : gains_of(recording, noise);
  const auto follow = [&]<class Model>(auto&& followed_drive) {
    Predictor<Model> predictor(std::move(followed_drive), out, noise.impact, prepared, *gains, extra);
    use(predictor);
  };
  const LoadParameters& moved = moved_load(scenario_, prepared.data);
  if (is_followed_with_states(followed))
    return follow.template operator()<DriveWithStates>(make_drive<true>(scenario_, sum_of(moved), followed, {}));
  std::visit(
      [&](const auto& load) {
        using Load = decltype(make_load(load));
        follow.template operator()<DriveWithBacklash<Load>>(make_drive(scenario_, load, followed, {}));
      },
      moved);
}

std::optional<std::vector<double>> Evaluation::innovations(const RecordedDrive& drive, const ProcessNoise& noise,
                                                           std::span<const double> extra,
                                                           std::vector<FilteredStates>* states) const {
  std::vector<double> e(layout_.size, 0.0);
  if (states) states->resize(layout_.recordings.size());
  try {
    for (std::size_t r = 0; r < layout_.recordings.size(); ++r) {
      ++passes_;
      const PreparedRecording& recording = layout_.recordings[r];
      FilteredStates* kept = states ? &(*states)[r] : nullptr;
      if (kept) *kept = FilteredStates(recording.samples());
      with_predictor(drive, r, noise, of_recording(extra, r), [&](auto& predictor) {
        const std::span<double> all(e);
        predictor(layout_.of(r, all), layout_.of_worm(r, all), kept);
      });
    }
  } catch (const SolverFault&) {
    return std::nullopt;
  }
  for (const double x : e)
    if (!(std::abs(x) < rules::lost)) return std::nullopt;
  return e;
}

std::vector<std::vector<double>> Evaluation::run_on(const RecordedDrive& drive, const ProcessNoise& noise,
                                                    std::size_t recording, const FilteredStates& states,
                                                    std::span<const std::size_t> begins, std::size_t steps,
                                                    std::span<const double> innovations,
                                                    std::span<const double> extra) const {
  std::vector<std::vector<double>> rows;
  std::span<const double> of_gear, of_worm;
  if (!innovations.empty()) {
    of_gear = layout_.of(recording, innovations);
    of_worm = layout_.of_worm(recording, innovations);
  }
  const PreparedRecording& data = layout_.recordings[recording];
  with_predictor(drive, recording, noise, of_recording(extra, recording), [&](auto& predictor) {
    for (const std::size_t begin : begins) {
      // not a number from where the model can no longer move
      std::vector<double> angles(std::min(steps, data.end_of_stretch(begin) - 1 - begin), std::nan(""));
      try {
        predictor.run_on(begin, states, of_gear, of_worm, angles);
      } catch (const SolverFault&) {
        // what was predicted up to there counts
      }
      rows.push_back(std::move(angles));
    }
  });
  return rows;
}

}  // namespace wormdrive
