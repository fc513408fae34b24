#pragma once

namespace wormdrive {

/// The instruction sets for which there are kernels.
enum class LaneKind { plain, avx2, avx512 };
inline constexpr LaneKind lane_kinds[] = {LaneKind::plain, LaneKind::avx2, LaneKind::avx512};

/// Trials in one register.
int lanes_of(LaneKind kind);
/// Whether this machine has the instructions.
bool is_available(LaneKind kind);
/// The widest that is available.
LaneKind widest_lanes();

}  // namespace wormdrive
