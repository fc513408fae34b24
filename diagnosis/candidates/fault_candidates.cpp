#include <algorithm>

#include "diagnosis/candidates/kinds.hpp"
#include "diagnosis/faults/recording_faults.hpp"
#include "diagnosis/rules/evidence.hpp"
#include "diagnosis/rules/noise.hpp"

namespace wormdrive {

std::vector<Candidate> fault_candidates(const Magnitudes& m, bool has_torque_spikes) {
  std::vector<Candidate> all;
  if (has_torque_spikes) {
    all.push_back(linear(TorqueSpikes::id, "share", 0.1, -1.0, 2.0));
    all.back().rare = true;
  }
  // an output of which next to nothing is smeared within a sample is its input
  all.push_back(late(FilteredTorque::id, "time_constant", m.period, 0.02 * m.period));
  all.push_back(late(LateTorque::id, "time", m.period, rules::least_late * m.period));
  constexpr double worst_clock = 0.02;  // an oscillator of a resistor and a capacitor, as a microcontroller has it
  all.push_back(linear(ClockDrift::id, "share", m.period / m.duration, -worst_clock, worst_clock));
  // so far apart that near one of them torque and angle still go together at the end
  const double apart = std::min(m.torque_memory, rules::colouring_time) / m.duration;
  for (int k = 1; k <= rules::most_far_clocks && k * apart <= worst_clock; ++k)
    all.back().far.insert(all.back().far.end(), {k * apart, -k * apart});
  // a rate that is not the one that somebody typed in: mostly by a factor of two
  all.push_back(linear(TimeScale::id, "share", 0.01, -0.9, 9.0));
  all.back().far = {-0.5, 1.0};
  all.back().alone = true;  // with a gain it does what a load and a gain do, exactly
  for (Candidate& s : all) s.of_recording = true;
  return all;
}

}  // namespace wormdrive
