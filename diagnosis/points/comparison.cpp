#include "diagnosis/points/comparison.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "description/build.hpp"
#include "diagnosis/rules/evidence.hpp"
#include "diagnosis/rules/points.hpp"
#include "statistics/student_t.hpp"

namespace wormdrive {
namespace {

/// Values for a model out of those of another; where that has none, out of the candidate's start.
std::vector<double> carried(const PointModel& to, const FittedModel& from, const PointCandidate* candidate = nullptr,
                            const std::vector<double>* start = nullptr) {
  std::vector<double> made;
  for (const Coordinate& c : to.coordinates) {
    made.push_back(c.centre);
    for (std::size_t k = 0; k < from.model.coordinates.size(); ++k)
      if (from.model.coordinates[k].is(c)) made.back() = from.all.values[k];
    if (!candidate) continue;
    for (std::size_t k = 0; k < candidate->coordinates.size(); ++k)
      if (candidate->coordinates[k].is(c)) made.back() = (*start)[k];
  }
  return made;
}

}  // namespace

std::size_t PointComparison::index_of(std::string_view effect) const {
  const auto found =
      std::find_if(candidates_.begin(), candidates_.end(), [&](const auto& c) { return c.effect == effect; });
  return static_cast<std::size_t>(found - candidates_.begin());
}

FittedModel PointComparison::judged(const PointModel& model, PointFit all, double held_out) const {
  const auto free = std::count_if(model.coordinates.begin(), model.coordinates.end(),
                                  [](const Coordinate& c) { return c.tolerance == 0.0; });
  FittedModel made{model, std::move(all), 0.0, 0.0, held_out};
  made.bic = bic(made.all.nll, static_cast<double>(free), static_cast<double>(fitter_.points().size()));
  // a stated value that is known within a tolerance, yet far outside of it: what the tails of Cauchy's law make of it
  for (std::size_t k = 0; k < model.coordinates.size(); ++k) {
    const Coordinate& c = model.coordinates[k];
    if (!model.holds(c.effect) || !candidate(c.effect).tolerated) continue;
    const double z = (made.all.values[k] - c.centre) / candidate(c.effect).coordinates.front().tolerance;
    made.doubt += 2.0 * std::log1p(z * z);
  }
  return made;
}

std::optional<FittedModel> PointComparison::fitted(const PointModel& model,
                                                   const std::vector<std::vector<double>>& starts) const {
  const auto all = fitter_.fit(model, starts, Part::all);
  if (!all) return std::nullopt;
  const auto first = fitter_.fit(model, {all->values}, Part::first_half),
             second = fitter_.fit(model, {all->values}, Part::second_half);
  if (!first || !second) return std::nullopt;
  return judged(model, *all, fitter_.held_out(*first, Part::first_half) + fitter_.held_out(*second, Part::second_half));
}

PointModel PointComparison::wider(const FittedModel& model, const PointCandidate& candidate,
                                  std::vector<std::vector<double>>& starts) const {
  PointModel made = with_cause(model.model, candidate);
  for (const std::vector<double>& start : candidate.starts) starts.push_back(carried(made, model, &candidate, &start));
  std::vector<double> afresh = starts.front();  // out of the valley in which the smaller model lies
  for (std::size_t k = 0; k < afresh.size(); ++k)
    for (const PointCandidate& one : candidates_)
      for (std::size_t c = 0; c < one.coordinates.size(); ++c)
        if (made.holds(one.effect) && one.coordinates[c].is(made.coordinates[k]) && !one.tolerated)
          afresh[k] = one.starts.front()[c];
  starts.push_back(std::move(afresh));
  return made;
}

std::optional<FittedModel> PointComparison::glanced(const FittedModel& model, const PointCandidate& candidate) const {
  std::vector<std::vector<double>> starts;
  const PointModel made = wider(model, candidate, starts);
  const auto all = fitter_.fit(made, starts, Part::all, quick);
  if (!all) return std::nullopt;
  return judged(made, *all, 0.0);
}

std::optional<FittedModel> PointComparison::extended(const FittedModel& model, const PointCandidate& candidate) const {
  std::vector<std::vector<double>> starts;
  const PointModel made = wider(model, candidate, starts);
  return fitted(made, starts);
}

std::optional<FittedModel> PointComparison::reduced(const FittedModel& model, const PointCandidate& candidate) const {
  const PointModel narrower = without_cause(model.model, candidate);
  return fitted(narrower, {carried(narrower, model)});
}

std::optional<FittedModel> PointComparison::again(const FittedModel& model, const FittedModel& wider) const {
  return fitted(model.model, {carried(model.model, wider), model.all.values});
}

std::vector<Exchange> PointComparison::exchanges(const FittedModel& model) const {
  std::vector<Exchange> list;
  for (const std::string_view effect : model.model.causes) {
    const std::size_t dropped = index_of(effect);
    const auto without = reduced(model, candidates_[dropped]);
    if (!without) continue;
    for (std::size_t taken = 0; taken < candidates_.size(); ++taken) {
      const PointCandidate& other = candidates_[taken];
      if (model.model.holds(other.effect) || !fits_beside(other, without->model)) continue;
      auto instead = extended(*without, other);
      if (instead && instead->bic - model.bic <= rules::points::equally_good && doubt(*instead).empty())
        list.push_back({dropped, taken, std::move(*instead)});
    }
  }
  return list;
}

bool PointComparison::fits_beside(const PointCandidate& candidate, const PointModel& model) const {
  return !model.holds(candidate.effect) && (candidate.excludes.empty() || !model.holds(candidate.excludes));
}

std::string PointComparison::doubt(const FittedModel& model) const {
  const std::vector<double>& values = model.all.values;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const Coordinate& c = model.model.coordinates[k];
    if (!model.model.holds(c.effect)) continue;
    if (std::abs(values[k] - c.low) < rules::points::near_bound * c.scale ||
        std::abs(values[k] - c.high) < rules::points::near_bound * c.scale)
      return fmt::format("{} comes to lie at the bound of what it can be", c.effect);
    const PointCandidate& one = candidate(c.effect);
    if (!one.tolerated) continue;
    const double tolerances = std::abs(values[k] - c.centre) / one.coordinates.front().tolerance;
    if (tolerances < rules::least_tolerances)
      return fmt::format("within its tolerance: {:.1f} standard deviations from what is stated", tolerances);
  }
  if (const double most = friction(model).high;
      most > std::max(rules::highest_friction, friction(fitter_.scenario().effects).high))
    return fmt::format("the friction of the teeth would reach {:.2f}: no teeth rub so", most);
  return "";
}

FrictionRange PointComparison::friction(const Effects<double>& effects) const {
  const double mu = stated_mesh(fitter_.scenario()).mu;
  return effects.friction_range({mu, mu}, 0.0);
}

FrictionRange PointComparison::friction(const FittedModel& model) const {
  return friction(fitter_.with(model.model, model.all.values));
}

bool PointComparison::misshapen(const FittedModel& model) const {
  for (const std::string_view effect : model.model.causes) {
    const PointCandidate& one = candidate(effect);
    for (std::size_t k = 0; k < model.all.values.size() && one.falls; ++k)
      if (model.model.coordinates[k].is(one.coordinates.front()) && model.all.values[k] < 0.0) return true;
  }
  return friction(model).low < std::min(0.0, friction(fitter_.scenario().effects).low);
}

}  // namespace wormdrive
