#include "diagnosis/predictor.hpp"

namespace wormdrive {

CommandPath take_out_command_path(Effects<double>& effects) {
  const CommandPath path{effects.torque_limit()};
  std::get<std::optional<TorqueSaturation<double>>>(effects.list).reset();
  auto& late_sensor = std::get<std::optional<EncoderDelay<double>>>(effects.list);
  auto& late_motor = std::get<std::optional<ActuatorDelay<double>>>(effects.list);
  if (late_sensor) late_motor = ActuatorDelay<double>{(late_motor ? late_motor->time : 0.0) + late_sensor->time};
  late_sensor.reset();
  return path;
}

}  // namespace wormdrive
