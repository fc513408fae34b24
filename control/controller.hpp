#pragma once
#include <utility>
#include <variant>

#include "control/open_loop.hpp"
#include "control/pid.hpp"
#include "control/sliding.hpp"

namespace wormdrive {

/// Every kind of controller as it is stated; a new one is a new file and one entry here. It names itself by `kind` and
/// `meaning`, lists its `fields()`, and its `make_controller` leads to a callable Measurement -> ControlSignals.
using ControllerParameters = std::variant<SlidingParameters, PidParameters, OpenLoopParameters>;

/// The controllers that parameters lead to.
template <class... P>
std::variant<decltype(make_controller(std::declval<const P&>(), NominalModel{}, Variations{}))...> controllers_of(
    const std::variant<P...>&);

/// A controller of any kind: a run is compiled once for all of them.
class AnyController {
 public:
  AnyController(const ControllerParameters& stated, const NominalModel& nominal, const Variations& variations)
      : law_(std::visit([&](const auto& p) -> Law { return make_controller(p, nominal, variations); }, stated)) {}
  ControlSignals operator()(const Measurement& m) {
    return std::visit([&m](auto& law) -> ControlSignals { return law(m); }, law_);
  }
  /// Calls visit(number) for every number that samples change.
  template <class Visit>
  void visit_memory(Visit&& visit) {
    std::visit(
        [&](auto& law) {
          if constexpr (requires { law.visit_memory(visit); }) law.visit_memory(visit);
        },
        law_);
  }

 private:
  using Law = decltype(controllers_of(std::declval<ControllerParameters>()));
  Law law_;
};

}  // namespace wormdrive
