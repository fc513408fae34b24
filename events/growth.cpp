#include "events/growth.hpp"

#include "core/numbers/eigenvalues.hpp"

namespace wormdrive {

double largest_growth(const Eigen::Matrix4d& J) { return eigenvalues(J).real().maxCoeff(); }
double largest_growth(const Eigen::Matrix3d& J) { return eigenvalues(J).real().maxCoeff(); }
double fastest_rate(const Eigen::Matrix4d& J) { return eigenvalues(J).cwiseAbs().maxCoeff(); }
double fastest_rate(const Eigen::Matrix3d& J) { return eigenvalues(J).cwiseAbs().maxCoeff(); }

}  // namespace wormdrive
