#pragma once

namespace wormdrive {

/// Time constants after which what decays is below rounding.
inline constexpr double lags_to_settle = 40.0;

}  // namespace wormdrive
