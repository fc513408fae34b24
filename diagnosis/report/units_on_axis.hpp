#pragma once
#include "diagnosis/diagnosis.hpp"

namespace wormdrive {

/// Gives everything that is estimated the units of the scenario's axis: N and m where it is linear.
void put_units_on_axis(Diagnosis& diagnosis, Axis axis);

}  // namespace wormdrive
