#include "events/taylor_program.hpp"

#include <algorithm>
#include <cmath>

#include "events/sine_cosine.hpp"

namespace wormdrive {

void TaylorProgram::clear() {
  steps_.clear();
  branches_.clear();
}

int TaylorProgram::result(Operation operation, int a, int b, double number) {
  for (std::size_t k = 0; k < steps_.size(); ++k) {
    const Step& s = steps_[k];
    if (s.operation == operation && s.a == a && s.b == b && s.number == number) return static_cast<int>(k);
  }
  const int degree = degree_of(operation, a, b);
  if (operation != Operation::sine && operation != Operation::cosine)
    return append({operation, a, b, number, degree});
  const int sine = append({Operation::sine, a, b, number, degree});
  append({Operation::cosine, a, b, number, degree});
  return operation == Operation::sine ? sine : sine + 1;
}

void TaylorProgram::depends_on(int result, double sign) {
  for (const Branch& known : branches_)
    if (known.result == result) return;
  branches_.push_back({result, sign});
}

int TaylorProgram::append(const Step& step) {
  steps_.push_back(step);
  if (store_.size() < steps_.size()) store_.emplace_back();
  return static_cast<int>(steps_.size()) - 1;
}

int TaylorProgram::degree_of(Operation operation, int a, int b) const {
  const auto of = [&](int result) { return steps_[static_cast<std::size_t>(result)].degree; };
  switch (operation) {
    case Operation::constant: return 0;
    case Operation::time: return 1;
    case Operation::add:
    case Operation::subtract: return std::max(of(a), of(b));
    case Operation::multiply: return std::min(highest_order, of(a) + of(b));
    case Operation::divide: return of(b) == 0 ? of(a) : highest_order;
    case Operation::angle:
    case Operation::speed:
    case Operation::sine:
    case Operation::cosine:
    case Operation::exponential:
    case Operation::square_root:
    case Operation::power: return highest_order;
  }
  return highest_order;
}

void TaylorProgram::propagate(int k, double t, const Coefficients& theta, const Coefficients& omega) {
  const auto at = static_cast<std::size_t>(k);
  for (std::size_t n = 0; n < steps_.size(); ++n) {
    const Step& step = steps_[n];
    Coefficients& r = store_[n];
    if (k > step.degree) {
      r[at] = 0.0;
      continue;
    }
    static constexpr Coefficients nothing{};
    const Coefficients& x = step.a < 0 ? nothing : store_[static_cast<std::size_t>(step.a)];
    const Coefficients& y = step.b < 0 ? nothing : store_[static_cast<std::size_t>(step.b)];
    const int x_degree = step.a < 0 ? 0 : steps_[static_cast<std::size_t>(step.a)].degree;
    const int y_degree = step.b < 0 ? 0 : steps_[static_cast<std::size_t>(step.b)].degree;
    // sum of weight(j) p[j] q[k - j] over the j that are given and that matter
    const auto convolved = [k](const Coefficients& p, const Coefficients& q, int first, int last, auto&& weight) {
      double sum = 0.0;
      for (int j = first; j <= last; ++j)
        sum += weight(j) * p[static_cast<std::size_t>(j)] * q[static_cast<std::size_t>(k - j)];
      return sum;
    };
    const auto one = [](int) { return 1.0; };
    const auto index = [](int j) { return static_cast<double>(j); };
    const int x_last = std::min(k, x_degree);
    switch (step.operation) {
      case Operation::constant: r[at] = step.number; break;
      case Operation::time: r[at] = k == 0 ? t : 1.0; break;
      case Operation::angle: r[at] = theta[at]; break;
      case Operation::speed: r[at] = omega[at]; break;
      case Operation::add: r[at] = x[at] + y[at]; break;
      case Operation::subtract: r[at] = x[at] - y[at]; break;
      case Operation::multiply: r[at] = convolved(x, y, std::max(0, k - y_degree), x_last, one); break;
      case Operation::divide: r[at] = (x[at] - convolved(y, r, 1, std::min(k, y_degree), one)) / y[0]; break;
      case Operation::sine: {
        Coefficients& cosine = store_[n + 1];
        if (k == 0) {
          const SineAndCosine start = sine_and_cosine(x[0]);
          r[0] = start.sine;
          cosine[0] = start.cosine;
        } else {
          r[at] = convolved(x, cosine, 1, x_last, index) / k;
          cosine[at] = -convolved(x, r, 1, x_last, index) / k;
        }
        break;
      }
      case Operation::cosine: break;  // came with the sine
      case Operation::exponential: r[at] = k == 0 ? std::exp(x[0]) : convolved(x, r, 1, x_last, index) / k; break;
      case Operation::square_root:
        r[at] = k == 0 ? std::sqrt(x[0]) : (x[at] - convolved(r, r, 1, k - 1, one)) / (2.0 * r[0]);
        break;
      case Operation::power:
        r[at] = k == 0 ? std::pow(x[0], step.number)
                       : convolved(x, r, 1, x_last, [&](int j) { return (step.number + 1.0) * j - k; }) / (k * x[0]);
        break;
    }
  }
}

}  // namespace wormdrive
