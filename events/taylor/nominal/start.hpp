#pragma once
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "events/taylor/leave_rest.hpp"
#include "events/taylor/nominal/flow.hpp"

namespace wormdrive {

/// How many leading coefficients of a guard vanish within their rounding at the start of a segment where a formula
/// gives them, as most starts have it: told by the sizes of the terms alone: what decides is far above all that
/// rounding may be, and what does not is below the least that it is.
template <class System>
std::optional<std::size_t> vanishing_by_far(const System& system, const NominalFlow<System>& nominal,
                                            typename NominalFlow<System>::Motion& series,
                                            const typename System::Instant& now, int guard) {
  const auto terms = [&](int k) { return nominal.guard_terms(series, now.t, guard, k); };
  const auto value = terms(0), rate = terms(1);
  if (!value) return std::nullopt;
  const Polynomial c = series.guard(guard);
  const double resolution = time_resolution(now.t), far = 4.0;
  const double phase = system.fastest_input(now.t) * std::abs(now.t) + system.ripple() * std::abs(now.x[0]);
  // phases of inputs and angles are known to their own rounding only
  const double share = 1e-9 + 16.0 * std::numeric_limits<double>::epsilon() * phase;
  const double least = 16.0 * Rounded::unit;  // of what is not known: eight times two roundings, see blur()
  if (c[0] > share * value->most && c[0] > far * std::abs(c[1]) * resolution) return 0;
  if (std::abs(c[0]) > least * value->present + std::abs(c[1]) * resolution) return std::nullopt;
  double hidden = share * value->most / std::abs(c[1]) + resolution;  // how long [s] rounding hides the rise
  if (hidden < series.step && std::abs(c[1]) > far * (share * rate->most + std::abs(c[2]) * (hidden + resolution) +
                                                      std::abs(c[3]) * hidden * hidden))
    return 1;
  // from rest the rate is the value that starts
  if (guard != System::speed_guard || c[0] != 0.0 || std::abs(c[1]) > least * rate->present) return std::nullopt;
  const double bend = std::abs(c[2]);
  hidden = 2.0 * share * rate->most / bend + 4.0 * resolution;
  if (hidden >= series.step || !(bend > far * (share * terms(2)->most + std::abs(c[3]) * (hidden + 3.0 * resolution) +
                                               2.0 * std::abs(c[4]) * hidden * hidden)))
    return std::nullopt;
  stay(series, guard, 1);
  return 2;
}

}  // namespace wormdrive
