#pragma once
#include <cstddef>
#include <utility>

#include "control/lanes/trial.hpp"
#include "events/taylor/tapes/leap.hpp"

namespace wormdrive {

/// Where the numbers of a mode on a trial's tape are among those of its register, in the order of a TapeSeriesOf<V>.
class LaneTape {
 public:
  LaneTape() = default;
  /// code: the operations of the register; numbers: the first of the trial's own.
  LaneTape(const TapeCode& code, double* numbers, int lanes)
      : code_(&code), numbers_(numbers), lanes_(static_cast<std::size_t>(lanes)) {}

  TapedMotionOf<double> motion() const { return from_lane<TapedMotionOf<double>>(numbers_, lanes_); }
  /// Of the register's series, the value of a state; the numbers are those at its begin.
  double& state(int k) const {
    return numbers_[TapeSeriesOf<double>::first_of(*code_, TapeInput::first_state + k) * lanes_];
  }

  /// Takes up that the lane has exchanged its numbers with those of another mode.
  void exchange(LaneTape& other) {
    std::swap(left_, other.left_);
    std::swap(fits_, other.fits_);
  }
  /// Leaves the numbers of a mode there, which numbers() returns; nullptr for a mode that has no operations, as at
  /// rest. The lane waits where they are not those of the register.
  template <class Numbers>
  void leave(const TapeCode* code, Numbers&& numbers) {
    if (code != left_) fits_ = code != nullptr && *code == *code_;
    if (!fits_) {
      left_ = code;
      numbers_[0] = 0.0;  // of TapedMotionOf: it waits
      return;
    }
    const double* const from = numbers();
    const std::size_t inputs =
        (sizeof(TapedMotionOf<double>) + static_cast<std::size_t>(code->waves) * sizeof(WaveOf<double>)) /
        sizeof(double);
    const std::size_t changed = code == left_ ? inputs : TapeSeriesOf<double>::numbers(*code);
    for (std::size_t k = 0; k < changed; ++k) numbers_[k * lanes_] = from[k];
    left_ = code;
  }

 private:
  const TapeCode* code_ = nullptr;  ///< of the register
  double* numbers_ = nullptr;
  std::size_t lanes_ = 0;
  const TapeCode* left_ = nullptr;  ///< of the mode in which it was left, which fits the register's or not
  bool fits_ = false;
};

}  // namespace wormdrive
