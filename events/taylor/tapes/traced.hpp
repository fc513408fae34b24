#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "events/taylor/expansion.hpp"
#include "events/taylor/tapes/exponent.hpp"
#include "events/taylor/tapes/series.hpp"

namespace wormdrive {

/// The power series of a motion by its equations as they are at one moment: recorded there, with all comparisons as
/// they turn out, so that a coefficient costs what its own terms cost. What system.ahead() finds, with work that grows
/// with the square of the order instead of its cube.
template <class System>
class TracedMotion {
 public:
  using Instant = typename System::Instant;
  static constexpr int effect_states = System::state_size - 2;
  using Motion = Expansion<System::guard_count, effect_states>;

  /// Records the equations; false where a comparison is a tie, so that it takes the series itself to decide it.
  bool begin(const System& system, const Instant& now) {
    const bool rests = now.mode.motion == wormdrive::Motion::stuck;
    tape_.clear(first_state + effect_states);
    std::array<Taped, System::state_size> x;
    x[0] = rests ? Taped(now.x[0]) : tape_.input(angle, now.x[0]);
    x[1] = rests ? Taped(now.x[1]) : tape_.input(speed, now.x[1]);
    for (int k = 0; k < effect_states; ++k) x[2 + k] = tape_.input(first_state + k, now.x[2 + k]);
    const auto at = resting(system.moment_at(tape_.input(time, now.t), x), now);
    acceleration_ = tape_.place(system.acceleration(at, now.mode));
    if constexpr (effect_states > 0) {
      const auto rates = system.state_rates(at, now.mode);
      std::transform(rates.begin(), rates.end(), rates_.begin(), [this](const Taped& r) { return tape_.place(r); });
    }
    const auto guards = system.guards(at, now.mode);
    std::transform(guards.begin(), guards.end(), guards_.begin(), [this](const Taped& g) { return tape_.place(g); });
    bends_.clear();
    if (system.template bend_count<System::template MomentHere>() > 0)
      system.for_each_bend(at, now.mode.motion, [this](const Taped& b) { bends_.push_back(tape_.place(b)); });
    if (!tape_.is_complete()) return false;
    lay_out();
    begin_ = now;
    known_ = 0;
    return true;
  }

  /// Angle, speed, states and guards to an order, which must not fall.
  void extend(int order, Motion& e) {
    TapeSeriesOf<double> series = this->series();
    if (known_ == 0) {
      e.theta[0] = begin_.x[0];
      e.omega[0] = begin_.x[1];
      for (int k = 0; k < effect_states; ++k) e.states[k][0] = begin_.x[2 + k];
    }
    for (; known_ <= order; ++known_) {
      const int k = known_;
      const double share = reciprocal[k + 1];
      series[time][k] = k == 0 ? begin_.t : k == 1 ? 1.0 : 0.0;
      series[angle][k] = e.theta[k];
      series[speed][k] = e.omega[k];
      for (int j = 0; j < effect_states; ++j) series[first_state + j][k] = e.states[j][k];
      series.work_out(k, code_.operations, tables_);
      for (int g = 0; g < System::guard_count; ++g) e.guards[g][k] = series[guards_[g]][k];
      e.theta[k + 1] = e.omega[k] * share;
      e.omega[k + 1] = series[acceleration_][k] * share;
      for (int j = 0; j < effect_states; ++j) e.states[j][k + 1] = series[rates_[j]][k] * share;
    }
    e.order = order;
  }

  /// The quantities at whose zeros the equations bend, to the same order.
  std::vector<Coefficients> bends() {
    std::vector<Coefficients> all(bends_.size(), Coefficients{});
    for (std::size_t k = 0; k < all.size(); ++k) std::copy_n(series()[bends_[k]], known_, all[k].begin());
    return all;
  }

  /// How long, of h [s], no exponential rises so much that its terms may be too small to be seen at first.
  double end_of_rise(double h) { return wormdrive::end_of_rise(series(), tape_.exponents(), known_ - 1, h, search_); }
  /// Whether the equations certainly remain these within h [s]: no comparison turns out otherwise, and no table goes on
  /// to its next section.
  bool remain(double h) {
    const TapeSeriesOf<double> series = this->series();
    for (const Tape::Decision& decision : tape_.decisions()) {
      const double* const compared = series[decision.place];
      if (!(std::abs(compared[0] - decision.value) > most_change(compared, h))) return false;
    }
    for (std::size_t k = 0; k < tape_.arguments().size(); ++k) {
      const double* const x = series[tape_.arguments()[k]];
      const SectionOf<double>& section = series.section(static_cast<int>(k));
      if (!(std::min(section.high - x[0], x[0] - section.low) > most_change(x, h))) return false;
    }
    return true;
  }

 private:
  enum Input : int { time, angle, speed, first_state };

  /// Prepares the memory for the operations that are recorded.
  void lay_out() {
    code_ = {};
    code_.steps = tape_.steps().data();
    code_.operations = static_cast<int>(tape_.steps().size());
    code_.places = tape_.places();
    code_.sections = static_cast<int>(tape_.arguments().size());
    const std::size_t room = TapeSeriesOf<double>::room(code_);
    if (memory_.size() < room) memory_.resize(room);
    TapeSeriesOf<double> series = this->series();
    put_constants(series);
    tables_ = TapeTables(tape_, series);
  }
  TapeSeriesOf<double> series() { return {code_, memory_.data()}; }

  /// The most by which a series may differ from its value within h [s]; what is left out of it counts as much as its
  /// last terms.
  double most_change(const double* c, double h) const {
    constexpr int last_ones = 6;
    double most = 0.0, power = h;
    for (int k = 1; k < known_; ++k, power *= h) most += (k + last_ones >= known_ ? 2.0 : 1.0) * std::abs(c[k]) * power;
    return most;
  }

  Tape tape_{0};
  int acceleration_ = 0;
  std::array<int, effect_states> rates_{};
  std::array<int, System::guard_count> guards_{};
  std::vector<int> bends_;
  TapeCode code_{};
  std::vector<double> memory_;
  TapeTables tables_;
  Instant begin_{};
  int known_ = 0;  ///< coefficients
  RootSearch search_;
};

}  // namespace wormdrive
