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

#include "diagnosis/data/read_recording.hpp"

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

/// What the data sheet states, with the tolerance that goes with stated_errors.
struct StatedParameter {
  std::string_view effect;
  double tolerance;
};
std::vector<StatedParameter> stated_parameters(const truth::Sheet& stated) {
  const truth::Geometry& g = stated.geometry;
  const double share = stated_errors.share;
  return {{"mesh_friction", share * stated.friction},
          {"load_magnitude", share},
          {"load_angle", stated_errors.angle},
          {"torque_gain", share},
          {"torque_offset", stated_errors.offset * times_usual(truth::Dimension::worm_torque, stated)},
          {"worm_inertia", share * g.worm_inertia},
          {"gear_inertia", share * (g.gear_inertia + g.mass * g.arm * g.arm)}};
}

/// Whether an effect is a stated parameter, or leaves the same data as one.
bool is_stated(const truth::Secret& secret) {
  const auto all = stated_parameters({});
  return std::any_of(all.begin(), all.end(), [&](const StatedParameter& n) { return same_or_twin(n.effect, secret); });
}

double signed_amount(const truth::Secret& secret, truth::Size size, const truth::Sheet& sheet,
                     truth::Generator& generator) {
  const bool turn = secret.either_sign && std::bernoulli_distribution(0.5)(generator);
  const double amount = secret.amount(size, sheet);
  const truth::Geometry& g = sheet.geometry;
  if (secret.dimension == truth::Dimension::gear_inertia && 2.0 * amount > g.gear_inertia + g.mass * g.arm * g.arm)
    return amount;  // no gear is lighter than nothing
  return turn ? -amount : amount;
}

/// A drive with an encoder, a rate and a duration.
void draw_bench(Case& drawn, truth::Generator& generator) {
  constexpr double rates[] = {250, 500, 1000, 2000, 4000};
  drawn.stated = truth::any_drive(generator);
  drawn.conditions.counts = drawn.stated.sensor.counts;
  drawn.period = 1.0 / rates[std::uniform_int_distribution<std::size_t>(0, std::size(rates) - 1)(generator)];
  drawn.duration = over_decades(8.0, 40.0, generator);
  drawn.duration = std::round(drawn.duration / drawn.period) * drawn.period;
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
    case Kind::stated_off: return "stated_off";
    case Kind::outside: return "outside";
  }
  return {};
}

Kind kind(std::string_view sought) {
  for (const Kind k : {Kind::single, Kind::nothing, Kind::pair, Kind::cancelling, Kind::stated_off, Kind::outside})
    if (name(k) == sought) return k;
  throw std::invalid_argument("a campaign hides single, nothing, pair, cancelling, stated_off or outside, not " +
                              std::string(sought));
}

double over_decades(double low, double high, truth::Generator& generator) {
  return low * std::pow(high / low, std::uniform_real_distribution<double>(0.0, 1.0)(generator));
}

std::vector<Case> draw(const Plan& plan) {
  truth::Generator generator(plan.seed);
  const std::vector<const truth::Secret*> secrets = pool(plan);
  std::vector<Case> cases;
  for (long k = 0; k < plan.cases; ++k) {
    Case drawn{plan.kind, plan.conditions, generator(), {}, plan.duration, plan.period};
    if (plan.any_bench) draw_bench(drawn, generator);
    const truth::Sheet& sheet = drawn.stated.sheet;
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
        hide(secret, signed_amount(secret, size, sheet, generator));
        break;
      }
      case Kind::pair: {
        const truth::Secret* first = one_of(secrets, generator);
        const truth::Secret* second = first;
        while (same_or_twin(second->effect, *first)) second = one_of(secrets, generator);
        for (const truth::Secret* secret : {first, second})
          hide(*secret, signed_amount(*secret, size, sheet, generator));
        break;
      }
      case Kind::stated_off: {
        const truth::Secret* effect = one_of(secrets, generator);
        while (is_stated(*effect)) effect = one_of(secrets, generator);
        hide(*effect, signed_amount(*effect, size, sheet, generator));
        const StatedParameter number = one_of(stated_parameters(sheet), generator);
        const double off = number.tolerance * std::uniform_real_distribution(5.0, 20.0)(generator);
        hide(truth::secret(number.effect), std::bernoulli_distribution(0.5)(generator) ? -off : off);
        break;
      }
      case Kind::cancelling: {
        const Cancelling& pair = cancelling_pairs[in_turn % std::size(cancelling_pairs)];
        const truth::Secret &first = truth::secret(pair.first), &second = truth::secret(pair.second);
        const double amount = signed_amount(first, size, sheet, generator);
        hide(first, amount);
        hide(second, pair.sign * std::copysign(second.amount(size, sheet), amount));
        break;
      }
    }
    cases.push_back(std::move(drawn));
  }
  return cases;
}

/// Of teeth that an encoder on the worm does not see yield [N/m].
constexpr double rigid_teeth = 1e9;

wormdrive::Scenario data_sheet(const Conditions& conditions, const truth::Sheet& stated) {
  const truth::Geometry& g = stated.geometry;
  wormdrive::Scenario sheet;
  sheet.title = "test bench";
  sheet.mesh = wormdrive::MeshParameters<double>{.i = g.ratio,
                                                 .lambda = g.lead_angle,
                                                 .phi_n = g.pressure_angle,
                                                 .lw = g.worm_radius,
                                                 .lg = g.gear_radius,
                                                 .mu = stated.friction,
                                                 .Jw = g.worm_inertia,
                                                 .Jg = g.gear_inertia};
  wormdrive::GravityArm arm;
  arm.mass = g.mass;
  arm.arm = g.arm;
  sheet.load = arm;
  sheet.run.duration = 24.0;
  const truth::NominalErrors errors = conditions.errors.share > 0.0 ? stated_errors : truth::NominalErrors{};
  sheet.tolerance =
      wormdrive::Tolerances{.friction = errors.share,
                            .load = errors.share,
                            .load_angle = errors.angle,
                            .worm_inertia = errors.share,
                            .gear_inertia = errors.share,
                            .torque_gain = errors.share,
                            .torque_offset = errors.offset * times_usual(truth::Dimension::worm_torque, stated)};
  return sheet;
}

truth::Drive disturbed_drive(const Case& drawn, truth::Generator& generator) {
  truth::Drive drive = drawn.stated;
  const double torque = times_usual(truth::Dimension::worm_torque, drive.sheet);
  drive.noise.coloured = drawn.conditions.coloured_torque * torque;
  drive.sensor.counts = drawn.conditions.counts;
  drive.sensor.worm_counts = drawn.conditions.worm_counts;
  if (drawn.conditions.worm_counts > 0.0) drive.teeth.stiffness = rigid_teeth;
  truth::NominalErrors errors = drawn.conditions.errors;
  errors.offset *= torque;
  truth::disturb_nominal(drive, errors, generator);
  for (const Hiding& hiding : drawn.hidden) hiding.secret->hide(drive, hiding.amount, generator);
  return drive;
}

truth::Recording recorded_motion(const truth::Drive& drive, const truth::EventSequence& course,
                                 const wormdrive::Scenario& sheet, std::uint64_t seed, double jitter) {
  truth::Sheet stated = drive.sheet;
  if (const auto* arm = std::get_if<wormdrive::GravityArm>(&sheet.load); arm && arm->mass)
    stated.geometry.mass = *arm->mass;
  const auto law = truth::follow(course, stated);
  const double duration = static_cast<double>(course.angle.size()) * course.period;
  truth::RecordingSettings settings{.duration = duration,
                                    .period = course.period,
                                    .jitter = jitter,
                                    .start_angle = course.angle.front(),
                                    .seed = seed};
  if (jitter > 0.0) settings.step = std::min(settings.step, 0.01 * course.period);  // jitter is whole steps
  const double steps = std::ceil(course.period / settings.step - 1e-6);
  if (std::abs(steps * settings.step / course.period - 1.0) > 1e-9) settings.step = course.period / steps;
  return truth::record(drive, law, settings);
}

wormdrive::Recording as_read(const truth::Recording& recorded, const wormdrive::Scenario& sheet, std::uint64_t seed) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() /
                                     ("recovery_" + std::to_string(getpid()) + "_" + std::to_string(seed) + ".csv");
  truth::write_csv(recorded, file.string());
  wormdrive::Recording recording;
  try {
    recording = wormdrive::read_recording(file.string(), sheet);
  } catch (...) {
    std::filesystem::remove(file);
    throw;
  }
  std::filesystem::remove(file);
  recording.name = "recording";
  return recording;
}

wormdrive::Recording follow(const truth::Drive& drive, const truth::EventSequence& course,
                            const wormdrive::Scenario& sheet, std::uint64_t seed) {
  return as_read(recorded_motion(drive, course, sheet, seed), sheet, seed);
}

Followed followed(const Case& drawn) {
  truth::Generator generator(drawn.seed);
  Followed bench{disturbed_drive(drawn, generator), {}};
  const auto course = truth::rich_course(generator(), drawn.duration, drawn.period);
  bench.recorded = recorded_motion(bench.drive, course, data_sheet(drawn), generator(), drawn.jitter);
  return bench;
}

Bench record(const Case& drawn) {
  Followed bench = followed(drawn);
  return {std::move(bench.drive), as_read(bench.recorded, data_sheet(drawn), drawn.seed)};
}

Outcome outcome(const Case& drawn, const Diagnose& diagnose, const std::function<void(truth::Recording&)>& logger) {
  try {
    Followed bench = followed(drawn);
    if (logger) logger(bench.recorded);
    const wormdrive::Scenario sheet = data_sheet(drawn);
    const wormdrive::Recording recording = as_read(bench.recorded, sheet, drawn.seed);
    const auto start = std::chrono::steady_clock::now();
    const wormdrive::Diagnosis found = diagnose(sheet, {recording});
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    Outcome judged = judge(drawn, bench.drive, found);
    judged.seconds = took.count();
    return judged;
  } catch (const std::exception& fault) {
    Outcome failed;
    failed.drawn = drawn;
    failed.told = fault.what();
    return failed;
  }
}

std::vector<Outcome> run(const std::vector<Case>& cases, const Diagnose& diagnose, int threads,
                         const std::function<void(const Outcome&)>& listen) {
  std::vector<Outcome> outcomes(cases.size());
  std::atomic<std::size_t> next{0};
  std::mutex one_at_a_time;
  const auto work = [&] {
    for (std::size_t k = next++; k < cases.size(); k = next++) {
      outcomes[k] = outcome(cases[k], diagnose);
      const std::lock_guard lock(one_at_a_time);
      if (listen) listen(outcomes[k]);
    }
  };
  std::vector<std::thread> crew;
  for (int k = 1; k < threads; ++k) crew.emplace_back(work);
  work();
  for (std::thread& worker : crew) worker.join();
  return outcomes;
}

}  // namespace recovery
