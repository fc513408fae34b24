#pragma once
#include "events/taylor/accuracy.hpp"
#include "events/taylor/tapes/exponent.hpp"
#include "events/taylor/tapes/leap.hpp"

namespace wormdrive {

/// One step of a drive, without a search for events: of one drive or of several at once. It is worked out first and
/// judged by the terms of its series: bounds beforehand would be too wide, as of a state that follows within a step.
template <class V>
class LeapByTerms {
 public:
  using Mask = MaskOf<V>;
  using In = TapeInput;

  /// leap: what has taken up the moment at which the step begins.
  explicit LeapByTerms(TapedLeapOf<V>& leap) : leap_(leap), series_(leap.series()), code_(series_.code()) {}

  /// Whether the equations on the tape are those that hold, by the comparisons that decided them.
  Mask holds() const {
    Mask same = series_.motion().motion != V(0.0);
    for (int k = 0; k < code_.comparisons; ++k)
      same = same & (series_.side(k).side * (series_[code_.decisions[k]][0] - series_.side(k).value) > V(0.0));
    return same;
  }

  /// Works out the motion, which value() tells of, and returns where, among these, it is accurate, no guard falls
  /// through zero within h [s] and no comparison turns out otherwise, if the tables stay in their sections. h becomes
  /// shorter where the series does not suffice for all of it.
  template <class Functions>
  Mask take(const Mask& among, V& h, const TaylorAccuracy& accuracy, Functions&& functions) {
    h = least<V>(h, leap_.longest_within_sections());
    expand(among, h, accuracy, functions);
    Mask certain = among & (shorten(among & (!terms_.suffice), h, accuracy) | terms_.suffice);
    leap_.end_series(terms_);
    if (any(certain)) certain = certain & keeps_mode(h);
    return certain;
  }
  /// How many coefficients of all operations that has taken.
  int worked_out() const { return terms_.most; }

  /// Whether certainly no comparison turns out otherwise within h [s], by series of so many coefficients.
  Mask keeps_sides(const V& h, int coefficients) {
    terms_ = {V(static_cast<double>(coefficients)), coefficients, h >= V(0.0), coefficients};
    return keeps_sides(h);
  }

 private:
  static constexpr int longest = TapedLeapOf<V>::longest;
  static constexpr int fewest = 6;  ///< coefficients, before no series is judged
  static constexpr int mostly = 8;  ///< so many suffice mostly

  /// Works out coefficients until the last ones are negligible over h.
  template <class Functions>
  void expand(const Mask& among, const V& h, const TaylorAccuracy& accuracy, Functions&& functions) {
    tolerate(h, accuracy);
    V power = 1.0;  // h^(k - 4), the fifth before the last
    Mask left = among;
    terms_ = {V(0.0), longest, among};
    leap_.expand_load(1, mostly);
    for (int k = 0; k < longest; ++k) {
      if (k == mostly + 1) leap_.expand_load(k, longest);
      if (k > 0) series_.work_out(k, code_.operations, functions);
      leap_.expand_motion(k);
      if (k > 4) power = power * h;
      if (k + 1 < fewest) continue;
      const Mask enough = left & suffices(k + 1, h, power);
      terms_.of_each = select(enough, V(static_cast<double>(k + 1)), terms_.of_each);
      left = left & !enough;
      if (terms_.fewest == 0 && any(enough)) terms_.fewest = k + 1;
      if (any(left)) continue;
      terms_.most = k + 1;
      break;
    }
    terms_.of_each = select(left, V(static_cast<double>(longest)), terms_.of_each);
    if (terms_.fewest == 0) terms_.fewest = longest;
    terms_.suffice = among & !left;
  }
  /// Finds what a term may add to speed and states in a step of h [s].
  void tolerate(const V& h, const TaylorAccuracy& accuracy) {
    for (int j = 0; j <= code_.states; ++j) tolerated_[j] = accuracy.allowed(abs(series_[followed(j)][0]), h) * h;
  }
  /// Whether series up to coefficient n suffice in a step of h [s]: its last two terms are negligible, and the two
  /// before as well, or it falls so evenly from pair to pair that what is left out is less than they are. Of a drive
  /// that moves, every other coefficient may vanish, as where an angle or a load over time is at an extreme; where
  /// friction begins as a power of the speed, only every third or fourth does not. power: h^(n - 5).
  Mask suffices(int n, const V& h, const V& power) const {
    constexpr double falls = 16.0;  // by 4 from one to the next
    const V square = h * h;
    const auto fades = [&](int j) {
      const V* const c = series_[followed(j)] + n;
      const auto pair = [&](int k, const V& factor) { return (abs(c[k]) + abs(c[k + 1]) * h) * factor; };
      const V first = pair(-5, power), second = pair(-3, square * power), last = pair(-1, square * square * power);
      const Mask falls_evenly =
          (falls * last <= second) & (falls * second <= first) & (falls * last >= second / first * second);
      return (last <= tolerated_[j]) & ((second <= tolerated_[j]) | falls_evenly);
    };
    Mask all = fades(0);
    for (int j = 1; j <= code_.states; ++j) all = all & fades(j);
    return all;
  }
  static int followed(int j) { return j == 0 ? In::speed : In::first_state + j - 1; }
  /// Lets steps be so short that their longest series suffice, and returns where there are such steps.
  Mask shorten(const Mask& which, V& h, const TaylorAccuracy& accuracy) {
    constexpr double share = 0.75;
    constexpr int tries = 100;  // to 1e-12 of the step
    Mask open = which;
    for (int n = 0; n < tries && any(open); ++n) {
      h = select(open, share * h, h);
      tolerate(h, accuracy);
      open = open & !suffices(longest, h, times_power<V>(1.0, h, longest - 5));
    }
    return which & !open;
  }

  /// Where no guard falls through zero and the equations remain.
  Mask keeps_mode(const V& h) const {
    const TapedMotionOf<V>& m = series_.motion();
    const V motion = m.motion, along = motion * series_[In::speed][0];
    const Mask without_teeth = !(m.flank != V(0.0)), clear = least_value(In::speed, motion, h) > V(0.0);
    const Mask moves = all(clear) ? clear : clear | ((along >= V(0.0)) & (least_slope(In::speed, motion, h) > V(0.0)));
    return moves & (without_teeth | (least_value(code_.beyond, -m.flank, h) > V(0.0))) & keeps_sides(h) &
           sees_exponentials(h);
  }
  Mask keeps_sides(const V& h) const {
    Mask keeps = h >= V(0.0);
    for (int k = 0; k < code_.comparisons; ++k) {
      const SideOf<V>& side = series_.side(k);
      keeps = keeps & (least_value(code_.decisions[k], side.side, h, side.value) > V(0.0));
    }
    return keeps;
  }
  Mask sees_exponentials(const V& h) const {
    Mask sees = h >= V(0.0);
    for (int k = 0; k < code_.exponentials; ++k) {
      const int place = code_.exponents[k];
      sees = sees & (least_value(place, V(-1.0), h, highest_exponent(series_[place][0])) > V(0.0));
    }
    return sees;
  }
  /// What is certainly no more than so many times what stands in a place, less a value, within h [s]: by Horner's rule
  /// for intervals.
  V least_value(int place, const V& side, const V& h, const V& less = 0.0) const {
    return least_of([&, c = series_[place]](int k) { return k == 0 ? c[0] - less : c[k]; }, 0, side, h);
  }
  /// The same of its slope.
  V least_slope(int place, const V& side, const V& h) const {
    return least_of([&, c = series_[place]](int k) { return static_cast<double>(k) * c[k]; }, 1, side, h);
  }
  template <class Coefficient>
  V least_of(const Coefficient& coefficient, int first, const V& side, const V& h) const {
    V least_so_far = 0.0;
    int k = terms_.most - 1;
    const auto add = [&](const V& c) { least_so_far = c + least<V>(h * least_so_far, V(0.0)); };
    for (; k > first && k + TaylorAccuracy::window >= terms_.fewest; --k) add(with_rest(k, side * coefficient(k)));
    for (; k >= first; --k) add(side * coefficient(k));
    return least_so_far;
  }
  /// A coefficient that comes to no more than what it stands for: what is left out of a series counts as much as its
  /// last terms.
  V with_rest(int k, const V& c) const {
    const V number = static_cast<double>(k);
    const V counted = select(number + static_cast<double>(TaylorAccuracy::window) < terms_.of_each, c, c - abs(c));
    return select(number < terms_.of_each, counted, V(0.0));
  }

  TapedLeapOf<V>& leap_;
  TapeSeriesOf<V>& series_;
  const TapeCode& code_;
  TermsOf<V> terms_{};
  V tolerated_[1 + TapeCode::most_states];  ///< of a term of speed and states, in their units
};

}  // namespace wormdrive
