#pragma once
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <variant>
#include <vector>

#include <boost/random/sobol.hpp>

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
/// that parameter from B; samples (parameters + 2) trials.
struct Saltelli {
  static constexpr std::string_view kind = "saltelli";
  std::uint64_t samples{};
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
};

using DesignSettings = std::variant<MonteCarlo, LatinHypercube, SobolSequence, Saltelli, Grid, OneAtATime>;

/// Whether the points are a sample of the parameters' distribution, so that shares of them are probabilities.
bool is_sample(const DesignSettings& settings);
/// Whether coordinates may be made dependent afterwards.
bool allows_correlation(const DesignSettings& settings);

/// How many trials a design has with so many parameters.
std::uint64_t size(const DesignSettings& settings, std::size_t parameters);

/// Gives the points of a design, any of them in any order; a thread has its own.
class Design {
 public:
  Design(DesignSettings settings, std::size_t parameters, std::uint64_t seed);

  /// The coordinates of a trial, each in (0, 1).
  std::vector<double> point(std::uint64_t trial);

 private:
  std::vector<double> at(const MonteCarlo&, std::uint64_t trial) const;
  std::vector<double> at(const LatinHypercube& design, std::uint64_t trial) const;
  std::vector<double> at(const SobolSequence&, std::uint64_t trial);
  std::vector<double> at(const Saltelli&, std::uint64_t trial);
  std::vector<double> at(const Grid& design, std::uint64_t trial) const;
  std::vector<double> at(const OneAtATime& design, std::uint64_t trial) const;
  double draw(std::uint64_t trial, std::size_t parameter) const;
  std::vector<double> sobol(std::uint64_t row);

  DesignSettings settings_;
  std::size_t parameters_;
  std::uint64_t seed_;
  boost::random::sobol sequence_;
  std::vector<std::uint64_t> shift_;  ///< of each dimension of the sequence
};

}  // namespace wormdrive
