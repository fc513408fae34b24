#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>
#include <tuple>

#include "control/reference_point.hpp"
#include "core/field.hpp"
#include "core/numbers/sine_cosine.hpp"

namespace wormdrive {

/// A sine whose frequency rises linearly over a duration and then stays.
struct ChirpReference {
  static constexpr std::string_view kind = "chirp";
  static constexpr std::string_view meaning = "a sine whose frequency changes linearly over a duration";
  double amplitude{};
  double first_frequency{};
  double last_frequency{};
  double duration{};

  static constexpr auto fields() {
    using P = ChirpReference;
    return std::tuple{
        Field{&P::amplitude, "amplitude", unit::radian, bounds::any, "amplitude of the sine"},
        Field{&P::first_frequency, "first_frequency", unit::hertz, bounds::not_negative, "frequency at t = 0"},
        Field{&P::last_frequency, "last_frequency", unit::hertz, bounds::not_negative, "frequency at the end"},
        Field{&P::duration, "duration", unit::second, bounds::positive, "time of the sweep"}};
  }
  bool operator==(const ChirpReference&) const = default;
  ReferencePoint at(double t) const {
    const double rate = t < duration ? 2.0 * std::numbers::pi * (last_frequency - first_frequency) / duration : 0.0;
    const double swept = std::min(t, duration), after = t - swept;
    const double omega =
        2.0 * std::numbers::pi * (first_frequency + (last_frequency - first_frequency) * swept / duration);
    const double phase = std::numbers::pi * swept * first_frequency + 0.5 * omega * swept + omega * after;
    const SineAndCosine now = sine_and_cosine(phase);
    return {amplitude * now.sine, amplitude * omega * now.cosine,
            amplitude * (rate * now.cosine - omega * omega * now.sine)};
  }
};

}  // namespace wormdrive
