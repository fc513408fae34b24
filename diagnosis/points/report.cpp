#include "diagnosis/points/report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "description/keys.hpp"
#include "diagnosis/fitting/signature.hpp"
#include "diagnosis/rules/evidence.hpp"
#include "diagnosis/rules/points.hpp"
#include "diagnosis/rules/verdict.hpp"
#include "diagnosis/verdict/verdict.hpp"
#include "statistics/student_t.hpp"

namespace wormdrive {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Squared size of a signature, in units of the noise, that a selection names: its threshold of BIC and ln N of a
/// parameter.
double needed(std::size_t data) { return rules::points::least_bic + std::log(static_cast<double>(data)); }

/// Slopes of one candidate's coordinates at a model, in units of the noise per scale.
std::vector<std::vector<double>> signatures(const PointFitter& fitter, const PointModel& model,
                                            const std::vector<double>& values, double scale) {
  std::vector<std::vector<double>> columns = fitter.slopes(model, values);
  for (std::vector<double>& column : columns)
    for (std::size_t k = 0; k < column.size(); ++k)
      column[k] *= std::sqrt(StudentT{}.information()) / (scale * fitter.points().deviation[k]);
  return columns;
}

/// Signature of a candidate's size beside a model, as its first start has it if the model does not hold it.
std::vector<double> signature(const PointFitter& fitter, const PointCandidate& candidate, const FittedModel& model) {
  PointModel alone;
  alone.coordinates = model.model.coordinates;
  std::vector<double> values = model.all.values;
  for (std::size_t k = 0; k < candidate.coordinates.size(); ++k) {
    if (std::any_of(alone.coordinates.begin(), alone.coordinates.end(),
                    [&](const Coordinate& c) { return c.is(candidate.coordinates[k]); }))
      continue;
    alone.coordinates.push_back(candidate.coordinates[k]);
    values.push_back(candidate.starts.front()[k]);
  }
  const std::vector<std::vector<double>> all = signatures(fitter, alone, values, model.all.scale);
  for (std::size_t k = 0; k < all.size(); ++k)
    if (alone.coordinates[k].is(candidate.coordinates.front())) return all[k];
  return {};
}

}  // namespace

double stated_ratio(const Scenario& scenario) {
  const auto* const mesh = std::get_if<MeshParameters<double>>(&scenario.mesh);
  return mesh ? mesh->i : 1.0;
}

std::vector<Visibility> point_certificate(const PointFitter& fitter, const std::vector<PointCandidate>& candidates,
                                          const FittedModel& model) {
  const double limit = needed(fitter.points().size());
  std::vector<std::vector<double>> all;
  for (const PointCandidate& candidate : candidates) all.push_back(signature(fitter, candidate, model));
  std::vector<Visibility> list;
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    const Coordinate& size = candidates[k].coordinates.front();
    Visibility seen;
    seen.effect = size.effect;
    seen.field = size.field;
    seen.unit = field_of({}, size.effect, size.field).unit;
    std::vector<std::vector<double>> stated;
    std::vector<double> tolerances;
    for (std::size_t other = 0; other < candidates.size(); ++other) {
      if (other == k || !candidates[other].tolerated) continue;
      stated.push_back(all[other]);
      tolerances.push_back(candidates[other].coordinates.front().tolerance /
                           candidates[other].coordinates.front().scale);
    }
    const double left = distinct(all[k], stated, tolerances), whole = distinct(all[k], {}, {});
    seen.observable = whole > 0.0;
    seen.detectable = left > 0.0 ? size.scale * std::sqrt(limit / left) : infinity;
    double nearest = infinity;
    for (std::size_t other = 0; other < candidates.size() && seen.observable; ++other) {
      if (other == k) continue;
      std::vector<std::vector<double>> with = stated;
      std::vector<double> free = tolerances;
      with.push_back(all[other]);
      free.push_back(0.0);
      const double rest = distinct(all[k], with, free);
      if (rest >= nearest) continue;
      nearest = rest;
      seen.nearest = candidates[other].effect;
    }
    seen.likeness = left > 0.0 ? 1.0 - nearest / left : 1.0;
    seen.nameable = nearest > 1e-9 * left ? size.scale * std::sqrt(limit / nearest) : infinity;
    if (candidates[k].tolerated) seen.nameable = std::max(seen.nameable, rules::least_tolerances * size.tolerance);
    list.push_back(std::move(seen));
  }
  Effects<double>{}.for_each([&]<class Effect>(const std::optional<Effect>&) {
    if (std::any_of(list.begin(), list.end(), [](const Visibility& v) { return v.effect == Effect::id; })) return;
    constexpr auto first = std::get<0>(Effect::fields());
    Visibility never;
    never.effect = Effect::id;
    never.field = first.name;
    never.unit = first.unit;
    never.detectable = never.nameable = infinity;
    never.observable = false;
    list.push_back(never);
  });
  return list;
}

std::vector<Remainder> point_remainders(const TorquePoints& points, const std::vector<double>& errors) {
  const bool moving =
      std::any_of(points.worm_speed.begin(), points.worm_speed.end(), [](double w) { return w != 0.0; });
  const std::vector<double>& axis = moving ? points.worm_speed : points.load_torque;
  std::vector<std::size_t> order(errors.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return points.direction[a] != points.direction[b] ? points.direction[a] < points.direction[b] : axis[a] < axis[b];
  });
  double products = 0.0, squares = 0.0, pairs = 0.0;
  for (std::size_t k = 0; k + 1 < order.size(); ++k) {
    const std::size_t a = order[k], b = order[k + 1];
    squares += std::pow(errors[a] / points.deviation[a], 2);
    if (points.direction[a] != points.direction[b]) continue;
    products += errors[a] / points.deviation[a] * errors[b] / points.deviation[b];
    pairs += 1.0;
  }
  squares += std::pow(errors[order.back()] / points.deviation[order.back()], 2);
  if (squares <= 0.0 || pairs <= 0.0) return {};
  const double correlation = products / pairs / (squares / static_cast<double>(errors.size()));
  const double evidence = correlation * std::sqrt(pairs);
  if (evidence < rules::points::left_evidence) return {};
  double sum = 0.0;
  for (const double e : errors) sum += e * e;
  const double share = std::min(1.0, correlation);
  return {{moving ? "speed" : "load", evidence, std::sqrt(share * sum / static_cast<double>(errors.size())),
           -0.5 * pairs * std::log1p(-std::min(0.999, share * share))}};
}

void judge_points(Diagnosis& d, const PointSelection& selection, const std::vector<PointCandidate>& candidates) {
  for (const std::vector<std::size_t>& members : selection.classes) {
    d.classes.emplace_back();
    for (const std::size_t k : members) d.classes.back().emplace_back(candidates[k].effect);
  }
  const PredictionError& error = d.prediction.front();
  const std::string gain =
      fmt::format(" The error of {}s that a fit has not seen falls from {:.3g} to {:.3g} m{}.",
                  in_words_of(d.extended.axis, "torque"), 1e3 * error.before, 1e3 * error.after, error.unit.symbol);
  const std::string left = d.remainders.empty() ? ""
                                                : fmt::format(" {:.2g} m{} rms over the {} remain unexplained.",
                                                              1e3 * d.remainders.front().torque, error.unit.symbol,
                                                              d.remainders.front().axis);
  if (d.causes.empty()) {
    d.verdict = d.remainders.empty() ? Verdict::adequate : Verdict::unexplained;
    d.sentence = d.remainders.empty() ? "The simulation contains every effect that these data show."
                                      : "The simulation lacks something that no effect of the catalogue explains.";
    d.sentence += left;
    return;
  }
  if (!d.remainders.empty() && error.before < rules::most_of_the_error * error.after) {
    d.verdict = Verdict::unexplained;
    d.sentence = "The simulation lacks something that no effect of the catalogue explains." + left;
    for (RankedCandidate& c : d.ranking)
      if (std::exchange(c.named, false)) c.outcome = "leaves structure behind";
    d.causes.clear();
    d.classes.clear();
    return;
  }
  const auto causes_in = [&](const std::vector<std::string>& members) {
    return std::count_if(d.causes.begin(), d.causes.end(), [&](const EstimatedEffect& cause) {
      return std::find(members.begin(), members.end(), cause.effect) != members.end();
    });
  };
  std::vector<std::string> names;
  for (const EstimatedEffect& cause : d.causes)
    if (const auto* members = class_of(d, cause.effect); !members || causes_in(*members) == 1)
      names.push_back(phrase(cause, d.extended.axis));
  d.verdict = d.classes.empty() ? Verdict::named : Verdict::ambiguous;
  if (!names.empty()) d.sentence = fmt::format("The simulation lacks {}.", fmt::join(names, " and "));
  for (const std::vector<std::string>& members : d.classes)
    if (causes_in(members) == 1)
      d.sentence += fmt::format(" These data cannot tell {} from {}.", members.front(),
                                fmt::join(members.begin() + 1, members.end(), " or "));
    else
      d.sentence += fmt::format("{}ome of {} are at work; these data cannot tell which.",
                                d.sentence.empty() ? "S" : " In addition, s", fmt::join(members, ", "));
  d.sentence += gain + left;
}

void propose_other_load(Diagnosis& d, const Scenario& scenario, const TorquePoints& more,
                        const std::vector<PointCandidate>& candidates, const PointSelection& selection) {
  const PointFitter fitter(scenario, more);
  const double before = std::accumulate(
      d.certificate.begin(), d.certificate.end(), 0.0,
      [&](double worst, const auto& v) { return class_of(d, v.effect) ? std::max(worst, v.likeness) : worst; });
  double after = 0.0;
  for (const Visibility& v : point_certificate(fitter, candidates, selection.after))
    if (class_of(d, v.effect) && v.observable) after = std::max(after, v.likeness);
  d.experiment = d.extended;
  d.experiment->load = Signal{{Constant{more.load_torque.back()}}};
  d.experiment->title = scenario.title + ", another load to tell effects apart";
  d.experiment_reason = fmt::format(
      "Record the same points under a load of {:.3g} {} as well, and diagnose both together: friction of the teeth "
      "grows with the load, bearing friction does not (the likest two of the class share {:.1f} % of their signature "
      "now, {:.1f} % then).",
      more.load_torque.back(), d.prediction.front().unit.symbol, 100.0 * before, 100.0 * after);
}

}  // namespace wormdrive
