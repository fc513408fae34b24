#pragma once
#include <atomic>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "description/scenario.hpp"
#include "diagnosis/candidates/coordinates.hpp"
#include "diagnosis/predictor/filtered_states.hpp"
#include "diagnosis/predictor/noise_model.hpp"
#include "diagnosis/predictor/observer_gains.hpp"

namespace wormdrive {

/// Predicts all recordings, once their faults are mended, by a scenario whose effects are changed.
class Evaluation {
 public:
  Evaluation(Scenario scenario, InnovationLayout layout, int threads);

  const Scenario& scenario() const { return scenario_; }
  const InnovationLayout& layout() const { return layout_; }
  int threads() const { return threads_; }
  /// Between two samples of the fastest recording [s].
  double shortest_period() const { return shortest_period_; }
  /// Recordings predicted so far.
  long passes() const { return passes_; }

  /// Innovations of all recordings [rad]; nothing where the model cannot move so. extra: torque added to the command at
  /// every sample [N m], empty for none. states: of every recording, if wanted.
  std::optional<std::vector<double>> innovations(const RecordedDrive& drive, const ProcessNoise& noise,
                                                 std::span<const double> extra = {},
                                                 std::vector<FilteredStates>* states = nullptr) const;

  /// The gear angles that the sensor would show `steps` samples on from samples of one recording, row by row [rad], if
  /// these were the innovations of all; predictions without any. extra: as above.
  std::vector<std::vector<double>> run_on(const RecordedDrive& drive, const ProcessNoise& noise, std::size_t recording,
                                          const FilteredStates& states, std::span<const std::size_t> begins,
                                          std::size_t steps, std::span<const double> innovations = {},
                                          std::span<const double> extra = {}) const;

 private:
  std::span<const double> of_recording(std::span<const double> extra, std::size_t recording) const;
  /// Of a recording with the times that it has.
  std::shared_ptr<const std::vector<ObserverGains>> gains_of(std::size_t recording, const ProcessNoise& noise) const;
  template <class Use>
  void with_predictor(const RecordedDrive& drive, std::size_t recording, const ProcessNoise& noise,
                      std::span<const double> extra, Use&& use) const;

  Scenario scenario_;
  InnovationLayout layout_;
  int threads_;
  double shortest_period_ = 0.0;
  mutable std::atomic<long> passes_{0};

  struct KnownGains {
    std::size_t recording;
    ProcessNoise noise;
    std::shared_ptr<const std::vector<ObserverGains>> gains;
  };
  mutable std::mutex knows_gains_;
  mutable std::deque<KnownGains> known_gains_;  ///< the last ones, for many passes have the same
};

}  // namespace wormdrive
