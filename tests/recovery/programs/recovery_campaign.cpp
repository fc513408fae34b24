// Hides effects, has them diagnosed, and writes what came of it; `recovery_campaign --help`.
#include <fstream>
#include <iostream>

#include <CLI/CLI.hpp>

#include "diagnosis/diagnose.hpp"
#include "recovery/tables.hpp"

int main(int argc, char** argv) {
  CLI::App app{"Hides effects in a ground truth and has them diagnosed."};
  std::string kind = "single", conditions = "ideal", output;
  std::vector<std::string> sizes{"small", "medium", "large"};
  recovery::Plan plan;
  bool worm_encoder = false;
  int threads = 2;
  app.add_option("--hide", kind, "single, nothing, pair, cancelling or outside");
  app.add_option("--conditions", conditions, "ideal, coloured, realistic or double");
  app.add_option("--sizes", sizes, "small, medium, large")->delimiter(',');
  app.add_option("--effects", plan.effects, "only these")->delimiter(',');
  app.add_option("--cases", plan.cases, "how many recordings");
  app.add_option("--seed", plan.seed, "of everything that is drawn");
  app.add_option("--duration", plan.duration, "of a recording [s]");
  app.add_option("--threads", threads, "recordings at a time");
  app.add_flag("--worm-encoder", worm_encoder, "with an encoder of 4096 counts on the worm");
  app.add_option("--output", output, "file to which the tables are appended");
  CLI11_PARSE(app, argc, argv);
  try {
    plan.kind = recovery::kind(kind);
    plan.conditions = recovery::conditions(conditions);
    if (worm_encoder) plan.conditions.worm_counts = 4096;
    plan.sizes.clear();
    for (const truth::Size size : truth::sizes)
      if (std::find(sizes.begin(), sizes.end(), name(size)) != sizes.end()) plan.sizes.push_back(size);
    if (plan.sizes.empty()) throw std::invalid_argument("sizes are small, medium or large");
    const recovery::Diagnose diagnose = [&](const auto& sheet, const auto& recordings) {
      return wormdrive::diagnose(sheet, recordings, {.threads = 1});
    };
    const auto outcomes = recovery::run(recovery::draw(plan), diagnose, threads,
                                        [](const recovery::Outcome& o) { std::cout << line(o) << std::endl; });
    const std::string text = recovery::tables(plan, outcomes);
    std::cout << "\n" << text;
    if (!output.empty() && !(std::ofstream(output, std::ios::app) << text).flush())
      throw std::runtime_error("cannot write " + output);
  } catch (const std::exception& fault) {
    std::cerr << "recovery_campaign: " << fault.what() << "\n";
    return 2;
  }
}
