#include "diagnosis/report/units_on_axis.hpp"

#include "description/keys.hpp"

namespace wormdrive {

void put_units_on_axis(Diagnosis& d, Axis axis) {
  if (axis == Axis::rotary) return;
  const auto convert = [&](std::string_view field, Unit& unit) { unit = spellings(field, unit, axis).front().unit; };
  const auto convert_all = [&](EstimatedEffect& effect) {
    for (Estimate& e : effect.parameters) convert(e.field, e.unit);
  };
  for (EstimatedEffect& cause : d.causes) convert_all(cause);
  for (EstimatedEffect& moved : d.calibration) convert_all(moved);
  for (Estimate& e : d.uncertainty.numbers) convert(e.field, e.unit);
  for (RankedCandidate& candidate : d.ranking) convert_all(candidate.effect);
  for (Visibility& v : d.certificate) convert(v.field, v.unit);
  for (Remainder& r : d.remainders)
    if (const std::size_t at = r.axis.find("angle"); at != std::string::npos) r.axis.replace(at, 5, "position");
}

}  // namespace wormdrive
