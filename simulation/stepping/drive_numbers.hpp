#pragma once
#include <array>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "events/segment_start.hpp"
#include "simulation/stepping/commanded.hpp"

namespace wormdrive {

/// Takes numbers one by one; behind the last they are NaN.
class NumberReader {
 public:
  explicit NumberReader(std::span<const double> numbers) : left_(numbers) {}
  double operator()() {
    if (left_.empty()) return std::numeric_limits<double>::quiet_NaN();
    const double first = left_.front();
    left_ = left_.subspan(1);
    return first;
  }
  std::span<const double> rest() const { return left_; }

 private:
  std::span<const double> left_;
};

/// How many numbers an instant of a drive has, and how many its inputs without the torques on their way.
template <class Drive>
constexpr std::size_t instant_numbers = 1 + Drive::state_size + 3;
inline constexpr std::size_t input_numbers = 7;

/// Time, state and mode as numbers.
template <class Drive>
void write_instant(const typename Drive::Instant& now, std::vector<double>& to) {
  to.push_back(now.t);
  to.insert(to.end(), now.x.data(), now.x.data() + Drive::state_size);
  if constexpr (shaft_count<Drive>() == 1) {
    to.insert(to.end(), {double(sign(now.mode.motion)), double(sign(now.mode.flank)), now.since});
  } else {
    to.insert(to.end(), {double(sign(now.mode.worm)), double(sign(now.mode.contact)), double(sign(now.mode.gear))});
  }
}
/// The instant again; nothing where the numbers are none.
template <class Drive>
std::optional<typename Drive::Instant> read_instant(NumberReader& next) {
  typename Drive::Instant now;
  now.t = next();
  for (int i = 0; i < Drive::state_size; ++i) now.x[i] = next();
  const std::array<double, 3> mode{next(), next(), next()};
  const auto is_sign = [](double x) { return x == -1.0 || x == 0.0 || x == 1.0; };
  if (!is_sign(mode[0]) || !is_sign(mode[1])) return std::nullopt;
  const auto motion = static_cast<Motion>(static_cast<int>(mode[0]));
  const auto flank = static_cast<Flank>(static_cast<int>(mode[1]));
  if constexpr (shaft_count<Drive>() == 1) {
    now.mode = {motion, flank};
    now.since = mode[2];
  } else {
    if (!is_sign(mode[2])) return std::nullopt;
    now.mode = {flank, motion, static_cast<Motion>(static_cast<int>(mode[2]))};
  }
  return now;
}

/// What the inputs of a drive remember, but for the torques on their way.
inline void write_inputs(const InputMemory& past, double knot, std::vector<double>& to) {
  to.insert(to.end(), {knot, past.entered, past.held_then, past.held.t, past.held.torque, past.frozen, past.lagged});
}
inline InputMemory read_inputs(NumberReader& next, double& knot) {
  knot = next();
  InputMemory past;
  past.entered = next();
  past.held_then = next();
  past.held.t = next();
  past.held.torque = next();
  past.frozen = next();
  past.lagged = next();
  return past;
}

}  // namespace wormdrive
