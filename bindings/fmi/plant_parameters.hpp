#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "description/keys.hpp"
#include "description/scenario.hpp"

namespace wormdrive {

/// A number that is stated of what an FMU carries. Value is double, or const double where it is only read.
template <class Value>
struct PlantParameter {
  std::string name;  ///< "mesh.friction", with the unit; terms of a sum are counted from 1, as arrays of FMI are
  Unit unit;         ///< SI
  Bounds bounds;
  std::string_view meaning;
  Value* value;  ///< [SI]

  bool is_allowed(double x) const;
};

/// All of them in one order: the k-th has the k-th value reference among the parameters. Tables over time or angle are
/// no parameters.
std::vector<PlantParameter<double>> plant_parameters(Scenario& scenario);
std::vector<PlantParameter<const double>> plant_parameters(const Scenario& scenario);

}  // namespace wormdrive
