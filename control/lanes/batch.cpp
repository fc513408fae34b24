#include "control/lanes/batch.hpp"

#include "control/lanes/kernels.hpp"

namespace wormdrive {

int lanes_of(LaneKind kind) {
  switch (kind) {
    case LaneKind::plain: return 2;
    case LaneKind::avx2: return 4;
    case LaneKind::avx512: return 8;
  }
  return 1;
}

int lanes_of(LaneKind kind, const LaneVariant& variant) { return (variant.taped ? 2 : 1) * lanes_of(kind); }

bool is_available([[maybe_unused]] LaneKind kind) {
#if defined(__x86_64__)
  switch (kind) {
    case LaneKind::plain: return true;
    case LaneKind::avx2: return __builtin_cpu_supports("avx2");
    case LaneKind::avx512: return __builtin_cpu_supports("avx512f");
  }
#endif
  return kind == LaneKind::plain;
}

LaneKind widest_lanes() {
  LaneKind widest = LaneKind::plain;
  for (const LaneKind kind : lane_kinds)
    if (is_available(kind)) widest = kind;
  return widest;
}

void take_samples(LaneKind kind, const LaneBatch& batch, std::span<const LaneSample> samples) {
  const LaneSample *const begin = samples.data(), *const end = begin + samples.size();
  switch (kind) {
    case LaneKind::plain: return take_samples_plain(batch, begin, end);
#if defined(__x86_64__)
    case LaneKind::avx2: return take_samples_avx2(batch, begin, end);
    case LaneKind::avx512: return take_samples_avx512(batch, begin, end);
#else
    case LaneKind::avx2:
    case LaneKind::avx512: return;
#endif
  }
}

void take_step(LaneKind kind, const StepBatch& batch) {
  switch (kind) {
    case LaneKind::plain: return take_step_plain(batch);
#if defined(__x86_64__)
    case LaneKind::avx2: return take_step_avx2(batch);
    case LaneKind::avx512: return take_step_avx512(batch);
#else
    case LaneKind::avx2:
    case LaneKind::avx512: return;
#endif
  }
}

}  // namespace wormdrive
