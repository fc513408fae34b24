// Eight trials in a register, for processors with AVX-512.
#if defined(__x86_64__)
#include <immintrin.h>

#include "control/lanes/library.hpp"

// Behind the standard library, whose functions the rest of the program shares.
#pragma GCC target("avx512f")

#include "control/lanes/kernel.hpp"
#include "control/lanes/kernels.hpp"
#include "control/lanes/step_kernel.hpp"

namespace wormdrive {
namespace {

struct Width {
  static constexpr int lanes = 8;
  using Register = double __attribute__((vector_size(64)));
  using Bits = long long __attribute__((vector_size(64)));

  [[gnu::always_inline]] static unsigned signs(Bits bits) {
    return _mm512_cmplt_epi64_mask(reinterpret_cast<__m512i>(bits), _mm512_setzero_si512());
  }
  // With a mask: GCC warns of what the intrinsic without one leaves undefined.
  [[gnu::always_inline]] static Register roots(Register x) { return _mm512_maskz_sqrt_pd(0xff, x); }
};

}  // namespace

void take_samples_avx512(const LaneBatch& batch, const LaneSample* begin, const LaneSample* end) {
  LaneKernel<Width>::take(batch, begin, end);
}
void take_step_avx512(const StepBatch& batch) { StepKernel<Width>::take(batch); }

}  // namespace wormdrive
#endif
