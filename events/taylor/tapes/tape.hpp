#pragma once
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/numbers/cubic_table.hpp"
#include "core/numbers/series.hpp"

namespace wormdrive {

class Taped;

/// The operations of which equations consist, one after the other: what they do to numbers they do to power series,
/// coefficient by coefficient, and to discs of complex numbers around them. The equations are recorded with Taped for a
/// scalar; what they do with an effect that is off leaves no trace. Where the inputs have values, comparisons are
/// decided by them.
class Tape {
 public:
  enum class Operation {
    combine,  ///< factor a + second b + offset
    multiply,
    divide,
    affine,       ///< factor a + offset
    invert,       ///< factor / a
    sine_cosine,  ///< sine, cosine in the place behind it, and behind that the slope of a
    exponential,  ///< in the place behind it the slope of a
    square_root,
    table,  ///< in the place behind it the slope between the point where a cubic begins and a
  };
  struct Step {
    Operation operation;
    int a, b, result;
    double factor, offset, second;
    const CubicTable* table;
  };
  /// A comparison: the equations hold while what stands in a place is on the side of a value on which it was, above
  /// (1) or below (-1); 0 for a tie.
  struct Decision {
    int place;
    double value, side;
  };
  /// A factor times what stands in a place, and a constant.
  struct Multiple {
    int place;
    double factor, constant;
  };
  /// Places of inputs come first.
  explicit Tape(int inputs) { clear(inputs); }
  Tape(const Tape&) = delete;  // scalars point to it
  Tape& operator=(const Tape&) = delete;
  /// Begins anew.
  void clear(int inputs);

  Taped input(int place, double value);
  /// Where a result stands, a constant as well.
  int place(const Taped& result);
  /// The same without a place of its own.
  static Multiple multiple(const Taped& result);

  const std::vector<Step>& steps() const { return steps_; }
  /// Places of the arguments of tables and of exponentials.
  const std::vector<int>& arguments() const { return arguments_; }
  const std::vector<int>& exponents() const { return exponents_; }
  const std::vector<Decision>& decisions() const { return decisions_; }
  int places() const { return places_; }
  /// False where something that is compared is a tie, so that it takes the series itself to decide it.
  bool is_complete() const { return complete_; }

  // ---- while the equations are recorded --------------------------------------------------------------------------

  Taped record(Operation operation, double value, int a, int b = 0, double factor = 0.0, double offset = 0.0,
               double second = 0.0, const CubicTable* table = nullptr);
  /// Notes that the equations hold while a difference has its sign.
  void decide_by(const Taped& difference);
  /// Of a comparison that cannot be recorded, an answer all the same.
  bool give_up() { return complete_ = false; }

 private:
  static std::size_t hash(const Step& s);

  std::vector<Step> steps_;
  std::vector<Decision> decisions_;
  std::vector<int> arguments_, exponents_;
  std::array<std::uint16_t, 1024> found_;  ///< by their hashes, numbers of steps from 1 on
  int places_;
  bool complete_;
};

/// A number in equations that are recorded: a constant, or a factor times the result in a place, and a constant. Sums
/// of two such numbers are one operation, and those and products with constants are not recorded before another
/// operation asks for them.
class Taped {
 public:
  Taped() = default;
  Taped(double constant) : constant_(constant), value_(constant) {}  // NOLINT(google-explicit-constructor): a scalar

  Taped& operator+=(const Taped& b) { return *this = *this + b; }
  Taped& operator-=(const Taped& b) { return *this = *this - b; }
  Taped operator-() const { return -1.0 * *this; }
  friend Taped operator+(const Taped& a, const Taped& b) {
    if (!a.tape_ && !b.tape_) return a.constant_ + b.constant_;
    if (!a.tape_) return b + a;
    if (b.tape_)
      return a.tape_->record(Operation::combine, a.value_ + b.value_, a.place_, b.place_, a.factor_,
                             a.constant_ + b.constant_, b.factor_);
    if (b.constant_ == 0.0) return a;
    return {a.tape_, a.place_, a.factor_, a.constant_ + b.constant_, a.value_ + b.constant_};
  }
  friend Taped operator-(const Taped& a, const Taped& b) {
    if (!b.tape_) return a + Taped(-b.constant_);
    return a + -b;
  }
  friend Taped operator*(const Taped& a, const Taped& b) {
    if (!a.tape_ && !b.tape_) return a.constant_ * b.constant_;
    if (!a.tape_) return b * a;
    if (b.tape_) {
      const Taped x = a.without_factor(), y = b.without_factor();
      const Taped product = a.tape_->record(Operation::multiply, x.value_ * y.value_, x.place(), y.place());
      return a.is_multiple() || b.is_multiple() ? a.outer_factor() * b.outer_factor() * product : product;
    }
    if (b.constant_ == 0.0) return 0.0;
    return {a.tape_, a.place_, a.factor_ * b.constant_, a.constant_ * b.constant_, a.value_ * b.constant_};
  }
  friend Taped operator/(const Taped& a, const Taped& b) {
    if (!b.tape_) return a.tape_ ? a * Taped(1.0 / b.constant_) : Taped(a.constant_ / b.constant_);
    const Taped y = b.without_factor();
    if (!a.tape_) {
      const double dividend = a.constant_ / b.outer_factor();
      return b.tape_->record(Operation::invert, dividend / y.value_, y.place(), 0, dividend);
    }
    const Taped x = a.without_factor();
    const Taped quotient = a.tape_->record(Operation::divide, x.value_ / y.value_, x.place(), y.place());
    return a.is_multiple() || b.is_multiple() ? a.outer_factor() / b.outer_factor() * quotient : quotient;
  }
  friend Taped sin(const Taped& x) { return sine_then_cosine(x)[0]; }
  friend Taped cos(const Taped& x) { return sine_then_cosine(x)[1]; }
  friend Taped exp(const Taped& x) {
    const double y = portable::exp(x.value_);
    return x.tape_ ? x.tape_->record(Operation::exponential, y, x.place()) : Taped(y);
  }
  friend Taped sqrt(const Taped& x) {
    const double y = std::sqrt(x.value_);
    return x.tape_ ? x.tape_->record(Operation::square_root, y, x.place()) : Taped(y);
  }
  friend Taped look_up(const CubicTable& table, const Taped& x) {
    const double y = table(x.value_);
    return x.tape_ ? x.tape_->record(Operation::table, y, x.place(), 0, 0.0, 0.0, 0.0, &table) : Taped(y);
  }
  friend Taped only_where(bool holds, const Taped& x) {
    if (!x.tape_) return holds ? x : Taped(0.0);
    const double share = holds ? 1.0 : 0.0;
    return x.tape_->record(Operation::affine, share * x.value_, x.place_, 0, share * x.factor_, share * x.constant_);
  }
  friend bool operator<(const Taped& a, const Taped& b) { return decided(a, b, a.value_ < b.value_); }
  friend bool operator>(const Taped& a, const Taped& b) { return b < a; }
  friend bool operator<=(const Taped& a, const Taped& b) { return decided(a, b, a.value_ <= b.value_); }
  friend bool operator>=(const Taped& a, const Taped& b) { return b <= a; }
  /// At zero it takes the coefficients that follow to tell.
  friend bool is_positive(const Taped& x) { return x.tape_ && x.value_ == 0.0 ? x.tape_->give_up() : x > Taped(0.0); }

 private:
  friend class Tape;
  using Operation = Tape::Operation;

  Taped(Tape* tape, int place, double value) : tape_(tape), place_(place), value_(value) {}
  Taped(Tape* tape, int place, double factor, double constant, double value)
      : tape_(tape), place_(place), is_plain_(false), factor_(factor), constant_(constant), value_(value) {}

  /// Of a multiple, the factor, and what it is a multiple of: the signs of a mode do not get into products, where they
  /// would be operations that other modes do without.
  bool is_multiple() const { return !is_plain_ && constant_ == 0.0; }
  double outer_factor() const { return is_multiple() ? factor_ : 1.0; }
  Taped without_factor() const { return is_multiple() ? Taped(tape_, place_, value_ / factor_) : *this; }
  /// Where it stands; recorded even where it is the same, because in another mode it may be its negative.
  int place() const {
    return is_plain_ ? place_ : tape_->record(Operation::affine, value_, place_, 0, factor_, constant_).place_;
  }
  static std::array<Taped, 2> sine_then_cosine(const Taped& x) {
    const auto [sine, cosine] = sine_and_cosine(x.value_);
    if (!x.tape_) return {sine, cosine};
    const Taped first = x.tape_->record(Operation::sine_cosine, sine, x.place());
    return {first, Taped(x.tape_, first.place_ + 1, cosine)};
  }
  static bool decided(const Taped& a, const Taped& b, bool decision) {
    Tape* const tape = a.tape_ ? a.tape_ : b.tape_;
    if (!tape) return decision;
    tape->decide_by(a - b);
    return decision;
  }

  Tape* tape_ = nullptr;  ///< none: a constant
  int place_ = 0;
  bool is_plain_ = true;
  double factor_ = 1.0, constant_ = 0.0;
  double value_ = 0.0;
};

template <>
struct ConstantOfScalar<Taped> {
  using type = double;
};

inline void Tape::clear(int inputs) {
  steps_.clear();
  decisions_.clear();
  for (std::vector<int>* const places : {&arguments_, &exponents_}) places->clear();
  found_.fill(0);
  places_ = inputs;
  complete_ = true;
}

inline Taped Tape::input(int place, double value) { return {this, place, value}; }

inline int Tape::place(const Taped& result) {
  return result.tape_ ? result.place()
                      : record(Operation::affine, result.constant_, 0, 0, 0.0, result.constant_).place_;
}

inline Tape::Multiple Tape::multiple(const Taped& result) {
  return result.tape_ ? Multiple{result.place_, result.factor_, result.constant_} : Multiple{0, 0.0, result.constant_};
}

inline void Tape::decide_by(const Taped& difference) {
  if (!difference.tape_) return;
  const double value = difference.constant_ == 0.0 ? 0.0 : -difference.constant_ / difference.factor_;
  for (const Decision& known : decisions_)
    if (known.place == difference.place_ && known.value == value) return;
  const double sign = difference.value_ > 0.0 ? 1.0 : difference.value_ < 0.0 ? -1.0 : 0.0;
  decisions_.push_back({difference.place_, value, difference.factor_ < 0.0 ? -sign : sign});
}

inline std::size_t Tape::hash(const Step& s) {
  std::uint64_t sum = 0;
  for (const std::uint64_t part : {static_cast<std::uint64_t>(s.operation), static_cast<std::uint64_t>(s.a),
                                   static_cast<std::uint64_t>(s.b), std::bit_cast<std::uint64_t>(s.factor),
                                   std::bit_cast<std::uint64_t>(s.offset), std::bit_cast<std::uint64_t>(s.second)})
    sum = (sum ^ part) * 0x9e3779b97f4a7c15U;  // Fibonacci hashing: the high bits have seen all of it
  return sum >> 54U;
}

/// What has been worked out before is not worked out again.
inline Taped Tape::record(Operation operation, double value, int a, int b, double factor, double offset, double second,
                          const CubicTable* table) {
  const Step step{operation, a, b, places_, factor, offset, second, table};
  std::size_t at = hash(step);
  for (; found_[at] != 0; at = (at + 1) % found_.size()) {
    const Step& s = steps_[found_[at] - 1U];
    if (s.operation == operation && s.a == a && s.b == b && s.factor == factor && s.offset == offset &&
        s.second == second && s.table == table)
      return {this, s.result, value};
  }
  const int further = operation == Operation::sine_cosine                                    ? 2
                      : operation == Operation::exponential || operation == Operation::table ? 1
                                                                                             : 0;
  steps_.push_back(step);
  if (operation == Operation::table) arguments_.push_back(a);
  if (operation == Operation::exponential) exponents_.push_back(a);
  // what would leave no room to look is recorded again
  if (steps_.size() < found_.size() / 2) found_[at] = static_cast<std::uint16_t>(steps_.size());
  places_ += 1 + further;
  return {this, step.result, value};
}

}  // namespace wormdrive
