// FMI 3.0: the clock that ticks with the samples of the controller in a loop. A tick takes the sample; one that an
// importer passes over is taken by itself.
#include "bindings/fmi/component.hpp"
#include "bindings/fmi/fmi3.h"

using namespace wormdrive;

namespace {

/// Calls use(instance, k) for every clock that is asked for.
template <class Use>
fmi3Status for_each_clock(fmi3Instance c, const char* function, Phases allowed, const fmi3ValueReference r[],
                          size_t count, const void* values, Use&& use) {
  return static_cast<fmi3Status>(call(c, function, allowed, [&](FmuInstance& instance) {
    need_list(r, count, "the list of value references");
    need_list(values, count, "the list of values");
    for (size_t k = 0; k < count; ++k) instance.sample_clock(r[k]);
    for (size_t k = 0; k < count; ++k) use(instance, k);
  }));
}

constexpr Phases where_intervals_are_known = Phase::initialization | Phase::event;

}  // namespace

fmi3Status fmi3GetClock(fmi3Instance c, const fmi3ValueReference r[], size_t count, fmi3Clock values[]) {
  return for_each_clock(c, __func__, Phase::event, r, count, values,
                        [&](const FmuInstance& instance, size_t k) { values[k] = instance.takes_sample(); });
}
fmi3Status fmi3SetClock(fmi3Instance c, const fmi3ValueReference r[], size_t count, const fmi3Clock values[]) {
  return for_each_clock(c, __func__, Phase::event, r, count, values, [&](FmuInstance& instance, size_t k) {
    if (values[k])
      instance.take_sample(r[k]);
    else if (instance.takes_sample())
      throw std::invalid_argument("a clock cannot be deactivated");
  });
}
fmi3Status fmi3GetIntervalDecimal(fmi3Instance c, const fmi3ValueReference r[], size_t count, fmi3Float64 intervals[],
                                  fmi3IntervalQualifier qualifiers[]) {
  return for_each_clock(
      c, __func__, where_intervals_are_known, r, count, intervals, [&](const FmuInstance& instance, size_t k) {
        need(qualifiers, "the list of qualifiers");
        intervals[k] = instance.sample_clock(r[k]).period;
        qualifiers[k] = instance.phase() == Phase::initialization ? fmi3IntervalChanged : fmi3IntervalUnchanged;
      });
}
fmi3Status fmi3GetShiftDecimal(fmi3Instance c, const fmi3ValueReference r[], size_t count, fmi3Float64 shifts[]) {
  return for_each_clock(c, __func__, where_intervals_are_known, r, count, shifts,
                        [&](const FmuInstance& instance, size_t k) { shifts[k] = instance.sample_clock(r[k]).offset; });
}
