#pragma once
#include <memory>
#include <optional>

#include "core/numbers/series.hpp"

namespace wormdrive {

/// A function of a number, seen through two pointers: one search serves every function.
template <class Value>
class FunctionView {
 public:
  template <class F>
  explicit FunctionView(const F& f)
      : object_(std::addressof(f)),
        call_([](const void* object, double at) -> Value { return (*static_cast<const F*>(object))(at); }) {}
  Value operator()(double at) const { return call_(object_, at); }

 private:
  const void* object_;
  Value (*call_)(const void*, double);
};

/// Root of f between a and b, where it has the values fa and fb of opposite sign or zero; the end behind the crossing.
double root_between(const FunctionView<double>& f, double a, double fa, double b, double fb);

/// The fall through zero in [a, b] that the values at both ends do not rule out; see falling_crossing.
std::optional<double> search_fall(const FunctionView<Series<double, 1>>& f, double a, const Series<double, 1>& left,
                                  double b, const Series<double, 1>& right);

/// Time in [a, b] at which a function of time falls through zero, also if it comes back within the step.
/// f(t) returns value and rate; left and right are f(a) and f(b); the function turns at most once in between.
template <class F>
std::optional<double> falling_crossing(const F& f, double a, const Series<double, 1>& left, double b,
                                       const Series<double, 1>& right) {
  if (!(right[0] < 0.0) && (left[1] >= 0.0 || right[1] <= 0.0)) return std::nullopt;
  return search_fall(FunctionView<Series<double, 1>>(f), a, left, b, right);
}

}  // namespace wormdrive
