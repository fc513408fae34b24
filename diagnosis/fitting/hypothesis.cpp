#include "diagnosis/fitting/hypothesis.hpp"

#include <algorithm>
#include <cmath>

#include "description/build.hpp"
#include "diagnosis/data/moved_load.hpp"
#include "diagnosis/rules/noise.hpp"

namespace wormdrive {

Hypothesis stated_hypothesis(const Effects<double>& effects, const std::vector<Coordinate>& stated) {
  Hypothesis h;
  h.drive.effects = effects;
  for (const Coordinate& c : stated)
    if (c.tolerance > 0.0) {
      h.free.push_back(c);
      h.values.push_back(c.centre);
    }
  return h;
}

RecordedDrive extended(const Hypothesis& h) {
  RecordedDrive drive = h.drive;
  apply(drive, h.free, h.values);
  return drive;
}

Hypothesis without_noise_model(Hypothesis h) {
  h.whitens = false;
  h.noise = {0.02, 0.0};
  return h;
}

double with_tolerances(double misfit, const Hypothesis& h) {
  for (std::size_t k = 0; k < h.free.size(); ++k)
    if (const Coordinate& c = h.free[k]; c.tolerance > 0.0)
      misfit += 0.5 * std::pow((h.values[k] - c.centre) / c.tolerance, 2);
  return misfit;
}

bool evaluate(const Evaluation& evaluation, Hypothesis& h) {
  constexpr double never = std::numeric_limits<double>::infinity();
  h.objective = h.bic = never;
  h.noise.period = evaluation.shortest_period();
  std::optional<std::vector<double>> e = evaluation.innovations(extended(h), h.noise);
  if (!e) return false;
  h.innovations = std::move(*e);
  h.noise_model = estimate_noise(evaluation.layout(), h.innovations, h.whitens);
  h.residuals = whitened(evaluation.layout(), h.innovations, h.noise_model);
  h.misfit = misfit(evaluation.layout(), h.residuals, h.noise_model);
  h.objective = with_tolerances(h.misfit.fitted, h);
  const auto unknown =
      std::count_if(h.free.begin(), h.free.end(), [](const Coordinate& c) { return !(c.tolerance > 0.0); });
  h.bic = 2.0 * h.objective +
          static_cast<double>(unknown) * std::log(static_cast<double>(evaluation.layout().fitted())) + h.choices;
  return std::isfinite(h.objective);
}

int index_of(const Hypothesis& h, const Coordinate& coordinate) {
  for (std::size_t k = 0; k < h.free.size(); ++k)
    if (h.free[k].is(coordinate)) return static_cast<int>(k);
  return -1;
}

int index_of(const Hypothesis& h, std::string_view effect, std::string_view field) {
  return index_of(h, Coordinate{.effect = effect, .field = field, .scale = 1.0, .low = 0.0, .high = 0.0});
}

void add_candidate(Hypothesis& h, const std::vector<Candidate>& all, std::size_t index, std::size_t start) {
  const Candidate& candidate = all[index];
  const bool is_far = start >= candidate.starts.size();
  CandidateStart from = candidate.starts[is_far ? 0 : start];
  if (is_far) from.values[0] = candidate.far[start - candidate.starts.size()];
  for (std::size_t k = 0; k < candidate.coordinates.size(); ++k) {
    const Coordinate& c = candidate.coordinates[k];
    const int known = index_of(h, c);
    if (known >= 0) {
      h.free[static_cast<std::size_t>(known)].tolerance = 0.0;
      if (is_far && k == 0) h.values[static_cast<std::size_t>(known)] = from.values[0];
    } else {
      h.free.push_back(c);
      h.free.back().tolerance = 0.0;
      h.values.push_back(from.values[k]);
    }
  }
  for (Coordinate& c : h.free)
    if (c.effect == candidate.frees) c.tolerance = 0.0;
  apply(h.drive, candidate.coordinates, from.values);  // so that what is chosen finds the effect on
  for (const FieldValue& f : from.chosen) set_field(h.drive, f);
  h.choices += candidate.choices;
  h.causes.push_back(index);
}

namespace {

std::vector<double> whitened_and_clipped(const Evaluation& evaluation, const Hypothesis& h,
                                         std::vector<double> change) {
  change = whitened(evaluation.layout(), change, h.noise_model);
  for (std::size_t k = 0; k < change.size(); ++k) {
    const double limit = rules::largest_change * h.noise_model.groups[evaluation.layout().group[k]].scale;
    change[k] = std::clamp(change[k], -limit, limit);
  }
  return change;
}

}  // namespace

std::vector<double> difference(const Evaluation& evaluation, const Hypothesis& h,
                               const std::vector<double>& innovations) {
  std::vector<double> change(innovations);
  for (std::size_t k = 0; k < change.size(); ++k) change[k] -= h.innovations[k];
  return whitened_and_clipped(evaluation, h, std::move(change));
}

std::vector<double> sensitivity(const Evaluation& evaluation, const Hypothesis& h, std::size_t k, double step) {
  Hypothesis moved{.drive = h.drive, .free = h.free, .values = h.values, .noise = h.noise};
  const Coordinate& c = h.free[k];
  for (const double turned : {step, -step}) {
    moved.values[k] = h.values[k] + turned * c.scale;
    if (moved.values[k] < c.low || moved.values[k] > c.high) continue;
    const auto e = evaluation.innovations(extended(moved), h.noise);
    if (!e) continue;
    std::vector<double> column = *e;
    for (std::size_t q = 0; q < column.size(); ++q) column[q] = (column[q] - h.innovations[q]) / turned;
    return whitened_and_clipped(evaluation, h, std::move(column));
  }
  return std::vector<double>(h.innovations.size(), 0.0);
}

double torque_per_recorded(const Hypothesis& h) {
  const RecordedDrive drive = extended(h);
  const auto& gain = std::get<std::optional<TorqueGain<double>>>(drive.effects.list);
  return gain ? 1.0 + gain->share : 1.0;
}

double inertia_on_worm(const Evaluation& evaluation, const Hypothesis& h, std::size_t recording) {
  const Scenario& scenario = evaluation.scenario();
  const LoadParameters& load = moved_load(scenario, evaluation.layout().recordings[recording].data);
  const auto drive = make_drive(scenario, sum_of(load), extended(h).effects, Signal{});
  return drive.mesh().Jw * drive.mesh().i + drive.mesh().C(0.0) * drive.Jg();
}

}  // namespace wormdrive
