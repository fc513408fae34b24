#include "statistics/student_t.hpp"

#include <boost/math/distributions/students_t.hpp>

namespace wormdrive {

double t_quantile(std::size_t degrees) {
  return boost::math::quantile(boost::math::students_t(static_cast<double>(std::max<std::size_t>(1, degrees))), 0.975);
}

}  // namespace wormdrive
