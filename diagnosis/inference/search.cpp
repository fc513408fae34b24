#include "diagnosis/inference/search.hpp"

#include <optional>
#include <utility>

#include "diagnosis/fitting/gap_search.hpp"
#include "diagnosis/fitting/noise_sizes.hpp"
#include "diagnosis/fitting/prediction_error.hpp"
#include "diagnosis/rules/evidence.hpp"
#include "diagnosis/rules/noise.hpp"

namespace wormdrive {

Selection searched_causes(const Evaluation& evaluation, const std::vector<Candidate>& all, const Hypothesis& base,
                          double torque, const DiagnosisSettings& settings) {
  if (settings.progress) settings.progress("fitting what is stated");
  Start start = fitted_start(evaluation, all, base);
  std::optional<Start> plain;
  const auto start_plainly = [&]() -> Start& {
    if (!plain) plain = fitted_start(evaluation, all, without_noise_model(base));
    return *plain;
  };
  CauseSearch found(evaluation, all, settings.most_causes, settings.progress);
  const Start* other = hides_what_is_slow(start.base.noise_model) ? &start_plainly() : nullptr;
  found.select(std::move(start), other);
  CauseSearch second(evaluation, all, settings.most_causes, settings.progress);
  CauseSearch* better = &found;
  if (hides_what_is_slow(found.model().noise_model)) {
    second.select(std::move(start_plainly()), nullptr);
    const auto error = [&](auto& s) { return error_ahead(evaluation, s.model(), rules::reported_horizon); };
    if (error(second) < rules::clearly_better * error(found)) better = &second;
    if (better == &second && !second.has_causes() && !hides_what_is_slow(found.base().noise_model)) {
      found.drop_causes();  // without any, one that hides nothing knows the noise better than none
      better = &found;
    }
  }
  if (gap_of(better->model()) ||
      noise_sizes(evaluation, better->model()).torque <= torque_per_recorded(better->model()) * torque)
    better->try_pairs();
  return better->confirmed();
}

}  // namespace wormdrive
