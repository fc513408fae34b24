#include "diagnosis/verdict/certificate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "diagnosis/fitting/fit.hpp"
#include "diagnosis/inference/comparison.hpp"
#include "diagnosis/rules/evidence.hpp"
#include "diagnosis/rules/verdict.hpp"
#include "statistics/symmetric_eigen.hpp"

namespace wormdrive {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

using Columns = std::vector<Eigen::Index>;

/// A candidate's signatures from one start.
struct Signature {
  std::size_t candidate, start;
  Columns columns;  ///< of the Gram matrix
  double size;      ///< that leaves it, of the first field [SI]
};

class Signatures {
 public:
  Signatures(const LinearSystem& linear, const Hypothesis& base, const std::vector<Candidate>& all)
      : gram_(linear.A), base_(base), all_(all) {
    for (const StartColumns& s : linear.starts) {
      const Candidate& candidate = all[s.candidate];
      Signature made{s.candidate, s.start, s.columns, candidate.coordinates[0].scale};
      if (candidate.finite) made.size = std::abs(candidate.starts[s.start].values[0]);
      if (candidate.toleranced) made.columns.push_back(index_of(base, candidate.coordinates[0]));
      if (!is_periodic(candidate) && made.columns.size() > 1)
        made.columns.erase(made.columns.begin() + 1, made.columns.end());
      list_.push_back(std::move(made));
    }
  }

  const std::vector<Signature>& list() const { return list_; }
  static bool is_periodic(const Candidate& s) { return s.coordinates[0].form == CoordinateForm::in_phase; }

  /// Squared length of the worst direction of a signature beside the tolerances and, if given, another candidate.
  double length(const Signature& of, const Signature* beside) const {
    Eigen::MatrixXd gram = gram_(of.columns, of.columns);
    Columns others;
    std::vector<double> precision;
    for (std::size_t k = 0; k < base_.free.size(); ++k) {
      const Coordinate& c = base_.free[k];
      if (is_own(all_[of.candidate], c)) continue;  // what it frees only draws near what it does
      others.push_back(static_cast<Eigen::Index>(k));
      const bool freed = beside && (all_[beside->candidate].frees == c.effect || is_own(all_[beside->candidate], c));
      precision.push_back(freed ? 0.0 : std::pow(c.scale / c.tolerance, 2));
    }
    if (beside && !all_[beside->candidate].toleranced)
      for (const Eigen::Index k : beside->columns) {
        others.push_back(k);
        precision.push_back(0.0);
      }
    if (!others.empty()) {
      Eigen::MatrixXd A = gram_(others, others);
      for (std::size_t k = 0; k < others.size(); ++k)
        A(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(k)) += precision[k];
      const Eigen::MatrixXd cross = gram_(others, of.columns);
      for (Eigen::Index k = 0; k < cross.cols(); ++k) gram.col(k) -= cross.transpose() * solve_normal(A, cross.col(k));
    }
    return std::max(0.0, symmetric_eigenvalues(gram)[0]);
  }

 private:
  static bool is_own(const Candidate& s, const Coordinate& c) {
    return std::any_of(s.coordinates.begin(), s.coordinates.end(), [&](const Coordinate& own) { return own.is(c); });
  }

  const Eigen::MatrixXd& gram_;
  const Hypothesis& base_;
  const std::vector<Candidate>& all_;
  std::vector<Signature> list_;
};

/// Whether the signature of a candidate changes its shape with its size: the smaller a lag is the more it looks like a
/// delay, and what tells them apart grows twice as fast with the size as they do.
bool is_shaped(const Candidate& s) { return s.finite && s.resizable && !s.either_sign; }

/// What one start of a candidate shows.
Visibility of_signature(const Signatures& signatures, const Signature& mine, const std::vector<Candidate>& all) {
  const Candidate& candidate = all[mine.candidate];
  const Coordinate& c = candidate.coordinates[0];
  Visibility v;
  v.effect = candidate.effect;
  v.field = c.field;
  if (Signatures::is_periodic(candidate))
    for (const FieldValue& f : candidate.starts[mine.start].chosen)
      v.chosen = fmt::format("{} = {:g}", f.field, f.value);
  v.unit = field_of({}, c.effect, c.field).unit;
  const double alone = signatures.length(mine, nullptr);
  const auto size = [&](double length) {
    return length > 1e-9 ? mine.size * std::sqrt(rules::findable_length / length) : never;
  };
  v.detectable = size(alone);
  double least = alone;
  for (const Signature& other : signatures.list()) {
    if (other.candidate == mine.candidate || all[other.candidate].frees == candidate.effect) continue;
    const double beside = signatures.length(mine, &other);
    if (beside >= least && !v.nearest.empty()) continue;
    least = beside;
    v.nearest = all[other.candidate].effect;
  }
  const double share = alone > 0.0 ? least / alone : 1.0;
  v.likeness = 1.0 - std::min(1.0, share);
  v.nameable = size(least);
  if (is_shaped(candidate) && share < rules::much_alike)
    v.nameable = std::max(v.nameable, mine.size * std::sqrt(rules::nameable_share / std::max(share, 1e-12)));
  else if (share < rules::nameable_share)
    v.nameable = never;
  v.resolved = v.nameable;
  if (candidate.toleranced) {
    const double least_size = rules::least_tolerances * c.tolerance;
    v.detectable = std::max(v.detectable, least_size);
    v.nameable = std::max(v.nameable, least_size);
  }
  v.observable = v.detectable < std::max(std::abs(c.high - c.centre), std::abs(c.low - c.centre));
  if (c.form == CoordinateForm::inverse) {
    v.detectable = 1.0 / v.detectable;
    v.nameable = 1.0 / v.nameable;
    v.resolved = 1.0 / v.resolved;
  }
  return v;
}

/// A limit shows if it cuts: the largest of those tried out that does.
Visibility of_limit(const Signatures& signatures, std::size_t candidate, const std::vector<Candidate>& all) {
  Visibility v;
  const Coordinate& c = all[candidate].coordinates[0];
  v.effect = c.effect;
  v.field = c.field;
  v.unit = field_of({}, c.effect, c.field).unit;
  v.detectable = v.nameable = v.resolved = never;
  v.observable = false;
  for (const Signature& s : signatures.list())
    if (s.candidate == candidate && signatures.length(s, nullptr) > rules::findable_length) {
      v.detectable = v.nameable = v.resolved = v.observable ? std::max(v.detectable, s.size) : s.size;
      v.observable = true;
    }
  return v;
}

}  // namespace

std::vector<Visibility> certificate(const LinearSystem& linear, const Hypothesis& base,
                                    const std::vector<Candidate>& all, const Magnitudes& sizes) {
  const Signatures signatures(linear, base, all);
  std::vector<Visibility> list;
  for (std::size_t c = 0; c < all.size(); ++c) {
    if (all[c].is_limit && !all[c].resizable) {
      list.push_back(of_limit(signatures, c, all));
      continue;
    }
    std::vector<Visibility> starts;
    for (std::size_t start = 0; start < all[c].starts.size(); ++start)
      for (const Signature& s : signatures.list())
        if (s.candidate == c && s.start == start) starts.push_back(of_signature(signatures, s, all));
    if (starts.empty()) continue;
    if (Signatures::is_periodic(all[c])) {  // each number of periods has a size of its own
      list.insert(list.end(), starts.begin(), starts.end());
      continue;
    }
    std::stable_sort(starts.begin(), starts.end(),
                     [](const Visibility& a, const Visibility& b) { return a.detectable < b.detectable; });
    list.push_back(starts[(starts.size() - 1) / 2]);
    for (const Twin& twin : all[c].twins) {
      Visibility v = list.back();
      v.effect = twin.effect;
      v.nearest = all[c].effect;
      v.likeness = 1.0;
      v.field = twin.field;
      v.unit = field_of({}, twin.effect, twin.field).unit;
      list.back().nearest = twin.effect;
      list.back().likeness = 1.0;
      list.push_back(v);
    }
  }
  for (const NotExamined& n : not_examined(base.drive.effects, sizes)) {
    if (!n.needs_worm_encoder) continue;
    Visibility v;
    v.effect = n.effect;
    v.detectable = v.nameable = v.resolved = never;
    v.observable = false;
    list.push_back(v);
  }
  return list;
}

std::vector<std::string> unobservable(const std::vector<Visibility>& certificate) {
  std::vector<std::string> effects;
  for (const Visibility& v : certificate)
    if (std::none_of(certificate.begin(), certificate.end(),
                     [&](const Visibility& other) { return other.effect == v.effect && other.observable; }) &&
        std::find(effects.begin(), effects.end(), v.effect) == effects.end())
      effects.push_back(v.effect);
  return effects;
}

}  // namespace wormdrive
