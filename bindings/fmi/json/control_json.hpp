#pragma once
#include "bindings/fmi/json/json_transfer.hpp"
#include "description/control_scenario.hpp"

namespace wormdrive {

/// A controller with its sampling, reference, sensor and disturbance as JSON in SI.
Json control_to_json(const ControlScenario& control, Axis axis);
/// The controller again, bit for bit. Throws std::exception where the JSON is none.
ControlScenario control_from_json(Json& json, Axis axis);

}  // namespace wormdrive
