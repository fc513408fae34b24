#pragma once
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace wormdrive {

/// The zero of an incremental encoder: where it was switched on it is off by an error, until the mark on its disc
/// passes. The mark tells the angle within a turn, so the error that remains is the nearest number of whole turns.
class EncoderZero {
 public:
  /// error [rad] and mark [rad] of its shaft; without a mark the error remains.
  EncoderZero(double error, std::optional<double> mark)
      : error_(error), mark_(mark.value_or(0.0)), searches_(mark ? 1.0 : 0.0) {}

  bool is_off() const { return error_ != 0.0; }

  /// The error [rad] at a sample, the first or a later one, that finds the shaft at an angle [rad]. The mark has passed
  /// where it lies between this angle and that of the sample before.
  double operator()(double angle, bool first) {
    constexpr double turn = 2.0 * std::numbers::pi;
    const double marks = std::floor((angle - mark_) / turn), before = std::exchange(marks_, marks);
    if (!first && searches_ != 0.0 && marks != before) {
      error_ = turn * std::round(error_ / turn);
      searches_ = 0.0;
    }
    return error_;
  }

  /// Calls visit(number) for every number that samples change.
  template <class Visit>
  void visit_memory(Visit&& visit) {
    visit(error_);
    visit(searches_);
    visit(marks_);
  }

 private:
  double error_, mark_;
  double searches_;     ///< 1 until the mark has passed, then 0
  double marks_ = 0.0;  ///< how many lay below the angle at the sample before
};

}  // namespace wormdrive
