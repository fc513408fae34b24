#include "events/growth.hpp"

#include <Eigen/Eigenvalues>

namespace wormdrive {

double largest_growth(const Eigen::Matrix4d& J) { return J.eigenvalues().real().maxCoeff(); }
double largest_growth(const Eigen::Matrix3d& J) { return J.eigenvalues().real().maxCoeff(); }
double fastest_rate(const Eigen::Matrix4d& J) { return J.eigenvalues().cwiseAbs().maxCoeff(); }
double fastest_rate(const Eigen::Matrix3d& J) { return J.eigenvalues().cwiseAbs().maxCoeff(); }

}  // namespace wormdrive
