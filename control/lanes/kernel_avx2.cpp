// Four trials in a register, for processors with AVX2.
#if defined(__x86_64__)
#include <immintrin.h>

#include "control/lanes/library.hpp"

// Behind the standard library, whose functions the rest of the program shares.
#pragma GCC target("avx2")

#include "control/lanes/kernel.hpp"
#include "control/lanes/kernels.hpp"
#include "control/lanes/step_kernel.hpp"

namespace wormdrive {
namespace {

struct Width {
  static constexpr int lanes = 4;
  using Register = double __attribute__((vector_size(32)));
  using Bits = long long __attribute__((vector_size(32)));

  [[gnu::always_inline]] static unsigned signs(Bits bits) {
    return static_cast<unsigned>(_mm256_movemask_pd(reinterpret_cast<__m256d>(bits)));
  }
  [[gnu::always_inline]] static Register roots(Register x) { return _mm256_sqrt_pd(x); }
};

}  // namespace

void take_samples_avx2(const LaneBatch& batch, const LaneSample* begin, const LaneSample* end) {
  LaneKernel<Width>::take(batch, begin, end);
}
void take_step_avx2(const StepBatch& batch) { StepKernel<Width>::take(batch); }

}  // namespace wormdrive
#endif
