#include "diagnosis/masked_pairs.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/fit.hpp"

namespace wormdrive {

namespace {

/// A suspect from one start with the columns of its signatures; a suspect that only sets a stated number free has none.
struct Entry {
  std::size_t suspect, start;
  std::vector<Eigen::Index> columns;
};

/// All signatures in one system of normal equations.
class LinearFit {
 public:
  LinearFit(const Evaluation& by, const Hypothesis& base, const Screening& screening, const std::vector<Suspect>& all)
      : base_(base), all_(all) {
    const WeightedColumns weigh(fit_weights(by.layout(), base.residuals, base.noise_model));
    const Eigen::VectorXd residual = weigh(base.residuals);
    std::vector<Eigen::VectorXd> columns;
    for (const auto& c : screening.free_columns) columns.push_back(weigh(c));
    for (const Screened& s : screening.found) {
      Entry entry{s.suspect, s.start, {}};
      for (const auto& c : s.signatures) {
        entry.columns.push_back(static_cast<Eigen::Index>(columns.size()));
        columns.push_back(weigh(c));
      }
      entries_.push_back(std::move(entry));
    }
    Eigen::MatrixXd V(residual.size(), static_cast<Eigen::Index>(columns.size()));
    for (std::size_t k = 0; k < columns.size(); ++k) V.col(static_cast<Eigen::Index>(k)) = columns[k];
    A_ = V.transpose() * V;
    b_ = -V.transpose() * residual;
  }

  const std::vector<Entry>& entries() const { return entries_; }

  /// Gain of the BIC by some of them together.
  double gain(const std::vector<const Entry*>& together) const {
    std::vector<Eigen::Index> in;
    for (Eigen::Index k = 0; k < static_cast<Eigen::Index>(base_.free.size()); ++k) in.push_back(k);
    for (const Entry* e : together) in.insert(in.end(), e->columns.begin(), e->columns.end());
    Eigen::MatrixXd A = A_(in, in);
    Eigen::VectorXd g = b_(in);
    Hypothesis tolerances{.effects = {}, .free = base_.free, .values = base_.values};
    for (const Entry* e : together)
      for (Coordinate& c : tolerances.free)
        for (const Coordinate& own : all_[e->suspect].coordinates)
          if (own.is(c) || all_[e->suspect].frees == c.effect) c.tolerance = 0.0;
    add_tolerances(tolerances, A, g);
    double unknown = 0.0;
    for (const Entry* e : together) unknown += static_cast<double>(all_[e->suspect].coordinates.size());
    constexpr double per_unknown = 10.0;  // about ln N
    return g.dot(solve_normal(A, g, 1e-6)) - per_unknown * unknown;
  }

  /// Of suspects together, each from the start that does best alone.
  double gain_of(const std::vector<std::size_t>& suspects) const {
    std::vector<const Entry*> together;
    for (const std::size_t suspect : suspects) {
      const Entry* best = nullptr;
      for (const Entry& e : entries_)
        if (e.suspect == suspect && (!best || gain({&e}) > gain({best}))) best = &e;
      if (best) together.push_back(best);
    }
    return gain(together);
  }

 private:
  const Hypothesis& base_;
  const std::vector<Suspect>& all_;
  std::vector<Entry> entries_;
  Eigen::MatrixXd A_;
  Eigen::VectorXd b_;
};

}  // namespace

std::vector<MaskedPair> masked_pairs(const Evaluation& by, const Hypothesis& base, const Screening& screening,
                                     const std::vector<Suspect>& all, const std::vector<std::size_t>& causes,
                                     std::size_t most) {
  const LinearFit linear(by, base, screening, all);
  constexpr double least_gain = 20.0, least_share = 0.05;
  const double have = linear.gain_of(causes), clearly = std::max(least_gain, least_share * have);
  const double more_than = causes.size() > 2 ? have - clearly : have + clearly;
  const std::vector<Entry>& e = linear.entries();
  std::vector<MaskedPair> pairs;
  for (std::size_t i = 0; i < e.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Suspect &a = all[e[i].suspect], &b = all[e[j].suspect];
      if (e[i].suspect == e[j].suspect || a.frees == b.effect || b.frees == a.effect) continue;
      const double gain = linear.gain({&e[i], &e[j]});
      if (gain > more_than) pairs.push_back({e[i].suspect, e[j].suspect, e[i].start, e[j].start, gain});
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
