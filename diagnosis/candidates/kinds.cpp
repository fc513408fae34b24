#include "diagnosis/candidates/kinds.hpp"

#include <algorithm>

#include "diagnosis/predictor/filtered_states.hpp"
#include "diagnosis/rules/noise.hpp"

namespace wormdrive {

Coordinate plain_coordinate(std::string_view effect, std::string_view field, double scale, double low, double high) {
  return {.effect = effect, .field = field, .scale = scale, .low = low, .high = high, .none_at_low = low == 0.0};
}

Candidate linear(std::string_view effect, std::string_view field, double scale, double low, double high) {
  Candidate s;
  s.effect = effect;
  s.coordinates = {plain_coordinate(effect, field, scale, low, high)};
  s.starts = {{{0.0}, {}}};
  return s;
}

Candidate finite(std::string_view effect, std::string_view field, double scale, double low, double high,
                 const std::vector<double>& starts) {
  Candidate s = linear(effect, field, scale, low, high);
  s.finite = true;
  s.starts.clear();
  for (const double x : starts) s.starts.push_back({{x}, {}});
  return s;
}

Candidate late(std::string_view effect, std::string_view field, double period, double least) {
  // What moves the teeth is slower than this, whatever the rate: a shift far below it shows as one of no size.
  constexpr double mechanical = 3e-3;  // [s]
  std::vector<double> starts{0.5 * period, 3.0 * period};
  if (starts.back() < mechanical) starts.push_back(2.0 * mechanical);
  Candidate s = finite(effect, field, period, least, std::max(30.0 * period, rules::remembered_time), starts);
  s.coordinates[0].model_error = {.of_scale = 0.0, .size = 1.5e-5};
  s.coordinates[0].none_at_low = true;
  return s;
}

}  // namespace wormdrive
