#pragma once
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/numbers/cubic_table.hpp"
#include "core/numbers/series.hpp"

namespace wormdrive {

class Taped;

/// The operations of which equations consist, one after the other: what they do to numbers they do to power series,
/// coefficient by coefficient, and to discs of complex numbers around them. The equations are recorded once, with Taped
/// for a scalar; what they do with an effect that is off leaves no trace.
class Tape {
 public:
  enum class Operation {
    add,
    subtract,
    multiply,
    divide,
    affine,       ///< factor a + offset
    invert,       ///< factor / a
    sine_cosine,  ///< sine, and cosine in the place behind it
    exponential,
    square_root,
    table,  ///< in the place behind it the slope between the point where a cubic begins and a
  };
  struct Step {
    Operation operation;
    int a, b, result;
    double factor, offset;
    const CubicTable* table;
  };
  /// A place whose value the equations hold for only while it is above a least one.
  struct Condition {
    int place;
    double least;
  };

  /// Places of inputs come first.
  explicit Tape(int inputs) : places_(inputs) {}
  Tape(const Tape&) = delete;  // scalars point to it
  Tape& operator=(const Tape&) = delete;

  Taped input(int place);
  /// Where a result stands, a constant as well.
  int place(const Taped& result);

  const std::vector<Step>& steps() const { return steps_; }
  const std::vector<Condition>& conditions() const { return conditions_; }
  int places() const { return places_; }
  /// False where the equations compare what is not known beforehand.
  bool is_complete() const { return complete_; }

  // ---- while the equations are recorded --------------------------------------------------------------------------

  Taped record(Operation operation, int a, int b = 0, double factor = 0.0, double offset = 0.0,
               const CubicTable* table = nullptr);
  void hold(const Condition& condition) { conditions_.push_back(condition); }
  /// Of a comparison that cannot be recorded, an answer all the same.
  bool give_up() { return complete_ = false; }

 private:
  std::vector<Step> steps_;
  std::vector<Condition> conditions_;
  int places_;
  bool complete_ = true;
};

/// A number in equations that are recorded: a constant, or a factor times the result in a place, and a constant. Sums
/// and products with constants are recorded as one operation, and not before another operation asks for them.
class Taped {
 public:
  Taped() = default;
  Taped(double constant) : constant_(constant) {}  // NOLINT(google-explicit-constructor): a scalar

  Taped& operator+=(const Taped& b) { return *this = *this + b; }
  Taped& operator-=(const Taped& b) { return *this = *this - b; }
  Taped operator-() const { return -1.0 * *this; }
  friend Taped operator+(const Taped& a, const Taped& b) {
    if (!a.tape_ && !b.tape_) return a.constant_ + b.constant_;
    if (!a.tape_) return b + a;
    if (b.tape_) return a.tape_->record(Operation::add, a.place(), b.place());
    return b.constant_ == 0.0 ? a : Taped(a.tape_, a.place_, a.factor_, a.constant_ + b.constant_);
  }
  friend Taped operator-(const Taped& a, const Taped& b) {
    if (!b.tape_) return a + Taped(-b.constant_);
    return a.tape_ ? a.tape_->record(Operation::subtract, a.place(), b.place()) : -b + a;
  }
  friend Taped operator*(const Taped& a, const Taped& b) {
    if (!a.tape_ && !b.tape_) return a.constant_ * b.constant_;
    if (!a.tape_) return b * a;
    if (b.tape_) return a.tape_->record(Operation::multiply, a.place(), b.place());
    if (b.constant_ == 0.0) return 0.0;
    return {a.tape_, a.place_, a.factor_ * b.constant_, a.constant_ * b.constant_};
  }
  friend Taped operator/(const Taped& a, const Taped& b) {
    if (!b.tape_) return a.tape_ ? a * Taped(1.0 / b.constant_) : Taped(a.constant_ / b.constant_);
    if (!a.tape_) return b.tape_->record(Operation::invert, b.place(), 0, a.constant_);
    return a.tape_->record(Operation::divide, a.place(), b.place());
  }
  friend Taped sin(const Taped& x) {
    return x.tape_ ? x.tape_->record(Operation::sine_cosine, x.place()) : Taped(sine_and_cosine(x.constant_).sine);
  }
  friend Taped cos(const Taped& x) {
    if (!x.tape_) return sine_and_cosine(x.constant_).cosine;
    Taped cosine = sin(x);
    ++cosine.place_;
    return cosine;
  }
  friend Taped exp(const Taped& x) {
    return x.tape_ ? x.tape_->record(Operation::exponential, x.place()) : Taped(portable::exp(x.constant_));
  }
  friend Taped sqrt(const Taped& x) {
    return x.tape_ ? x.tape_->record(Operation::square_root, x.place()) : Taped(std::sqrt(x.constant_));
  }
  /// x, which stays above a limit.
  friend Taped at_least(const Taped& x, double least) {
    if (!x.tape_) return at_least(x.constant_, least);
    x.tape_->hold({x.place(), least});
    return x;
  }
  friend Taped look_up(const CubicTable& table, const Taped& x) {
    return x.tape_ ? x.tape_->record(Operation::table, x.place(), 0, 0.0, 0.0, &table) : Taped(table(x.constant_));
  }
  friend bool operator<(const Taped& a, const Taped& b) {
    for (const Taped* x : {&a, &b})
      if (x->tape_) return x->tape_->give_up();
    return a.constant_ < b.constant_;
  }
  friend bool operator>(const Taped& a, const Taped& b) { return b < a; }
  friend bool operator<=(const Taped& a, const Taped& b) {
    for (const Taped* x : {&a, &b})
      if (x->tape_) return x->tape_->give_up();
    return a.constant_ <= b.constant_;
  }
  friend bool operator>=(const Taped& a, const Taped& b) { return b <= a; }

 private:
  friend class Tape;
  using Operation = Tape::Operation;

  Taped(Tape* tape, int place) : tape_(tape), place_(place) {}
  Taped(Tape* tape, int place, double factor, double constant)
      : tape_(tape), place_(place), is_plain_(false), factor_(factor), constant_(constant) {}

  /// Where it stands; recorded even where it is the same, because in another mode it may be its negative.
  int place() const {
    return is_plain_ ? place_ : tape_->record(Operation::affine, place_, 0, factor_, constant_).place_;
  }

  Tape* tape_ = nullptr;  ///< none: a constant
  int place_ = 0;
  bool is_plain_ = true;
  double factor_ = 1.0, constant_ = 0.0;
};

template <>
struct ConstantOfScalar<Taped> {
  using type = double;
};

inline Taped Tape::input(int place) { return {this, place}; }

inline int Tape::place(const Taped& result) {
  return result.tape_ ? result.place() : record(Operation::affine, 0, 0, 0.0, result.constant_).place_;
}

/// What has been worked out before is not worked out again.
inline Taped Tape::record(Operation operation, int a, int b, double factor, double offset, const CubicTable* table) {
  for (const Step& s : steps_)
    if (s.operation == operation && s.a == a && s.b == b && s.factor == factor && s.offset == offset &&
        s.table == table)
      return {this, s.result};
  const bool two = operation == Operation::sine_cosine || operation == Operation::table;
  steps_.push_back({operation, a, b, places_, factor, offset, table});
  places_ += two ? 2 : 1;
  return {this, steps_.back().result};
}

}  // namespace wormdrive
