#pragma once
#include <functional>
#include <string>
#include <vector>

namespace bench {

/// Where a run ended and what it took.
struct Outcome {
  double theta, omega;  ///< [rad], [rad/s]
  long evaluations;     ///< of the acceleration; of its power series where a solver works with one
  int events;
};

/// A contender that is set up for one tolerance: the run that is timed and, where a controller's rounding could part
/// its way from the others, the one on a recorded torque that is compared.
struct Prepared {
  std::function<Outcome()> timed, compared;
};

struct Contender {
  std::string name;
  std::function<Prepared(double tolerance)> prepare;
  bool adjustable = true;  ///< false: it has no tolerance, and takes part as a limit
};

struct Contest {
  std::string title;
  double per;            ///< times are printed per this many seconds: 1e-6 for us of a run
  std::string per_what;  ///< "us per run"
  Outcome reference;
  std::vector<Contender> contenders;
};

/// CPU times [s] of repeated runs of one program.
class Timing {
 public:
  /// The k-th measurement, not counted if k < 0. How stack and heap lie to each other can change a time by more than
  /// what is compared here: every measurement shifts the stack, so that the median is over layouts and not that of the
  /// one which this process happens to have.
  void measure(const std::function<Outcome()>& run, int k);
  double median() const;
  double total() const { return total_; }

 private:
  std::vector<double> times_;
  double total_ = 0.0;
};

/// How the programs are called: [--rows] [--repetitions N].
struct Options {
  bool rows = false;  ///< tab-separated values for bench/run.py instead of a table
  int repetitions = 31;
};
Options options(int argc, char** argv);

/// Finds for every contender the loosest tolerance that reaches `accuracy`, times all in turn and prints the table.
void hold(const Contest& contest, const Options& options);

inline constexpr double accuracy = 1e-10;  ///< of the end state [rad, rad/s]

}  // namespace bench
