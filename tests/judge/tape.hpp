#pragma once
#include <array>
#include <vector>

#include "judge/real.hpp"

namespace judge {

/// An expression written down once, whose power series in time is worked out coefficient by coefficient.
template <class Real>
class Tape {
 public:
  static constexpr int order = Precision<Real>::order;
  using Series = std::array<Real, order + 1>;
  enum class Op { given, constant, sum, difference, product, quotient, shifted, scaled, sine, cosine, exponential };

  Tape() = default;
  Tape(const Tape&) = delete;  // its values point to it
  Tape& operator=(const Tape&) = delete;

  /// One value of the expression.
  struct Value {
    Tape* tape;
    int at;

    friend Value operator+(Value a, Value b) { return a.tape->add(Op::sum, a.at, b.at); }
    friend Value operator-(Value a, Value b) { return a.tape->add(Op::difference, a.at, b.at); }
    friend Value operator*(Value a, Value b) { return a.tape->add(Op::product, a.at, b.at); }
    friend Value operator/(Value a, Value b) { return a.tape->add(Op::quotient, a.at, b.at); }
    friend Value operator+(Value a, Real b) { return a.tape->add(Op::shifted, a.at, a.at, b); }
    friend Value operator-(Value a, Real b) { return a + -b; }
    friend Value operator*(Real b, Value a) { return a.tape->add(Op::scaled, a.at, a.at, b); }
    friend Value sin(Value x) { return {x.tape, x.tape->sine_and_cosine(x.at)}; }
    friend Value cos(Value x) { return {x.tape, x.tape->sine_and_cosine(x.at) + 1}; }
    friend Value exp(Value x) { return x.tape->add(Op::exponential, x.at, x.at); }
  };

  /// A value whose coefficients are set from outside.
  Value input() { return add(Op::given, 0, 0); }
  Value constant(Real value) { return add(Op::constant, 0, 0, value); }

  Series& operator[](Value v) { return series_[v.at]; }
  const Series& operator[](Value v) const { return series_[v.at]; }

  /// An exponential and what it is of: one of nothing may grow beyond everything else within a step.
  struct Exponential {
    Value value, of;
  };
  const std::vector<Exponential>& exponentials() const { return exponentials_; }

  /// Works out the k-th coefficient of everything but the inputs, out of those up to k.
  void expand(int k) {
    for (std::size_t at = 0; at < nodes_.size(); ++at)
      series_[at][k] = coefficient(nodes_[at], static_cast<int>(at), k);
  }

  /// A value made of others by an operation.
  Value add(Op op, int a, int b, Real constant = 0) {
    nodes_.push_back({op, a, b, constant});
    series_.push_back({});
    const Value made{this, static_cast<int>(nodes_.size()) - 1};
    if (op == Op::exponential) exponentials_.push_back({made, {this, a}});
    return made;
  }
  /// The sine of a value, followed by its cosine.
  int sine_and_cosine(int of) {
    const int sine = add(Op::sine, of, static_cast<int>(nodes_.size()) + 1).at;
    add(Op::cosine, of, sine);
    return sine;
  }

 private:
  struct Node {
    Op op;
    int a, b;
    Real constant;
  };

  Real coefficient(const Node& node, int at, int k) const {
    const Series &a = series_[node.a], &b = series_[node.b];
    Real sum = 0;
    switch (node.op) {
      case Op::given: return series_[at][k];
      case Op::constant: return k == 0 ? node.constant : Real(0);
      case Op::sum: return a[k] + b[k];
      case Op::difference: return a[k] - b[k];
      case Op::product:
        for (int j = 0; j <= k; ++j)
          if (a[j] != 0 && b[k - j] != 0) sum += a[j] * b[k - j];
        return sum;
      case Op::quotient:
        for (int j = 0; j < k; ++j)
          if (b[k - j] != 0) sum += series_[at][j] * b[k - j];
        return (a[k] - sum) / b[0];
      case Op::shifted: return k == 0 ? a[0] + node.constant : a[k];
      case Op::scaled: return node.constant * a[k];
      case Op::sine:
        if (k == 0) return sin(a[0]);
        return derived(a, b, k);
      case Op::cosine:
        if (k == 0) return cos(a[0]);
        return -derived(a, b, k);
      case Op::exponential:
        if (k == 0) return exp(a[0]);
        return derived(a, series_[at], k);
    }
    return sum;
  }
  /// The k-th coefficient of f(x), where f' is known to order k - 1.
  static Real derived(const Series& x, const Series& slope, int k) {
    Real sum = 0;
    for (int j = 1; j <= k; ++j)
      if (x[j] != 0) sum += j * x[j] * slope[k - j];
    return sum / k;
  }

  std::vector<Node> nodes_;
  std::vector<Series> series_;
  std::vector<Exponential> exponentials_;
};

}  // namespace judge
