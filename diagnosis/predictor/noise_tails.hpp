#pragma once
#include <cmath>
#include <numeric>
#include <vector>

#include "diagnosis/predictor/noise_model.hpp"
#include "statistics/student_t.hpp"

namespace wormdrive {

/// Of an innovation, with what it counts.
struct Square {
  double value, share;
};

/// Student's t as a negative log likelihood, less what it is at zero with the usual degrees of freedom.
class NegativeLogLikelihood {
 public:
  explicit NegativeLogLikelihood(const NoiseGroup& g)
      : level_(std::log(g.scale) +
               (StudentT{g.freedom}.normalization() - StudentT{rules::tail_freedom}.normalization())),
        power_(0.5 * (g.freedom + 1.0)),
        inverse_(1.0 / (g.freedom * g.scale * g.scale)) {}
  double operator()(double square) const { return level_ + power_ * std::log1p(square * inverse_); }
  double operator()(const std::vector<Square>& squares) const {
    return std::accumulate(squares.begin(), squares.end(), 0.0, [&](double sum, const Square& square) {
      return sum + square.share * (*this)(square.value);
    });
  }

 private:
  double level_, power_, inverse_;
};

/// Scale and tails of a group: the usual tails, or those of errors of rounding where the errors become more likely. The
/// latter grow into the former with the scale: a likelihood that jumps would hold a fit where it is.
/// least: scale; resolution: of the encoder.
void fit_scale_and_tails(NoiseGroup& group, const std::vector<Square>& squares, double least, double resolution,
                         int rounds);

/// Whether hardly any noise but rounding is seen while the drive moves, in any recording.
bool mostly_rounding(const NoiseModel& noise);

}  // namespace wormdrive
