#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>

#include "core/numbers/portable.hpp"
#include "core/numbers/sine_cosine.hpp"

namespace wormdrive {

/// To which order a series is known: as far as it has room, or where it is open so far only, which may change. A
/// constant is known to order 0 and has no further coefficients.
template <int N, bool open>
struct SeriesOrder {
  static constexpr int last = N;
  static constexpr void know(int /*order*/) {}
};
template <int N>
struct SeriesOrder<N, true> {
  int last = 0;
  void know(int order) { last = order; }
};

/// Truncated power series sum of c[k] s^k, k = 0..last, around the present moment: a scalar that carries the future.
/// Coefficients behind the last are zero.
///
/// The equations of core/ are instantiated with it unchanged to obtain derivatives along the motion.
template <class T, int N, bool open = false>
struct Series : SeriesOrder<N, open> {
  using SeriesOrder<N, open>::last, SeriesOrder<N, open>::know;
  std::array<T, N + 1> c{};

  Series() = default;
  /// A constant, or a number that a constant is made from: they mix freely, also where T carries derivatives.
  template <class Constant>
  requires std::constructible_from<T, Constant> Series(
      const Constant& constant) {  // NOLINT(google-explicit-constructor)
    c[0] = T(constant);
  }

  /// The series of the variable itself, value + s; an open one is known to an order.
  static Series variable(T value, int order = N) {
    Series x(value);
    if constexpr (N > 0) x.c[1] = T(1);
    x.know(order);
    return x;
  }
  /// The order, but none for which there is no room.
  static constexpr int within(int order) { return order < N ? order : N; }
  /// Makes it known to the next order.
  void append(int order, const T& coefficient) {
    c[order] = coefficient;
    know(order);
  }

  T& operator[](int k) { return c[k]; }
  const T& operator[](int k) const { return c[k]; }

  Series& operator+=(const Series& b) {
    know(std::max(last, b.last));
    for (int k = 0; k <= b.last; ++k) c[k] += b.c[k];
    return *this;
  }
  Series& operator-=(const Series& b) {
    know(std::max(last, b.last));
    for (int k = 0; k <= b.last; ++k) c[k] -= b.c[k];
    return *this;
  }
  /// f of every coefficient.
  template <class F>
  Series each(const F& f) const {
    Series r;
    r.know(last);
    for (int k = 0; k <= last; ++k) r.c[k] = f(c[k]);
    return r;
  }
  Series operator-() const {
    return each([](const T& x) { return -x; });
  }
  friend Series operator+(Series a, const Series& b) { return a += b; }
  friend Series operator-(Series a, const Series& b) { return a -= b; }
  friend Series operator*(const Series& a, const Series& b) {
    Series r;
    r.know(std::max(a.last, b.last));
    for (int k = 0; k <= r.last; ++k)
      for (int j = 0; j <= k; ++j) r.c[k] += a.c[j] * b.c[k - j];
    return r;
  }
  friend Series operator/(const Series& a, const Series& b) {
    Series r;
    r.know(std::max(a.last, b.last));
    for (int k = 0; k <= r.last; ++k) {
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
  friend Series operator*(const Series& a, const Constant& b) {
    return a.each([factor = T(b)](const T& x) { return x * factor; });
  }
  template <class Constant>
  requires std::constructible_from<T, Constant>
  friend Series operator*(const Constant& a, const Series& b) {
    return b.each([factor = T(a)](const T& x) { return factor * x; });
  }
  template <class Constant>
  requires std::constructible_from<T, Constant>
  friend Series operator/(const Series& a, const Constant& b) {
    return a.each([divisor = T(b)](const T& x) { return x / divisor; });
  }
  friend bool operator<=(const Series& a, const Series& b) { return a.c[0] <= b.c[0]; }
  friend bool operator<(const Series& a, const Series& b) { return a.c[0] < b.c[0]; }
  friend bool operator>=(const Series& a, const Series& b) { return b <= a; }
  friend bool operator>(const Series& a, const Series& b) { return b < a; }
};

/// A series of whatever order, and the highest that it may have: one type where a number of orders is in use, for every
/// one more the equations would be compiled again.
inline constexpr int highest_series = 25;
template <class T>
using OpenSeries = Series<T, highest_series, true>;

/// The scalar of what does not change along the motion: the coefficient of a series, any other scalar itself.
template <class S>
struct ConstantOfScalar {
  using type = S;
};
template <class T, int N, bool open>
struct ConstantOfScalar<Series<T, N, open>> {
  using type = T;
};
template <class S>
using ConstantOf = typename ConstantOfScalar<S>::type;

/// Whether a coefficient decides nothing.
template <class T>
bool is_zero(const T& x) {
  return x == T(0.0);
}

/// Whether a quantity is positive, or at zero just about to be: on which side of a bend an equation goes on.
template <class S>
bool is_positive(const S& x) {
  return x > S(0.0);
}
template <class T, int N, bool open>
bool is_positive(const Series<T, N, open>& x) {
  for (int k = 0; k < x.last; ++k)
    if (!is_zero(x[k])) return x[k] > T(0.0);
  return x[x.last] > T(0.0);
}

/// x, but no less than a limit. Whoever looks beyond it sees a constant.
template <class S>
S at_least(const S& x, double least) {
  return x < S(least) ? S(least) : x;
}

/// x where that holds, else 0: equations that are recorded have the same operations on both sides.
template <class S>
S only_where(bool holds, const S& x) {
  return holds ? x : S(0.0);
}

/// Sine and cosine of one series, which need each other.
template <class T, int N, bool open>
struct SineCosine {
  Series<T, N, open> sine, cosine;

  explicit SineCosine(const Series<T, N, open>& x) {
    if constexpr (requires { sine_and_cosine(x[0]); }) {
      const auto start = sine_and_cosine(x[0]);
      sine[0] = start.sine;
      cosine[0] = start.cosine;
    } else {
      using std::cos, std::sin;  // Jets have their own
      sine[0] = sin(x[0]);
      cosine[0] = cos(x[0]);
    }
    sine.know(x.last);
    cosine.know(x.last);
    std::array<T, N + 1> rate;  // k x[k]
    for (int k = 1; k <= x.last; ++k) {
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

template <class T, int N, bool open>
Series<T, N, open> sin(const Series<T, N, open>& x) {
  return SineCosine<T, N, open>(x).sine;
}
template <class T, int N, bool open>
Series<T, N, open> cos(const Series<T, N, open>& x) {
  return SineCosine<T, N, open>(x).cosine;
}

/// From r r = x.
template <class T, int N, bool open>
Series<T, N, open> sqrt(const Series<T, N, open>& x) {
  using std::sqrt;  // Jets have their own
  Series<T, N, open> r(sqrt(x[0]));
  r.know(x.last);
  for (int k = 1; k <= x.last; ++k) {
    T rest = x[k];
    for (int j = 1; j < k; ++j) rest -= r[j] * r[k - j];
    r[k] = rest / (T(2) * r[0]);
  }
  return r;
}

/// From r' = x' r.
template <class T, int N, bool open>
Series<T, N, open> exp(const Series<T, N, open>& x) {
  using portable::exp;
  Series<T, N, open> r(exp(x[0]));
  r.know(x.last);
  for (int k = 1; k <= x.last; ++k) {
    for (int j = 1; j <= k; ++j) r[k] += T(j) * x[j] * r[k - j];
    r[k] = r[k] / T(k);
  }
  return r;
}

}  // namespace wormdrive
