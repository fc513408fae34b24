#include "recovery/truth/recording.hpp"

#include <fstream>
#include <stdexcept>

namespace truth {

void write_csv(const Recording& recording, const std::string& path) {
  std::ofstream file(path);
  file.precision(9);
  const bool worm = !recording.worm_angle.empty();
  file << "time_s,motor_torque_Nm,gear_angle_rad" << (worm ? ",worm_angle_rad" : "") << "\n";
  for (std::size_t k = 0; k < recording.time.size(); ++k) {
    file << recording.time[k] << "," << recording.motor_torque[k] << "," << recording.gear_angle[k];
    if (worm) file << "," << recording.worm_angle[k];
    file << "\n";
  }
  if (!file.flush()) throw std::runtime_error("cannot write " + path);
}

}  // namespace truth
