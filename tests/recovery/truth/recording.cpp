#include "recovery/truth/recording.hpp"

#include <fstream>
#include <iomanip>
#include <stdexcept>

namespace truth {

void write_csv(const Recording& recording, const std::string& path) {
  // digits that are far below any noise
  std::ofstream file(path);
  file << std::fixed;
  const bool worm = !recording.worm_angle.empty();
  file << "time_s,motor_torque_Nm,gear_angle_rad" << (worm ? ",worm_angle_rad" : "") << "\n";
  for (std::size_t k = 0; k < recording.time.size(); ++k) {
    file << std::setprecision(recording.time_digits) << recording.time[k] << "," << std::setprecision(7)
         << recording.motor_torque[k] << "," << recording.gear_angle[k];
    if (worm) file << "," << recording.worm_angle[k];
    file << "\n";
  }
  if (!file.flush()) throw std::runtime_error("cannot write " + path);
}

}  // namespace truth
