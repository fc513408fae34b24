#include "sweep/study/correlated_strata.hpp"

#include <algorithm>
#include <utility>

#include "sweep/study/keyed_permutation.hpp"

namespace wormdrive {
namespace {

/// Normal scores of the strata, in units of their root mean square.
std::vector<double> scores_of(std::uint64_t strata) {
  std::vector<double> scores(strata);
  double squares = 0.0;
  for (std::uint64_t s = 0; s < strata; ++s) {
    scores[s] = normal_quantile((static_cast<double>(s) + 0.5) / static_cast<double>(strata));
    squares += scores[s] * scores[s];
  }
  const double size = std::sqrt(squares / static_cast<double>(strata));
  for (double& score : scores) score /= size;
  return scores;
}

/// What turns scores in random order into scores that are correlated as wanted, wanted: the lower triangle of their
/// correlations. The correlations that random orders have by accident are taken out, unless the trials are so few that
/// these hide everything.
Eigen::MatrixXd mixing(const std::vector<std::vector<std::uint32_t>*>& orders, const std::vector<double>& scores,
                       const Eigen::MatrixXd& wanted) {
  const Eigen::Index size = wanted.rows();
  Eigen::MatrixXd accidental = Eigen::MatrixXd::Identity(size, size);
  for (Eigen::Index j = 0; j < size; ++j)
    for (Eigen::Index k = 0; k < j; ++k) {
      double product = 0.0;
      for (std::size_t trial = 0; trial < scores.size(); ++trial)
        product += scores[(*orders[static_cast<std::size_t>(j)])[trial]] *
                   scores[(*orders[static_cast<std::size_t>(k)])[trial]];
      accidental(j, k) = accidental(k, j) = product / static_cast<double>(scores.size());
    }
  constexpr double least_pivot = 0.1;
  const auto factor = lower_factor(accidental);
  if (!factor || factor->diagonal().minCoeff() < least_pivot) return wanted;
  Eigen::MatrixXd mixed = wanted;  // times the inverse of the factor, by substitution
  for (Eigen::Index row = 0; row < size; ++row)
    for (Eigen::Index k = size - 1; k >= 0; --k) {
      for (Eigen::Index j = k + 1; j < size; ++j) mixed(row, k) -= mixed(row, j) * (*factor)(j, k);
      mixed(row, k) /= (*factor)(k, k);
    }
  return mixed;
}

}  // namespace

std::uint64_t CorrelatedStrata::operator()(std::uint64_t trial, std::size_t parameter) const {
  std::call_once(laid_out_, [this] { lay_out(); });
  const std::vector<std::uint32_t>& own = strata_[parameter];
  return own.empty() ? KeyedPermutation(trials_, seed_, parameter)(trial) : own[trial];
}

void CorrelatedStrata::lay_out() const {
  const std::vector<std::size_t> correlated = copula_.dependent();
  strata_.resize(copula_.size());
  std::vector<std::vector<std::uint32_t>*> orders;
  for (const std::size_t parameter : correlated) {
    std::vector<std::uint32_t>& order = *orders.emplace_back(&strata_[parameter]);
    const KeyedPermutation permutation(trials_, seed_, parameter);
    order.resize(trials_);
    for (std::uint64_t trial = 0; trial < trials_; ++trial)
      order[trial] = static_cast<std::uint32_t>(permutation(trial));
  }
  if (trials_ == 1 || orders.empty()) return;
  const std::vector<double> scores = scores_of(trials_);
  const Eigen::MatrixXd mixed = mixing(orders, scores, copula_.factor(correlated));
  std::vector<std::pair<double, std::uint32_t>> wanted(trials_);
  for (std::size_t k = orders.size(); k-- > 1;) {  // the last first: each takes the random orders of those before it
    for (std::uint32_t trial = 0; trial < trials_; ++trial) {
      double score = 0.0;
      for (std::size_t j = 0; j <= k; ++j)
        score += mixed(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(j)) * scores[(*orders[j])[trial]];
      wanted[trial] = {score, trial};
    }
    std::sort(wanted.begin(), wanted.end());
    for (std::uint32_t stratum = 0; stratum < trials_; ++stratum) (*orders[k])[wanted[stratum].second] = stratum;
  }
}

}  // namespace wormdrive
