#include "diagnosis/predictor/predictor.hpp"

namespace wormdrive {

TakenOut take_out(Effects<double>& effects) {
  auto& backlash = std::get<std::optional<Backlash<double>>>(effects.list);
  auto& teeth = std::get<std::optional<ToothCompliance<double>>>(effects.list);
  const TakenOut out{effects.torque_limit(), backlash ? backlash->gap : 0.0, teeth ? 1.0 / teeth->stiffness : 0.0};
  backlash.reset();
  teeth.reset();
  std::get<std::optional<TorqueSaturation<double>>>(effects.list).reset();
  auto& late_sensor = std::get<std::optional<EncoderDelay<double>>>(effects.list);
  auto& late_motor = std::get<std::optional<ActuatorDelay<double>>>(effects.list);
  if (late_sensor) late_motor = ActuatorDelay<double>{(late_motor ? late_motor->time : 0.0) + late_sensor->time};
  late_sensor.reset();
  return out;
}

}  // namespace wormdrive
