#include "statistics/student_t.hpp"

#include <numbers>

#include <boost/math/distributions/students_t.hpp>

namespace wormdrive {

double StudentT::normalization() const {  // std::lgamma() would write a variable that all threads share
  return boost::math::lgamma(0.5 * nu) - boost::math::lgamma(0.5 * (nu + 1.0)) + 0.5 * std::log(std::numbers::pi * nu);
}

double t_quantile(std::size_t degrees) {
  return boost::math::quantile(boost::math::students_t(static_cast<double>(std::max<std::size_t>(1, degrees))), 0.975);
}

}  // namespace wormdrive
