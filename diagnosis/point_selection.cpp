#include "diagnosis/point_selection.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>

#include "diagnosis/student_t.hpp"

namespace wormdrive {
namespace {

class Selector {
 public:
  Selector(const PointFitter& fitter, const std::vector<PointCandidate>& candidates, const PointThresholds& thresholds)
      : fitter_(fitter), candidates_(candidates), limits_(thresholds) {}

  PointSelection run() {
    PointSelection selection;
    const PointModel free = calibration(candidates_);
    std::vector<double> start;
    for (const Coordinate& c : free.coordinates) start.push_back(c.centre);
    const auto nominal = fitted(free, {start});
    if (!nominal) throw std::invalid_argument("the scenario has no torque at these points");
    selection.before = selection.after = *nominal;
    selection.judgements = judge_all(selection.after);
    while (selection.after.model.causes.size() < limits_.causes) {
      std::vector<PointJudgement> judgements =
          selection.after.model.causes.empty() ? selection.judgements : judge_all(selection.after);
      const auto best = std::find_if(judgements.begin(), judgements.end(), [](const auto& j) { return j.accepted; });
      keep(selection.judgements, judgements);
      if (best == judgements.end()) break;
      selection.after = best->with;
      drop_superfluous(selection.after, best->candidate);
    }
    find_classes(selection);
    return selection;
  }

 private:
  std::optional<FittedModel> fitted(const PointModel& model, const std::vector<std::vector<double>>& starts) const {
    const auto all = fitter_.fit(model, starts, Part::all);
    if (!all) return std::nullopt;
    std::vector<std::vector<double>> from = starts;
    from.push_back(all->values);
    const auto first = fitter_.fit(model, from, Part::first_half), second = fitter_.fit(model, from, Part::second_half);
    if (!first || !second) return std::nullopt;
    const auto data = static_cast<double>(fitter_.points().size());
    return FittedModel{model, *all, bic(all->nll, static_cast<double>(free_parameters(model)), data),
                       fitter_.held_out(*first, Part::first_half) + fitter_.held_out(*second, Part::second_half)};
  }
  static std::size_t free_parameters(const PointModel& model) {
    return static_cast<std::size_t>(std::count_if(model.coordinates.begin(), model.coordinates.end(),
                                                  [](const Coordinate& c) { return c.tolerance == 0.0; }));
  }

  /// Values for a model out of those of another; where that has none, out of the candidate's start.
  static std::vector<double> carried(const PointModel& to, const PointModel& from, const std::vector<double>& values,
                                     const PointCandidate* candidate, const std::vector<double>* start) {
    std::vector<double> made;
    for (const Coordinate& c : to.coordinates) {
      made.push_back(c.centre);
      for (std::size_t k = 0; k < from.coordinates.size(); ++k)
        if (from.coordinates[k].is(c)) made.back() = values[k];
      if (!candidate || candidate->tolerated) continue;
      for (std::size_t k = 0; k < candidate->coordinates.size(); ++k)
        if (candidate->coordinates[k].is(c)) made.back() = (*start)[k];
    }
    return made;
  }

  std::optional<FittedModel> extended(const FittedModel& model, const PointCandidate& candidate) const {
    const PointModel wider = with_cause(model.model, candidate);
    std::vector<std::vector<double>> starts;
    for (const std::vector<double>& start : candidate.starts)
      starts.push_back(carried(wider, model.model, model.all.values, &candidate, &start));
    return fitted(wider, starts);
  }

  std::optional<PointJudgement> judge(std::size_t index, FittedModel& model) const {
    const PointCandidate& candidate = candidates_[index];
    const auto with = extended(model, candidate);
    if (!with) return std::nullopt;
    // a fair comparison: the simpler model may start from where the wider one ended
    const auto again =
        fitted(model.model, {carried(model.model, with->model, with->all.values, nullptr, nullptr), model.all.values});
    if (again && again->bic < model.bic) model = *again;
    PointJudgement judgement{index, *with, model.bic - with->bic, model.held_out - with->held_out, false, ""};
    decide(judgement, candidate);
    return judgement;
  }

  void decide(PointJudgement& judgement, const PointCandidate& candidate) const {
    for (std::size_t k = 0; k < judgement.with.model.coordinates.size(); ++k) {
      const Coordinate& c = judgement.with.model.coordinates[k];
      if (c.effect != candidate.effect) continue;
      const double value = judgement.with.all.values[k];
      if (std::abs(value - c.low) < 1e-6 * c.scale || std::abs(value - c.high) < 1e-6 * c.scale) {
        judgement.outcome = "at the bound of what it can be";
        return;
      }
      const double stated =
          std::find_if(candidate.coordinates.begin(), candidate.coordinates.end(), [&](const Coordinate& other) {
            return other.is(c);
          })->tolerance;
      if (candidate.tolerated && std::abs(value - c.centre) < limits_.tolerances * stated) {
        judgement.outcome = fmt::format("within its tolerance: {:.1f} of at least {:g} standard deviations",
                                        std::abs(value - c.centre) / stated, limits_.tolerances);
        return;
      }
    }
    const double needed = candidate.tolerated ? limits_.tolerated_delta_bic : limits_.delta_bic;
    if (judgement.delta_bic <= needed)
      judgement.outcome = fmt::format("explains too little: dBIC at most {:g}", needed);
    else if (judgement.held_out_gain <= limits_.held_out_gain)
      judgement.outcome = "does not predict data that the fit did not see";
    else
      judgement.accepted = true;
  }

  std::vector<PointJudgement> judge_all(FittedModel& model) const {
    std::vector<PointJudgement> judgements;
    for (std::size_t k = 0; k < candidates_.size(); ++k) {
      if (model.model.holds(candidates_[k].effect) || excluded(candidates_[k], model.model)) continue;
      if (auto judgement = judge(k, model)) judgements.push_back(std::move(*judgement));
    }
    std::sort(judgements.begin(), judgements.end(),
              [](const auto& a, const auto& b) { return a.delta_bic > b.delta_bic; });
    return judgements;
  }

  /// Both say how friction falls with the sliding speed.
  static bool excluded(const PointCandidate& candidate, const PointModel& model) {
    return (candidate.effect == "agma" && model.holds("stribeck")) ||
           (candidate.effect == "stribeck" && model.holds("agma"));
  }

  /// What an effect was judged last stands; of the named ones as they were accepted.
  static void keep(std::vector<PointJudgement>& standing, const std::vector<PointJudgement>& latest) {
    for (const PointJudgement& judgement : latest) {
      const auto same = std::find_if(standing.begin(), standing.end(),
                                     [&](const PointJudgement& j) { return j.candidate == judgement.candidate; });
      if (same == standing.end())
        standing.push_back(judgement);
      else
        *same = judgement;
    }
  }

  const PointCandidate& candidate(std::string_view effect) const {
    return *std::find_if(candidates_.begin(), candidates_.end(), [&](const auto& c) { return c.effect == effect; });
  }

  std::optional<FittedModel> reduced(const FittedModel& model, const PointCandidate& candidate) const {
    const PointModel narrower = without_cause(model.model, candidate);
    return fitted(narrower, {carried(narrower, model.model, model.all.values, nullptr, nullptr)});
  }

  void drop_superfluous(FittedModel& model, std::size_t newest) const {
    for (bool dropped = true; dropped;) {
      dropped = false;
      for (const std::string_view effect : std::vector<std::string_view>(model.model.causes)) {
        if (effect == candidates_[newest].effect) continue;
        const PointCandidate& one = candidate(effect);
        const auto without = reduced(model, one);
        const double needed = one.tolerated ? limits_.tolerated_delta_bic : limits_.delta_bic;
        if (!without || without->bic - model.bic > needed) continue;
        model = *without;
        dropped = true;
      }
    }
  }

  /// Puts every other candidate in the place of every named one; classes that share a member are one.
  void find_classes(PointSelection& selection) const {
    const FittedModel& model = selection.after;
    std::vector<std::size_t> group(candidates_.size());
    std::iota(group.begin(), group.end(), std::size_t{0});
    for (const std::string_view effect : model.model.causes) {
      const PointCandidate& named = candidate(effect);
      const auto place = static_cast<std::size_t>(&named - candidates_.data());
      const auto without = reduced(model, named);
      if (!without) continue;
      const double margin = std::max(limits_.alike, limits_.alike_share * (without->bic - model.bic));
      for (std::size_t k = 0; k < candidates_.size(); ++k) {
        if (model.model.holds(candidates_[k].effect) || excluded(candidates_[k], without->model)) continue;
        const auto instead = extended(*without, candidates_[k]);
        if (!instead || instead->bic - model.bic > margin) continue;
        const std::size_t from = group[k], to = group[place];
        for (std::size_t& g : group)
          if (g == from) g = to;
      }
    }
    for (std::size_t g = 0; g < group.size(); ++g) {
      std::vector<std::size_t> members;
      for (std::size_t k = 0; k < group.size(); ++k)
        if (group[k] == g) members.push_back(k);
      if (members.size() < 2) continue;
      std::stable_partition(members.begin(), members.end(),
                            [&](std::size_t k) { return model.model.holds(candidates_[k].effect); });
      selection.classes.push_back(std::move(members));
    }
  }

  const PointFitter& fitter_;
  const std::vector<PointCandidate>& candidates_;
  const PointThresholds& limits_;
};

}  // namespace

PointSelection select(const PointFitter& fitter, const std::vector<PointCandidate>& candidates,
                      const PointThresholds& thresholds) {
  return Selector(fitter, candidates, thresholds).run();
}

}  // namespace wormdrive
