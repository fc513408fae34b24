#pragma once
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "description/keys.hpp"
#include "description/scenario.hpp"

namespace wormdrive {

/// A number of a scenario that can be varied: where it stands, and what it may be.
struct Variable {
  std::string name;   ///< path without its unit, "effect.mesh_friction.change"
  Spelling spelling;  ///< the path as --set takes it, and its unit
  Bounds bounds;      ///< in SI
  std::variant<double*, std::optional<double>*> place;

  /// Sets the number, stated in the unit of the spelling.
  void set(double stated) const {
    std::visit([&](auto* number) { *number = stated * spelling.unit.si; }, place);
  }
  /// The unit in which the number stands in a scenario.
  Unit si_unit() const { return spelling.unit.suffix == unit::degrees.suffix ? unit::radian : spelling.unit; }
};

/// Every number of a scenario, under each of its spellings; they point into the scenario.
std::vector<Variable> variables(Scenario& scenario);

}  // namespace wormdrive
