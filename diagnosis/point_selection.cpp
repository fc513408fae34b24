#include "diagnosis/point_selection.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "diagnosis/signature.hpp"
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
    return FittedModel{model, *all, bic_of(model, *all), doubt_of(model, all->values),
                       fitter_.held_out(*first, Part::first_half) + fitter_.held_out(*second, Part::second_half)};
  }
  double bic_of(const PointModel& model, const PointFit& fit) const {
    const auto free = std::count_if(model.coordinates.begin(), model.coordinates.end(),
                                    [](const Coordinate& c) { return c.tolerance == 0.0; });
    return bic(fit.nll, static_cast<double>(free), static_cast<double>(fitter_.points().size()));
  }

  /// A stated value that is known within a tolerance, yet far outside of it: 2 ln(1 + z^2) is what the tails of
  /// Cauchy's distribution make of it.
  double doubt_of(const PointModel& model, const std::vector<double>& values) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < values.size(); ++k) {
      const Coordinate& c = model.coordinates[k];
      if (!model.holds(c.effect) || !candidate(c.effect).tolerated) continue;
      const double z = (values[k] - c.centre) / candidate(c.effect).coordinates.front().tolerance;
      sum += 2.0 * std::log1p(z * z);
    }
    return sum;
  }

  /// Values for a model out of those of another; where that has none, out of the candidate's start.
  static std::vector<double> carried(const PointModel& to, const PointModel& from, const std::vector<double>& values,
                                     const PointCandidate* candidate, const std::vector<double>* start) {
    std::vector<double> made;
    for (const Coordinate& c : to.coordinates) {
      made.push_back(c.centre);
      for (std::size_t k = 0; k < from.coordinates.size(); ++k)
        if (from.coordinates[k].is(c)) made.back() = values[k];
      if (!candidate) continue;
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
    std::vector<double> afresh = starts.front();  // out of the valley in which the smaller model lies
    for (std::size_t k = 0; k < afresh.size(); ++k)
      for (const PointCandidate& one : candidates_)
        for (std::size_t c = 0; c < one.coordinates.size(); ++c)
          if (made.holds(one.effect) && one.coordinates[c].is(made.coordinates[k]) && !one.tolerated)
            afresh[k] = one.starts.front()[c];
    starts.push_back(std::move(afresh));
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
  std::vector<FittedModel> grown(const std::vector<FittedModel>& smaller, bool stated_too) const {
    std::vector<FittedModel> models;
    std::set<std::set<std::string_view>> seen;
    for (const FittedModel& model : smaller)
      for (const PointCandidate& one : candidates_) {
        if (model.model.holds(one.effect) || excluded(one, model.model) || (one.tolerated && !stated_too)) continue;
        std::set<std::string_view> causes(model.model.causes.begin(), model.model.causes.end());
        causes.insert(one.effect);
        if (!seen.insert(causes).second) continue;
        std::vector<std::vector<double>> starts;
        const PointModel made = wider(model, one, starts);
        const auto all = fitter_.fit(made, starts, Part::all, quick);
        if (all && doubt(made, all->values).empty())
          models.push_back({made, *all, bic_of(made, *all), doubt_of(made, all->values), 0.0});
      }
    std::sort(models.begin(), models.end(), [](const auto& a, const auto& b) { return a.rank() < b.rank(); });
    if (models.size() > limits_.models) models.resize(limits_.models);
    return models;
  }

  /// Level effects stand in for each other, so the way to the best model is full of traps: one search among effects
  /// that nobody has stated, one among all.
  FittedModel search(const FittedModel& nominal) const {
    const FittedModel unstated = improved(best_of_sizes(nominal, limits_.unstated, false));
    const FittedModel all = improved(best_of_sizes(nominal, limits_.together, true));
    return unstated.rank() < all.rank() ? unstated : all;
  }

  FittedModel best_of_sizes(const FittedModel& nominal, std::size_t largest, bool stated_too) const {
    FittedModel chosen = nominal;
    std::vector<FittedModel> models{nominal};
    for (std::size_t size = 1; size <= largest; ++size) {
      models = grown(models, stated_too);
      std::optional<FittedModel> best;  // of those that are equally likely the one that predicts best
      for (const FittedModel& model : models) {
        if (model.rank() > models.front().rank() + 2.0) break;
        const auto judged = fitted(model.model, {model.all.values});
        if (judged && (!best || judged->held_out < best->held_out)) best = judged;
      }
      if (!best) break;
      const auto steps = static_cast<double>(size - chosen.model.causes.size());
      if (chosen.rank() - best->rank() > steps * limits_.delta_bic &&
          chosen.held_out - best->held_out > limits_.held_out_gain)
        chosen = *best;
    }
    return chosen;
  }

  FittedModel improved(FittedModel chosen) const {
    drop_superfluous(chosen);
    while (chosen.model.causes.size() < limits_.causes && (add(chosen) || exchange(chosen))) drop_superfluous(chosen);
    return chosen;
  }

  /// Adds the effect that helps most, if it passes the thresholds.
  bool add(FittedModel& chosen) const {
    const FittedModel before = chosen;
    for (const PointCandidate& one : candidates_) {
      if (before.model.holds(one.effect) || excluded(one, before.model)) continue;
      const auto with = extended(before, one);
      if (!with || !doubt(with->model, with->all.values).empty()) continue;
      if (before.held_out - with->held_out > limits_.held_out_gain && with->rank() < chosen.rank()) chosen = *with;
    }
    if (before.rank() - chosen.rank() > limits_.delta_bic) return true;
    chosen = before;
    return false;
  }

  /// Puts another effect in the place of one, if that is clearly better.
  bool exchange(FittedModel& chosen) const {
    const FittedModel before = chosen;
    for (const std::string_view effect : before.model.causes) {
      const auto without = reduced(before, candidate(effect));
      if (!without) continue;
      for (const PointCandidate& one : candidates_) {
        if (before.model.holds(one.effect) || excluded(one, without->model)) continue;
        const auto with = extended(*without, one);
        if (!with || !doubt(with->model, with->all.values).empty()) continue;
        if (with->held_out < before.held_out && with->rank() < chosen.rank()) chosen = *with;
      }
    }
    if (before.rank() - chosen.rank() > 0.5) return true;
    chosen = before;
    return false;
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
        if (!without || without->rank() - model.rank() > limits_.delta_bic) continue;
        model = *without;
        dropped = true;
        break;
      }
    }
  }

  /// Named effects of which each can be imitated by the others together are one class.
  void join_imitated(const FittedModel& model, std::vector<std::size_t>& group) const {
    const std::vector<std::vector<double>> slopes = fitter_.slopes(model.model, model.all.values);
    const auto columns = [&](const std::vector<std::string_view>& effects) {
      std::vector<std::vector<double>> chosen;
      for (std::size_t k = 0; k < slopes.size(); ++k)
        if (std::find(effects.begin(), effects.end(), model.model.coordinates[k].effect) != effects.end())
          chosen.push_back(slopes[k]);
      return chosen;
    };
    for (const std::string_view effect : model.model.causes) {
      std::vector<std::string_view> others = model.model.causes;
      std::erase(others, effect);
      const std::vector<double> own = columns({effect}).front();
      if (imitation(own, columns(others)) < limits_.imitated) continue;
      for (const std::string_view other : std::vector<std::string_view>(others)) {
        std::vector<std::string_view> rest = others;
        std::erase(rest, other);
        if (imitation(own, columns(rest)) >= limits_.imitated) {
          others = rest;  // not needed for it
          continue;
        }
        const std::size_t from = group[index_of(other)], to = group[index_of(effect)];
        std::replace(group.begin(), group.end(), from, to);
      }
    }
  }
  std::size_t index_of(std::string_view effect) const {
    return static_cast<std::size_t>(&candidate(effect) - candidates_.data());
  }

  /// Puts every other candidate in the place of every named one; classes that share a member are one.
  void find_classes(PointSelection& selection) const {
    const FittedModel& model = selection.after;
    std::vector<std::size_t> group(candidates_.size());
    std::iota(group.begin(), group.end(), std::size_t{0});
    for (const std::string_view effect : model.model.causes) {
      const PointCandidate& named = candidate(effect);
      const std::size_t place = index_of(effect);
      const auto without = reduced(model, named);
      if (!without) continue;
      for (std::size_t k = 0; k < candidates_.size(); ++k) {
        if (model.model.holds(candidates_[k].effect) || excluded(candidates_[k], without->model)) continue;
        const auto instead = extended(*without, candidates_[k]);
        if (!instead || instead->bic - model.bic > limits_.alike) continue;
        if (!doubt(instead->model, instead->all.values).empty()) continue;
        const std::size_t from = group[k], to = group[place];
        std::replace(group.begin(), group.end(), from, to);
      }
    }
    join_imitated(model, group);
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
