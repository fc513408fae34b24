#pragma once
#include <string>
#include <vector>

namespace wormdrive {

/// A table of results whose rows are compared where they stand at the same place. All of its columns of numbers are
/// compared.
struct ComparedTable {
  std::string name;
  std::vector<std::string> over = {};        ///< columns of numbers that say where a row stands
  std::vector<std::string> over_texts = {};  ///< columns of texts that say so; without either it is the row's number
  std::vector<std::string> texts = {};       ///< the other columns of texts

  /// Results may report at other times than one another, but at no other place.
  bool over_time() const { return over == std::vector<std::string>{"time"}; }
};

/// What a result has beside its tables: attributes of one of its objects, "/" for the file itself.
struct ComparedAttributes {
  std::string object;
  std::vector<std::string> texts = {};
  std::vector<std::string> numbers = {};  ///< empty: all of them but details
};

/// The tables of all kinds of results, see output/schema.md, but for /events, which are compared one by one, and for
/// those of sweeps.
inline const std::vector<ComparedTable> compared_tables{
    {"trajectory", {"time"}},
    {"controller", {"time"}},
    {"statics", {"load_torque"}},
    {"model", {"worm_speed"}},
    {"records", {}, {"record"}},
    {"efficiency", {"worm_speed", "load_torque"}},
    {"levels", {"index"}},
    {"estimates", {"index"}, {}, {"method"}},
    {"design_point", {}, {"parameter"}, {"unit"}},
    {"runs", {"index"}},
    {"residual"},
    {"examples"},
    {"torques", {"worm_speed", "load_torque"}, {"point"}},
    {"prediction", {}, {}, {"unit"}},
    {"ranking", {}, {"effect"}, {"outcome"}},
    {"certificate", {}, {"effect", "parameter", "chosen"}, {"unit", "nearest"}}};

inline const std::vector<ComparedAttributes> compared_attributes{
    {"/",
     {"regime", "sentence"},
     {"surface", "ratio", "C1", "C2", "H", "mu", "mu_w", "mu_g", "stuck_outside", "rms_error", "rms_torque"}},
    {"controller"},
    {"estimates", {"metric"}},
    {"design_point"}};

/// Attributes that follow from the rows of a table: what is allowed there has to be allowed here, for an error is much
/// smaller than the numbers it is the difference of.
struct FollowingNumbers {
  std::string begin;   ///< of their names
  std::string column;  ///< whose magnitude counts
};
inline const std::vector<FollowingNumbers> following_numbers{
    {"error_", "controller/gear_angle"}, {"torque_", "controller/applied_torque"}, {"rms_", "records/motor_torque"}};

/// Details of violations, which are counted.
inline bool is_detail(const std::string& attribute) {
  return attribute.ends_with("_first") || attribute.ends_with("_worst") || attribute.ends_with("_limit");
}

}  // namespace wormdrive
