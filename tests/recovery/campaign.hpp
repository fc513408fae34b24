#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "diagnosis/data/recording.hpp"
#include "diagnosis/diagnosis.hpp"
#include "recovery/truth/excitation.hpp"
#include "recovery/truth/hidden.hpp"
#include "recovery/truth/recording.hpp"

namespace recovery {

/// How far a bench is from its data sheet, and how well it measures.
struct Conditions {
  std::string_view name;
  truth::NominalErrors errors;
  double coloured_torque = 0.0;  ///< [N m]
  double counts = 65536;         ///< of the gear's encoder
  double worm_counts = 0.0;      ///< of the worm's; 0: none
};

/// What the data sheet promises: 1 %, half a degree, 0.3 mN m.
inline constexpr truth::NominalErrors stated_errors{
    .share = 0.01, .angle = 0.5 * std::numbers::pi / 180, .offset = 3e-4};

/// "ideal", "realistic", "coloured" (torque noise alone), "double" (twice the stated errors); throws
/// std::invalid_argument for another name.
Conditions conditions(std::string_view name);

/// What a campaign hides.
enum class Kind {
  single,
  nothing,
  pair,
  cancelling,
  stated_off,  ///< an effect, and a stated parameter that is off by 5 to 20 of its tolerances
  outside
};
Kind kind(std::string_view name);
std::string_view name(Kind kind);

/// One effect as it is hidden.
struct Hiding {
  const truth::Secret* secret;
  truth::Size size;
  double amount;  ///< with its sign
};

/// A bench with something hidden, drawn.
struct Case {
  Kind kind;
  Conditions conditions;
  std::uint64_t seed;
  std::vector<Hiding> hidden;
  double duration = 24.0, period = 1e-3;  ///< [s]
  truth::Drive stated{};                  ///< the drive as its data sheet has it
  double jitter = 0.0;                    ///< most by which a sample is early or late [periods]
};

/// What a campaign draws from.
struct Plan {
  Kind kind = Kind::single;
  Conditions conditions{};
  std::vector<truth::Size> sizes{truth::Size::small, truth::Size::medium, truth::Size::large};
  std::vector<std::string> effects{};  ///< of singles and outside; empty: all that these sensors show
  long cases = 100;
  std::uint64_t seed = 1;
  double duration = 24.0, period = 1e-3;  ///< [s]
  bool any_bench = false;                 ///< drives, encoders, rates and durations are drawn, too
};

/// Between two limits, each decade as likely as another.
double over_decades(double low, double high, truth::Generator& generator);

/// The cases of a plan: effects in turn, sizes in turn, everything else drawn from the seed.
std::vector<Case> draw(const Plan& plan);

/// What the data sheet says of the bench: all that the diagnosis is told. Where the nominal values are exact it says
/// so; else it states 1 %, also where the errors are larger.
wormdrive::Scenario data_sheet(const Conditions& conditions, const truth::Sheet& stated = {});
inline wormdrive::Scenario data_sheet(const Case& drawn) { return data_sheet(drawn.conditions, drawn.stated.sheet); }

/// The drive of a case, with what it recorded on a rich course.
struct Followed {
  truth::Drive drive;
  truth::Recording recorded;
};
Followed followed(const Case& drawn);

/// Records a case, writes it to a CSV file, and reads it as a user's.
struct Bench {
  truth::Drive drive;  ///< sealed: for the score alone
  wormdrive::Recording recording;
};
Bench record(const Case& drawn);

/// The drive of a case, with what is hidden in it.
truth::Drive disturbed_drive(const Case& drawn, truth::Generator& generator);

/// Follows a course as the data sheet's controller does.
truth::Recording recorded_motion(const truth::Drive& drive, const truth::EventSequence& course,
                                 const wormdrive::Scenario& sheet, std::uint64_t seed, double jitter = 0.0);
/// Writes a CSV file and reads it as a user's; the seed is part of the file's name. Throws InputFault if it is
/// rejected.
wormdrive::Recording as_read(const truth::Recording& recorded, const wormdrive::Scenario& sheet, std::uint64_t seed);
/// Both, one after the other.
wormdrive::Recording follow(const truth::Drive& drive, const truth::EventSequence& course,
                            const wormdrive::Scenario& sheet, std::uint64_t seed);

using Diagnose =
    std::function<wormdrive::Diagnosis(const wormdrive::Scenario&, const std::vector<wormdrive::Recording>&)>;

/// How a diagnosis compares with what was hidden.
enum class Score {
  exact,     ///< the effects, no more and no less; of effects with the same data one of them, or the class of them
  in_class,  ///< ambiguous, and the truth is of the class
  off,       ///< beside them, or where nothing was hidden, stated parameters that are off by far more than they may be
  partial,   ///< some of the effects, and nothing else
  extra,     ///< the truth and something beside
  silent,    ///< no name, though something was hidden
  wrong,     ///< a name that is not the truth
  crash      ///< an exception
};
inline constexpr Score scores[] = {Score::exact, Score::in_class, Score::off,   Score::partial,
                                   Score::extra, Score::silent,   Score::wrong, Score::crash};
std::string_view name(Score score);

/// How many 95 % intervals hold the truth.
struct Coverage {
  long intervals = 0, holding = 0;

  void count(const wormdrive::Estimate& estimate, double truth) {
    ++intervals;
    holding += estimate.low <= truth && truth <= estimate.high;
  }
  Coverage& operator+=(const Coverage& more) {
    intervals += more.intervals;
    holding += more.holding;
    return *this;
  }
};

struct Outcome {
  Case drawn;
  Score score = Score::crash;
  bool flagged = false;            ///< unexplained, or something remains
  bool observable = true;          ///< what is hidden is large enough to be named, by the diagnosis' own certificate
  std::vector<std::string> named;  ///< causes
  std::size_t class_size = 1;
  std::vector<double> errors;      ///< of the named causes' parameters, as shares of the truth
  std::vector<double> deviations;  ///< of all their parameters, in standard errors
  Coverage causes, calibrated;     ///< intervals of the causes; of stated parameters that moved beside the right ones
  double held_out = 0.0;           ///< 0.25 s prediction error after over the noise floor; 0: not told
  double improved = 0.0;           ///< the same over that of the stated drive; 0: not told
  double seconds = 0.0;
  std::string told;  ///< the sentence, or the exception's words
};

/// Whether a name is that of what is hidden, or of something with exactly the same data.
bool same_or_twin(std::string_view named, const truth::Secret& secret);

/// What a certificate says of an effect as it is in a drive, null if it says nothing.
const wormdrive::Visibility* visibility(const wormdrive::Diagnosis& found, std::string_view effect,
                                        const truth::Drive& drive);

/// Compares names and parameters; the drive is the truth.
Outcome judge(const Case& drawn, const truth::Drive& drive, const wormdrive::Diagnosis& found);

/// Records a case, with what a logger does to it, and diagnoses it; what goes wrong is told in the outcome.
Outcome outcome(const Case& drawn, const Diagnose& diagnose, const std::function<void(truth::Recording&)>& logger = {});

/// Records and diagnoses every case, on several threads; the outcomes stand in the order of the cases. `listen` is
/// called after every case, by one thread at a time.
std::vector<Outcome> run(const std::vector<Case>& cases, const Diagnose& diagnose, int threads,
                         const std::function<void(const Outcome&)>& listen = {});

}  // namespace recovery
