#include "diagnosis/diagnose.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "description/build.hpp"
#include "description/keys.hpp"
#include "diagnosis/candidates/tolerances.hpp"
#include "diagnosis/experiment/next_step.hpp"
#include "diagnosis/fitting/fit.hpp"
#include "diagnosis/fitting/gap_search.hpp"
#include "diagnosis/fitting/noise_sizes.hpp"
#include "diagnosis/fitting/prediction_error.hpp"
#include "diagnosis/inference/alone.hpp"
#include "diagnosis/inference/intervals.hpp"
#include "diagnosis/inference/ranking.hpp"
#include "diagnosis/inference/resampled_draws.hpp"
#include "diagnosis/inference/search.hpp"
#include "diagnosis/inference/selection.hpp"
#include "diagnosis/report/units_on_axis.hpp"
#include "diagnosis/representative_pieces.hpp"
#include "diagnosis/rules/evidence.hpp"
#include "diagnosis/rules/noise.hpp"
#include "diagnosis/rules/recordings.hpp"
#include "diagnosis/rules/verdict.hpp"
#include "diagnosis/verdict/adequacy.hpp"
#include "diagnosis/verdict/certificate.hpp"
#include "diagnosis/verdict/extended_scenario.hpp"
#include "diagnosis/verdict/learned_terms.hpp"
#include "diagnosis/verdict/other_ratio.hpp"
#include "diagnosis/verdict/residual_torque.hpp"
#include "diagnosis/verdict/unclaimed_terms.hpp"
#include "diagnosis/verdict/verdict.hpp"

namespace wormdrive {

namespace {

/// Which blocks are held out, and every sum, hangs on the order of the recordings: it is that of what they hold, in
/// whatever order they are given.
std::vector<Recording> in_their_own_order(std::vector<Recording> recordings) {
  const auto content = [](const Recording& r) {
    return std::tie(r.period, r.start, r.motor_torque, r.gear_angle, r.worm_angle);
  };
  std::stable_sort(recordings.begin(), recordings.end(),
                   [&](const Recording& a, const Recording& b) { return content(a) < content(b); });
  return recordings;
}

std::vector<PreparedRecording> prepared_all(std::vector<Recording> recordings, const Scenario& scenario) {
  if (recordings.empty()) throw std::invalid_argument("a diagnosis needs a recording");
  std::vector<PreparedRecording> all;
  std::size_t blocks = 0;
  for (Recording& r : recordings) {
    if (r.samples() < rules::least_samples ||
        static_cast<double>(r.samples()) * r.period < rules::least_duration - 1e-9)
      throw std::invalid_argument(fmt::format("a diagnosis needs recordings of at least {} s and {} samples",
                                              rules::least_duration, rules::least_samples));
    const auto [low, high] = std::minmax_element(r.gear_angle.begin(), r.gear_angle.end());
    if (*low == *high) throw std::invalid_argument("nothing moves in the recording");
    all.push_back(prepared(std::move(r), blocks, stated_mesh(scenario).i));
    blocks += all.back().blocks();
  }
  return all;
}

InnovationLayout with_nothing_held_out(std::vector<PreparedRecording> all) {
  for (PreparedRecording& r : all) r = with_all_data(std::move(r));
  return InnovationLayout(std::move(all));
}

/// What the scenario states, with the noise that suits it.
Hypothesis as_stated(const Evaluation& evaluation, Hypothesis base) {
  for (std::size_t k = 0; k < base.free.size(); ++k) base.values[k] = base.free[k].centre;
  evaluate(evaluation, base);
  return base;
}

/// What may be missing in the drive, or wrong with its recordings.
std::vector<Candidate> everything(const Scenario& scenario, const std::vector<PreparedRecording>& recordings,
                                  const Magnitudes& sizes, const std::vector<Coordinate>& stated) {
  std::vector<Candidate> all = candidates(scenario.effects, sizes, stated);
  const bool spikes = std::any_of(recordings.begin(), recordings.end(),
                                  [](const PreparedRecording& r) { return !r.torque_spikes.empty(); });
  for (Candidate& fault : fault_candidates(sizes, spikes)) all.push_back(std::move(fault));
  return all;
}

/// A model with all its numbers found again, those of its noise first.
Hypothesis fitted_anew(const Evaluation& evaluation, Hypothesis h) {
  evaluate(evaluation, h);
  restart_noise(evaluation, h);
  adjust_noise(evaluation, h, 3);
  fit(evaluation, h, 12, 0.01);
  adjust_noise(evaluation, h, 2);
  refine_gap(evaluation, h);
  fit(evaluation, h, 6, 0.01);
  return h;
}

/// What is left without a cause, and any line, counts if the error ahead falls once its torque is added.
void keep_what_counts(Diagnosis& d, const Evaluation& evaluation, const Selection& found, const Magnitudes& sizes,
                      Axis axis) {
  std::vector<Remainder> kept, judged;
  for (const Remainder& r : d.remainders) (found.causes.empty() || r.frequency > 0.0 ? judged : kept).push_back(r);
  const std::vector<double> shares = shares_of_error(evaluation, found.model, sizes, judged);
  for (std::size_t k = 0; k < shares.size(); ++k) {
    const Remainder& r = judged[k];
    if (shares[k] >= rules::of_no_account)
      kept.push_back(r);
    else
      d.remarks.push_back(fmt::format(
          "{} is left, but with it the error {} s ahead falls by less than {:.0f} %, or no more than by chance",
          r.frequency > 0.0 ? r.axis : fmt::format("a {} over {}", in_words_of(axis, "torque"), r.axis),
          rules::reported_horizon, 100.0 * rules::of_no_account));
  }
  d.remainders = strongest_first(std::move(kept));
}

/// What a model predicts and leaves, against the scenario as it is stated.
void describe(Diagnosis& d, const Evaluation& evaluation, const Hypothesis& before, const Hypothesis& after) {
  d.prediction = prediction_errors(evaluation, before, after, d.seed);
  d.examples = prediction_examples(evaluation, before, after);
  d.residual = residual_torque(evaluation, before, after);
  d.noise_angle = noise_sizes(evaluation, after).angle;
  const PredictionError* e = reported_error(d);
  const bool is_overstated = e && e->after_high < e->floor;
  d.noise_torque = noise_sizes(evaluation, with_least_noise(evaluation, after, is_overstated)).torque;
}

/// The same with its numbers as they are: nothing that is added moves them.
Hypothesis settled(Hypothesis h) {
  h.drive = extended(h);
  h.free.clear();
  h.values.clear();
  return h;
}

}  // namespace

Diagnosis diagnose(const Scenario& scenario, const std::vector<Recording>& given, const DiagnosisSettings& settings) {
  if (const std::string why = why_not_diagnosed(scenario.effects); !why.empty()) throw std::invalid_argument(why);
  std::vector<Recording> recordings = in_their_own_order(given);
  const auto tell = [&](const std::string& what) {
    if (settings.progress) settings.progress(what);
  };
  const bool is_long = samples_of(recordings) > rules::most_searched;
  std::vector<Recording> to_search = is_long ? representative_pieces(recordings) : std::vector<Recording>{};
  std::vector<PreparedRecording> all_prepared = prepared_all(std::move(recordings), scenario);
  Magnitudes sizes = magnitudes(scenario, all_prepared);
  const std::vector<Coordinate> stated = toleranced_coordinates(scenario, sizes, settings.tolerances);
  const std::vector<Candidate> all = everything(scenario, all_prepared, sizes, stated);
  auto searched = is_long ? prepared_all(std::move(to_search), scenario) : all_prepared;
  const Evaluation evaluation(scenario, InnovationLayout(std::move(searched)), settings.threads);

  const Hypothesis base = stated_hypothesis(scenario.effects, stated);
  Selection found = searched_causes(evaluation, all, base, sizes.torque, settings);
  try_alone(evaluation, all, found);

  Diagnosis d;
  d.seed = settings.seed;
  tell("working out what the data can show");
  d.certificate = certificate(found.linear, found.base, all, sizes);
  d.ranking = ranking(evaluation, found, all);
  sizes.torque *= torque_per_recorded(found.model);  // what is left is a torque as the motor gave it

  tell("predicting ahead");
  const Hypothesis before = as_stated(evaluation, found.base);
  describe(d, evaluation, before, found.model);

  tell("fitting all data");
  const Evaluation by_all(scenario, with_nothing_held_out(std::move(all_prepared)), settings.threads);
  Hypothesis last = fitted_anew(by_all, found.model);
  const Eigen::MatrixXd spread = covariance(by_all, last, 2);
  d.uncertainty = joint_estimate(last, spread);
  if (settings.draws > 0) tell("resampling the data");
  d.uncertainty.draws = resampled_draws(by_all, last, spread, d.uncertainty, settings.draws, settings.seed);
  for (const Found& f : found.causes)
    d.causes.push_back(estimated(last, spread, all[f.candidate].effect, all[f.candidate].coordinates));
  const auto is_cause = [&](const Coordinate& c) {
    return std::any_of(found.causes.begin(), found.causes.end(),
                       [&](const Found& f) { return all[f.candidate].effect == c.effect; });
  };
  const auto is_freed = [&](const Coordinate& c) {
    return std::any_of(found.causes.begin(), found.causes.end(),
                       [&](const Found& f) { return all[f.candidate].frees == c.effect; });
  };
  const auto calibrate = [&](const Eigen::MatrixXd& errors) {
    d.calibration.clear();
    for (const Coordinate& c : last.free)
      if (c.tolerance > 0.0 || (is_freed(c) && !is_cause(c)))
        d.calibration.push_back(estimated(last, errors, c.effect, {c}));
    put_units_on_axis(d, scenario.axis);
  };

  tell("looking for what is left");
  const Evaluation pieces(scenario, with_nothing_held_out(evaluation.layout().recordings), settings.threads);
  d.remainders = remainders(by_all, last, pieces, sizes);
  keep_what_counts(d, evaluation, found, sizes, scenario.axis);
  if (const auto excess = error_above_noise(d)) d.remainders.push_back(*excess);
  d.extended = scenario;
  calibrate(spread);
  judge(d, found, all, sizes);

  const bool claimed = !d.causes.empty(), withdrawn = !claimed && !found.causes.empty();
  if (const auto alone = withdrawn ? better_alone(evaluation, found, all) : std::nullopt) {
    found = *alone;
    last = fitted_anew(by_all, found.model);
    calibrate(covariance(by_all, last, 2));
    describe(d, evaluation, before, found.model);
  }
  const bool may_learn = !d.remainders.empty() && !noise_dominated(d, sizes.torque);
  const auto learn = [&](const Hypothesis& beside) {
    if (may_learn) tell("learning what is left");
    return may_learn ? learned_terms(evaluation, beside, sizes) : std::nullopt;
  };
  std::optional<LearnedTerms> learned = learn(claimed ? settled(found.model) : found.base);
  const bool kept = withdrawn && unclaimed_terms_predict(d, evaluation, found, all, learned), stays = claimed || kept;
  if (withdrawn) d.uncertainty = {};
  if (kept) {
    d.sentence += unclaimed_terms_sentence(d, found, all);
    learned = learn(settled(found.model));
  } else if (withdrawn) {
    d.calibration.clear();
    last = found.base;
  }
  if (learned || (withdrawn && !kept)) describe(d, evaluation, before, learned ? learned->model : found.base);
  if (learned) {
    last = refined_terms(by_all, *learned, stays ? settled(last) : last, sizes);
    if (!stays) calibrate(covariance(by_all, last, 2));
    d.sentence += learned_sentence(*learned, scenario.axis);
  }
  if (stays || learned || (found.causes.empty() && calibration_matters(d))) {
    Effects<double> found_effects = extended(last).effects;
    for (const Found& f : found.causes)  // names that were withdrawn beside others
      if (claimed && !all[f.candidate].of_recording &&
          std::none_of(d.causes.begin(), d.causes.end(),
                       [&](const EstimatedEffect& cause) { return cause.effect == all[f.candidate].effect; }))
        withdraw(found_effects, scenario.effects, all[f.candidate]);
    d.extended = extended_scenario(scenario, found_effects, last.noise.impact, d.remarks);
  }
  propose_next_step(d, scenario, all, stated, sizes, by_all.layout().recordings, settings);
  if (auto remark = other_ratio(d, scenario, sizes.has_worm_encoder)) d.remarks.push_back(std::move(*remark));
  for (const PreparedRecording& r : evaluation.layout().recordings)
    if (!r.shares.empty())
      d.remarks.push_back(
          fmt::format("{}: readings that are closer than a step of the encoder, {:.2g} {}, count as one together",
                      r.data.name, r.data.gear_resolution, units_on(scenario.axis, "rad")));
  if (evaluation.layout().samples < by_all.layout().samples)
    d.remarks.push_back(
        fmt::format("causes were sought in {} of the {} samples, in pieces from all of the time; what was found is "
                    "fitted to all samples",
                    evaluation.layout().samples, by_all.layout().samples));
  for (const NotExamined& n : not_examined(scenario.effects, sizes))
    d.remarks.push_back(fmt::format("{} was not examined: {}", n.effect, n.reason));
  d.passes = evaluation.passes() + by_all.passes() + pieces.passes();
  return d;
}

}  // namespace wormdrive
