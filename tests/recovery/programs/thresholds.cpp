#include "recovery/programs/thresholds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "recovery/tables.hpp"

namespace recovery {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// Effects whose hidden amount is the size that a certificate tells, one of each pair of twins.
std::vector<const truth::Secret*> gradual() {
  std::vector<const truth::Secret*> all;
  for (const truth::Secret& secret : truth::catalogue()) {
    const bool second_twin = secret.effect == "encoder_delay" || secret.effect == "encoder_offset";
    if (!secret.needs_worm_encoder && !second_twin && secret.effect != "torque_saturation") all.push_back(&secret);
  }
  return all;
}

/// A name, a class with the truth in it, or word of something that no name fits.
bool is_seen(const Outcome& outcome) {
  return outcome.score == Score::exact || outcome.score == Score::in_class ||
         (outcome.score == Score::silent && outcome.flagged);
}

/// Of exact twins, as the class of both.
bool is_named(const Outcome& outcome) { return outcome.score == Score::exact; }

/// Between the last good answer and the first that is not lies the threshold.
bool within_a_factor_of_two(const Limit& limit) { return limit.reached > 0.0 && limit.missed >= 0.25; }

std::string cells(const Limit& limit) {
  const auto size = [&](double multiple) { return multiple > 0.0 ? fmt::format("{:g} x", multiple) : "-"; };
  return fmt::format("{:.2g} | {} | {} | {}", limit.certified, size(limit.reached), size(limit.missed), limit.answer);
}

}  // namespace

std::vector<Threshold> thresholds(const Plan& plan, const Diagnose& diagnose) {
  truth::Generator generator(plan.seed);
  std::vector<const truth::Secret*> secrets;
  for (const std::string& effect : plan.effects) secrets.push_back(&truth::secret(effect));
  if (secrets.empty()) secrets = gradual();
  struct Nothing {
    Case drawn;
    wormdrive::Diagnosis found;
  };
  std::vector<Nothing> nothing;
  const wormdrive::Scenario sheet = data_sheet(conditions("ideal"));
  for (int k = 0; k < benches; ++k) {
    const Case drawn{Kind::nothing, conditions("ideal"), generator(), {}, plan.duration};
    nothing.push_back({drawn, diagnose(sheet, {record(drawn).recording})});
  }
  std::vector<Threshold> measured;
  for (const truth::Secret* secret : secrets) {
    const auto hiding = [&](const Nothing& bench, double amount) {  // in the very motion that the certificate is of
      Case drawn = bench.drawn;
      drawn.kind = Kind::single;
      drawn.hidden = {{secret, truth::Size::medium, amount}};
      return drawn;
    };
    const auto limit = [&](double wormdrive::Visibility::*size, const auto& good) {
      std::vector<double> certified;
      for (const Nothing& bench : nothing) {
        truth::Generator of_bench(bench.drawn.seed);
        const truth::Drive drive = disturbed_drive(hiding(bench, secret->medium), of_bench);
        const wormdrive::Visibility* seen = visibility(bench.found, secret->effect, drive);
        certified.push_back(seen ? seen->*size : never);
      }
      Limit found{*std::max_element(certified.begin(), certified.end())};
      if (!std::isfinite(found.certified)) return found;
      for (const double multiple : multiples) {
        long well = 0, badly = 0;
        for (std::size_t k = 0; k < nothing.size() && 2 * std::max(well, badly) <= benches; ++k) {
          const Case drawn = hiding(nothing[k], multiple * certified[k]);
          const Bench bench = record(drawn);
          const Outcome outcome = judge(drawn, bench.drive, diagnose(sheet, {bench.recording}));
          ++(good(outcome) ? well : badly);
          if (!good(outcome)) found.answer = answer(outcome);
        }
        if (badly > well) {
          found.missed = multiple;
          break;
        }
        found.reached = multiple;
      }
      return found;
    };
    measured.push_back({secret, limit(&wormdrive::Visibility::detectable, is_seen),
                        limit(&wormdrive::Visibility::nameable, is_named)});
  }
  return measured;
}

std::vector<Unseen> unseen(std::uint64_t seed, const Diagnose& diagnose) {
  struct Motion {
    std::string_view name;
    double amplitude, frequency;
    std::vector<std::string_view> effects;
  };
  const std::vector<Motion> motions{
      // the load never changes its side, nothing accelerates, the torque is a third of any limit
      {"0.9 rad at 0.1 Hz", 0.9, 0.1, {"backlash", "gear_inertia", "worm_inertia", "torque_saturation"}},
      {"0.1 rad at 0.1 Hz",
       0.1,
       0.1,
       {"backlash", "gear_inertia", "worm_inertia", "torque_saturation", "gear_viscous"}}};
  truth::Generator generator(seed);
  std::vector<Unseen> cases;
  for (const Motion& motion : motions)
    for (const std::string_view effect : motion.effects) {
      const truth::Secret& secret = truth::secret(effect);
      Case hiding{Kind::single, conditions("ideal"), generator(), {{&secret, truth::Size::small, secret.small}}, 12.0};
      const auto course = truth::slow_course(motion.amplitude, motion.frequency, hiding.duration);
      const truth::Drive drive = disturbed_drive(hiding, generator);
      const wormdrive::Scenario sheet = data_sheet(hiding);
      const wormdrive::Diagnosis found = diagnose(sheet, {follow(drive, course, sheet, generator())});
      const Outcome outcome = judge(hiding, drive, found);
      const wormdrive::Visibility* seen = visibility(found, effect, drive);
      const bool limit = effect == "torque_saturation";  // shows from a smaller one on
      const bool hides =
          seen && (!seen->observable || (limit ? seen->detectable < secret.small : seen->detectable > secret.small));
      cases.push_back({&secret, std::string(motion.name), hides, outcome.named.empty(), answer(outcome)});
    }
  return cases;
}

std::string table(const std::vector<Threshold>& measured) {
  std::string text =
      "| effect | certificate: seen from | measured: down to | missed at | answer there "
      "| certificate: named from | measured: down to | missed at | answer there |\n"
      "|---|---|---|---|---|---|---|---|---|\n";
  long seen = 0, named = 0, known = 0;
  for (const Threshold& t : measured) {
    text += fmt::format("| {} | {} | {} |\n", t.secret->effect, cells(t.seen), cells(t.named));
    known += std::isfinite(t.named.certified);
    seen += within_a_factor_of_two(t.seen);
    named += within_a_factor_of_two(t.named);
  }
  return text + fmt::format("\nWithin a factor of 2 of the certificate: {} and {} of {}.\n", seen, named, known);
}

std::string table(const std::vector<Unseen>& cases) {
  std::string text = "| hidden | motion | certificate | answer |\n|---|---|---|---|\n";
  for (const Unseen& u : cases)
    text += fmt::format("| {} {:g} | {} | {} | {} |\n", u.secret->effect, u.secret->small, u.motion,
                        u.certified ? "cannot show it" : "says that it shows", u.answer);
  return text;
}

}  // namespace recovery
