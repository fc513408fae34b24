#include "diagnosis/verdict/learned_vibration.hpp"

#include <algorithm>
#include <utility>

#include "diagnosis/fitting/fit.hpp"
#include "diagnosis/fitting/prediction_error.hpp"
#include "diagnosis/rules/noise.hpp"
#include "diagnosis/rules/verdict.hpp"
#include "diagnosis/verdict/spectral_line.hpp"

namespace wormdrive {

namespace {

constexpr std::string_view effect = Vibration<double>::id;

/// A hypothesis with a vibration of a frequency, fitted: its amplitude and phase, then all three, where the noise
/// cannot take it for its own; then the noise that is left.
std::optional<Hypothesis> with_vibration(const Evaluation& evaluation, Hypothesis h, double frequency,
                                         const Magnitudes& sizes) {
  add_vibration(h, {0.0, 0.0, frequency}, sizes);
  const Coordinate last = h.free.back();
  h.free.pop_back();  // without an amplitude nothing depends on the frequency
  h.values.pop_back();
  set_field(h.drive, {effect, last.field, frequency});
  const bool whitens = h.whitens;
  const ProcessNoise found = h.noise;
  h = followed_slowly(evaluation, std::move(h));
  if (!evaluate(evaluation, h)) return std::nullopt;
  fit(evaluation, h, 2);
  h.free.push_back(last);
  h.values.push_back(frequency);
  fit(evaluation, h, 4);
  h.whitens = whitens;
  h.noise = found;
  if (!evaluate(evaluation, h)) return std::nullopt;
  restart_noise(evaluation, h);
  adjust_noise(evaluation, h, 3);
  fit(evaluation, h, 4);
  return h;
}

/// Whether the error ahead falls by more than is of no account and than by chance: against the model as it was, and
/// with the noise that is found beside the vibration, for another noise alone may predict better.
bool lowers_error(const Evaluation& evaluation, const Hypothesis& h, const Hypothesis& shaken) {
  Hypothesis alike = h;
  alike.noise = shaken.noise;
  const auto falls_from = [&](const Hypothesis& one) {
    return share_of_error(evaluation, one, shaken, rules::reported_horizon) >= rules::of_no_account;
  };
  return falls_from(h) && (!evaluate(evaluation, alike) || falls_from(alike));
}

}  // namespace

void add_vibration(Hypothesis& h, const LearnedVibration& v, const Magnitudes& sizes) {
  const double torque = rules::test_torque * sizes.torque;
  for (const auto& [form, value] :
       {std::pair{CoordinateForm::in_phase, v.in_phase}, std::pair{CoordinateForm::in_quadrature, v.in_quadrature}}) {
    h.free.push_back({.effect = effect,
                      .field = "amplitude",
                      .scale = torque,
                      .low = -sizes.largest_torque,
                      .high = sizes.largest_torque,
                      .form = form});
    h.values.push_back(value);
  }
  // within the longest recording a frequency is told from the next one by a turn
  const double step = 1.0 / sizes.duration;
  h.free.push_back({.effect = effect,
                    .field = "frequency",
                    .scale = step,
                    .low = std::max(0.5 * v.frequency, v.frequency - 2.0 * step),
                    .high = v.frequency + 2.0 * step});
  h.values.push_back(v.frequency);
}

std::optional<LearnedVibration> learned_vibration(const Evaluation& evaluation, Hypothesis& h,
                                                  const Magnitudes& sizes) {
  if (field_of(h.drive, effect, "amplitude").on) return std::nullopt;
  ScoreTest line;
  for (ScoreTest& one : spectral_lines(evaluation, h))
    if (one.what.evidence > line.what.evidence) line = std::move(one);
  if (line.what.evidence <= rules::left_line) return std::nullopt;
  std::optional<Hypothesis> best;
  for (const double lines : {-0.5, 0.0, 0.5}) {
    std::optional<Hypothesis> here = with_vibration(evaluation, h, line.what.frequency + lines / sizes.duration, sizes);
    if (here && here->objective < (best ? *best : h).objective) best = std::move(here);
  }
  if (!best || !lowers_error(evaluation, h, *best)) return std::nullopt;
  h = std::move(*best);
  const std::size_t n = h.values.size();
  return LearnedVibration{h.values[n - 3], h.values[n - 2], h.values[n - 1]};
}

}  // namespace wormdrive
