#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/fitting/linear_system.hpp"
#include "diagnosis/inference/comparison.hpp"

namespace wormdrive {

/// A candidate that was fitted beside a hypothesis.
struct Tried {
  std::size_t candidate;
  Hypothesis model;
  Evidence evidence;
};

/// A cause that was found, with the candidates that do as well.
struct Found {
  std::size_t candidate;
  std::vector<std::size_t> equals;  ///< other candidates within reach of its evidence
};

/// Where a search for causes sets out.
struct Start {
  Hypothesis base;      ///< the scenario with its tolerances, fitted
  Screening screening;  ///< of the base
};

/// Fits what is stated and screens all candidates beside it.
Start fitted_start(const Evaluation& evaluation, const std::vector<Candidate>& all, Hypothesis base);

/// What the search for causes came to.
struct Selection {
  Hypothesis base;   ///< the scenario with its tolerances
  Hypothesis model;  ///< with the causes
  std::vector<Found> causes;
  std::vector<Tried> tried;                   ///< candidates beside the base, the best first
  std::vector<Screened> screened{};           ///< beside the base, the best first; without their signatures
  LinearSystem linear{};                      ///< of the base with these
  std::optional<std::size_t> beyond_bound{};  ///< the candidate that does far best, beyond what it can be
};

/// A search for causes, step by step.
class CauseSearch {
 public:
  CauseSearch(const Evaluation& evaluation, const std::vector<Candidate>& all, int most_causes,
              std::function<void(const std::string&)> progress)
      : evaluation_(evaluation), all_(all), most_causes_(most_causes), progress_(std::move(progress)) {}

  /// Forward selection with backward elimination. The candidates that do best at another start, if there is one, are
  /// tried as well.
  void select(Start start, const Start* other);
  /// Tries pairs of candidates that mask each other.
  void try_pairs();
  /// Leaves what is stated, without a cause.
  void drop_causes() {
    s_.model = s_.base;
    s_.causes.clear();
  }
  /// The causes with what does as well as each of them; nothing can be done after that.
  Selection confirmed();
  const Hypothesis& base() const { return s_.base; }
  const Hypothesis& model() const { return s_.model; }
  bool has_causes() const { return !s_.causes.empty(); }

 private:
  std::vector<Tried> try_candidates(const Start& start, const Start* other);
  std::vector<Screened> worth_fitting(const std::vector<Screened>& found) const;
  std::vector<Tried> try_from(const Start& other, const Hypothesis& current) const;
  Evidence judged(const Hypothesis& without, const Hypothesis& with, const Candidate& candidate) const;
  bool improves_prediction(const Tried& with) const;
  bool supported(const Evidence& evidence, const Hypothesis& with, const Candidate& candidate) const;
  bool take_best(std::vector<Tried>& tried, bool first_round);
  void compare_fairly(Tried& with, bool base_too);
  void eliminate(double enough);
  void simplify();
  bool exchange_for_fewer();
  Hypothesis fit_causes(const std::vector<std::size_t>& causes, const Hypothesis* warm, int rounds) const;
  void confirm_classes();
  void name_far_numbers();
  void judge_freed_numbers();
  void tell(const std::string& what) const {
    if (progress_) progress_(what);
  }

  const Evaluation& evaluation_;
  const std::vector<Candidate>& all_;
  int most_causes_;
  std::function<void(const std::string&)> progress_;
  Selection s_;
};

}  // namespace wormdrive
