#pragma once
#include <functional>
#include <string>
#include <vector>

#include "diagnosis/comparison.hpp"
#include "diagnosis/linear_system.hpp"

namespace wormdrive {

/// A suspect that was fitted beside a hypothesis.
struct Tried {
  std::size_t suspect;
  Hypothesis model;
  Evidence evidence;
};

/// A cause that was found, with the suspects that do as well.
struct Found {
  std::size_t suspect;
  std::vector<std::size_t> equals;  ///< other suspects within reach of its evidence
};

/// What the search for causes came to.
struct Selection {
  Hypothesis base;   ///< the scenario with its tolerances
  Hypothesis model;  ///< with the causes
  std::vector<Found> causes;
  std::vector<Tried> tried;  ///< suspects beside the base, the best first
  Screening screening;       ///< of the base
  LinearSystem linear{};     ///< of the base with it
};

/// Forward selection with backward elimination, then pairs of suspects that mask each other.
class CauseSearch {
 public:
  CauseSearch(const Evaluation& by, const std::vector<Suspect>& all, int most_causes,
              std::function<void(const std::string&)> progress)
      : by_(by), all_(all), most_causes_(most_causes), progress_(std::move(progress)) {}

  Selection operator()(Hypothesis base);

 private:
  void fit_base(Hypothesis& base) const;
  std::vector<Tried> try_suspects(const Hypothesis& current, bool first_round);
  std::vector<Screened> worth_fitting(const std::vector<Screened>& found) const;
  std::vector<Tried> try_plainly(const Hypothesis& current) const;
  void finish_with_noise_model(Hypothesis& h, const ProcessNoise& noise) const;
  bool matters(const Tried& with) const;
  bool stands(const Evidence& evidence, const Hypothesis& with, const Suspect& suspect) const;
  bool take_best(std::vector<Tried>& tried, bool first_round);
  void compare_fairly(Tried& with, bool base_too);
  void eliminate();
  void simplify();
  Hypothesis fit_causes(const std::vector<std::size_t>& causes, const Hypothesis* warm, int rounds) const;
  void try_pairs();
  void confirm_classes();
  void tell(const std::string& what) const {
    if (progress_) progress_(what);
  }

  const Evaluation& by_;
  const std::vector<Suspect>& all_;
  int most_causes_;
  std::function<void(const std::string&)> progress_;
  Selection s_;
};

}  // namespace wormdrive
