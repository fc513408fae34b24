#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "judge/drive.hpp"

namespace wormdrive::test::near_ties {

/// Teeth that bend: stiffness [N/m], damping of the limited law [N s/m], gap [rad].
struct Elastic {
  double stiffness, damping, gap;
};

/// A drive under inputs of which something almost touches something.
struct Case {
  judge::Drive drive;
  std::optional<Elastic> elastic;
  double report = 0.0;       ///< interval of the reports [s]
  double sample = 0.0;       ///< period of samples that change nothing [s], 0 for none
  std::string tie;           ///< what touches what
  double excess = 0.0;       ///< by which share it goes beyond
  double tolerance = 1e-12;  ///< relative, of every run; the absolute one is that of a hundredth of a radian in its run
};

/// Motion of the worm, flank, motion of the gear; the last is 0 for rigid teeth.
using Modes = std::array<int, 3>;
struct Change {
  double t;
  Modes before, after;
};

/// What a solver made of a case.
struct ProgramRun {
  std::string halt;    ///< why it did not come to its end; empty if it did
  std::string broken;  ///< the first record that contradicts its own mode; empty if none does
  Modes start{};       ///< behind the settling at the start
  std::vector<Change> changes;
  double theta = 0.0, omega = 0.0;           ///< of the gear at the end
  long steps = 0;                            ///< of the solver
  std::vector<std::vector<double>> reports;  ///< angle and speed of every shaft at every report
};

enum class By { bdf, adams, taylor };
constexpr const char* name(By by) {
  switch (by) {
    case By::bdf: return "cvode BDF";
    case By::adams: return "cvode Adams";
    case By::taylor: return "taylor";
  }
  return "";
}

double absolute_tolerance(const Case& tie, By by);

/// Runs a case by one of the program's solvers.
ProgramRun run(const Case& tie, By by);

}  // namespace wormdrive::test::near_ties
