#pragma once
#include <limits>
#include <string>
#include <string_view>
#include <tuple>
#include <variant>
#include <vector>

#include "core/field.hpp"

namespace wormdrive {

// How an uncertain number is distributed, in the unit in which its parameter is stated. Each has quantile(u), the value
// below which it lies with probability u, 0 < u < 1; and refusal(), what bounds of single fields cannot say, or empty.

/// Every value between two limits is equally likely.
struct Uniform {
  static constexpr std::string_view kind = "uniform";
  double low{}, high{};

  static constexpr auto fields() {
    return std::tuple{Field{&Uniform::low, "low", unit::none, bounds::any, "lowest value"},
                      Field{&Uniform::high, "high", unit::none, bounds::any, "highest value"}};
  }
  std::string refusal() const;
  double quantile(double u) const { return low + u * (high - low); }
};

/// The bell curve, without limits.
struct Normal {
  static constexpr std::string_view kind = "normal";
  double mean{}, deviation{};

  static constexpr auto fields() {
    return std::tuple{Field{&Normal::mean, "mean", unit::none, bounds::any, "mean"},
                      Field{&Normal::deviation, "deviation", unit::none, bounds::positive, "standard deviation"}};
  }
  std::string refusal() const { return ""; }
  double quantile(double u) const;
};

/// The bell curve cut off at one or both ends; mean and deviation are those before the cut.
struct TruncatedNormal {
  static constexpr std::string_view kind = "truncated_normal";
  double mean{}, deviation{};
  double low{-std::numeric_limits<double>::infinity()}, high{std::numeric_limits<double>::infinity()};

  static constexpr auto fields() {
    using P = TruncatedNormal;
    constexpr Presence o = Presence::optional;
    return std::tuple{
        Field{&P::mean, "mean", unit::none, bounds::any, "mean before truncation"},
        Field{&P::deviation, "deviation", unit::none, bounds::positive, "standard deviation before truncation"},
        Field{&P::low, "low", unit::none, bounds::any, "lowest value; none if not stated", o},
        Field{&P::high, "high", unit::none, bounds::any, "highest value; none if not stated", o}};
  }
  std::string refusal() const;
  double quantile(double u) const;
};

/// A positive number whose logarithm is normal.
struct Lognormal {
  static constexpr std::string_view kind = "lognormal";
  double median{}, log_deviation{};

  static constexpr auto fields() {
    using P = Lognormal;
    return std::tuple{Field{&P::median, "median", unit::none, bounds::positive, "half of the values lie below"},
                      Field{&P::log_deviation, "log_deviation", unit::none, bounds::positive,
                            "standard deviation of the natural logarithm"}};
  }
  std::string refusal() const { return ""; }
  double quantile(double u) const;
};

/// Rises linearly to its most likely value and falls linearly from it.
struct Triangular {
  static constexpr std::string_view kind = "triangular";
  double low{}, mode{}, high{};

  static constexpr auto fields() {
    using P = Triangular;
    return std::tuple{Field{&P::low, "low", unit::none, bounds::any, "lowest value"},
                      Field{&P::mode, "mode", unit::none, bounds::any, "most likely value"},
                      Field{&P::high, "high", unit::none, bounds::any, "highest value"}};
  }
  std::string refusal() const;
  double quantile(double u) const;
};

/// Every ratio of two values is as likely anywhere between two limits: the logarithm is uniform.
struct LogUniform {
  static constexpr std::string_view kind = "log_uniform";
  double low{}, high{};

  static constexpr auto fields() {
    return std::tuple{Field{&LogUniform::low, "low", unit::none, bounds::positive, "lowest value"},
                      Field{&LogUniform::high, "high", unit::none, bounds::positive, "highest value"}};
  }
  std::string refusal() const;
  double quantile(double u) const;
};

/// Between two limits, with a density like (x - low)^(alpha - 1) (high - x)^(beta - 1).
struct Beta {
  static constexpr std::string_view kind = "beta";
  double alpha{}, beta{}, low{}, high{};

  static constexpr auto fields() {
    return std::tuple{Field{&Beta::alpha, "alpha", unit::none, bounds::positive, "shape at the lowest value"},
                      Field{&Beta::beta, "beta", unit::none, bounds::positive, "shape at the highest value"},
                      Field{&Beta::low, "low", unit::none, bounds::any, "lowest value"},
                      Field{&Beta::high, "high", unit::none, bounds::any, "highest value"}};
  }
  std::string refusal() const;
  double quantile(double u) const;
};

/// An expert's three numbers: the beta distribution with mean (low + 4 mode + high) / 6 [Malcolm1959].
struct Pert {
  static constexpr std::string_view kind = "pert";
  double low{}, mode{}, high{};

  static constexpr auto fields() {
    return std::tuple{Field{&Pert::low, "low", unit::none, bounds::any, "lowest value"},
                      Field{&Pert::mode, "mode", unit::none, bounds::any, "most likely value"},
                      Field{&Pert::high, "high", unit::none, bounds::any, "highest value"}};
  }
  std::string refusal() const;
  double quantile(double u) const;
};

/// The largest of many: with probability exp(-exp(-(x - mode) / scale)) below x.
struct Gumbel {
  static constexpr std::string_view kind = "gumbel";
  double mode{}, scale{};

  static constexpr auto fields() {
    return std::tuple{Field{&Gumbel::mode, "mode", unit::none, bounds::any, "most likely value"},
                      Field{&Gumbel::scale, "scale", unit::none, bounds::positive, "deviation over pi / sqrt(6)"}};
  }
  std::string refusal() const { return ""; }
  double quantile(double u) const;
};

/// The smallest of many: with probability exp(-((x - low) / scale)^shape) above x.
struct Weibull {
  static constexpr std::string_view kind = "weibull";
  double shape{}, scale{}, low{};

  static constexpr auto fields() {
    return std::tuple{
        Field{&Weibull::shape, "shape", unit::none, bounds::positive, "exponent"},
        Field{&Weibull::scale, "scale", unit::none, bounds::positive, "63.2 % lie less than this above the lowest"},
        Field{&Weibull::low, "low", unit::none, bounds::any, "lowest value", Presence::optional}};
  }
  std::string refusal() const { return ""; }
  double quantile(double u) const;
};

/// One of several values, equally likely unless weights say otherwise.
struct Discrete {
  static constexpr std::string_view kind = "discrete";
  std::vector<double> values, weights;

  std::string refusal() const;
  double quantile(double u) const;
  /// Every value once, in the order in which they are stated, all equally likely.
  Discrete each_once() const;
};

/// A distribution as it was found: values at probabilities from 0 to 1, straight between them.
struct QuantileTable {
  static constexpr std::string_view kind = "table";
  std::vector<double> values, probabilities;

  std::string refusal() const;
  double quantile(double u) const;
};

/// What was measured, each value as likely as the others: a column of a file.
struct Empirical {
  static constexpr std::string_view kind = "empirical";
  std::vector<double> values;  ///< in rising order

  std::string refusal() const { return ""; }  // whoever reads the file says what is wrong with it
  /// Of n values the k-th for (k - 1)/n <= u < k/n.
  double quantile(double u) const;
};

/// What was found together with others: a column of a file, of which every trial draws a row. All parameters of the
/// file have the values of that row.
struct RowOfFile {
  static constexpr std::string_view kind = "row";
  std::string file;
  std::vector<double> values;  ///< row by row

  std::string refusal() const { return ""; }
  double quantile(double u) const;
};

/// A new distribution is a struct like these and one entry here.
using Distribution = std::variant<Uniform, Normal, TruncatedNormal, Lognormal, Triangular, Discrete, QuantileTable,
                                  LogUniform, Beta, Pert, Gumbel, Weibull, Empirical, RowOfFile>;

inline double quantile(const Distribution& distribution, double u) {
  return std::visit([u](const auto& d) { return d.quantile(u); }, distribution);
}

/// Whether both are columns of one file, drawn by its rows.
inline bool are_of_one_row(const Distribution& a, const Distribution& b) {
  const auto *const one = std::get_if<RowOfFile>(&a), *const other = std::get_if<RowOfFile>(&b);
  return one && other && one->file == other->file;
}

/// Whether only single values can be drawn, all of them whole.
bool only_whole_numbers(const Distribution& distribution);

}  // namespace wormdrive
