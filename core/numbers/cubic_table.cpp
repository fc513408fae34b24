#include "core/numbers/cubic_table.hpp"

#include <utility>

// pchip of boost 1.74 uses the global isnan and forgets to include it
// clang-format off
#include <math.h>
#include <boost/math/interpolators/pchip.hpp>
// clang-format on

namespace wormdrive {

CubicTable::CubicTable(std::vector<double> x, std::vector<double> y) : x_(std::move(x)), y_(std::move(y)) {
  const boost::math::interpolators::pchip<std::vector<double>> spline(std::vector<double>(x_), std::vector<double>(y_),
                                                                      0.0, 0.0);
  for (double point : x_) slopes_.push_back(spline.prime(point));
}

}  // namespace wormdrive
