// Hides effects, has them diagnosed, and writes what came of it; `recovery_campaign --help`.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "diagnosis/diagnose.hpp"
#include "recovery/programs/experiments.hpp"
#include "recovery/programs/logs.hpp"
#include "recovery/programs/mistakes.hpp"
#include "recovery/programs/thresholds.hpp"
#include "recovery/tables.hpp"

namespace {

using recovery::Kind, recovery::Plan;
using truth::Size;

/// Everything of which docs/diagnosis_benchmark.md tells; `scale` is a share of the recordings.
std::vector<Plan> benchmark(std::uint64_t seed, double scale) {
  const std::vector<Size> all(std::begin(truth::sizes), std::end(truth::sizes)), upper{Size::medium, Size::large};
  std::vector<Plan> plans;
  const auto add = [&](Kind kind, std::string_view conditions, const std::vector<Size>& sizes, double cases) {
    plans.push_back({.kind = kind,
                     .conditions = recovery::conditions(conditions),
                     .sizes = sizes,
                     .cases = std::max(1L, std::lround(scale * cases)),
                     .seed = seed++});
    return &plans.back();
  };
  add(Kind::single, "ideal", all, 156);
  add(Kind::single, "realistic", all, 156);
  add(Kind::single, "double", upper, 52);
  add(Kind::nothing, "ideal", all, 75);
  add(Kind::nothing, "coloured", all, 75);
  add(Kind::nothing, "realistic", all, 150);
  add(Kind::nothing, "double", all, 100);
  add(Kind::pair, "ideal", upper, 70);
  add(Kind::cancelling, "ideal", upper, 32);
  add(Kind::stated_off, "realistic", upper, 60);
  add(Kind::outside, "ideal", upper, 60);
  Plan* const with_worm = add(Kind::single, "ideal", all, 27);
  with_worm->effects = {"backlash", "tooth_compliance", "transmission_error"};
  with_worm->conditions.worm_counts = 4096;
  return plans;
}

constexpr const char* head = R"(# Benchmark of the diagnosis

Written by `recovery_campaign --all --output FILE` with seed {} and {:g} of the full number of recordings. A
[ground truth](../tests/recovery/truth/drive.hpp) that shares no code with the program hides effects in simulated
recordings; the diagnosis sees only a data sheet and a CSV file. Each size of an effect is three times the one before
([tests/recovery/truth/hidden.cpp](../tests/recovery/truth/hidden.cpp)).

| conditions | nominal values | coloured torque noise, 50 ms | encoder |
|---|---|---|---|
| ideal | exact | none | 65536 counts |
| coloured | exact | 0.5 mN m | 65536 counts |
| realistic | off by 1 %, 0.5 deg, 0.3 mN m (standard deviations), as stated | 0.5 mN m | 16384 counts |
| double | off by twice as much as stated | 0.5 mN m | 16384 counts |

If the nominal values are exact, the data sheet says so (`[tolerance]` 0); otherwise it states 1 %. White torque noise
of 0.5 mN m and encoder noise of 3e-5 rad are always present.

| score | the diagnosis names |
|---|---|
| exact | exactly the hidden effects; nothing if nothing was hidden |
| in class | a class of effects that the data cannot distinguish and that contains the hidden one |
| off | in addition only stated parameters that are wrong by 2.5 tolerances or more |
| partial | some of several hidden effects, nothing else |
| extra | the hidden effects and another one |
| silent | nothing, although something was hidden |
| wrong | an effect that was not hidden |

| row or column | meaning |
|---|---|
| `observable` | effects that are nameable according to the certificate of the same diagnosis |
| `flagged` | diagnoses that report something unexplained |
| `class` | mean size of the class |
| `error` | median error of the named parameters, error of the nominal values included |
| `covered` | share of the 95 % intervals of named parameters that contain the true value |
| `calibrated` | the same of stated parameters that moved, where the answer is exact |
| `held out` | median ratio of the prediction error 0.25 s ahead on held-out data to that of noise alone |

)";

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Hides effects in simulated recordings and counts how often the diagnosis finds them."};
  std::string kind = "single", conditions = "ideal", output;
  std::vector<std::string> sizes{"small", "medium", "large"};
  Plan plan;
  bool worm_encoder = false, all = false;
  int threads = 2;
  double scale = 1.0;
  app.add_option(
      "--hide", kind,
      "what is hidden: single, nothing, pair, cancelling, stated_off (an effect beside a stated parameter that is far "
      "off) or outside (of the catalogue); or a study: thresholds (the "
      "smallest size that is named), unseen (motions that cannot show the effect), experiments (proposed ones), slips "
      "(in the data sheet), faults (of the recording), logs (that are uneven, beside clean ones of the same benches)");
  app.add_option("--conditions", conditions, "ideal, coloured, realistic or double");
  app.add_option("--sizes", sizes, "sizes of the effects: small, medium, large")->delimiter(',');
  app.add_option("--effects", plan.effects, "hide only these effects, or make only these mistakes")->delimiter(',');
  app.add_option("--cases", plan.cases, "number of recordings");
  app.add_option("--seed", plan.seed, "seed of all random numbers");
  app.add_option("--duration", plan.duration, "of a recording [s]");
  app.add_flag("--any-bench", plan.any_bench, "drives, encoders, rates and durations are drawn, too");
  app.add_option("--threads", threads, "recordings at a time");
  app.add_flag("--worm-encoder", worm_encoder, "with an encoder of 4096 counts on the worm");
  app.add_flag("--all", all, "every campaign of the benchmark page instead");
  app.add_option("--scale", scale, "share of the benchmark's recordings");
  app.add_option("--output", output, "Markdown file to write");
  CLI11_PARSE(app, argc, argv);
  try {
    constexpr std::string_view studies[] = {"thresholds", "unseen", "experiments", "slips", "faults", "logs"};
    const bool special = std::find(std::begin(studies), std::end(studies), kind) != std::end(studies);
    plan.kind = special ? Kind::single : recovery::kind(kind);
    plan.conditions = recovery::conditions(conditions);
    if (worm_encoder) plan.conditions.worm_counts = 4096;
    plan.sizes.clear();
    for (const Size size : truth::sizes)
      if (std::find(sizes.begin(), sizes.end(), name(size)) != sizes.end()) plan.sizes.push_back(size);
    if (plan.sizes.empty()) throw std::invalid_argument("sizes are small, medium or large");
    const recovery::Diagnose diagnose = [&](const auto& sheet, const auto& recordings) {
      return wormdrive::diagnose(sheet, recordings, {.threads = 1});
    };
    std::string text = all ? fmt::format(head, plan.seed, scale) : "";
    const auto add = [&](const std::string& more) {
      text += more;
      // a long campaign leaves what it has
      if (!output.empty() && !(std::ofstream(output) << text).flush())
        throw std::runtime_error("cannot write " + output);
    };
    if (!special)
      for (const Plan& one : all ? benchmark(plan.seed, scale) : std::vector<Plan>{plan})
        add(recovery::tables(one, recovery::run(recovery::draw(one), diagnose, threads,
                                                [](const auto& outcome) { std::cout << line(outcome) << std::endl; })));
    if (all || kind == "thresholds") add("### Thresholds\n\n" + table(recovery::thresholds(plan, diagnose)));
    if (all || kind == "unseen")
      add("\n### Motions that cannot show it\n\n" + table(recovery::unseen(plan.seed, diagnose)));
    if (all || kind == "experiments") {
      plan.effects = {"mesh_friction",      "worm_coulomb",  "gear_coulomb", "load_magnitude", "torque_gain",
                      "friction_asymmetry", "torque_offset", "worm_viscous", "gear_viscous",   "stribeck"};
      plan.cases = std::max(1L, std::lround(scale * 40));
      plan.sizes = {Size::medium, Size::large};
      plan.duration = 12.0;
      add("\n### Experiments\n\n" + table(recovery::experiments(plan, diagnose)));
    }
    if (kind == "slips") add(table(recovery::mistakes(recovery::slips(), plan, diagnose, threads)));
    if (kind == "faults") add(table(recovery::mistakes(recovery::recording_faults(), plan, diagnose, threads)));
    if (kind == "logs") add(table(recovery::logs(plan, diagnose, threads)));
    std::cout << "\n" << text;
  } catch (const std::exception& fault) {
    std::cerr << "recovery_campaign: " << fault.what() << "\n";
    return 2;
  }
}
