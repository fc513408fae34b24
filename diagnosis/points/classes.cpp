#include "diagnosis/points/classes.hpp"

#include <algorithm>
#include <numeric>

#include "diagnosis/fitting/signature.hpp"
#include "diagnosis/rules/points.hpp"

namespace wormdrive {
namespace {

/// Which class every candidate is in.
class Groups {
 public:
  explicit Groups(std::size_t count) : group_(count) { std::iota(group_.begin(), group_.end(), std::size_t{0}); }
  void join(std::size_t a, std::size_t b) {
    const std::size_t from = group_[a], to = group_[b];
    std::replace(group_.begin(), group_.end(), from, to);
  }
  std::vector<std::size_t> members(std::size_t group) const {
    std::vector<std::size_t> all;
    for (std::size_t k = 0; k < group_.size(); ++k)
      if (group_[k] == group) all.push_back(k);
    return all;
  }

 private:
  std::vector<std::size_t> group_;
};

/// Named effects each of which can be imitated by the others together.
void join_imitated(const PointComparison& comparison, const FittedModel& model, Groups& groups) {
  const std::vector<std::vector<double>> slopes = comparison.fitter().slopes(model.model, model.all.values);
  const auto columns = [&](const std::vector<std::string_view>& effects) {
    std::vector<std::vector<double>> chosen;
    for (std::size_t k = 0; k < slopes.size(); ++k)
      if (std::find(effects.begin(), effects.end(), model.model.coordinates[k].effect) != effects.end())
        chosen.push_back(slopes[k]);
    return chosen;
  };
  const auto without = [](std::vector<std::string_view> effects, std::string_view one) {
    std::erase(effects, one);
    return effects;
  };
  const auto imitable = [&](std::string_view effect, const std::vector<std::string_view>& others) {
    for (const std::vector<double>& own : columns({effect}))
      if (imitation(own, columns(others)) < rules::points::imitated) return false;
    return true;
  };
  const std::vector<std::string_view>& causes = model.model.causes;
  for (const std::string_view effect : causes) {
    std::vector<std::string_view> others = without(causes, effect);
    if (!imitable(effect, others)) continue;
    for (const std::string_view other : without(causes, effect)) {
      if (!imitable(other, without(causes, other))) continue;
      if (imitable(effect, without(others, other)))
        others = without(others, other);  // not needed for it
      else
        groups.join(comparison.index_of(other), comparison.index_of(effect));
    }
  }
}

}  // namespace

std::vector<std::vector<std::size_t>> equivalence_classes(const PointComparison& comparison, const FittedModel& model) {
  Groups groups(comparison.candidates().size());
  for (const Exchange& exchange : comparison.exchanges(model)) groups.join(exchange.taken, exchange.dropped);
  join_imitated(comparison, model, groups);
  std::vector<std::vector<std::size_t>> classes;
  for (std::size_t group = 0; group < comparison.candidates().size(); ++group) {
    std::vector<std::size_t> members = groups.members(group);
    if (members.size() < 2) continue;
    std::stable_partition(members.begin(), members.end(),
                          [&](std::size_t k) { return model.model.holds(comparison.candidates()[k].effect); });
    classes.push_back(std::move(members));
  }
  return classes;
}

}  // namespace wormdrive
