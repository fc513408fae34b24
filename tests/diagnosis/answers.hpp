#pragma once
#include <algorithm>
#include <string_view>

#include "catch.hpp"
#include "diagnosis/diagnose.hpp"
#include "diagnosis/verdict/verdict.hpp"

namespace wormdrive::test {

/// What a diagnosis says of a cause; null where it does not name it.
inline const EstimatedEffect* cause(const Diagnosis& d, std::string_view effect) {
  const auto at = std::find_if(d.causes.begin(), d.causes.end(),
                               [&](const EstimatedEffect& named) { return named.effect == effect; });
  return at == d.causes.end() ? nullptr : &*at;
}
inline bool names(const Diagnosis& d, std::string_view effect) { return cause(d, effect) != nullptr; }

/// The error 0.25 s ahead, on data that nothing was fitted to.
inline const PredictionError& error_ahead(const Diagnosis& d) {
  const PredictionError* const error = reported_error(d);
  REQUIRE(error);
  REQUIRE(error->horizon == 0.25);
  return *error;
}

}  // namespace wormdrive::test
