#include "recovery/programs/mistakes.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "description/diagnostics.hpp"
#include "recovery/spoiled_torque.hpp"
#include "recovery/tables.hpp"
#include "statistics/parallel.hpp"

namespace recovery {
namespace {

using wormdrive::Scenario, truth::Generator;
using Record = truth::Recording;

double between(double low, double high, Generator& generator) {
  return std::uniform_real_distribution<double>(low, high)(generator);
}

/// A factor over decades, not so near 1 that nobody minds.
double factor(double low, double high, Generator& generator) {
  for (;;) {
    const double f = over_decades(low, high, generator);
    if (f < 0.8 || f > 1.25) return f;
  }
}

wormdrive::MeshParameters<double>& mesh(Scenario& sheet) {
  return std::get<wormdrive::MeshParameters<double>>(sheet.mesh);
}
wormdrive::GravityArm& arm(Scenario& sheet) { return std::get<wormdrive::GravityArm>(sheet.load); }

std::string times(std::vector<double>& column, double f) {
  for (double& x : column) x *= f;
  return fmt::format("x {:.3g}", f);
}

double largest(const std::vector<double>& column) {
  double most = 0.0;
  for (const double x : column) most = std::max(most, std::abs(x));
  return most;
}

}  // namespace

std::vector<Mistake> slips() {
  return {{"inertia",
           [](Scenario& sheet, Record&, Generator& generator) {
             wormdrive::GravityArm& load = arm(sheet);
             const double f = factor(0.2, 10.0, generator), all = mesh(sheet).Jg + load.inertia();
             load.amplitude = load.torque_amplitude();
             load.mass = load.arm = {};
             mesh(sheet).Jg = all / f;
             return fmt::format("x {:.3g}", f);
           },
           {"gear_inertia"},
           {}},
          {"angle of the arm",
           [](Scenario& sheet, Record&, Generator& generator) {
             double off = 0.0;
             while (std::abs(off) < 0.1) off = between(-std::numbers::pi, std::numbers::pi, generator);
             arm(sheet).offset += off;
             return fmt::format("{:+.3g} rad", off);
           },
           {"load_angle"},
           {}},
          {"torque constant",
           [](Scenario&, Record& recorded, Generator& generator) {
             return times(recorded.motor_torque, factor(0.1, 10.0, generator));
           },
           {"torque_gain"},
           {"wrong unit", "when it is read in m"}},
          {"friction",
           [](Scenario& sheet, Record&, Generator& generator) {
             double f = 1.0;
             while (std::abs(f - 1.0) < 0.2) f = between(0.0, 3.0, generator);
             mesh(sheet).mu *= f;
             return fmt::format("x {:.3g}", f);
           },
           {"mesh_friction"},
           {}},
          {"ratio",
           [](Scenario& sheet, Record&, Generator& generator) {
             const double f = factor(0.5, 2.0, generator);
             mesh(sheet).i *= f;
             return fmt::format("x {:.3g}", f);
           },
           {},
           {"a ratio of "}},
          {"load forgotten",
           [](Scenario& sheet, Record&, Generator&) {
             sheet.load = wormdrive::Signal{};
             return std::string();
           },
           {},
           {"state the [load]"}},
          {"sign",
           [](Scenario&, Record& recorded, Generator& generator) {
             const bool of_torque = generator() % 2 == 0;
             times(of_torque ? recorded.motor_torque : recorded.gear_angle, -1.0);
             return std::string(of_torque ? "of the torque" : "of the angle");
           },
           {},
           {"with the opposite sign"}}};
}

std::vector<Mistake> recording_faults() {
  return {{"bad torque samples",
           [](Scenario&, Record& recorded, Generator& generator) {
             const double size = largest(recorded.motor_torque) * factor(1.5, 30.0, generator);
             const auto bad = 3 + generator() % 18;
             for (std::size_t k = 0; k < bad; ++k)
               recorded.motor_torque[100 + generator() % (recorded.time.size() - 200)] = k % 2 == 0 ? size : -size;
             return fmt::format("{} of {:.2g} N m", bad, size);
           },
           {"torque_spikes"},
           {"left out: motor_torque"},
           true},
          {"torque late",
           [](Scenario&, Record& recorded, Generator& generator) {
             const auto late = static_cast<double>(1 + generator() % 8);
             reread(recorded.motor_torque, [&](double k) { return k - late; });
             return fmt::format("{:g} samples", late);
           },
           {"torque_late"},
           {}},
          {"torque filtered",
           [](Scenario&, Record& recorded, Generator& generator) {
             const double samples = factor(0.5, 20.0, generator);
             filter(recorded.motor_torque, samples);
             return fmt::format("{:.3g} samples", samples);
           },
           {"torque_filtered"},
           {}},
          {"torque in m N m",
           [](Scenario&, Record& recorded, Generator&) { return times(recorded.motor_torque, 1e3); },
           {},
           {"when it is read in mN m"}},
          {"angle in degrees",
           [](Scenario&, Record& recorded, Generator&) { return times(recorded.gear_angle, 180.0 / std::numbers::pi); },
           {},
           {"when it is read in degrees"}},
          {"columns swapped",
           [](Scenario&, Record& recorded, Generator&) {
             std::swap(recorded.motor_torque, recorded.gear_angle);
             return std::string();
           },
           {},
           {"when they are swapped"}},
          {"a mean of two rows' torques",
           [](Scenario&, Record& recorded, Generator&) {
             for (std::size_t k = recorded.time.size() - 1; k > 0; --k)
               recorded.motor_torque[k] = 0.5 * (recorded.motor_torque[k] + recorded.motor_torque[k - 1]);
             return std::string();
           },
           {"torque_late", "torque_filtered"},
           {},
           true},
          {"coarse encoder",
           [](Scenario&, Record& recorded, Generator& generator) {
             const double counts = std::round(factor(1000.0, 4000.0, generator)),
                          step = 2.0 * std::numbers::pi / counts;
             for (double& angle : recorded.gear_angle) angle = step * std::round(angle / step);
             return fmt::format("{:g} counts", counts);
           },
           {},
           {},
           true},
          {"clock of the torque",
           [](Scenario&, Record& recorded, Generator& generator) {
             const double share = std::pow(10.0, between(-3.5, -2.0, generator));
             reread(recorded.motor_torque, [&](double k) { return k - share * k; });
             return fmt::format("{:.2g}", share);
           },
           {"clock_drift"},
           {},
           false,
           {"torque_late", "torque_filtered"}},
          {"time scale",
           [](Scenario&, Record& recorded, Generator& generator) {
             return times(recorded.time, factor(0.5, 2.0, generator));
           },
           {"time_scale"},
           {}}};
}

namespace {

Judged judged(const Mistake& mistake, const Case& bench, const Diagnose& diagnose) {
  Generator generator(bench.seed + 1);  // the bench has its own
  Scenario sheet = data_sheet(bench);
  truth::Recording recorded = followed(bench).recorded;
  Judged j{mistake.name, mistake.make(sheet, recorded, generator)};
  const auto tells = [&](const std::string& said) {
    return std::any_of(mistake.words.begin(), mistake.words.end(),
                       [&](std::string_view word) { return said.find(word) != std::string::npos; });
  };
  const auto is_among = [](const std::vector<std::string_view>& effects, std::string_view effect) {
    return std::ranges::find(effects, effect) != effects.end();
  };
  try {
    const wormdrive::Diagnosis d = diagnose(sheet, {as_read(recorded, sheet, bench.seed)});
    j.answer = d.sentence;
    bool told = tells(d.sentence);
    for (const std::string& remark : d.remarks) told = told || tells(remark);
    const bool claims = d.verdict == wormdrive::Verdict::named || d.verdict == wormdrive::Verdict::ambiguous;
    std::size_t right = 0, others = 0;
    for (const auto& cause : d.causes)
      if (is_among(mistake.effects, cause.effect))
        ++right;
      else if (!is_among(mistake.follow, cause.effect))
        ++others;
    bool in_class = false;
    for (const auto& of_class : d.classes)
      for (const std::string& member : of_class) in_class = in_class || is_among(mistake.effects, member);
    if (told)
      j.score = Score::exact;
    else if (!claims || d.causes.empty())
      j.score = mistake.may_be_harmless && d.verdict == wormdrive::Verdict::adequate ? Score::exact : Score::silent;
    else if (right > 0 && others == 0 && !in_class)
      j.score = Score::exact;
    else if (in_class && d.causes.size() == 1)
      j.score = Score::in_class;
    else
      j.score = right > 0 ? Score::extra : Score::wrong;
  } catch (const wormdrive::InputFault& fault) {
    j.answer = fault.what();
    j.score = tells(j.answer) ? Score::exact : Score::crash;
  }
  return j;
}

}  // namespace

std::vector<Judged> mistakes(const std::vector<Mistake>& all, const Plan& plan, const Diagnose& diagnose, int threads) {
  Plan nothing = plan;
  nothing.kind = Kind::nothing;
  nothing.effects.clear();
  const std::vector<Case> benches = draw(nothing);
  std::vector<std::size_t> made;  // a mistake has the same benches whichever others are made
  for (std::size_t k = 0; k < benches.size(); ++k)
    if (plan.effects.empty() || std::ranges::count(plan.effects, all[k % all.size()].name) > 0) made.push_back(k);
  std::vector<Judged> outcomes(made.size());
  wormdrive::parallel_for(made.size(), threads, [&](std::size_t k) {
    outcomes[k] = judged(all[made[k] % all.size()], benches[made[k]], diagnose);
    std::cout << fmt::format("{} {}: {} -> {}\n", outcomes[k].mistake, outcomes[k].size, name(outcomes[k].score),
                             outcomes[k].answer)
              << std::flush;
  });
  return outcomes;
}

std::string table(const std::vector<Judged>& judged) {
  std::string text =
      "| mistake | n | told | in class | beside another name | silent | wrong | another rejection |\n"
      "|---|---|---|---|---|---|---|---|\n";
  constexpr Score columns[] = {Score::exact, Score::in_class, Score::extra, Score::silent, Score::wrong, Score::crash};
  std::map<std::string_view, std::map<Score, long>> rows;
  for (const Judged& j : judged) {
    ++rows[j.mistake][j.score];
    ++rows["all"][j.score];
  }
  const auto row = [&](std::string_view title) {
    long n = 0;
    std::vector<long> counts;
    for (const Score score : columns) n += counts.emplace_back(rows[title][score]);
    text += fmt::format("| {} | {} | {} |\n", title, n, fmt::join(counts, " | "));
  };
  std::vector<std::string_view> seen;
  for (const Judged& j : judged)
    if (std::find(seen.begin(), seen.end(), j.mistake) == seen.end()) row(seen.emplace_back(j.mistake));
  row("all");
  return text;
}

}  // namespace recovery
