#pragma once
#include <string_view>
#include <vector>

#include "core/numbers/cubic_table.hpp"
#include "diagnosis/candidates/magnitudes.hpp"
#include "diagnosis/candidates/recorded_drive.hpp"
#include "diagnosis/fitting/hypothesis.hpp"

namespace wormdrive {

/// Of what a map can be a function.
enum class MapArgument { worm_speed, sliding_speed, gear_angle, time };

/// An effect whose table can be learned, over one of its axes.
struct MapForm {
  std::string_view effect;  ///< id in the catalogue
  std::string_view what;    ///< as a sentence says it: "torque on the worm"
  MapArgument over;
  double step;  ///< change of a value that shows, in the unit of the table
  /// Switches the effect on, with a table.
  void (*put)(RecordedDrive& drive, CubicTable table);
};

/// Everything that a map could be of, but for effects that a drive has already.
std::vector<MapForm> map_forms(const RecordedDrive& drive, const Magnitudes& sizes, double ratio);

/// In a sentence.
std::string_view name(MapArgument over);

/// What a map could be over, at every sample at which the drive moves, sorted; empty where it cannot move so.
std::vector<double> values_of(MapArgument over, const Evaluation& evaluation, const Hypothesis& h);

}  // namespace wormdrive
