#include "diagnosis/inference/masked_pairs.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/fitting/fit.hpp"
#include "diagnosis/inference/comparison.hpp"
#include "diagnosis/rules/evidence.hpp"

namespace wormdrive {

namespace {

/// What causes promise together in a linear system.
class Promise {
 public:
  Promise(const LinearSystem& linear, const Hypothesis& base, const std::vector<Candidate>& all)
      : linear_(linear), base_(base), all_(all) {}

  /// Gain of the BIC by some of them together.
  double gain(const std::vector<const StartColumns*>& together) const {
    std::vector<Eigen::Index> in;
    for (Eigen::Index k = 0; k < static_cast<Eigen::Index>(base_.free.size()); ++k) in.push_back(k);
    for (const StartColumns* e : together) in.insert(in.end(), e->columns.begin(), e->columns.end());
    Eigen::MatrixXd A = linear_.A(in, in);
    Eigen::VectorXd g = linear_.b(in);
    Hypothesis tolerances{.drive = {}, .free = base_.free, .values = base_.values};
    for (const StartColumns* e : together)
      for (Coordinate& c : tolerances.free)
        for (const Coordinate& own : all_[e->candidate].coordinates)
          if (own.is(c) || all_[e->candidate].frees == c.effect) c.tolerance = 0.0;
    add_tolerances(tolerances, A, g);
    double unknown = 0.0;
    for (const StartColumns* e : together) unknown += static_cast<double>(all_[e->candidate].coordinates.size());
    return g.dot(solve_normal(A, g, 1e-6)) - rules::price_of_unknown * unknown;
  }

  /// Of candidates together, each from the start that does best alone.
  double gain_of(const std::vector<std::size_t>& candidates) const {
    std::vector<const StartColumns*> together;
    for (const std::size_t candidate : candidates) {
      const StartColumns* best = nullptr;
      for (const StartColumns& e : linear_.starts)
        if (e.candidate == candidate && (!best || gain({&e}) > gain({best}))) best = &e;
      if (best) together.push_back(best);
    }
    return gain(together);
  }

 private:
  const LinearSystem& linear_;
  const Hypothesis& base_;
  const std::vector<Candidate>& all_;
};

}  // namespace

double clear_margin(double gain) { return std::max(rules::least_bic, rules::clear_share * gain); }

std::vector<MaskedPair> masked_pairs(const LinearSystem& linear, const Hypothesis& base,
                                     const std::vector<Candidate>& all, const std::vector<std::size_t>& causes,
                                     std::size_t most) {
  const Promise promise(linear, base, all);
  const double have = promise.gain_of(causes), clearly = clear_margin(have);
  const double more_than = causes.size() > 2 ? have - clearly : have + clearly;
  const std::vector<StartColumns>& e = linear.starts;
  std::vector<MaskedPair> pairs;
  for (std::size_t i = 0; i < e.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Candidate &a = all[e[i].candidate], &b = all[e[j].candidate];
      if (e[i].candidate == e[j].candidate || a.frees == b.effect || b.frees == a.effect) continue;
      const double gain = promise.gain({&e[i], &e[j]});
      if (gain > more_than) pairs.push_back({e[i].candidate, e[j].candidate, e[i].start, e[j].start, gain});
    }
  std::stable_sort(pairs.begin(), pairs.end(), [](const auto& a, const auto& b) { return a.gain > b.gain; });
  std::vector<MaskedPair> best;
  for (const MaskedPair& p : pairs) {
    if (best.size() >= most) break;
    if (std::none_of(best.begin(), best.end(), [&](const MaskedPair& q) {
          return (q.first == p.first && q.second == p.second) || (q.first == p.second && q.second == p.first);
        }))
      best.push_back(p);
  }
  return best;
}

}  // namespace wormdrive
