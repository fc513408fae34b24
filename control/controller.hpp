#pragma once
#include <optional>
#include <utility>
#include <variant>

#include "control/anti_windup.hpp"
#include "control/model_recovery.hpp"
#include "control/open_loop.hpp"
#include "control/pid.hpp"
#include "control/position_servo.hpp"
#include "control/sliding.hpp"

namespace wormdrive {

/// Every kind of controller as it is stated; a new one is a new file and one entry here. It names itself by `kind` and
/// `meaning`, lists its `fields()`, and its `make_controller` leads to a callable Measurement -> ControlSignals.
using ControllerParameters =
    std::variant<SlidingParameters, PidParameters, PositionServoParameters, OpenLoopParameters>;

/// Whether a law has an integral that may wind up: it then has a tracking_time() and takes an IntegralGrowth.
template <class Law>
concept WindsUp = requires(Law& law) {
  law.prevent_windup(IntegralGrowth{});
  law.tracking_time();
};

/// The controllers that parameters lead to.
template <class... P>
std::variant<decltype(make_controller(std::declval<const P&>(), NominalModel{}, Variations{}))...> controllers_of(
    const std::variant<P...>&);

/// A controller of any kind, with its anti-windup: a run is compiled once for all of them.
class AnyController {
 public:
  AnyController(const ControllerParameters& stated, const NominalModel& nominal, const Variations& variations,
                const AntiWindupSettings& anti_windup = {})
      : law_(std::visit([&](const auto& p) -> Law { return make_controller(p, nominal, variations); }, stated)) {
    std::visit(
        [&]<class L>(L& law) {
          if constexpr (WindsUp<L>) {
            const double time = anti_windup.tracking_time.value_or(law.tracking_time());
            if (anti_windup.method == AntiWindup::model_recovery)
              recovery_.emplace(nominal, time);
            else
              law.prevent_windup({anti_windup.method, time});
          }
        },
        law_);
  }
  ControlSignals operator()(const Measurement& m) {
    if (recovery_) return (*recovery_)([this](const Measurement& seen) { return decide(seen); }, m);
    return decide(m);
  }
  /// Calls visit(number) for every number that samples change.
  template <class Visit>
  void visit_memory(Visit&& visit) {
    std::visit(
        [&](auto& law) {
          if constexpr (requires { law.visit_memory(visit); }) law.visit_memory(visit);
        },
        law_);
    if (recovery_) recovery_->visit_memory(visit);
  }

 private:
  using Law = decltype(controllers_of(std::declval<ControllerParameters>()));
  ControlSignals decide(const Measurement& m) {
    return std::visit([&m](auto& law) -> ControlSignals { return law(m); }, law_);
  }

  Law law_;
  std::optional<ModelRecovery> recovery_;
};

/// Whether a law works with a model of the drive; the parameters of one that does not say so.
inline bool has_model(const ControllerParameters& stated) {
  return std::visit(
      []<class P>(const P&) {
        return !requires { P::without_model; };
      },
      stated);
}
/// Whether the integral of a law may wind up.
inline bool winds_up(const ControllerParameters& stated) {
  return std::visit([](const auto& p) { return WindsUp<decltype(make_controller(p, NominalModel{}, Variations{}))>; },
                    stated);
}

}  // namespace wormdrive
