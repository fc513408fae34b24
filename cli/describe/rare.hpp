#pragma once
#include <string>

#include "sweep/rare/rare_event.hpp"

namespace wormdrive {

/// "0.0481 [0.0413, 0.0561] (95 % interval)"
std::string in_words(const RareEstimate& p);

/// Whether both methods agree, and what that means; or why there is nothing to compare.
std::string verdict_on(const RareEvent& event);

}  // namespace wormdrive
