#include "diagnosis/points/selection.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "diagnosis/points/classes.hpp"
#include "diagnosis/rules/evidence.hpp"
#include "diagnosis/rules/points.hpp"
#include "statistics/parallel.hpp"

namespace wormdrive {
namespace {

class Selector {
 public:
  Selector(const PointComparison& comparison, int threads) : comparison_(comparison), threads_(threads) {}

  PointSelection run() {
    PointSelection selection;
    const PointModel free = calibration(comparison_.candidates());
    std::vector<double> start;
    for (const Coordinate& c : free.coordinates) start.push_back(c.centre);
    auto nominal = comparison_.fitted(free, {start});
    if (!nominal) throw std::invalid_argument("the scenario has no torque at these points");
    std::vector<PointJudgement> singles;
    for (std::size_t k = 0; k < comparison_.candidates().size(); ++k)
      if (auto judgement = judge(k, *nominal)) singles.push_back(std::move(*judgement));
    selection.before = *nominal;
    selection.after = well_shaped(search(*nominal));
    selection.classes = equivalence_classes(comparison_, selection.after);
    report(selection, std::move(singles));
    return selection;
  }

 private:
  /// One effect beside a model. A fair comparison: the simpler one may start from where the wider one ended.
  std::optional<PointJudgement> judge(std::size_t index, FittedModel& model) const {
    const auto with = comparison_.extended(model, comparison_.candidates()[index]);
    if (!with) return std::nullopt;
    const auto again = comparison_.again(model, *with);
    if (again && again->bic < model.bic) model = *again;
    return PointJudgement{index, *with, model.bic - with->bic, model.held_out - with->held_out, false, ""};
  }

  struct Beside {
    const FittedModel* model;
    const PointCandidate* one;
  };
  /// What glances show of effects beside models, in their order.
  std::vector<FittedModel> glances(const std::vector<Beside>& pairs) const {
    std::vector<std::optional<FittedModel>> seen(pairs.size());
    parallel_for(pairs.size(), threads_,
                 [&](std::size_t k) { seen[k] = comparison_.glanced(*pairs[k].model, *pairs[k].one); });
    std::vector<FittedModel> models;
    for (auto& with : seen)
      if (with) models.push_back(std::move(*with));
    return models;
  }

  /// The best models of a size out of those of one less.
  std::vector<FittedModel> grown(const std::vector<FittedModel>& smaller, bool stated_too) const {
    std::vector<Beside> pairs;
    std::set<std::set<std::string_view>> seen;
    for (const FittedModel& model : smaller)
      for (const PointCandidate& one : comparison_.candidates()) {
        if (!comparison_.fits_beside(one, model.model) || (one.tolerated && !stated_too)) continue;
        std::set<std::string_view> causes(model.model.causes.begin(), model.model.causes.end());
        causes.insert(one.effect);
        if (seen.insert(causes).second) pairs.push_back({&model, &one});
      }
    std::vector<FittedModel> models = glances(pairs);
    std::erase_if(models, [&](const FittedModel& m) { return !comparison_.doubt(m).empty(); });
    std::sort(models.begin(), models.end(), [](const auto& a, const auto& b) { return a.rank() < b.rank(); });
    if (models.size() > rules::points::most_models) models.resize(rules::points::most_models);
    return models;
  }

  /// Level effects stand in for each other, so the way to the best model is full of traps: one search among effects
  /// that nobody has stated, one among all. Of the two, the one with more causes needs decisive evidence for each of
  /// them.
  FittedModel search(const FittedModel& nominal) const {
    const FittedModel unstated = improved(best_of_sizes(nominal, rules::points::together_unstated, false));
    const FittedModel all = improved(best_of_sizes(nominal, rules::points::together, true));
    const auto dear = [](const FittedModel& m) {
      return m.rank() + rules::points::decisive_bic * static_cast<double>(m.model.causes.size());
    };
    return dear(unstated) < dear(all) ? unstated : all;
  }

  /// A model whose friction is no misshapen law: in place of one that fits as well, by the exchange of one effect.
  FittedModel well_shaped(const FittedModel& found) const {
    if (!comparison_.misshapen(found)) return found;
    std::optional<FittedModel> best;
    for (Exchange& exchange : comparison_.exchanges(found))
      if (!comparison_.misshapen(exchange.model) && (!best || exchange.model.bic < best->bic))
        best = std::move(exchange.model);
    return best.value_or(found);
  }

  FittedModel best_of_sizes(const FittedModel& nominal, std::size_t largest, bool stated_too) const {
    FittedModel chosen = nominal;
    std::vector<FittedModel> models{nominal};
    for (std::size_t size = 1; size <= largest; ++size) {
      models = grown(models, stated_too);
      std::optional<FittedModel> best;  // of those that are equally likely the one that predicts best
      for (const FittedModel& model : models) {
        if (model.rank() > models.front().rank() + rules::points::equally_likely) break;
        const auto judged = comparison_.fitted(model.model, {model.all.values});
        if (judged && (!best || judged->held_out < best->held_out)) best = judged;
      }
      if (!best) break;
      const auto steps = static_cast<double>(size - chosen.model.causes.size());
      if (chosen.rank() - best->rank() > steps * rules::points::least_bic &&
          chosen.held_out - best->held_out > rules::least_held_out)
        chosen = *best;
    }
    return chosen;
  }

  FittedModel improved(FittedModel chosen) const {
    drop_superfluous(chosen);
    while (chosen.model.causes.size() < rules::points::most_causes && (add(chosen) || exchange(chosen)))
      drop_superfluous(chosen);
    return chosen;
  }

  /// Takes of models that a glance found promising the best one that predicts better; false if none is better by this
  /// much.
  bool take_best(FittedModel& chosen, std::vector<FittedModel> promising, double held_out_gain, double gain) const {
    std::sort(promising.begin(), promising.end(), [](const auto& a, const auto& b) { return a.rank() < b.rank(); });
    if (promising.size() > rules::points::most_looked_at) promising.resize(rules::points::most_looked_at);
    const FittedModel before = chosen;
    for (const FittedModel& glance : promising) {
      const auto model = comparison_.fitted(glance.model, {glance.all.values});
      if (!model || !comparison_.doubt(*model).empty()) continue;
      if (before.held_out - model->held_out > held_out_gain && before.rank() - model->rank() > gain &&
          model->rank() < chosen.rank())
        chosen = *model;
    }
    return chosen.rank() < before.rank();
  }

  /// Adds the effect that helps most, if it passes the thresholds.
  bool add(FittedModel& chosen) const {
    std::vector<Beside> pairs;
    for (const PointCandidate& one : comparison_.candidates())
      if (comparison_.fits_beside(one, chosen.model)) pairs.push_back({&chosen, &one});
    return take_best(chosen, glances(pairs), rules::least_held_out, rules::points::least_bic);
  }

  /// Puts another effect in the place of one, if that is clearly better.
  bool exchange(FittedModel& chosen) const {
    std::vector<FittedModel> smaller;
    for (const std::string_view effect : chosen.model.causes)
      if (auto without = comparison_.reduced(chosen, comparison_.candidate(effect)))
        smaller.push_back(std::move(*without));
    std::vector<Beside> pairs;
    for (const FittedModel& without : smaller)
      for (const PointCandidate& one : comparison_.candidates())
        if (!chosen.model.holds(one.effect) && comparison_.fits_beside(one, without.model))
          pairs.push_back({&without, &one});
    return take_best(chosen, glances(pairs), 0.0, rules::points::least_exchange);
  }

  void drop_superfluous(FittedModel& model) const {
    for (bool dropped = true; dropped;) {
      dropped = false;
      for (const std::string_view effect : std::vector<std::string_view>(model.model.causes)) {
        const auto without = comparison_.reduced(model, comparison_.candidate(effect));
        if (!without || without->rank() - model.rank() > rules::points::least_bic) continue;
        model = *without;
        dropped = true;
        break;
      }
    }
  }

  /// The named ones against the model without them, the others as the only effect beside the nominal drive.
  void report(PointSelection& selection, std::vector<PointJudgement> singles) const {
    const FittedModel& model = selection.after;
    for (PointJudgement& judgement : singles) {
      const PointCandidate& one = comparison_.candidates()[judgement.candidate];
      judgement.named = model.model.holds(one.effect);
      if (judgement.named) {
        if (const auto without = comparison_.reduced(model, one)) {
          judgement.delta_bic = without->bic - model.bic;
          judgement.held_out_gain = without->held_out - model.held_out;
        }
        judgement.with = model;
        judgement.outcome = "named";
        continue;
      }
      judgement.outcome = comparison_.doubt(judgement.with);
      if (!judgement.outcome.empty()) continue;
      if (judgement.delta_bic <= rules::points::least_bic)
        judgement.outcome = fmt::format("explains too little: dBIC at most {:g}", rules::points::least_bic);
      else if (judgement.held_out_gain <= rules::least_held_out)
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
    if (!comparison_.fits_beside(one, model.model)) return 0.0;
    const auto with = comparison_.extended(model, one);
    return with ? model.bic - with->bic : 0.0;
  }

  const PointComparison& comparison_;
  int threads_;
};

}  // namespace

PointSelection select(const PointFitter& fitter, const std::vector<PointCandidate>& candidates, int threads) {
  const PointComparison comparison(fitter, candidates);
  return Selector(comparison, threads).run();
}

}  // namespace wormdrive
