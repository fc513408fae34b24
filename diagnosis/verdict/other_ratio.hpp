#pragma once
#include <optional>
#include <string>

#include "diagnosis/diagnosis.hpp"

namespace wormdrive {

/// Without an encoder on the worm its inertia enters as Jw i only. Where one is named, a sentence on the ratio that
/// would do the same, if it is another one by half a turn of the worm at least.
std::optional<std::string> other_ratio(const Diagnosis& d, const Scenario& scenario, bool has_worm_encoder);

}  // namespace wormdrive
