// Two trials in a register, for every processor.
#include "control/lanes/library.hpp"
#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include "control/lanes/kernel.hpp"
#include "control/lanes/kernels.hpp"
#include "control/lanes/step_kernel.hpp"

namespace wormdrive {
namespace {

struct Width {
  static constexpr int lanes = 2;
  using Register = double __attribute__((vector_size(16)));
  using Bits = long long __attribute__((vector_size(16)));

  [[gnu::always_inline]] static unsigned signs(Bits bits) {
#if defined(__SSE2__)
    return static_cast<unsigned>(_mm_movemask_pd(reinterpret_cast<__m128d>(bits)));
#else
    return (bits[0] < 0 ? 1U : 0U) | (bits[1] < 0 ? 2U : 0U);
#endif
  }
  [[gnu::always_inline]] static Register roots(Register x) {
#if defined(__SSE2__)
    return _mm_sqrt_pd(x);
#else
    return Register{std::sqrt(x[0]), std::sqrt(x[1])};
#endif
  }
};

}  // namespace

void take_samples_plain(const LaneBatch& batch, const LaneSample* begin, const LaneSample* end) {
  LaneKernel<Width>::take(batch, begin, end);
}
void take_step_plain(const StepBatch& batch) { StepKernel<Width>::take(batch); }

}  // namespace wormdrive
