#pragma once
#include <string_view>
#include <utility>

#include "control/controller_signals.hpp"
#include "control/lemma1.hpp"
#include "control/nominal.hpp"
#include "core/signal.hpp"

namespace wormdrive {

/// A torque over time that is sampled and held, whatever the gear does.
struct OpenLoopParameters {
  static constexpr std::string_view kind = "open_loop";
  static constexpr std::string_view meaning = "a torque over time, sampled and held";
  static constexpr bool without_model = true;
  Signal torque;
};

class OpenLoopController {
 public:
  explicit OpenLoopController(Signal torque) : torque_(std::move(torque)) {}

  ControlSignals operator()(const Measurement& m) const { return {.torque = torque_.piece(m.t)(m.t)}; }

 private:
  Signal torque_;
};

inline OpenLoopController make_controller(const OpenLoopParameters& p, const NominalModel&, const Variations&) {
  return OpenLoopController(p.torque);
}

}  // namespace wormdrive
