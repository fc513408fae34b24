#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <tuple>

#include <fmt/format.h>

#include "core/field.hpp"

namespace wormdrive {

// What may be wrong with a recording itself, each with what its owner can do about it. A fault has an id and fields as
// an effect has, but no simulation knows it: it changes what the file says, and the drive stays as it is.

/// Single torques that stand far out of their neighbours never acted.
struct TorqueSpikes {
  static constexpr std::string_view id = "torque_spikes";
  double share{};  ///< 0: they acted, 1: what their neighbours suggest acted

  static constexpr auto fields() {
    return std::tuple{Field{&TorqueSpikes::share, "share", unit::none, bounds::any, "of each spike that never acted"}};
  }
  std::string remedy() const { return "Leave these rows out of the file, or log the torque without losing values."; }
};

/// The torque in the file went through a filter of first order after it was commanded.
struct FilteredTorque {
  static constexpr std::string_view id = "torque_filtered";
  double time_constant{};

  static constexpr auto fields() {
    return std::tuple{
        Field{&FilteredTorque::time_constant, "time_constant", unit::second, bounds::not_negative, "of the filter"}};
  }
  std::string remedy() const {
    return fmt::format("Log the torque as commanded: the one in the file went through a filter of {:.3g} ms.",
                       1e3 * time_constant);
  }
};

/// The torque stands in the rows later than it acted, or the angle earlier than it was.
struct LateTorque {
  static constexpr std::string_view id = "torque_late";
  double time{};

  static constexpr auto fields() {
    return std::tuple{
        Field{&LateTorque::time, "time", unit::second, bounds::not_negative, "from when it acts to where it stands"}};
  }
  std::string remedy() const {
    return fmt::format("In the file, shift the torque by {:.3g} ms towards the start, or the angle towards the end.",
                       1e3 * time);
  }
};

/// Torque and angle were logged by two clocks, which agree at the start.
struct ClockDrift {
  static constexpr std::string_view id = "clock_drift";
  double share{};

  static constexpr auto fields() {
    return std::tuple{Field{&ClockDrift::share, "share", unit::none, bounds::any,
                            "by which the torque falls behind the angle, of the time that has passed"}};
  }
  std::string remedy() const {
    return fmt::format(
        "Log torque and angle by one clock: in the file the torque falls behind the angle by {:.3g} ms "
        "every second.",
        1e3 * share);
  }
};

/// The stamps do not count seconds.
struct TimeScale {
  static constexpr std::string_view id = "time_scale";
  double share{};

  static constexpr auto fields() {
    return std::tuple{
        Field{&TimeScale::share, "share", unit::none, bounds::any, "by which the file counts too many seconds"}};
  }
  std::string remedy() const {
    return fmt::format("Multiply the times in the file by {:.5g}: its clock counts {:.5g} s in a second.",
                       1.0 / (1.0 + share), 1.0 + share);
  }
};

/// Every fault that can be sought, off unless found. They are mended in this order.
struct RecordingFaults {
  std::tuple<std::optional<TorqueSpikes>, std::optional<FilteredTorque>, std::optional<LateTorque>,
             std::optional<ClockDrift>, std::optional<TimeScale>>
      list;

  /// Calls visit(optional fault) for every fault.
  template <class Visit>
  void for_each(Visit&& visit) {
    for_each_in(list, visit);
  }
  template <class Visit>
  void for_each(Visit&& visit) const {
    for_each_in(list, visit);
  }
  template <class Fault>
  const std::optional<Fault>& of() const {
    return std::get<std::optional<Fault>>(list);
  }
  bool any() const {
    bool found = false;
    for_each([&](const auto& fault) { found = found || fault; });
    return found;
  }
};

/// Whether an id is that of a fault of the recording, and not of an effect of the drive.
inline bool is_recording_fault(std::string_view id) {
  bool found = false;
  RecordingFaults{}.for_each([&]<class Fault>(const std::optional<Fault>&) { found = found || Fault::id == id; });
  return found;
}

}  // namespace wormdrive
