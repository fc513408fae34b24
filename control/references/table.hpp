#pragma once
#include <string_view>

#include "control/reference_point.hpp"
#include "core/numbers/cubic_table.hpp"
#include "core/numbers/series.hpp"
#include "core/table_columns.hpp"

namespace wormdrive {

/// A table of angles over strictly increasing times, at least four, smooth between its points.
struct TableReference {
  static constexpr std::string_view kind = "table";
  static constexpr std::string_view meaning = "table of angles over time, smooth between its points";
  CubicTable table;  ///< angles [rad] over times [s]

  static constexpr TableColumns columns() {
    return {{"times", unit::second}, {"angles", unit::radian}, {"time", unit::second}, {"gear_angle", unit::radian}};
  }
  bool operator==(const TableReference&) const = default;
  ReferencePoint at(double t) const {
    const auto x = table(Series<double, 2>::variable(t));
    return {x[0], x[1], 2.0 * x[2]};
  }
};

}  // namespace wormdrive
