#pragma once
#include <cstddef>
#include <vector>

#include "events/polynomial_root.hpp"
#include "events/taylor_expansion.hpp"

namespace wormdrive {

/// A formula as a list of operations, each on results of earlier ones: propagated coefficient by coefficient it turns
/// the equations of motion into power series at a cost of O(order^2) [Moore 1966].
class TaylorProgram {
 public:
  enum class Operation {
    constant,
    time,
    angle,
    speed,
    add,
    subtract,
    multiply,
    divide,
    sine,    ///< together with the cosine, which follows it
    cosine,
    exponential,
    square_root,
    power,  ///< to a constant exponent
  };

  /// The place at which a formula took a branch: the program holds while this result keeps its sign.
  struct Branch {
    int result;
    double sign;  ///< +1 or -1
  };

  void clear();

  /// The result of an operation on results a and b; one that was asked for before is not computed twice.
  int result(Operation operation, int a = -1, int b = -1, double number = 0.0);
  /// Notes that a branch was taken by the sign of a result.
  void depends_on(int result, double sign);

  const std::vector<Branch>& branches() const { return branches_; }

  /// Computes coefficient k of every result; the coefficients up to k of angle and speed must be there.
  void propagate(int k, double t, const Coefficients& theta, const Coefficients& omega);
  /// Coefficient k of a result.
  double coefficient(int result, int k) const { return store_[static_cast<std::size_t>(result)][static_cast<std::size_t>(k)]; }

 private:
  struct Step {
    Operation operation;
    int a, b;
    double number;
    int degree;  ///< behind it all coefficients are zero
  };

  int degree_of(Operation operation, int a, int b) const;
  int append(const Step& step);

  std::vector<Step> steps_;
  std::vector<Coefficients> store_;
  std::vector<Branch> branches_;
};

}  // namespace wormdrive
