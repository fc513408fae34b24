#include "diagnosis/point_selection.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
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
    auto nominal = fitted(free, {start});
    if (!nominal) throw std::invalid_argument("the scenario has no torque at these points");
    std::vector<PointJudgement> singles;
    for (std::size_t k = 0; k < candidates_.size(); ++k)
      if (auto judgement = judge(k, *nominal)) singles.push_back(std::move(*judgement));
    selection.before = *nominal;
    selection.after = search(*nominal);
    find_classes(selection);
    report(selection, std::move(singles));
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
    return FittedModel{model, *all, bic_of(model, *all),
                       fitter_.held_out(*first, Part::first_half) + fitter_.held_out(*second, Part::second_half)};
  }
  double bic_of(const PointModel& model, const PointFit& fit) const {
    const auto free = std::count_if(model.coordinates.begin(), model.coordinates.end(),
                                    [](const Coordinate& c) { return c.tolerance == 0.0; });
    return bic(fit.nll, static_cast<double>(free), static_cast<double>(fitter_.points().size()));
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

  PointModel wider(const FittedModel& model, const PointCandidate& candidate,
                   std::vector<std::vector<double>>& starts) const {
    PointModel made = with_cause(model.model, candidate);
    for (const std::vector<double>& start : candidate.starts)
      starts.push_back(carried(made, model.model, model.all.values, &candidate, &start));
    return made;
  }
  std::optional<FittedModel> extended(const FittedModel& model, const PointCandidate& candidate) const {
    std::vector<std::vector<double>> starts;
    return fitted(wider(model, candidate, starts), starts);
  }

  /// One effect beside a model. A fair comparison: the simpler one may start from where the wider one ended.
  std::optional<PointJudgement> judge(std::size_t index, FittedModel& model) const {
    const auto with = extended(model, candidates_[index]);
    if (!with) return std::nullopt;
    const auto again =
        fitted(model.model, {carried(model.model, with->model, with->all.values, nullptr, nullptr), model.all.values});
    if (again && again->bic < model.bic) model = *again;
    return PointJudgement{index, *with, model.bic - with->bic, model.held_out - with->held_out, false, ""};
  }

  /// Why a model cannot be believed; empty if it can.
  std::string doubt(const PointModel& model, const std::vector<double>& values) const {
    for (std::size_t k = 0; k < values.size(); ++k) {
      const Coordinate& c = model.coordinates[k];
      if (!model.holds(c.effect)) continue;
      if (std::abs(values[k] - c.low) < 1e-4 * c.scale || std::abs(values[k] - c.high) < 1e-4 * c.scale)
        return fmt::format("{} comes to lie at the bound of what it can be", c.effect);
      const PointCandidate& one = candidate(c.effect);
      if (!one.tolerated) continue;
      const double tolerances = std::abs(values[k] - c.centre) / one.coordinates.front().tolerance;
      if (tolerances < limits_.tolerances)
        return fmt::format("within its tolerance: {:.1f} standard deviations from what is stated", tolerances);
    }
    return "";
  }

  /// The best models of a size out of those of one less.
  std::vector<FittedModel> grown(const std::vector<FittedModel>& smaller) const {
    std::vector<FittedModel> models;
    std::set<std::set<std::string_view>> seen;
    for (const FittedModel& model : smaller)
      for (const PointCandidate& one : candidates_) {
        if (model.model.holds(one.effect) || excluded(one, model.model)) continue;
        std::set<std::string_view> causes(model.model.causes.begin(), model.model.causes.end());
        causes.insert(one.effect);
        if (!seen.insert(causes).second) continue;
        std::vector<std::vector<double>> starts;
        const PointModel made = wider(model, one, starts);
        const auto all = fitter_.fit(made, starts, Part::all);
        if (all && doubt(made, all->values).empty()) models.push_back({made, *all, bic_of(made, *all), 0.0});
      }
    std::sort(models.begin(), models.end(), [](const auto& a, const auto& b) { return a.bic < b.bic; });
    if (models.size() > limits_.models) models.resize(limits_.models);
    return models;
  }

  FittedModel search(const FittedModel& nominal) const {
    FittedModel chosen = nominal;
    std::vector<FittedModel> models{nominal};
    for (std::size_t size = 1; size <= limits_.causes; ++size) {
      models = grown(models);
      std::optional<FittedModel> best;  // of those that are equally likely the one that predicts best
      for (const FittedModel& model : models) {
        if (model.bic > models.front().bic + 2.0) break;
        const auto judged = fitted(model.model, {model.all.values});
        if (judged && (!best || judged->held_out < best->held_out)) best = judged;
      }
      if (!best) break;
      const auto steps = static_cast<double>(size - chosen.model.causes.size());
      if (chosen.bic - best->bic > steps * limits_.delta_bic &&
          chosen.held_out - best->held_out > limits_.held_out_gain)
        chosen = *best;
    }
    drop_superfluous(chosen);
    return chosen;
  }

  /// Both say how friction falls with the sliding speed.
  static bool excluded(const PointCandidate& candidate, const PointModel& model) {
    return (candidate.effect == "agma" && model.holds("stribeck")) ||
           (candidate.effect == "stribeck" && model.holds("agma"));
  }

  const PointCandidate& candidate(std::string_view effect) const {
    return *std::find_if(candidates_.begin(), candidates_.end(), [&](const auto& c) { return c.effect == effect; });
  }

  std::optional<FittedModel> reduced(const FittedModel& model, const PointCandidate& candidate) const {
    const PointModel narrower = without_cause(model.model, candidate);
    return fitted(narrower, {carried(narrower, model.model, model.all.values, nullptr, nullptr)});
  }

  void drop_superfluous(FittedModel& model) const {
    for (bool dropped = true; dropped;) {
      dropped = false;
      for (const std::string_view effect : std::vector<std::string_view>(model.model.causes)) {
        const auto without = reduced(model, candidate(effect));
        if (!without || without->bic - model.bic > limits_.delta_bic) continue;
        model = *without;
        dropped = true;
        break;
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
        if (!doubt(instead->model, instead->all.values).empty()) continue;
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

  /// The named ones against the model without them, the others as the only effect beside the nominal drive.
  void report(PointSelection& selection, std::vector<PointJudgement> singles) const {
    const FittedModel& model = selection.after;
    for (PointJudgement& judgement : singles) {
      const PointCandidate& one = candidates_[judgement.candidate];
      judgement.named = model.model.holds(one.effect);
      if (judgement.named) {
        if (const auto without = reduced(model, one)) {
          judgement.delta_bic = without->bic - model.bic;
          judgement.held_out_gain = without->held_out - model.held_out;
        }
        judgement.with = model;
        judgement.outcome = "named";
        continue;
      }
      judgement.outcome = doubt(judgement.with.model, judgement.with.all.values);
      if (!judgement.outcome.empty()) continue;
      if (judgement.delta_bic <= limits_.delta_bic)
        judgement.outcome = fmt::format("explains too little: dBIC at most {:g}", limits_.delta_bic);
      else if (judgement.held_out_gain <= limits_.held_out_gain)
        judgement.outcome = "does not predict data that the fit did not see";
      else
        judgement.outcome = fmt::format("adds too little to what is named: dBIC {:.1f}", added(model, one));
    }
    for (const std::vector<std::size_t>& members : selection.classes)
      for (PointJudgement& judgement : singles)
        if (std::find(members.begin(), members.end(), judgement.candidate) != members.end())
          judgement.outcome =
              judgement.named ? "named, or another one of its class" : "can stand for one that is named";
    std::stable_sort(singles.begin(), singles.end(), [](const auto& a, const auto& b) {
      return a.named != b.named ? a.named : a.delta_bic > b.delta_bic;
    });
    selection.judgements = std::move(singles);
  }
  double added(const FittedModel& model, const PointCandidate& one) const {
    if (excluded(one, model.model)) return 0.0;
    const auto with = extended(model, one);
    return with ? model.bic - with->bic : 0.0;
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
