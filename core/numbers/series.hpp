#pragma once
#include <array>
#include <cmath>
#include <concepts>

#include "core/numbers/portable.hpp"
#include "core/numbers/sine_cosine.hpp"

namespace wormdrive {

/// Truncated power series sum of c[k] s^k, k = 0..N, around the present moment: a scalar that carries the future.
///
/// The equations of core/ are instantiated with it unchanged to obtain derivatives along the motion.
template <class T, int N>
struct Series {
  std::array<T, N + 1> c{};

  Series() = default;
  /// A constant, or a number that a constant is made from: they mix freely, also where T carries derivatives.
  template <class Constant>
  requires std::constructible_from<T, Constant> Series(
      const Constant& constant) {  // NOLINT(google-explicit-constructor)
    c[0] = T(constant);
  }

  /// The series of the variable itself, value + s.
  static Series variable(T value) {
    Series x(value);
    if constexpr (N > 0) x.c[1] = T(1);
    return x;
  }

  T& operator[](int k) { return c[k]; }
  const T& operator[](int k) const { return c[k]; }

  Series& operator+=(const Series& b) {
    for (int k = 0; k <= N; ++k) c[k] += b.c[k];
    return *this;
  }
  Series& operator-=(const Series& b) {
    for (int k = 0; k <= N; ++k) c[k] -= b.c[k];
    return *this;
  }
  Series operator-() const {
    Series r;
    for (int k = 0; k <= N; ++k) r.c[k] = -c[k];
    return r;
  }
  friend Series operator+(Series a, const Series& b) { return a += b; }
  friend Series operator-(Series a, const Series& b) { return a -= b; }
  friend Series operator*(const Series& a, const Series& b) {
    Series r;
    for (int k = 0; k <= N; ++k)
      for (int j = 0; j <= k; ++j) r.c[k] += a.c[j] * b.c[k - j];
    return r;
  }
  friend Series operator/(const Series& a, const Series& b) {
    Series r;
    for (int k = 0; k <= N; ++k) {
      T rest = a.c[k];
      for (int j = 0; j < k; ++j) rest -= r.c[j] * b.c[k - j];
      r.c[k] = rest / b.c[0];
    }
    return r;
  }
  // A constant has one coefficient: the equations pay for a parameter what a parameter costs, not what a series does.
  template <class Constant>
  requires std::constructible_from<T, Constant>
  friend Series operator+(Series a, const Constant& b) {
    a.c[0] += T(b);
    return a;
  }
  template <class Constant>
  requires std::constructible_from<T, Constant>
  friend Series operator+(const Constant& a, Series b) {
    b.c[0] = T(a) + b.c[0];
    return b;
  }
  template <class Constant>
  requires std::constructible_from<T, Constant>
  friend Series operator-(Series a, const Constant& b) {
    a.c[0] -= T(b);
    return a;
  }
  template <class Constant>
  requires std::constructible_from<T, Constant>
  friend Series operator-(const Constant& a, const Series& b) {
    Series r = -b;
    r.c[0] = T(a) - b.c[0];
    return r;
  }
  template <class Constant>
  requires std::constructible_from<T, Constant>
  friend Series operator*(Series a, const Constant& b) {
    const T factor(b);
    for (T& c : a.c) c = c * factor;
    return a;
  }
  template <class Constant>
  requires std::constructible_from<T, Constant>
  friend Series operator*(const Constant& a, Series b) {
    const T factor(a);
    for (T& c : b.c) c = factor * c;
    return b;
  }
  template <class Constant>
  requires std::constructible_from<T, Constant>
  friend Series operator/(Series a, const Constant& b) {
    const T divisor(b);
    for (T& c : a.c) c = c / divisor;
    return a;
  }
  friend bool operator<=(const Series& a, const Series& b) { return a.c[0] <= b.c[0]; }
  friend bool operator<(const Series& a, const Series& b) { return a.c[0] < b.c[0]; }
  friend bool operator>=(const Series& a, const Series& b) { return b <= a; }
  friend bool operator>(const Series& a, const Series& b) { return b < a; }
};

/// The scalar of what does not change along the motion: the coefficient of a series, any other scalar itself.
template <class S>
struct ConstantOfScalar {
  using type = S;
};
template <class T, int N>
struct ConstantOfScalar<Series<T, N>> {
  using type = T;
};
template <class S>
using ConstantOf = typename ConstantOfScalar<S>::type;

/// x, but no less than a limit. Whoever looks beyond it sees a constant.
template <class S>
S at_least(const S& x, double least) {
  return x < S(least) ? S(least) : x;
}

/// Sine and cosine of one series, which need each other.
template <class T, int N>
struct SineCosine {
  Series<T, N> sine, cosine;

  explicit SineCosine(const Series<T, N>& x) {
    if constexpr (requires { sine_and_cosine(x[0]); }) {
      const auto start = sine_and_cosine(x[0]);
      sine[0] = start.sine;
      cosine[0] = start.cosine;
    } else {
      using std::cos, std::sin;  // Jets have their own
      sine[0] = sin(x[0]);
      cosine[0] = cos(x[0]);
    }
    std::array<T, N + 1> rate;  // k x[k]
    for (int k = 1; k <= N; ++k) {
      rate[k] = T(k) * x[k];
      for (int j = 1; j <= k; ++j) {
        sine[k] += rate[j] * cosine[k - j];
        cosine[k] -= rate[j] * sine[k - j];
      }
      sine[k] = sine[k] / T(k);
      cosine[k] = cosine[k] / T(k);
    }
  }
};

template <class T, int N>
Series<T, N> sin(const Series<T, N>& x) {
  return SineCosine<T, N>(x).sine;
}
template <class T, int N>
Series<T, N> cos(const Series<T, N>& x) {
  return SineCosine<T, N>(x).cosine;
}

/// From r' = x' r.
template <class T, int N>
Series<T, N> exp(const Series<T, N>& x) {
  using portable::exp;
  Series<T, N> r(exp(x[0]));
  for (int k = 1; k <= N; ++k) {
    for (int j = 1; j <= k; ++j) r[k] += T(j) * x[j] * r[k - j];
    r[k] = r[k] / T(k);
  }
  return r;
}

}  // namespace wormdrive
