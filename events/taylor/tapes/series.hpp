#pragma once
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/numbers/lanes.hpp"
#include "core/numbers/sine_cosine.hpp"
#include "events/taylor/polynomial.hpp"
#include "events/taylor/tapes/tape.hpp"

namespace wormdrive {

/// What the equations on a tape take from outside, in the places that come first; states of effects come behind.
struct TapeInput {
  enum : int { time, angle, speed, command, load, disturbance, brake, first_state };
};

/// The operations on a tape and which of their results count, without any number: what drives that have the same
/// effects have in common. The tape must outlive it.
struct TapeCode {
  static constexpr int most_states = 16;

  const Tape::Step* steps = nullptr;
  int operations = 0, of_acceleration = 0;  ///< all, and those up to the acceleration and the rates of the states
  int places = 0, states = 0;
  int acceleration = 0, beyond = 0, worm = 0, gear = 0;  ///< places of what counts
  const int* arguments = nullptr;                        ///< places that are bound to a section of a table
  int sections = 0;
  const int* rates = nullptr;      ///< places of the rates of the states
  const int* decisions = nullptr;  ///< places that have to stay on their sides ...
  const int* exponents = nullptr;  ///< ... and those of the arguments of exponentials
  int comparisons = 0, exponentials = 0;
  int waves = 0;      ///< of the load over time
  bool lags = false;  ///< the motor's torque follows its command with a lag

  friend bool operator==(const TapeCode& a, const TapeCode& b);
};

/// A cosine over time, and its sine and cosine at the present moment.
template <class V>
struct WaveOf {
  V amplitude, omega, phase;
  SineAndCosineOf<V> now;
};

/// The cubic of a table that holds now, or the constant before or behind all: between which arguments, and
/// value + s (slope + s (second + s third)), s = x - begin.
template <class V>
struct SectionOf {
  V low, high, begin, value, slope, second, third;
};

/// The value on a side of which something has to stay: above, 1, or below, -1.
template <class V>
struct SideOf {
  V value, side;
};

/// The constants of an operation.
template <class V>
struct LineOf {
  V factor, offset, second;
};

/// What a leap needs of a drive in one mode beside the operations of its tape, of one drive or of several at once. It
/// consists of V alone. All in SI.
template <class V>
struct TapedMotionOf {
  V motion, flank;       ///< +1, -1 or (flank) 0; motion 0 where the lane has to wait
  V surface;             ///< Jw i/Jg
  V load, slope, start;  ///< of the load over time: load + slope (t - start) + its waves
  V brake;               ///< torque of the brake [N m]
  V next_knot;           ///< when the inputs become others
  V leaps;               ///< that a lane has taken
};

/// The power series in time of all that stands on a tape, in memory that is somebody else's: of one drive or of several
/// at once.
///
/// The numbers that describe a drive come first in it, in the same order for one as for several.
template <class V>
class TapeSeriesOf {
 public:
  using Mask = MaskOf<V>;

  /// Coefficients of each place: an angle has two more than the order of the series.
  static constexpr int stride = highest_order + 2;

  TapeSeriesOf(const TapeCode& code, double* memory) : code_(&code) {
    motion_ = reinterpret_cast<TapedMotionOf<V>*>(memory);
    waves_ = reinterpret_cast<WaveOf<V>*>(motion_ + 1);
    lines_ = reinterpret_cast<LineOf<V>*>(waves_ + code.waves);
    sides_ = reinterpret_cast<SideOf<V>*>(lines_ + code.operations);
    sections_ = reinterpret_cast<SectionOf<V>*>(sides_ + code.comparisons);
    coefficients_ = reinterpret_cast<V*>(sections_ + code.sections);
  }
  /// How many numbers describe a drive ...
  static std::size_t numbers(const TapeCode& code) {
    return (sizeof(TapedMotionOf<V>) + sizeof(SectionOf<V>) * static_cast<std::size_t>(code.sections) +
            sizeof(WaveOf<V>) * static_cast<std::size_t>(code.waves) +
            sizeof(LineOf<V>) * static_cast<std::size_t>(code.operations) +
            sizeof(SideOf<V>) * static_cast<std::size_t>(code.comparisons)) /
           sizeof(V);
  }
  /// ... behind how many V the first coefficients of a place are ...
  static std::size_t first_of(const TapeCode& code, int place) {
    return numbers(code) + static_cast<std::size_t>(place * stride);
  }
  /// ... and how many V there are in all.
  static std::size_t room(const TapeCode& code) {
    return numbers(code) + static_cast<std::size_t>(code.places * stride);
  }

  const TapeCode& code() const { return *code_; }
  TapedMotionOf<V>& motion() { return *motion_; }
  const TapedMotionOf<V>& motion() const { return *motion_; }
  WaveOf<V>& wave(int k) { return waves_[k]; }
  LineOf<V>& line(int step) { return lines_[step]; }
  SideOf<V>& side(int comparison) { return sides_[comparison]; }
  const SideOf<V>& side(int comparison) const { return sides_[comparison]; }
  SectionOf<V>& section(int k) { return sections_[k]; }
  const SectionOf<V>& section(int k) const { return sections_[k]; }

  /// The coefficients of a place.
  V* operator[](int place) { return coefficients_ + place * stride; }
  const V* operator[](int place) const { return coefficients_ + place * stride; }
  /// Works out coefficient k of the results of the first so many operations, in order; inputs have theirs. functions:
  /// sine_and_cosine() and exp() of a V; find(section, x) lets a section be that of x, turns(section, x, k) the next
  /// one if coefficient k of x is what takes x out of it just now, and says whether it did.
  template <class Functions>
  void work_out(int k, int operations, Functions&& functions);

 private:
  const TapeCode* code_;
  TapedMotionOf<V>* motion_;
  WaveOf<V>* waves_;
  LineOf<V>* lines_;
  SideOf<V>* sides_;
  SectionOf<V>* sections_;
  V* coefficients_;
};

/// How near to its end a section of a table ends: what rounding leaves of the time at which a point is met.
inline double resolution_of(const SectionOf<double>& s, double x) {
  return 1e-12 * greatest(std::fabs(x), least(s.high - s.low, 1.0));
}

/// Puts the constants of the operations on a tape where they belong.
inline void put_constants(TapeSeriesOf<double>& series) {
  for (int k = 0; k < series.code().operations; ++k) {
    const Tape::Step& step = series.code().steps[k];
    series.line(k) = {step.factor, step.offset, step.second};
  }
}

/// The sections of the tables on the tape of a drive alone, and its elementary functions.
class TapeTables {
 public:
  TapeTables() = default;
  TapeTables(const Tape& tape, TapeSeriesOf<double>& series);

  SineAndCosine sine_and_cosine(double x) const { return wormdrive::sine_and_cosine(x); }
  double exp(double x) const { return portable::exp(x); }
  void find(int section, double x);
  bool turns(int section, const double* x, int k);

 private:
  struct Place {
    const CubicTable* table;
    SectionOf<double>* section;
    std::size_t number;

    /// The n-th section: before the first point, the cubics between the points, behind the last.
    void choose(std::size_t n);
  };
  std::vector<Place> places_;
};

extern template class TapeSeriesOf<double>;
extern template void TapeSeriesOf<double>::work_out(int, int, TapeTables&);

}  // namespace wormdrive
