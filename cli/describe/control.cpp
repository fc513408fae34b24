#include "cli/describe/control.hpp"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/describe/drive.hpp"
#include "description/build_control.hpp"

namespace wormdrive {
namespace {

/// "eta >= M b_hat/2 - E: 30 rad/s^2 against 1.287 rad/s^2, margin 28.71"; what to do if it fails.
std::string describe(const Condition& c) {
  const std::string text =
      fmt::format("{:<34} {:>10.4g} {} {:<10.4g} {:<11} {} {:.4g}", c.rule, c.actual, c.at_most ? "<=" : ">=", c.limit,
                  c.unit, c.holds() ? "holds, margin" : "FAILS by", std::abs(c.margin()));
  if (c.holds()) return text;
  if (!c.of_key) return fmt::format("{}; a larger {} would cover it", text, c.key);
  if (c.at_most) return fmt::format("{}; {} = {:.6g} would cover it", text, c.key, c.actual);
  return fmt::format("{}; {} = {:.6g} would satisfy it", text, c.key, c.limit);
}

std::optional<PidGains> pid_gains(const Scenario& scenario) {
  const auto* const pid = std::get_if<PidParameters>(&scenario.control->law);
  return pid ? std::optional(lqr_gains(*pid, mean_inertia(make_nominal(scenario)))) : std::nullopt;
}

bool is_sliding(const Scenario& scenario) { return std::holds_alternative<SlidingParameters>(scenario.control->law); }

void print_lemma1(const Scenario& scenario) {
  const auto& law = std::get<SlidingParameters>(scenario.control->law);
  const Lemma1 lemma = make_lemma1(scenario);
  fmt::print("\nLemma 1 from the nominal model and its variations\n");
  for (std::size_t k = 0; k < 2; ++k) {
    const BranchBounds& b = lemma.branch[k];
    fmt::print(
        "  branch C{}: b_hat {:.6g} 1/(kg m^2), d_hat {:.6g} 1/(kg m^2), beta {:.6g}, D {:.6g} 1/(kg m^2), "
        "E {:.6g} rad/s^2\n",
        k + 1, b.b_hat, b.d_hat, b.beta, b.D, b.E);
  }
  fmt::print("  M {:.6g} N m, least eta {:.6g} rad/s^2\n", lemma.M, least_eta(SlidingBounds(law, lemma), lemma));
  fmt::print("  guaranteed precision 2 Phi/lambda_c = {:.6g} rad, sharp 2 Phi/(e lambda_c) = {:.6g} rad\n",
             guaranteed_precision(law), sharp_precision(law));
  for (const Condition& c : lemma1_conditions(scenario)) fmt::print("  {}\n", describe(c));
}

nlohmann::json lemma1_as_json(const Scenario& scenario) {
  const auto& law = std::get<SlidingParameters>(scenario.control->law);
  const Lemma1 lemma = make_lemma1(scenario);
  nlohmann::json result{{"M", lemma.M},
                        {"least_eta", least_eta(SlidingBounds(law, lemma), lemma)},
                        {"guaranteed_precision", guaranteed_precision(law)},
                        {"sharp_precision", sharp_precision(law)}};
  for (const BranchBounds& b : lemma.branch)
    result["branches"].push_back({{"b_hat", b.b_hat}, {"d_hat", b.d_hat}, {"beta", b.beta}, {"D", b.D}, {"E", b.E}});
  for (const Condition& c : lemma1_conditions(scenario))
    result["conditions"].push_back({{"rule", c.rule},
                                    {"actual", c.actual},
                                    {"limit", c.limit},
                                    {"unit", c.unit},
                                    {"margin", c.margin()},
                                    {"holds", c.holds()},
                                    {"key", c.key}});
  return result;
}

}  // namespace

void print_design(const Scenario& scenario) {
  if (!scenario.control) return;
  if (const auto gains = pid_gains(scenario))
    fmt::print(
        "\ngains of the PID on M = {:.6g} kg m^2\n  Ki {:.6g} N m/(rad s), Kp {:.6g} N m/rad, Kd {:.6g} N m s/rad\n",
        mean_inertia(make_nominal(scenario)), gains->Ki, gains->Kp, gains->Kd);
  if (is_sliding(scenario)) print_lemma1(scenario);
}

nlohmann::json design_as_json(const Scenario& scenario) {
  if (!scenario.control) return nullptr;
  nlohmann::json result = nlohmann::json::object();
  if (const auto gains = pid_gains(scenario))
    result["gains"] = {{"Ki", gains->Ki}, {"Kp", gains->Kp}, {"Kd", gains->Kd}};
  if (is_sliding(scenario)) result["lemma1"] = lemma1_as_json(scenario);
  return result;
}

void print_control(const ControlSummary& summary) {
  const Metrics& m = summary.metrics;
  const std::string torque = fmt::format("torque {:.3g} N m rms, {:.3g} peak", m.torque_rms, m.torque_peak);
  if (summary.follows)
    print_item("tracking", fmt::format("error {:.3g} rad peak to peak, {:.3g} rms, {:.3g} at most; {}",
                                       m.error_peak_to_peak, m.error_rms, m.error_max, torque));
  else
    print_item("control", torque);
  print_item("", fmt::format("{:g} reversals, {:g} flank changes, {:.3g} s stuck{}", m.reversals, m.flank_changes,
                             m.time_stuck,
                             summary.lemma ? fmt::format(", {:.3g} s outside the layer", m.time_outside_layer) : ""));
  if (!summary.lemma) return;
  const Lemma1Monitor& lemma = *summary.lemma;
  const bool reached = !std::isnan(lemma.reached());
  std::string text = reached ? fmt::format("layer reached at {:.4g} s", lemma.reached())
                             : "the layer is never reached; the promises for the time after that cannot be checked";
  if (reached && lemma.clean()) text += "; all promises kept";
  print_item("Lemma 1", text);
  for (const Violation& v : lemma.violations())
    if (v.count > 0)
      print_item("", fmt::format("broken: {} at {} sample{}, first at {:.6g} s; worst value {:.4g}, limit {:.4g}",
                                 v.promise, v.count, v.count == 1 ? "" : "s", v.first, v.worst, v.limit));
}

nlohmann::json as_json(const ControlSummary& summary) {
  nlohmann::json result;
  for_each_field<Metrics>([&](const auto& field) {
    if (!summary.has(field.member)) return;
    result["metrics"][std::string(field.name)] = {
        {"value", summary.metrics.*field.member}, {"unit", field.unit.symbol}, {"meaning", field.meaning}};
  });
  if (!summary.lemma) return result;
  result["layer_reached_s"] = summary.lemma->reached();
  result["violations"] = nlohmann::json::array();
  for (const Violation& v : summary.lemma->violations())
    if (v.count > 0)
      result["violations"].push_back(
          {{"promise", v.promise}, {"samples", v.count}, {"first_s", v.first}, {"worst", v.worst}, {"limit", v.limit}});
  return result;
}

}  // namespace wormdrive
