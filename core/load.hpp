#pragma once
#include <variant>

#include "core/loads/angle_table.hpp"
#include "core/loads/gravity_arm.hpp"
#include "core/loads/timed_load.hpp"

namespace wormdrive {

/// Every kind of load as it is stated; a new one is a new file, one entry here and one line in `make_load`.
using LoadParameters = std::variant<Signal, GravityArm, AngleTable>;

inline TimedLoad make_load(const Signal& signal) { return {signal}; }
inline GravityLoad make_load(const GravityArm& arm) { return GravityLoad(arm); }
inline TableLoad make_load(const AngleTable& table) { return TableLoad(table); }

}  // namespace wormdrive
