#include "recovery/campaign.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <unistd.h>

#include "diagnosis/read_recording.hpp"
#include "recovery/truth/excitation.hpp"

namespace recovery {
namespace {

/// Effects that nearly cancel over most of a recording, with the sign of the second to the first.
struct Cancelling {
  std::string_view first, second;
  double sign;
};
constexpr Cancelling cancelling_pairs[] = {
    {"mesh_friction", "load_magnitude", -1.0},    {"torque_gain", "load_magnitude", 1.0},
    {"torque_gain", "mesh_friction", 1.0},        {"worm_coulomb", "mesh_friction", -1.0},
    {"torque_offset", "friction_asymmetry", 1.0}, {"worm_viscous", "stribeck", 1.0},
    {"friction_drift", "mesh_friction", -1.0},    {"worm_inertia", "gear_inertia", -1.0}};

template <class T>
const T& one_of(const std::vector<T>& all, truth::Generator& generator) {
  return all[std::uniform_int_distribution<std::size_t>(0, all.size() - 1)(generator)];
}

double signed_amount(const truth::Secret& secret, truth::Size size, truth::Generator& generator) {
  const bool turn = secret.either_sign && std::bernoulli_distribution(0.5)(generator);
  return turn ? -secret.amount(size) : secret.amount(size);
}

bool same_or_twin(std::string_view named, const truth::Secret& secret) {
  if (secret.effect == "dwell" && named == "static_friction") return true;
  return named == secret.effect || std::find(secret.twins.begin(), secret.twins.end(), named) != secret.twins.end();
}

std::vector<const truth::Secret*> pool(const Plan& plan) {
  std::vector<const truth::Secret*> all;
  if (!plan.effects.empty()) {
    for (const std::string& effect : plan.effects) all.push_back(&truth::secret(effect));
    return all;
  }
  for (const truth::Secret& secret : plan.kind == Kind::outside ? truth::outside() : truth::catalogue())
    if (!secret.needs_worm_encoder || plan.conditions.worm_counts > 0.0) all.push_back(&secret);
  return all;
}

}  // namespace

Conditions conditions(std::string_view name) {
  truth::NominalErrors doubled = stated_errors;
  doubled.share *= 2.0;
  doubled.angle *= 2.0;
  doubled.offset *= 2.0;
  for (const Conditions& known :
       {Conditions{"ideal", {}}, Conditions{"coloured", {}, 5e-4, 65536},
        Conditions{"realistic", stated_errors, 5e-4, 16384}, Conditions{"double", doubled, 5e-4, 16384}})
    if (known.name == name) return known;
  throw std::invalid_argument("conditions are ideal, coloured, realistic or double, not " + std::string(name));
}

std::string_view name(Kind kind) {
  switch (kind) {
    case Kind::single: return "single";
    case Kind::nothing: return "nothing";
    case Kind::pair: return "pair";
    case Kind::cancelling: return "cancelling";
    case Kind::outside: return "outside";
  }
  return {};
}

Kind kind(std::string_view sought) {
  for (const Kind k : {Kind::single, Kind::nothing, Kind::pair, Kind::cancelling, Kind::outside})
    if (name(k) == sought) return k;
  throw std::invalid_argument("a campaign hides single, nothing, pair, cancelling or outside, not " +
                              std::string(sought));
}

std::string_view name(Score score) {
  switch (score) {
    case Score::exact: return "exact";
    case Score::in_class: return "in class";
    case Score::partial: return "partial";
    case Score::extra: return "extra";
    case Score::silent: return "silent";
    case Score::wrong: return "wrong";
    case Score::crash: return "crash";
  }
  return {};
}

std::vector<Case> draw(const Plan& plan) {
  truth::Generator generator(plan.seed);
  const std::vector<const truth::Secret*> secrets = pool(plan);
  std::vector<Case> cases;
  for (long k = 0; k < plan.cases; ++k) {
    Case drawn{plan.kind, plan.conditions, generator(), {}, plan.duration};
    const auto in_turn = static_cast<std::size_t>(k);
    const truth::Size size = plan.sizes[(in_turn / secrets.size()) % plan.sizes.size()];
    const auto hide = [&](const truth::Secret& secret, double amount) {
      drawn.hidden.push_back({&secret, size, amount});
    };
    switch (plan.kind) {
      case Kind::nothing: break;
      case Kind::single:
      case Kind::outside: {
        const truth::Secret& secret = *secrets[in_turn % secrets.size()];
        hide(secret, signed_amount(secret, size, generator));
        break;
      }
      case Kind::pair: {
        const truth::Secret* first = one_of(secrets, generator);
        const truth::Secret* second = first;
        while (same_or_twin(second->effect, *first)) second = one_of(secrets, generator);
        for (const truth::Secret* secret : {first, second}) hide(*secret, signed_amount(*secret, size, generator));
        break;
      }
      case Kind::cancelling: {
        const Cancelling& pair = cancelling_pairs[in_turn % std::size(cancelling_pairs)];
        const truth::Secret &first = truth::secret(pair.first), &second = truth::secret(pair.second);
        const double amount = signed_amount(first, size, generator);
        hide(first, amount);
        hide(second, pair.sign * std::copysign(second.amount(size), amount));
        break;
      }
    }
    cases.push_back(std::move(drawn));
  }
  return cases;
}

/// Of teeth that an encoder on the worm does not see yield [N/m].
constexpr double rigid_teeth = 1e9;

wormdrive::Scenario data_sheet(const Conditions& conditions) {
  const truth::Geometry g;
  wormdrive::Scenario sheet;
  sheet.title = "test bench";
  sheet.mesh = wormdrive::MeshParameters<double>{.i = g.ratio,
                                                 .lambda = g.lead_angle,
                                                 .phi_n = g.pressure_angle,
                                                 .lw = g.worm_radius,
                                                 .lg = g.gear_radius,
                                                 .mu = truth::MeshFriction{}.level,
                                                 .Jw = g.worm_inertia,
                                                 .Jg = g.gear_inertia};
  wormdrive::GravityArm arm;
  arm.mass = g.mass;
  arm.arm = g.arm;
  sheet.load = arm;
  sheet.run.duration = 24.0;
  const truth::NominalErrors stated = conditions.errors.share > 0.0 ? stated_errors : truth::NominalErrors{};
  sheet.tolerance = wormdrive::Tolerances{.friction = stated.share,
                                          .load = stated.share,
                                          .load_angle = stated.angle,
                                          .worm_inertia = stated.share,
                                          .gear_inertia = stated.share,
                                          .torque_gain = stated.share,
                                          .torque_offset = stated.offset};
  return sheet;
}

Bench record(const Case& drawn) {
  truth::Generator generator(drawn.seed);
  Bench bench;
  truth::Drive& drive = bench.drive;
  drive.noise.coloured = drawn.conditions.coloured_torque;
  drive.sensor.counts = drawn.conditions.counts;
  drive.sensor.worm_counts = drawn.conditions.worm_counts;
  if (drawn.conditions.worm_counts > 0.0) drive.teeth.stiffness = rigid_teeth;
  truth::disturb_nominal(drive, drawn.conditions.errors, generator);
  for (const Hiding& hiding : drawn.hidden) hiding.secret->hide(drive, hiding.amount, generator);
  const auto course = truth::rich_course(generator(), drawn.duration);
  const auto law = truth::follow(course, truth::Geometry{}, truth::MeshFriction{}.level);
  const auto recorded = truth::record(drive, law, {.duration = drawn.duration, .seed = generator()});
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() /
      ("recovery_" + std::to_string(getpid()) + "_" + std::to_string(drawn.seed) + ".csv");
  truth::write_csv(recorded, file.string());
  try {
    bench.recording = wormdrive::read_recording(file.string(), data_sheet(drawn.conditions));
  } catch (...) {
    std::filesystem::remove(file);
    throw;
  }
  std::filesystem::remove(file);
  bench.recording.name = "recording";
  return bench;
}

Outcome judge(const Case& drawn, const truth::Drive& drive, const wormdrive::Diagnosis& found) {
  using wormdrive::Verdict;
  Outcome outcome;
  outcome.drawn = drawn;
  outcome.told = found.sentence;
  outcome.flagged = found.verdict == Verdict::unexplained || !found.remainders.empty();
  const bool claims = found.verdict == Verdict::named || found.verdict == Verdict::ambiguous;
  if (claims)
    for (const auto& cause : found.causes) outcome.named.push_back(cause.effect);
  outcome.class_size = std::max<std::size_t>(1, found.equivalents.size());
  const auto is_hidden = [&](const std::string& named) {
    return std::any_of(drawn.hidden.begin(), drawn.hidden.end(),
                       [&](const Hiding& h) { return same_or_twin(named, *h.secret); });
  };
  const auto is_named = [&](const Hiding& h, const std::vector<std::string>& names) {
    return std::any_of(names.begin(), names.end(), [&](const std::string& n) { return same_or_twin(n, *h.secret); });
  };
  const auto named = [&](const Hiding& h) { return is_named(h, outcome.named); };
  const auto in_class = [&](const Hiding& h) { return named(h) || is_named(h, found.equivalents); };
  const bool all_named = std::all_of(drawn.hidden.begin(), drawn.hidden.end(), named);
  const bool only_hidden =
      std::all_of(outcome.named.begin(), outcome.named.end(), is_hidden) && outcome.named.size() <= drawn.hidden.size();
  const bool class_of_twins = std::all_of(found.equivalents.begin(), found.equivalents.end(), is_hidden);
  if (!claims || outcome.named.empty())
    outcome.score = drawn.hidden.empty() ? Score::exact : Score::silent;
  else if (drawn.hidden.empty())
    outcome.score = Score::wrong;
  else if (all_named && only_hidden && (found.verdict == Verdict::named || class_of_twins))
    outcome.score = Score::exact;
  else if (found.verdict == Verdict::ambiguous && std::all_of(drawn.hidden.begin(), drawn.hidden.end(), in_class) &&
           outcome.named.size() <= drawn.hidden.size())
    outcome.score = Score::in_class;
  else
    outcome.score = all_named ? Score::extra : only_hidden ? Score::partial : Score::wrong;
  for (const Hiding& hiding : drawn.hidden)
    for (const auto& cause : found.causes) {
      if (cause.effect != hiding.secret->effect) continue;
      for (const truth::TrueParameter& parameter : hiding.secret->parameters)
        for (const wormdrive::Estimate& estimate : cause.parameters) {
          if (estimate.field != parameter.field) continue;
          const double is = parameter.of(drive);
          outcome.errors.push_back(std::abs(estimate.value - is) / std::abs(is));
          if (estimate.standard_error > 0.0)
            outcome.deviations.push_back((estimate.value - is) / estimate.standard_error);
        }
    }
  for (const auto& error : found.prediction)
    if (std::abs(error.horizon - 0.25) < 1e-9 && error.floor > 0.0) outcome.held_out = error.after / error.floor;
  return outcome;
}

std::vector<Outcome> run(const std::vector<Case>& cases, const Diagnose& diagnose, int threads,
                         const std::function<void(const Outcome&)>& listen) {
  std::vector<Outcome> outcomes(cases.size());
  std::atomic<std::size_t> next{0};
  std::mutex one_at_a_time;
  const auto work = [&] {
    for (std::size_t k = next++; k < cases.size(); k = next++) {
      Outcome& outcome = outcomes[k];
      try {
        const Bench bench = record(cases[k]);
        const auto start = std::chrono::steady_clock::now();
        const wormdrive::Diagnosis found = diagnose(data_sheet(cases[k].conditions), {bench.recording});
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
        outcome = judge(cases[k], bench.drive, found);
        outcome.seconds = took.count();
      } catch (const std::exception& fault) {
        outcome.drawn = cases[k];
        outcome.told = fault.what();
      }
      const std::lock_guard lock(one_at_a_time);
      if (listen) listen(outcome);
    }
  };
  std::vector<std::thread> crew;
  for (int k = 1; k < threads; ++k) crew.emplace_back(work);
  work();
  for (std::thread& worker : crew) worker.join();
  return outcomes;
}

}  // namespace recovery
