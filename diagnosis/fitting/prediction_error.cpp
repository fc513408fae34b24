#include "diagnosis/fitting/prediction_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

#include "description/build.hpp"
#include "description/keys.hpp"
#include "diagnosis/rules/noise.hpp"
#include "statistics/moments.hpp"
#include "statistics/student_t.hpp"

namespace wormdrive {

namespace {

/// One prediction of one model.
struct Stretch {
  std::size_t recording, begin, block;
  double mean_square;          ///< of its errors [rad^2]
  std::vector<double> errors;  ///< prediction less measurement [rad]
};

double mean_square(const std::vector<double>& errors) {
  double sum = 0.0;
  for (const double e : errors) sum += e * e;
  return sum <= rules::largest_square_error * static_cast<double>(errors.size())
             ? sum / static_cast<double>(errors.size())
             : rules::largest_square_error;
}

/// Samples of a recording from which predictions are judged.
std::vector<std::size_t> beginnings(const PreparedRecording& recording, std::size_t steps) {
  std::vector<std::size_t> begins;
  const std::size_t between = std::max<std::size_t>(1, std::min(steps, recording.block_length) / 2);
  for (std::size_t k = recording.block_length; k + steps + 1 < recording.samples(); k += between)
    if (recording.held_out[k] && recording.used[k] && k >= recording.start_of_stretch(k) + recording.block_length &&
        k + steps < recording.end_of_stretch(k))
      begins.push_back(k);
  return begins;
}

/// A hypothesis that has gone through the recordings, ready to predict from all beginnings.
class Forecast {
 public:
  Forecast(const Evaluation& evaluation, const Hypothesis& h, std::span<const double> extra = {})
      : evaluation_(evaluation), noise_(h.noise), drive_(extended(h)), extra_(extra) {
    goes_on_ = evaluation.innovations(drive_, noise_, extra, &states_).has_value();
  }

  /// Against what was measured.
  std::vector<Stretch> of_data(double horizon) const {
    return against(horizon,
                   [&](std::size_t r, const Begins& begins, std::size_t steps) { return measured(r, begins, steps); });
  }
  /// Against its own motion with innovations.
  std::vector<Stretch> of_noise(double horizon, std::span<const double> innovations) const {
    return against(horizon, [&](std::size_t r, const Begins& begins, std::size_t steps) {
      return evaluation_.run_on(drive_, noise_, r, states_[r], begins, steps, innovations, extra_);
    });
  }
  /// The same start without a model of the drive, which goes on at the same speed, against what was measured.
  std::vector<Stretch> at_constant_speed(double horizon) const {
    return stretches(horizon, [&](std::size_t r, const Begins& begins, std::size_t steps) {
      const double period = evaluation_.layout().recordings[r].data.period;
      Angles angles(begins.size());
      for (std::size_t q = 0; q < begins.size(); ++q)
        for (std::size_t k = 1; k <= steps; ++k)
          angles[q].push_back(states_[r].angle[begins[q]] +
                              static_cast<double>(k) * period * states_[r].speed[begins[q]]);
      return std::pair(std::move(angles), measured(r, begins, steps));
    });
  }

 private:
  using Begins = std::vector<std::size_t>;
  using Angles = std::vector<std::vector<double>>;

  Angles measured(std::size_t r, const Begins& begins, std::size_t steps) const {
    const std::vector<double>& angle = evaluation_.layout().recordings[r].data.gear_angle;
    Angles all;
    for (const std::size_t begin : begins) {
      const auto from = angle.begin() + static_cast<std::ptrdiff_t>(begin + 1);
      all.emplace_back(from, from + static_cast<std::ptrdiff_t>(steps));
    }
    return all;
  }
  /// truth(recording, begins, steps): what comes after each beginning.
  template <class Truth>
  std::vector<Stretch> against(double horizon, Truth&& truth) const {
    return stretches(horizon, [&](std::size_t r, const Begins& begins, std::size_t steps) {
      return std::pair(evaluation_.run_on(drive_, noise_, r, states_[r], begins, steps, {}, extra_),
                       truth(r, begins, steps));
    });
  }
  /// both(recording, begins, steps): what is predicted from each beginning on, and what comes.
  template <class Both>
  std::vector<Stretch> stretches(double horizon, Both&& both) const {
    std::vector<Stretch> all;
    if (!goes_on_) return all;
    const InnovationLayout& layout = evaluation_.layout();
    for (std::size_t r = 0; r < layout.recordings.size(); ++r) {
      const PreparedRecording& recording = layout.recordings[r];
      const auto steps = static_cast<std::size_t>(std::max(1L, std::lround(horizon / recording.data.period)));
      const Begins begins = beginnings(recording, steps);
      auto [errors, truth] = both(r, begins, steps);
      for (std::size_t q = 0; q < begins.size(); ++q) {
        for (std::size_t k = 0; k < errors[q].size(); ++k) errors[q][k] -= truth[q][k];
        all.push_back(
            {r, begins[q], layout.block[layout.begins[r] + begins[q]], mean_square(errors[q]), std::move(errors[q])});
      }
    }
    return all;
  }

  const Evaluation& evaluation_;
  ProcessNoise noise_;
  RecordedDrive drive_;
  std::span<const double> extra_;
  std::vector<FilteredStates> states_;
  bool goes_on_ = false;
};

double rms(const std::vector<Stretch>& all) {
  double sum = 0.0;
  for (const Stretch& s : all) sum += s.mean_square;
  return all.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(all.size()));
}

/// 95 % interval of the rms by drawing blocks with replacement.
void bootstrap(const std::vector<Stretch>& all, std::uint64_t seed, PredictionError& e) {
  std::vector<std::size_t> blocks;
  for (const Stretch& s : all)
    if (blocks.empty() || blocks.back() != s.block) blocks.push_back(s.block);
  if (blocks.empty()) return;
  std::vector<double> sums(blocks.size(), 0.0), counts(blocks.size(), 0.0);
  for (const Stretch& s : all) {
    const auto b = static_cast<std::size_t>(std::find(blocks.begin(), blocks.end(), s.block) - blocks.begin());
    sums[b] += s.mean_square;
    counts[b] += 1.0;
  }
  std::mt19937_64 random(seed);
  constexpr int draws = 1000;
  std::vector<double> drawn;
  for (int k = 0; k < draws; ++k) {
    double sum = 0.0, count = 0.0;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      const std::size_t which = random() % blocks.size();
      sum += sums[which];
      count += counts[which];
    }
    drawn.push_back(std::sqrt(sum / count));
  }
  std::sort(drawn.begin(), drawn.end());
  e.after_low = drawn[draws / 40];
  e.after_high = drawn[draws - 1 - draws / 40];
}

}  // namespace

double error_ahead(const Evaluation& evaluation, const Hypothesis& h, double horizon) {
  return rms(Forecast(evaluation, h).of_data(horizon));
}

namespace {

/// gain(without, with): what a block shows, of the sums of its squares.
template <class Gain>
double share_that_goes(const std::vector<Stretch>& without, const std::vector<Stretch>& with, Gain&& gain) {
  if (with.size() != without.size()) return 0.0;  // with it the model loses the motion
  std::vector<double> gains;                      // of blocks
  for (std::size_t k = 0; k < without.size();) {
    double sum_without = 0.0, sum_with = 0.0;
    const std::size_t block = without[k].block;
    for (; k < without.size() && without[k].block == block; ++k) {
      sum_without += without[k].mean_square;
      sum_with += with[k].mean_square;
    }
    gains.push_back(gain(sum_without, sum_with));
  }
  if (gains.size() < 2) return std::numeric_limits<double>::infinity();
  Moments moments;
  moments.add(gains);
  const double chance = t_quantile(gains.size() - 1) * moments.deviation() / std::sqrt(moments.count);
  return moments.mean > chance ? 1.0 - rms(with) / rms(without) : 0.0;
}

}  // namespace

double share_of_error(const Evaluation& evaluation, const Hypothesis& h, double horizon,
                      std::span<const double> extra) {
  return share_that_goes(Forecast(evaluation, h).of_data(horizon), Forecast(evaluation, h, extra).of_data(horizon),
                         [](double without, double with) { return without - with; });
}

double share_of_error(const Evaluation& evaluation, const Hypothesis& h, const Hypothesis& other, double horizon) {
  return share_that_goes(Forecast(evaluation, h).of_data(horizon), Forecast(evaluation, other).of_data(horizon),
                         [](double without, double with) { return std::log(without / with); });
}

std::vector<PredictionError> prediction_errors(const Evaluation& evaluation, const Hypothesis& before,
                                               const Hypothesis& after, std::uint64_t seed) {
  std::vector<PredictionError> all;
  std::vector<std::vector<double>> noises;
  constexpr std::uint64_t draws = 4;
  for (std::uint64_t k = 0; k < draws; ++k)
    noises.push_back(drawn_innovations(evaluation.layout(), after.residuals, after.noise_model, seed + k));
  const Forecast forecast_before(evaluation, before), forecast_after(evaluation, after);
  for (const double horizon : rules::horizons) {
    PredictionError e;
    e.unit = spellings("angle", e.unit, evaluation.scenario().axis).front().unit;
    e.horizon = horizon;
    const std::vector<Stretch> then = forecast_before.of_data(horizon), now = forecast_after.of_data(horizon);
    if (now.empty()) continue;
    e.before = rms(then);
    e.after = rms(now);
    bootstrap(now, seed, e);
    std::vector<Stretch> drawn;
    for (const std::vector<double>& noise : noises)
      for (Stretch& s : forecast_after.of_noise(horizon, noise)) drawn.push_back(std::move(s));
    e.floor = rms(drawn);
    e.constant_speed = rms(forecast_after.at_constant_speed(horizon));
    all.push_back(e);
  }
  return all;
}

std::vector<PredictionExample> prediction_examples(const Evaluation& evaluation, const Hypothesis& before,
                                                   const Hypothesis& after) {
  std::vector<PredictionExample> examples;
  const Forecast forecast_before(evaluation, before), forecast_after(evaluation, after);
  for (const double horizon : rules::horizons) {
    const std::vector<Stretch> then = forecast_before.of_data(horizon), now = forecast_after.of_data(horizon);
    if (then.empty() || then.size() != now.size()) continue;
    std::vector<std::size_t> order(then.size());
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return then[a].mean_square > then[b].mean_square; });
    for (const std::size_t place : {std::size_t{0}, order.size() / 2, order.size() - 1}) {
      const Stretch &a = then[order[place]], &b = now[order[place]];
      const Recording& data = evaluation.layout().recordings[a.recording].data;
      PredictionExample example;
      example.horizon = horizon;
      for (std::size_t k = 0; k < std::min(a.errors.size(), b.errors.size()); ++k) {
        const double measured = data.gear_angle[a.begin + 1 + k];
        example.time.push_back(data.start + data.time(a.begin + 1 + k));
        example.measured.push_back(measured);
        example.before.push_back(measured + a.errors[k]);
        example.after.push_back(measured + b.errors[k]);
      }
      examples.push_back(std::move(example));
    }
  }
  return examples;
}

}  // namespace wormdrive
