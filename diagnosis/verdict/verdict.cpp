#include "diagnosis/verdict/verdict.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "description/keys.hpp"
#include "diagnosis/fitting/prediction_error.hpp"
#include "diagnosis/rules/noise.hpp"
#include "diagnosis/rules/verdict.hpp"

namespace wormdrive {

std::string joined(const std::vector<std::string>& parts, std::string_view last) {
  std::string all;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (k > 0) all += k + 1 == parts.size() ? fmt::format(" {} ", last) : ", ";
    all += parts[k];
  }
  return all;
}

namespace {

/// What moved within its tolerance, at least the number that moved most.
std::string calibration_clause(const Diagnosis& d, const Hypothesis& h) {
  std::vector<double> tolerances;
  for (std::size_t k = 0; k < h.free.size(); ++k)
    if (h.free[k].tolerance > 0.0) tolerances.push_back(std::abs(h.values[k] - h.free[k].centre) / h.free[k].tolerance);
  const double most = tolerances.empty() ? 0.0 : *std::max_element(tolerances.begin(), tolerances.end());
  std::vector<std::string> moved;
  for (std::size_t k = 0; k < std::min(tolerances.size(), d.calibration.size()); ++k)
    if (tolerances[k] >= std::min(1.0, most)) moved.push_back(phrase(d.calibration[k], d.extended.axis));
  return " once stated parameters move within their tolerances: " + joined(moved, "and") + ".";
}

std::string remainder_sentence(const Diagnosis& d, double torque) {
  const bool linear = d.extended.axis == Axis::linear;
  const std::string_view unit = linear ? unit::newton.symbol : unit::newton_metre.symbol;
  if (d.remainders.empty() || noise_dominated(d, torque))
    return fmt::format(" Noise of {:.2g} {} rms remains, compared with {:.2g} {} of the motor.", d.noise_torque, unit,
                       torque, unit);
  const Remainder& r = d.remainders.front();
  if (r.torque > 0.0)
    return fmt::format(" A {} of {:.2g} {} rms over {} remains unexplained.", linear ? "force" : "torque", r.torque,
                       unit, r.axis);
  return fmt::format(" {}{} remains unexplained.", static_cast<char>(r.axis.front() - 'a' + 'A'), r.axis.substr(1));
}

/// What the drive lacks, and what is wrong with the recording and how to mend it.
std::string causes_sentences(const Diagnosis& d) {
  std::vector<std::string> lacking, wrong;
  std::string remedies;
  for (const EstimatedEffect& cause : d.causes) {
    (cause.remedy.empty() ? lacking : wrong).push_back(phrase(cause, d.extended.axis));
    if (!cause.remedy.empty()) remedies += " " + cause.remedy;
  }
  std::string text;
  if (!lacking.empty())
    text = (d.remainders.empty() ? "The simulation lacks " : "The simulation lacks, among other things, ") +
           joined(lacking, "and") + ".";
  if (!wrong.empty())
    text += fmt::format("{}The recording is faulty: {}.{}", text.empty() ? "" : " ", joined(wrong, "and"), remedies);
  return text;
}

}  // namespace

std::string gain_sentence(const Diagnosis& d) {
  const PredictionError* e = reported_error(d);
  if (!e) return "";
  constexpr double milli = 1e3;
  return fmt::format(
      " On data not used for the fit the {} s prediction error {} from {:.3g} to {:.3g} m{} (noise floor {:.2g}).",
      e->horizon, e->after <= e->before ? "falls" : "rises", milli * e->before, milli * e->after, e->unit.symbol,
      milli * e->floor);
}

std::string in_words(std::string id) {
  std::replace(id.begin(), id.end(), '_', ' ');
  return id;
}

const PredictionError* reported_error(const Diagnosis& d) {
  for (const PredictionError& e : d.prediction)
    if (e.horizon == rules::reported_horizon) return &e;
  return nullptr;
}

bool calibration_matters(const Diagnosis& d) {
  const PredictionError* e = reported_error(d);
  return e && e->after < (1.0 - rules::of_no_account) * e->before;
}

bool impacts(const Diagnosis& d) {
  return std::any_of(d.causes.begin(), d.causes.end(), [](const auto& c) { return has_impacts(c.effect); });
}

bool needs_much_noise(const Diagnosis& d, double torque) {
  return !impacts(d) && d.noise_torque > rules::most_noise * torque;
}

bool noise_dominated(const Diagnosis& d, double torque) {
  const bool follows = std::any_of(d.prediction.begin(), d.prediction.end(), [](const PredictionError& e) {
    return e.after < rules::most_of_motion * e.constant_speed;
  });
  return !follows && needs_much_noise(d, torque);
}

std::optional<Remainder> error_above_noise(const Diagnosis& d) {
  const PredictionError* e = reported_error(d);
  if (!e || e->after_low <= rules::above_noise * e->floor) return std::nullopt;  // a few blocks may be all of it
  const double ratio = e->after / e->floor;
  // what bounces leave does not speak against a gap
  const double gain =
      impacts(d) && ratio <= rules::above_noise_of_impacts ? 0.0 : std::numeric_limits<double>::infinity();
  return Remainder{fmt::format("an error {} s ahead that is {:.2g} times that of noise", e->horizon, ratio), ratio, 0.0,
                   gain};
}

const std::vector<std::string>* class_of(const Diagnosis& d, std::string_view effect) {
  for (const std::vector<std::string>& members : d.classes)
    if (std::find(members.begin(), members.end(), effect) != members.end()) return &members;
  return nullptr;
}

std::string phrase(const EstimatedEffect& effect, Axis axis) {
  std::string text = in_words(effect.effect) + ":";
  for (const Estimate& p : effect.parameters) {
    if (&p != &effect.parameters.front()) text += ",";
    text += fmt::format(" {} {:.4g}", in_words_of(axis, in_words(p.field)), p.value / p.unit.si);
    if (p.standard_error > 0.0) text += fmt::format(" +- {:.2g}", p.standard_error / p.unit.si);
    if (!p.unit.suffix.empty()) text += fmt::format(" {}", p.unit.symbol);
  }
  return text;
}

std::string learned_sentence(const LearnedTerms& learned, Axis axis) {
  std::vector<std::string> terms, effects;
  for (const LearnedMap& map : learned.maps) {
    terms.push_back(fmt::format("a {} over the {}", in_words_of(axis, std::string(map.form.what)),
                                in_words_of(axis, std::string(name(map.form.over)))));
    effects.emplace_back(map.form.effect);
  }
  if (learned.vibration) {
    terms.push_back(fmt::format("a vibration of {:.5g} Hz", learned.vibration->frequency));
    effects.emplace_back(Vibration<double>::id);
  }
  const bool one = terms.size() == 1;
  constexpr double milli = 1e3;
  return fmt::format(
      " {} learned from these data: {}. {} no cause and {} in the extended scenario as {}. With {} the {} s prediction "
      "error on data not used for the fit is {:.3g} m{} instead of {:.3g}.",
      one ? "One term was" : "Terms were", joined(terms, "and"), one ? "It claims" : "They claim", one ? "is" : "are",
      joined(effects, "and"), one ? "it" : "them", rules::reported_horizon, milli * learned.with, units_on(axis, "rad"),
      milli * learned.without);
}

void judge(Diagnosis& d, const Selection& selection, const std::vector<Candidate>& all, const Magnitudes& sizes) {
  for (const Found& found : selection.causes) {
    std::vector<std::string> members{std::string(all[found.candidate].effect)};
    for (const std::size_t other : found.equals) {
      members.emplace_back(all[other].effect);
      for (const Twin& twin : all[other].twins) members.emplace_back(twin.effect);
    }
    if (!is_removed(selection.model, all[found.candidate]))  // what is stated is not there, whatever else may be
      for (const Twin& twin : all[found.candidate].twins) members.emplace_back(twin.effect);
    if (members.size() > 1) d.classes.push_back(std::move(members));
  }

  if (selection.beyond_bound)
    d.remarks.push_back(
        fmt::format("{} explains most of the difference, but only with a value outside its limits: something else "
                    "acts like it",
                    in_words(std::string(all[*selection.beyond_bound].effect))));

  const std::string lacking = "The simulation lacks something that no effect of the catalogue explains.";
  if (d.causes.empty()) {
    const bool adequate = d.remainders.empty() && !noise_dominated(d, sizes.torque);
    d.verdict = adequate ? Verdict::adequate : Verdict::unexplained;
    d.sentence = adequate ? "The simulation contains every effect that these data show"
                          : lacking + remainder_sentence(d, sizes.torque);
    if (adequate) d.sentence += calibration_matters(d) ? calibration_clause(d, selection.base) + gain_sentence(d) : ".";
    return;
  }

  // What leaves structure behind is not the whole truth. It may keep its name if it does most of the work: of the error
  // ahead, of which little but noise is left, or a share of no account, where noise is less; or of all that the data
  // show, whose evidence grows with the logarithm of the error only.
  // A shock is followed no better than its law, which leaves more behind.
  const double most_of_the_evidence = impacts(d) ? rules::most_of_the_evidence_of_impacts : rules::most_of_the_evidence;
  const PredictionError* e = reported_error(d);
  double left = 0.0;
  for (const Remainder& r : d.remainders) left = std::max(left, r.gain);
  const double explained = 0.5 * (selection.base.bic - selection.model.bic);
  const bool predicts =
      e && ((e->before >= rules::most_of_the_error * e->after && e->after <= rules::little_but_noise * e->floor) ||
            e->after <= rules::of_no_account * e->before);
  const bool most_done = predicts || explained >= most_of_the_evidence * left;
  if (needs_much_noise(d, sizes.torque) || (!d.remainders.empty() && !most_done)) {
    const auto withdrawn = [&](std::string_view effect) { return !sizes.has_worm_encoder || !is_kinematic(effect); };
    std::vector<std::string> tried;
    for (const EstimatedEffect& cause : d.causes)
      if (withdrawn(cause.effect)) tried.push_back(in_words(cause.effect));
    if (!tried.empty())
      d.remarks.push_back("best of the catalogue, but it leaves structure behind: " + joined(tried, "and"));
    std::erase_if(d.classes, [&](const std::vector<std::string>& members) { return withdrawn(members.front()); });
    std::erase_if(d.causes, [&](const EstimatedEffect& cause) { return withdrawn(cause.effect); });
    for (RankedCandidate& c : d.ranking)
      if (c.named && withdrawn(c.effect.effect)) {
        c.named = false;
        c.outcome = "leaves structure behind";
      }
  }
  if (d.causes.empty()) {
    d.verdict = Verdict::unexplained;
    d.sentence = lacking + remainder_sentence(d, sizes.torque);
    return;
  }

  d.verdict = d.classes.empty() ? Verdict::named : Verdict::ambiguous;
  d.sentence = causes_sentences(d);
  for (const std::vector<std::string>& members : d.classes) {
    std::vector<std::string> others;
    for (std::size_t k = 1; k < members.size(); ++k) others.push_back(in_words(members[k]));
    d.sentence += fmt::format(" These data cannot tell {} from {}.", in_words(members[0]), joined(others, "or"));
  }
  d.sentence += gain_sentence(d);
  if (e && e->after > e->before)
    d.remarks.push_back(fmt::format(
        "the error {} s ahead is not smaller: the named causes rest on the likelihood of the single samples, "
        "{:.3g} nats{}",
        e->horizon, explained, impacts(d) ? "; teeth that bounce cannot be followed far" : ""));
  if (!d.remainders.empty()) d.sentence += remainder_sentence(d, sizes.torque);
}

}  // namespace wormdrive
