#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "recovery/campaign.hpp"

// What a diagnosis deserves for what it says of what was hidden.

namespace recovery {
namespace {

/// Whether a certificate says that an effect can be named as it is in the drive, the errors of what is stated included;
/// of exact twins, as their class.
bool can_be_named(const wormdrive::Diagnosis& found, const Hiding& hiding, const truth::Drive& drive) {
  const truth::Secret& secret = *hiding.secret;
  const wormdrive::Visibility* v = visibility(found, secret.effect, drive);
  if (!v) return true;
  if (!v->observable) return false;
  if (secret.effect == "torque_saturation") return hiding.amount <= v->detectable;
  const double size = secret.parameters.empty() ? hiding.amount : secret.parameters.front().of(drive);
  return std::abs(size) >= v->nameable;
}

/// use(estimate, true value) of the parameters that the ground truth knows.
template <class Use>
void each_known(const truth::Secret& secret, const truth::Drive& drive, const wormdrive::EstimatedEffect& found,
                Use&& use) {
  for (const truth::TrueParameter& parameter : secret.parameters)
    for (const wormdrive::Estimate& estimate : found.parameters)
      if (estimate.field == parameter.field) use(estimate, parameter.of(drive));
}

/// Whether a stated parameter is off by so many of its tolerances that naming it is no fault.
bool is_off(std::string_view named, const truth::Drive& drive, const wormdrive::Tolerances& stated) {
  constexpr double far = 2.5;
  const truth::Geometry& sheet = drive.sheet.geometry;
  const double gear_inertia = sheet.gear_inertia + sheet.mass * sheet.arm * sheet.arm;
  const auto beyond = [&](std::string_view effect, double tolerance) {
    return same_or_twin(named, truth::secret(effect)) &&
           std::abs(truth::secret(effect).parameters.front().of(drive)) >= far * tolerance && tolerance > 0.0;
  };
  return beyond("mesh_friction", stated.friction * drive.sheet.friction) || beyond("load_magnitude", stated.load) ||
         beyond("load_angle", stated.load_angle) || beyond("torque_gain", stated.torque_gain) ||
         beyond("torque_offset", stated.torque_offset.value_or(0.0)) ||
         beyond("worm_inertia", stated.worm_inertia * sheet.worm_inertia) ||
         beyond("gear_inertia", stated.gear_inertia * gear_inertia);
}

}  // namespace

std::string_view name(Score score) {
  switch (score) {
    case Score::exact: return "exact";
    case Score::in_class: return "in class";
    case Score::off: return "off";
    case Score::partial: return "partial";
    case Score::extra: return "extra";
    case Score::silent: return "silent";
    case Score::wrong: return "wrong";
    case Score::crash: return "crash";
  }
  return {};
}

bool same_or_twin(std::string_view named, const truth::Secret& secret) {
  if (secret.effect == "dwell" && named == "static_friction") return true;
  return named == secret.effect || std::find(secret.twins.begin(), secret.twins.end(), named) != secret.twins.end();
}

const wormdrive::Visibility* visibility(const wormdrive::Diagnosis& found, std::string_view effect,
                                        const truth::Drive& drive) {
  const std::string periods = fmt::format("periods = {:g}", drive.actuator.cogging_periods);
  for (const wormdrive::Visibility& v : found.certificate)
    if (v.effect == effect && (v.chosen.empty() || v.chosen == periods)) return &v;
  return nullptr;
}

Outcome judge(const Case& drawn, const truth::Drive& drive, const wormdrive::Diagnosis& found) {
  using wormdrive::Verdict;
  Outcome outcome;
  outcome.drawn = drawn;
  outcome.told = found.sentence;
  outcome.flagged = found.verdict == Verdict::unexplained || !found.remainders.empty();
  outcome.observable = std::all_of(drawn.hidden.begin(), drawn.hidden.end(),
                                   [&](const Hiding& h) { return can_be_named(found, h, drive); });
  const bool claims = found.verdict == Verdict::named || found.verdict == Verdict::ambiguous;
  if (claims)
    for (const auto& cause : found.causes) outcome.named.push_back(cause.effect);
  std::vector<std::string> members;
  for (const std::vector<std::string>& of_class : found.classes) {
    members.insert(members.end(), of_class.begin(), of_class.end());
    outcome.class_size = std::max(outcome.class_size, of_class.size());
  }
  const auto is_hidden = [&](const std::string& cause) {
    return std::any_of(drawn.hidden.begin(), drawn.hidden.end(),
                       [&](const Hiding& h) { return same_or_twin(cause, *h.secret); });
  };
  const auto is_named = [&](const Hiding& h, const std::vector<std::string>& names) {
    return std::any_of(names.begin(), names.end(), [&](const std::string& n) { return same_or_twin(n, *h.secret); });
  };
  const auto named = [&](const Hiding& h) { return is_named(h, outcome.named); };
  const auto in_class = [&](const Hiding& h) { return named(h) || is_named(h, members); };
  const bool all_named = std::all_of(drawn.hidden.begin(), drawn.hidden.end(), named);
  const bool only_hidden =
      std::all_of(outcome.named.begin(), outcome.named.end(), is_hidden) && outcome.named.size() <= drawn.hidden.size();
  const auto stated = data_sheet(drawn).tolerance.value_or(wormdrive::Tolerances{});
  const auto off = [&](const std::string& cause) { return is_off(cause, drive, stated); };
  const bool only_true = std::all_of(outcome.named.begin(), outcome.named.end(), [&](const std::string& cause) {
    return is_hidden(cause) || off(cause) ||
           (found.verdict == Verdict::ambiguous && std::any_of(members.begin(), members.end(), off));
  });
  const bool some_off = !std::all_of(outcome.named.begin(), outcome.named.end(), is_hidden);
  const bool class_of_twins = std::all_of(members.begin(), members.end(), is_hidden);
  if (!claims || outcome.named.empty())
    outcome.score = drawn.hidden.empty() ? Score::exact : Score::silent;
  else if (drawn.hidden.empty())
    outcome.score = only_true ? Score::off : Score::wrong;
  else if (all_named && only_hidden && (found.verdict == Verdict::named || class_of_twins))
    outcome.score = Score::exact;
  else if (found.verdict == Verdict::ambiguous && std::all_of(drawn.hidden.begin(), drawn.hidden.end(), in_class) &&
           outcome.named.size() <= drawn.hidden.size())
    outcome.score = Score::in_class;
  else
    outcome.score = all_named     ? (only_true && some_off ? Score::off : Score::extra)
                    : only_hidden ? Score::partial
                    : only_true   ? Score::silent
                                  : Score::wrong;
  for (const Hiding& hiding : drawn.hidden)
    for (const auto& cause : found.causes) {
      if (cause.effect != hiding.secret->effect) continue;
      each_known(*hiding.secret, drive, cause, [&](const wormdrive::Estimate& estimate, double is) {
        outcome.errors.push_back(std::abs(estimate.value - is) / std::abs(is));
        if (!(estimate.standard_error > 0.0)) return;
        outcome.deviations.push_back((estimate.value - is) / estimate.standard_error);
        outcome.causes.count(estimate, is);
      });
    }
  if (outcome.score == Score::exact)
    for (const auto& moved : found.calibration)
      each_known(truth::secret(moved.effect), drive, moved,
                 [&](const wormdrive::Estimate& estimate, double is) { outcome.calibrated.count(estimate, is); });
  for (const auto& error : found.prediction) {
    if (std::abs(error.horizon - 0.25) > 1e-9 || !(error.floor > 0.0)) continue;
    outcome.held_out = error.after / error.floor;
    outcome.improved = error.after / error.before;
  }
  return outcome;
}

}  // namespace recovery
