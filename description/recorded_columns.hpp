#pragma once
#include <array>
#include <map>
#include <string>
#include <string_view>

#include "core/unit.hpp"

namespace wormdrive {

/// Names of columns in files of measured data that are called otherwise than usual, by the usual name:
/// {"motor_torque_Nm", "u"}.
using ColumnNames = std::map<std::string, std::string, std::less<>>;

/// A quantity that a file of measured data may hold.
struct RecordedColumn {
  std::string_view name;  ///< without its unit
  Unit unit;
};

/// All of them; a usual column name is the first spelling of these.
inline constexpr std::array recorded_columns{RecordedColumn{"time", unit::second},
                                             RecordedColumn{"motor_torque", unit::newton_metre},
                                             RecordedColumn{"gear_angle", unit::radian},
                                             RecordedColumn{"worm_angle", unit::radian},
                                             RecordedColumn{"gear_speed", unit::radian_per_second},
                                             RecordedColumn{"worm_speed", unit::radian_per_second},
                                             RecordedColumn{"load_torque", unit::newton_metre},
                                             RecordedColumn{"record", unit::none}};

/// What the column of a usual name is called in a file.
inline std::string column_name(const ColumnNames& names, std::string_view usual) {
  const auto found = names.find(usual);
  return found == names.end() ? std::string(usual) : found->second;
}

}  // namespace wormdrive
