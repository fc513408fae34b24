#include "diagnosis/changes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "description/keys.hpp"
#include "diagnosis/candidates/coordinates.hpp"
#include "diagnosis/inference/comparison.hpp"
#include "diagnosis/inference/intervals.hpp"
#include "diagnosis/rules/evidence.hpp"
#include "diagnosis/verdict/verdict.hpp"

namespace wormdrive {
namespace {

constexpr double unseen = std::numeric_limits<double>::infinity();

struct Number {
  std::string effect;
  Estimate estimate;
};

/// The numbers of the drive that were fitted to the data. Points tell them with the causes and the calibration.
std::vector<Number> fitted_numbers(const Diagnosis& d) {
  std::vector<Number> all;
  for (std::size_t k = 0; k < d.uncertainty.numbers.size(); ++k)
    all.push_back({d.uncertainty.effects[k], d.uncertainty.numbers[k]});
  if (all.empty())
    for (const std::vector<EstimatedEffect>* effects : {&d.causes, &d.calibration})
      for (const EstimatedEffect& e : *effects)
        for (const Estimate& parameter : e.parameters) all.push_back({e.effect, parameter});
  const auto is_one_of = [](const std::vector<EstimatedEffect>& effects, const Number& n) {
    return std::any_of(effects.begin(), effects.end(), [&](const auto& e) { return e.effect == n.effect; });
  };
  std::erase_if(all, [&](const Number& n) {  // a name that was withdrawn is in neither list
    return is_recording_fault(n.effect) || !(is_one_of(d.causes, n) || is_one_of(d.calibration, n));
  });
  return all;
}

/// A number by the earlier data. One that was not fitted is what the scenario states, or nothing; how well that is
/// known follows from the smallest size that would have shown.
Estimate earlier_estimate(const Diagnosis& earlier, const Scenario& fitted, const std::string& effect,
                          const Estimate& later) {
  for (const Number& n : fitted_numbers(earlier))
    if (n.effect == effect && n.estimate.field == later.field) return n.estimate;
  const FieldOfEffect stated = field_of(fitted.effects, effect, later.field);
  double error = unseen;
  for (const Visibility& v : earlier.certificate)
    if (v.effect == effect && v.field == later.field && v.observable) error = v.detectable / rules::least_tolerances;
  return estimate(later.field, later.unit, stated.on ? stated.value : 0.0, error);
}

Change change(const std::string& effect, const Estimate& before, const Estimate& after) {
  double difference = after.value - before.value;
  if (after.unit.suffix == unit::degrees.suffix) difference = std::remainder(difference, 2.0 * std::numbers::pi);
  const double error = std::hypot(before.standard_error, after.standard_error);
  return {effect, before, after, estimate(after.field, after.unit, difference, error),
          std::abs(difference) > rules::least_tolerances * error};
}

/// "worm viscous: coefficient 1e-05 -> 2.1e-05 N m s/rad (by 1.1e-05 +- 1e-06)"
std::string phrase(const Change& c, Axis axis) {
  const double si = c.after.unit.si;
  return fmt::format("{}: {} {:.4g} -> {:.4g}{} (by {:+.3g} +- {:.2g})", in_words(c.effect),
                     in_words_of(axis, in_words(c.after.field)), c.before.value / si, c.after.value / si,
                     c.after.unit.suffix.empty() ? "" : fmt::format(" {}", c.after.unit.symbol),
                     c.difference.value / si, c.difference.standard_error / si);
}

std::string sentence_of(const std::vector<Change>& all, const Diagnosis& later) {
  std::vector<std::string> certain, hidden;
  const auto is_size_of_a_cause = [&](const Change& c) {
    return std::any_of(later.causes.begin(), later.causes.end(), [&](const EstimatedEffect& cause) {
      return cause.effect == c.effect && cause.parameters.front().field == c.after.field;
    });
  };
  for (const Change& c : all) {
    if (c.certain) certain.push_back(phrase(c, later.extended.axis));
    if (c.before.standard_error == unseen && is_size_of_a_cause(c)) hidden.push_back(in_words(c.effect));
  }
  std::string text = certain.empty() ? "" : fmt::format("Changed: {}.", fmt::join(certain, "; "));
  if (later.verdict == Verdict::unexplained)
    text += std::string(text.empty() ? "" : " ") + "Something changed that no effect of the catalogue explains.";
  if (text.empty()) text = "Nothing that these data show has changed.";
  if (!hidden.empty())
    text += fmt::format(" Seen now, but the earlier data could not show it: {}.", fmt::join(hidden, ", "));
  for (const std::vector<std::string>& members : later.classes) {
    std::vector<std::string> names;
    for (const std::string& id : members) names.push_back(in_words(id));
    text += fmt::format(" These data cannot distinguish {}.", fmt::join(names, ", "));
  }
  for (const EstimatedEffect& cause : later.causes)
    if (!cause.remedy.empty())
      text += fmt::format(" The later recording is faulty: {}. {}", in_words(cause.effect), cause.remedy);
  return text;
}

}  // namespace

Scenario as_fitted(const Scenario& stated, const Diagnosis& fitted) {
  Scenario scenario = stated;
  scenario.effects = fitted.extended.effects;
  for (const Number& n : fitted_numbers(fitted))
    set_field(scenario.effects, {n.effect, n.estimate.field, n.estimate.value});
  return scenario;
}

std::vector<Tolerance> known_tolerances(const Diagnosis& fitted) {
  std::vector<Tolerance> tolerances;
  for (const Number& n : fitted_numbers(fitted))
    tolerances.push_back({n.effect, n.estimate.field, n.estimate.standard_error});
  return tolerances;
}

void tell_changes(const Diagnosis& earlier, const Scenario& fitted, Diagnosis& later) {
  Since since{{}, earlier.verdict, earlier.sentence, fitted, {}};
  for (const Number& n : fitted_numbers(later))
    since.changes.push_back(change(n.effect, earlier_estimate(earlier, fitted, n.effect, n.estimate), n.estimate));
  std::stable_partition(since.changes.begin(), since.changes.end(), [](const Change& c) { return c.certain; });
  later.sentence = sentence_of(since.changes, later);
  later.since = std::move(since);
}

}  // namespace wormdrive
