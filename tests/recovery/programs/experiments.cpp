#include "recovery/programs/experiments.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "recovery/tables.hpp"

namespace recovery {
namespace {

truth::EventSequence course_of(const wormdrive::Scenario& experiment) {
  std::vector<double> angle;
  const double period = truth::EventSequence{}.period;
  for (double t = 0.0; t < experiment.run.duration; t += period)
    angle.push_back(experiment.control->reference.at(t).angle);
  return truth::course_through(std::move(angle));
}

/// A slow motion that leaves classes; the smaller and slower the larger ones.
truth::EventSequence poor_course(truth::Generator& generator, double duration) {
  const double amplitude = over_decades(0.1, 0.8, generator);
  return truth::slow_course(amplitude, over_decades(0.06, 0.3, generator), duration);
}

}  // namespace

std::vector<Split> experiments(const Plan& plan, const Diagnose& diagnose) {
  std::vector<Split> splits;
  for (const Case& hidden : draw(plan)) {
    truth::Generator generator(hidden.seed);
    truth::Drive drive = disturbed_drive(hidden, generator);
    const wormdrive::Scenario sheet = data_sheet(hidden);
    const auto slow = follow(drive, poor_course(generator, hidden.duration), sheet, generator());
    const wormdrive::Diagnosis first = diagnose(sheet, {slow});
    const bool unexplained = first.verdict == wormdrive::Verdict::unexplained;
    if (!unexplained && judge(hidden, drive, first).score != Score::in_class) continue;
    Split split{hidden, first.classes.empty() ? std::vector<std::string>{} : first.classes[0],
                first.experiment.has_value()};
    if (split.proposed) {
      wormdrive::Scenario heavier = sheet;
      heavier.load = first.experiment->load;
      const double mass = *std::get<wormdrive::GravityArm>(heavier.load).mass;
      drive.geometry.mass *= mass / *std::get<wormdrive::GravityArm>(sheet.load).mass;
      auto second = follow(drive, course_of(*first.experiment), heavier, generator());
      second.load = heavier.load;
      const Outcome outcome = judge(hidden, drive, diagnose(sheet, {slow, second}));
      split.score = outcome.score;
      split.answer = answer(outcome);
    }
    splits.push_back(std::move(split));
  }
  return splits;
}

std::string table(const std::vector<Split>& splits) {
  std::string text = "| hidden | class before | after the experiment |\n|---|---|---|\n";
  long split = 0, proposed = 0;
  for (const Split& s : splits) {
    proposed += s.proposed;
    split += s.proposed && s.score == Score::exact;
    std::vector<std::string> what;
    for (const Hiding& h : s.hidden.hidden) what.push_back(fmt::format("{} {:+.3g}", h.secret->effect, h.amount));
    text += fmt::format("| {} | {} | {} |\n", fmt::join(what, ", "),
                        s.members.empty() ? "unexplained" : fmt::format("{}", fmt::join(s.members, ", ")),
                        s.proposed ? fmt::format("{} ({})", s.answer, name(s.score)) : "none was proposed");
  }
  return text + fmt::format("\nClasses with an experiment: {} of {}; split to the right name: {} of {}.\n", proposed,
                            splits.size(), split, proposed);
}

}  // namespace recovery
