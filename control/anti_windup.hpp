#pragma once
#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <tuple>

#include "core/field.hpp"

namespace wormdrive {

/// What keeps the integral of a controller from winding up while the actuator limits its torque. The first two are in
/// K. J. Astrom, T. Hagglund, Advanced PID Control, ISA 2006, section 3.5.
enum class AntiWindup {
  none,
  back_calculation,  ///< the integral moves towards the value that asks for the torque that was applied
  conditional,       ///< the integral waits while it would ask for more of what the limit takes away
  model_recovery     ///< the law sees the drive as it would move without the limit, see ModelRecovery
};

struct AntiWindupSettings {
  AntiWindup method = AntiWindup::none;
  std::optional<double> tracking_time;  ///< [s]; that of the law if not stated

  static constexpr auto fields() {
    return std::tuple{Field{&AntiWindupSettings::tracking_time, "tracking_time", unit::second, bounds::positive,
                            "time constant of back_calculation and model_recovery; of pid sqrt(Kd/Ki), of sliding "
                            "1/bandwidth, if not stated",
                            Presence::optional}};
  }
  static constexpr auto choices() {
    constexpr std::array<std::string_view, 4> methods{"none", "back_calculation", "conditional", "model_recovery"};
    return std::tuple{Choice{&AntiWindupSettings::method, "anti_windup", methods,
                             "what keeps the integral from winding up while the torque is limited"}};
  }
  /// Whether a method has a time constant.
  static bool tracks(AntiWindup method) {
    return method == AntiWindup::back_calculation || method == AntiWindup::model_recovery;
  }
};

/// How the integral of an error grows from sample to sample. Where the limit took nothing away it is the plain sum, to
/// the last bit.
struct IntegralGrowth {
  AntiWindup method = AntiWindup::none;
  double tracking_time = 0.0;  ///< [s]

  /// By how much the integral grows within a period [s] at an error e.
  /// beyond: how far it lies beyond the value that would have asked for the torque that was applied.
  double operator()(double e, double period, double beyond) const {
    switch (method) {
      case AntiWindup::none:
      case AntiWindup::model_recovery: break;
      case AntiWindup::back_calculation: return e * period - std::min(period / tracking_time, 1.0) * beyond;
      case AntiWindup::conditional: return e * beyond > 0.0 ? 0.0 : e * period;
    }
    return e * period;
  }
};

}  // namespace wormdrive
