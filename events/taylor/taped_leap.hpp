#pragma once
#include "events/taylor/accuracy.hpp"
#include "events/taylor/leap.hpp"
#include "events/taylor/tape_series.hpp"

namespace wormdrive {

/// One step of a drive whose equations are on a tape, without a search for events: of one drive or of several at once.
template <class V>
class TapedLeapOf {
 public:
  using Mask = MaskOf<V>;
  using In = TapeInput;

  static constexpr int longest = 20;          ///< coefficients of the acceleration
  static constexpr int stride = longest + 2;  ///< that the angle has
  static constexpr double farthest = 64.0;    ///< leaps that the disc of times is wide

  explicit TapedLeapOf(const TapeSeriesOf<V>& series) : series_(series) {}

  /// Takes up a moment [s, rad, rad/s] with what the motor is told and what disturbs the worm's shaft [N m], and works
  /// out all that they come to.
  template <class Functions>
  [[gnu::always_inline]] void begin(double t, const V& theta, const V& omega, const V& motor, const V& disturbs,
                                    Functions&& functions) {
    series_[In::time][0] = t;
    series_[In::time][1] = 1.0;
    series_[In::angle][0] = theta;
    series_[In::speed][0] = omega;
    series_[In::command][0] = motor;
    series_[In::disturbance][0] = disturbs;
    const TapedMotionOf<V>& m = series_.motion();
    V torque = m.load + m.slope * (t - m.start);
    for (int k = 0; k < series_.code().waves; ++k) {
      WaveOf<V>& wave = series_.wave(k);
      wave.now = functions.sine_and_cosine(wave.omega * t + wave.phase);
      torque += wave.amplitude * wave.now.cosine;
    }
    series_[In::load][0] = torque;
    series_.work_out(0, series_.code().operations, functions);
  }

  /// Whether the mode certainly goes on under new torques: they are clear of the switching surface, as
  /// WormDrive::flank_by_far() has it.
  [[gnu::always_inline]] Mask goes_on() const {
    const TapedMotionOf<V>& m = series_.motion();
    const V distance = -m.flank * first(series_.code().beyond);
    const V most = abs(first(series_.code().worm)) + abs(m.surface * first(series_.code().gear));
    const Mask without_teeth = !(m.flank != V(0.0));
    return (m.motion * first(In::speed) > V(0.0)) & (without_teeth | (distance > 2e-3 * most));
  }

  /// Where, among these, it is certain beforehand that no guard falls through zero within h and how far the series must
  /// go. command_disc: that in which the motor's command stays within one of times.
  ///
  /// Around the present moment there is a disc of complex times in which angle and speed stay in discs of theirs, and
  /// so nothing strays from its value f by more than some r. What is so bounded in a disc of a radius R differs from f
  /// by at most r |s|/R at a time s (Schwarz), and its k-th coefficient is at most r/R^k (Cauchy).
  template <class CommandDisc>
  [[gnu::always_inline]] Mask foresee(const Mask& among, double h, const TaylorAccuracy& accuracy,
                                      CommandDisc&& command_disc) {
    const TapeCode& code = series_.code();
    const TapedMotionOf<V>& m = series_.motion();
    const V omega = first(In::speed), v = abs(omega), alpha = first(code.acceleration);
    // Radii with which both angle and speed use up theirs at about the same time.
    series_.radius(In::angle) = m.angle_disc;
    series_.radius(In::speed) = greatest<V>(0.5 * (root(v * v + 4.0 * m.angle_disc * abs(alpha)) - v),
                                            m.angle_disc * (1.0 / (4.0 * farthest * h)));
    series_.radius(In::time) = least<V>(V(farthest * h), m.time_disc);
    series_.radius(In::command) = command_disc(series_.radius(In::time));
    series_.radius(In::load) = load_disc(series_.radius(In::time));
    series_.radius(In::disturbance) = 0.0;
    series_.work_out_discs();
    const V factor = series_.shrinking();
    Mask certain = factor >= V(1.0);
    if (!all(certain)) {
      const V smaller = select(certain, V(1.0), (1.0 - 1e-6) * factor);
      for (const int which : {In::time, In::angle, In::speed, In::command, In::load})
        series_.radius(which) = series_.radius(which) * smaller;
      series_.work_out_discs();
      certain = series_.shrinking() >= V(1.0);
    }
    const V strays = series_.radius(code.acceleration);
    const V disc = least<V>(least<V>(series_.radius(In::speed) / (above_one * (abs(alpha) + strays)),
                                     series_.radius(In::angle) / (v + series_.radius(In::speed))),
                            series_.radius(In::time));
    const V ratio = above_one * h / disc;
    certain = certain & among & (ratio <= V(0.5));
    if (!any(certain)) return certain;

    const V bend = strays * ratio, change = above_one * (abs(alpha) + bend) * h, along = m.motion * omega;
    certain = certain & ((along > change) | ((along >= V(0.0)) & (m.motion * alpha > bend)));
    const Mask without_teeth = !(m.flank != V(0.0));
    certain = certain & (without_teeth | (-m.flank * first(code.beyond) > series_.radius(code.beyond) * ratio));
    certain = certain & series_.stays_in_range(ratio);

    const V allowed = accuracy.allowed(v + change, h) * (1.0 - ratio);
    terms_ = TermsOf<V>::needed(certain, 1, longest, bend, ratio, allowed);
    return terms_.suffice;
  }

  /// Works out the motion from there, which value() tells.
  template <class Functions>
  [[gnu::always_inline]] void follow(Functions&& functions) {
    expand_load();
    V *const theta = series_[In::angle], *const omega = series_[In::speed];
    const V* const acceleration = series_[series_.code().acceleration];
    for (int k = 0; k < terms_.most; ++k) {
      if (k > 0) series_.work_out(k, series_.code().of_acceleration, functions);
      theta[k + 1] = omega[k] * one_over(k + 1);
      omega[k + 1] = acceleration[k] * one_over(k + 1);
    }
    theta[terms_.most + 1] = omega[terms_.most] * one_over(terms_.most + 1);
    if constexpr (!std::is_same_v<V, double>)
      for (int k = 1; k <= terms_.most; ++k) {  // a drive alone would have stopped there
        const Mask counts = V(static_cast<double>(k)) <= terms_.of_each;
        omega[k] = select(counts, omega[k], V(0.0));
        theta[k + 1] = select(counts, theta[k + 1], V(0.0));
      }
  }
  /// Angle and speed so many seconds after the latest moment.
  V angle_after(double s) const { return value(series_[In::angle], terms_.most + 2, s); }
  V speed_after(double s) const { return value(series_[In::speed], terms_.most + 1, s); }

  TapeSeriesOf<V>& series() { return series_; }
  const TapeSeriesOf<V>& series() const { return series_; }

  /// Coefficients of the load over time from the second on, up to the order that is asked for.
  void expand_load(int order) {
    const TapedMotionOf<V>& m = series_.motion();
    V* const c = series_[In::load];
    for (int k = 1; k <= order; ++k) c[k] = k == 1 ? m.slope : V(0.0);
    for (int n = 0; n < series_.code().waves; ++n) {
      const WaveOf<V>& wave = series_.wave(n);
      const V cosine = wave.amplitude * wave.now.cosine, sine = wave.amplitude * wave.now.sine;
      V weight = 1.0;  // omega^k / k!
      for (int k = 1; k <= order; ++k) {
        weight = weight * (wave.omega * one_over(k));
        c[k] += weight * (k % 4 == 0 ? cosine : k % 4 == 1 ? -sine : k % 4 == 2 ? -cosine : sine);
      }
    }
  }

 private:
  const V& first(int place) const { return series_[place][0]; }
  void expand_load() { expand_load(terms_.most - 1); }

  /// The most by which the load over time differs from its value within so many seconds, complex ones too: a cosine by
  /// amplitude (e^x - 1), x = omega seconds, which is at most as steep as where x is greatest, and there is at most 1.
  V load_disc(const V& seconds) const {
    const TapedMotionOf<V>& m = series_.motion();
    const V x = m.fastest * seconds;
    const V growth = 1.0 + x * (1.0 / 2) * (1.0 + x * (1.0 / 3) * (1.0 + x * (1.0 / 4) * (1.0 + x * (1.3 / 5))));
    return select(seconds > V(0.0), seconds * (abs(m.slope) + m.steepness * growth), V(0.0));
  }

  [[gnu::always_inline]] static V value(const V* c, int size, double s) {
    if constexpr (std::is_same_v<V, double>) {
      return wormdrive::value({c, static_cast<std::size_t>(size)}, s);
    } else {
      const double square = s * s;  // as a drive alone has it, even and odd powers side by side
      V even = 0.0, odd = 0.0;
      if (size % 2 == 1) even = c[--size];
      for (; size > 0; size -= 2) {
        even = even * square + c[size - 2];
        odd = odd * square + c[size - 1];
      }
      return even + s * odd;
    }
  }

  TapeSeriesOf<V> series_;
  TermsOf<V> terms_{};  ///< of the latest leap
};

}  // namespace wormdrive
