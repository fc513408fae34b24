#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <variant>
#include <vector>

#include "sweep/study/correlated_strata.hpp"

namespace wormdrive {

// How the trials of a sweep are spread over the unit cube, a coordinate for each parameter: the probability below its
// value. A new design is a struct here, an entry in the variant and a `point` in design.cpp.

/// Every trial on its own.
struct MonteCarlo {
  static constexpr std::string_view kind = "monte_carlo";
  std::uint64_t trials{};
};
/// Of n equally likely strata of each parameter every one is used once.
struct LatinHypercube {
  static constexpr std::string_view kind = "latin_hypercube";
  std::uint64_t trials{};
};
/// A Sobol sequence with a random digital shift.
struct SobolSequence {
  static constexpr std::string_view kind = "sobol";
  std::uint64_t trials{};
};
/// For Sobol indices [Saltelli2010]: of two independent samples A and B the rows A, B, and for each parameter A with
/// that parameter from B; samples (parameters + 2) trials. For indices of pairs B with each parameter from A comes on
/// top [Saltelli2002]. The samples are dealt out to Sobol sequences whose digital shifts are independent: a single
/// sequence does not tell how far it is off, these do by how much they differ.
struct Saltelli {
  static constexpr std::string_view kind = "saltelli";
  static constexpr std::uint64_t replicates = 16;
  std::uint64_t samples{};
  bool second_order = false;

  /// Trials of a sample.
  std::uint64_t rows(std::size_t parameters) const { return (second_order ? 2 : 1) * parameters + 2; }
};
/// For Shapley effects [Song2016, Goda2021]: of each random order of the parameters a draw, and for each place of the
/// order the same with all parameters from there on drawn anew, given those before it; permutations (parameters + 1)
/// trials.
struct Shapley {
  static constexpr std::string_view kind = "shapley";
  std::uint64_t permutations{};
  Copula copula;  ///< of the parameters, which are drawn in the order of each permutation
};
/// Trajectories through a grid of levels, along each of which every parameter changes once, by half of the levels
/// [Morris1991]: (parameters + 1) trials each. The levels are in the middle of equally likely strata, so that
/// distributions without limits have them, too.
struct Morris {
  static constexpr std::string_view kind = "morris";
  std::uint64_t trajectories{}, levels{};
};
/// Every combination of levels.
struct Grid {
  static constexpr std::string_view kind = "grid";
  std::vector<std::uint64_t> levels;  ///< of each parameter
};
/// All at their medians, then each parameter in turn over its levels.
struct OneAtATime {
  static constexpr std::string_view kind = "one_at_a_time";
  std::vector<std::uint64_t> levels;
  std::vector<double> medians;  ///< the coordinates at which they are
};

/// The rows of a table, whose columns stand as the values of discrete parameters, one after the other.
struct TableOfPoints {
  static constexpr std::string_view kind = "table";
  std::uint64_t trials{};
};

using DesignSettings =
    std::variant<MonteCarlo, LatinHypercube, SobolSequence, Saltelli, Grid, OneAtATime, TableOfPoints, Morris, Shapley>;

/// The coordinate at which a level stands: in the middle of the stratum that is its own.
double middle_of(std::uint64_t level, std::uint64_t levels);

/// Whether the points are a sample of the parameters' distribution, so that shares of them are probabilities.
bool is_sample(const DesignSettings& settings);
/// Whether every parameter has levels of its own.
bool goes_by_levels(const DesignSettings& settings);
/// Whether every trial is a draw of all parameters.
bool draws_each_trial(const DesignSettings& settings);
/// Whether parameters may be dependent.
bool allows_correlation(const DesignSettings& settings);

/// How many trials a design has with so many parameters.
std::uint64_t size(const DesignSettings& settings, std::size_t parameters);

/// Trials that belong together, and how many of them, the first ones, are draws of their own from the distribution of
/// the parameters: in a Saltelli design A and B, of a permutation one. Where the design is no sample, every trial
/// counts.
struct Block {
  std::uint64_t trials = 1, draws = 1;

  bool is_draw(std::uint64_t trial) const { return trial % trials < draws; }
};
Block block_of(const DesignSettings& settings, std::size_t parameters);

/// The trial whose noise a trial has: itself, but where a row of a Saltelli design is A or B with one parameter from
/// the other one that of A or B, and of a trajectory of Morris or a permutation its first one, so that nothing but
/// parameters are others.
std::uint64_t noise_of(const DesignSettings& settings, std::size_t parameters, std::uint64_t trial);

/// Gives the points of a design, any of them in any order; a thread has its own.
class Design {
 public:
  /// strata: those of a Latin hypercube of correlated parameters, else none.
  Design(DesignSettings settings, std::size_t parameters, std::uint64_t seed,
         std::shared_ptr<const CorrelatedStrata> strata = nullptr);
  ~Design();

  /// The coordinates of a trial, each in (0, 1).
  std::vector<double> point(std::uint64_t trial);
  /// All parameters in the random order of a trajectory of Morris, or of a permutation.
  std::vector<std::size_t> order(std::uint64_t key) const;

 private:
  std::vector<double> at(const MonteCarlo&, std::uint64_t trial) const;
  std::vector<double> at(const LatinHypercube& design, std::uint64_t trial) const;
  std::vector<double> at(const SobolSequence&, std::uint64_t trial);
  std::vector<double> at(const Saltelli& design, std::uint64_t trial);
  std::vector<double> at(const Grid& design, std::uint64_t trial) const;
  std::vector<double> at(const OneAtATime& design, std::uint64_t trial) const;
  std::vector<double> at(const TableOfPoints& design, std::uint64_t trial) const;
  std::vector<double> at(const Morris& design, std::uint64_t trial) const;
  std::vector<double> at(const Shapley& design, std::uint64_t trial) const;
  double draw(std::uint64_t trial, std::size_t parameter) const;
  /// A row of the sequence under one of its shifts.
  std::vector<double> sobol(std::uint64_t row, std::uint64_t replicate);

  DesignSettings settings_;
  std::size_t parameters_;
  std::uint64_t seed_;
  std::shared_ptr<const CorrelatedStrata> strata_;
  struct Sequence;  // of a library whose header takes seconds to read
  std::unique_ptr<Sequence> sequence_;
  std::vector<std::vector<std::uint64_t>> shifts_;  ///< of each replicate and dimension of the sequence
};

}  // namespace wormdrive
