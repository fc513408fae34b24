#pragma once
#include <cmath>

#include "core/series.hpp"
#include "events/taylor_program.hpp"

namespace wormdrive {

/// A scalar that writes down what is computed with it: the equations of core/ are instantiated with it unchanged and
/// leave a program. It knows its present value and how that goes on, by which comparisons are decided.
class Traced {
 public:
  using Ahead = Series<double, 3>;
  using Operation = TaylorProgram::Operation;

  Traced() = default;
  Traced(double constant) : ahead_(constant) {}  // NOLINT(google-explicit-constructor): constants mix freely
  /// An input of the program: time, angle or speed.
  Traced(TaylorProgram& program, Operation input, const Ahead& ahead)
      : ahead_(ahead), program_(&program), result_(program.result(input)) {}

  /// The result of the program that this is.
  int result_in(TaylorProgram& program) const {
    return program_ ? result_ : program.result(Operation::constant, -1, -1, ahead_[0]);
  }

  Traced& operator+=(const Traced& b) { return *this = *this + b; }
  Traced& operator-=(const Traced& b) { return *this = *this - b; }
  Traced& operator*=(const Traced& b) { return *this = *this * b; }
  Traced& operator/=(const Traced& b) { return *this = *this / b; }
  Traced operator-() const { return *this * Traced(-1.0); }
  friend Traced operator+(const Traced& a, const Traced& b) {
    if (a.is(0.0)) return b;
    return b.is(0.0) ? a : Traced(Operation::add, a, b, a.ahead_ + b.ahead_);
  }
  friend Traced operator-(const Traced& a, const Traced& b) {
    return b.is(0.0) ? a : Traced(Operation::subtract, a, b, a.ahead_ - b.ahead_);
  }
  friend Traced operator*(const Traced& a, const Traced& b) {
    if (a.is(0.0) || b.is(0.0)) return 0.0;
    if (a.is(1.0)) return b;
    return b.is(1.0) ? a : Traced(Operation::multiply, a, b, a.ahead_ * b.ahead_);
  }
  friend Traced operator/(const Traced& a, const Traced& b) {
    return a.is(0.0) || b.is(1.0) ? a : Traced(Operation::divide, a, b, a.ahead_ / b.ahead_);
  }

  friend bool operator<(const Traced& a, const Traced& b) { return side(a, b) < 0; }
  friend bool operator>(const Traced& a, const Traced& b) { return side(a, b) > 0; }
  friend bool operator<=(const Traced& a, const Traced& b) { return side(a, b) <= 0; }
  friend bool operator>=(const Traced& a, const Traced& b) { return side(a, b) >= 0; }

  friend Traced sin(const Traced& x) { return Traced(Operation::sine, x, sin(x.ahead_)); }
  friend Traced cos(const Traced& x) { return Traced(Operation::cosine, x, cos(x.ahead_)); }
  friend Traced exp(const Traced& x) {
    return Traced(Operation::exponential, x, composed(x, [](double u, int) { return std::exp(u); }));
  }
  friend Traced sqrt(const Traced& x) { return Traced(Operation::square_root, x, composed(x, PowerRule{0.5})); }
  friend Traced pow(const Traced& x, double exponent) {
    return Traced(Operation::power, x, composed(x, PowerRule{exponent}), exponent);
  }
  friend Traced abs(const Traced& x) { return x < Traced(0.0) ? -x : x; }

 private:
  /// Differences that vanish within this time [s] are decided by their rate, as everywhere in the drive.
  static constexpr double instant = 1e-11;

  Traced(Operation operation, const Traced& a, const Traced& b, const Ahead& ahead)
      : ahead_(ahead), program_(a.program_ ? a.program_ : b.program_) {
    if (program_) result_ = program_->result(operation, a.result_in(*program_), b.result_in(*program_));
  }
  Traced(Operation operation, const Traced& a, const Ahead& ahead, double number = 0.0)
      : ahead_(ahead), program_(a.program_) {
    if (program_) result_ = program_->result(operation, a.result_, -1, number);
  }

  bool is(double constant) const { return !program_ && ahead_[0] == constant; }

  /// Sign of a - b just after now; the program holds while it stays.
  static int side(const Traced& a, const Traced& b) {
    const Traced difference = a - b;
    const int sign = sign_just_after(difference.ahead_, instant);
    if (difference.program_ && sign != 0) difference.program_->depends_on(difference.result_, sign);
    return sign;
  }

  /// Derivatives of u to a power.
  struct PowerRule {
    double exponent;
    double operator()(double u, int derivative) const {
      double factor = 1.0;
      for (int k = 0; k < derivative; ++k) factor *= exponent - k;
      return factor * std::pow(u, exponent - derivative);
    }
  };
  /// The series of f(x), from the derivatives of f.
  template <class F>
  static Ahead composed(const Traced& x, F&& f) {
    Ahead change = x.ahead_, power(1.0), sum(f(x.ahead_[0], 0));
    change[0] = 0.0;
    double factorial = 1.0;
    for (int k = 1; k <= 3; ++k) {
      power = power * change;
      factorial *= k;
      sum += Ahead(f(x.ahead_[0], k) / factorial) * power;
    }
    return sum;
  }

  Ahead ahead_{};
  TaylorProgram* program_ = nullptr;  ///< none: a constant
  int result_ = -1;
};

}  // namespace wormdrive
