#pragma once
#include <algorithm>
#include <string_view>

#include "diagnosis/diagnose.hpp"

namespace wormdrive::test {

/// What a diagnosis says of a cause; null where it does not name it.
inline const EstimatedEffect* cause(const Diagnosis& d, std::string_view effect) {
  const auto at = std::find_if(d.causes.begin(), d.causes.end(),
                               [&](const EstimatedEffect& named) { return named.effect == effect; });
  return at == d.causes.end() ? nullptr : &*at;
}
inline bool names(const Diagnosis& d, std::string_view effect) { return cause(d, effect) != nullptr; }

}  // namespace wormdrive::test
