#pragma once
#include <cstddef>

#include "events/segment_start.hpp"
#include "events/taylor/leave_rest.hpp"
#include "events/taylor/nominal/start.hpp"

namespace wormdrive {

/// How many leading coefficients of a guard vanish within their rounding at the start of a segment, all where nothing
/// decides. A motion from rest goes on by what is left of it, see leave_rest().
template <class System, class Motion>
std::size_t vanishing_at_start(const System& system, const NominalFlow<System>& nominal, Motion& series,
                               const typename System::Instant& now, int guard) {
  if constexpr (NominalFlow<System>::known)
    if (const auto few = vanishing_by_far(system, nominal, series, now, guard)) return *few;
  const Polynomial c = series.guard(guard);
  const double resolution = time_resolution(now.t);
  if (const auto few = undecided_at_once(guard_series<1>(system, now)[guard], c[2], c[3], resolution)) return *few;
  constexpr int last = 4;
  const auto ahead = guard_series<last>(system, now)[guard];
  const int vanishing = undecided(ahead, resolution);
  if (guard == System::speed_guard && System::leaves_rest(now)) leave_rest(series, guard, ahead, vanishing, resolution);
  return vanishing > last ? c.size() : static_cast<std::size_t>(vanishing);
}

}  // namespace wormdrive
