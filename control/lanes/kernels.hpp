#pragma once
#include "control/lanes/batch.hpp"
#include "control/lanes/step_batch.hpp"

namespace wormdrive {

// The kernels, each for processors that have its instructions.
void take_samples_plain(const LaneBatch& batch, const LaneSample* begin, const LaneSample* end);
void take_samples_avx2(const LaneBatch& batch, const LaneSample* begin, const LaneSample* end);
void take_samples_avx512(const LaneBatch& batch, const LaneSample* begin, const LaneSample* end);

void take_step_plain(const StepBatch& batch);
void take_step_avx2(const StepBatch& batch);
void take_step_avx512(const StepBatch& batch);

}  // namespace wormdrive
