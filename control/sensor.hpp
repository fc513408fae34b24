#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/numbers/portable.hpp"
#include "statistics/random.hpp"

namespace wormdrive {

/// How the gear angle reaches the controller, and how the speed is made from it.
struct SensorSettings {
  double counts{0.0};  ///< of the encoder per turn of its shaft; 0: exact
  double noise{0.0};   ///< standard deviation on its shaft [rad]
  double seed{1};
  double zero_error{0.0};              ///< by which its shaft's angle is off until the index mark has passed [rad]
  std::optional<double> index_mark{};  ///< angle of its shaft at the mark [rad]; none: the error remains
  double filter_cutoff{0.0};           ///< of the one-pole low-pass behind the difference [Hz]; 0: none
  bool exact_speed = false;            ///< of the angle that the sensor sees, instead of the filtered difference
  bool on_worm = false;  ///< the encoder sits on the worm's shaft, and its angle over the ratio is measured

  static constexpr auto fields() {
    using P = SensorSettings;
    constexpr Presence o = Presence::optional;
    return std::tuple{
        Field{&P::counts, "counts", unit::whole, bounds::not_negative,
              "encoder counts per turn of its shaft; 0 is exact", o},
        Field{&P::noise, "noise", unit::radian, bounds::not_negative,
              "standard deviation of the angle of the encoder's shaft", o},
        Field{&P::seed, "seed", unit::whole, seeds, "seed of the noise", o},
        Field{&P::zero_error, "zero_error", unit::radian, bounds::any,
              "error of the encoder's zero when it is switched on, an angle of its shaft", o},
        Field{&P::index_mark, "index_mark", unit::radian, bounds::any,
              "angle of its shaft at the index mark, which ends the error; without it the error remains", o},
        Field{&P::filter_cutoff, "speed_filter", unit::hertz, bounds::not_negative,
              "cut-off of the speed's low-pass; 0 is none", o}};
  }
  static constexpr auto choices() {
    using P = SensorSettings;
    using Words = std::array<std::string_view, 2>;
    return std::tuple{Choice{&P::on_worm, "shaft", Words{"gear", "worm"}, "where the encoder sits"},
                      Choice{&P::exact_speed, "speed", Words{"difference", "exact"}, "how the speed is obtained"}};
  }
};

/// The encoder: noise, then rounding to counts.
class Encoder {
 public:
  explicit Encoder(const SensorSettings& settings)
      : settings_(settings), exact_(settings.noise <= 0.0 && settings.counts <= 0.0) {}

  /// It shows every angle as it is.
  bool is_exact() const { return exact_; }
  /// The measured angle of its shaft [rad] at the k-th sample.
  double operator()(double angle, std::uint64_t k) const {
    if (exact_) return angle;
    if (settings_.noise > 0.0) angle += noise(k);
    if (settings_.counts <= 0.0) return angle;
    const double step = count();
    return step * std::floor(angle / step + 0.5);
  }
  /// The noise of the k-th sample [rad].
  double noise(std::uint64_t k) const {
    return settings_.noise * normal(static_cast<std::uint64_t>(settings_.seed), Stream::encoder_noise, k);
  }
  /// The angle of a count [rad]; infinite without counts.
  double count() const { return 2.0 * std::numbers::pi / settings_.counts; }

 private:
  SensorSettings settings_;
  bool exact_;
};

}  // namespace wormdrive
