#pragma once
#include <string_view>

namespace wormdrive {

/// What an instance of an FMU may do at present [FMI 2.0.4, sections 3.2.3 and 4.2.4; 3.0, section 2.3]. The values are
/// bits, so that a set of phases is their sum.
enum class Phase : unsigned {
  instantiated = 1,
  initialization = 2,
  event = 4,
  continuous = 8,
  step = 16,          ///< between communication points
  intermediate = 32,  ///< inside a step, while the importer looks at an event
  terminated = 64,
};

/// Phases in which a function may be called.
class Phases {
 public:
  constexpr Phases(Phase phase) : bits_(static_cast<unsigned>(phase)) {}  // NOLINT(google-explicit-constructor)
  constexpr bool contain(Phase phase) const { return (bits_ & static_cast<unsigned>(phase)) != 0; }
  friend constexpr Phases operator|(Phases a, Phases b) { return Phases(a.bits_ | b.bits_); }

 private:
  constexpr explicit Phases(unsigned bits) : bits_(bits) {}
  unsigned bits_;
};
constexpr Phases operator|(Phase a, Phase b) { return Phases(a) | Phases(b); }

inline constexpr Phases before_run = Phase::instantiated | Phase::initialization;
inline constexpr Phases any_mode = Phase::event | Phase::continuous | Phase::step;
/// All but the inside of a step, where an importer may only look.
inline constexpr Phases outside_step = before_run | any_mode | Phase::terminated;
inline constexpr Phases whole_life = outside_step | Phase::intermediate;

constexpr std::string_view describe(Phase phase) {
  switch (phase) {
    case Phase::instantiated: return "before the initialization mode";
    case Phase::initialization: return "in initialization mode";
    case Phase::event: return "in event mode";
    case Phase::continuous: return "in continuous-time mode";
    case Phase::step: return "in step mode";
    case Phase::intermediate: return "in intermediate update mode";
    case Phase::terminated: return "after termination";
  }
  return "";
}

}  // namespace wormdrive
