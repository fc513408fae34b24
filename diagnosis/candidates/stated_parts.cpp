#include "diagnosis/candidates/stated_parts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "diagnosis/candidates/kinds.hpp"

namespace wormdrive {

namespace {

/// A part by its effect, why it is none where it is not stated, and the numbers of it that a recording may show.
struct StatedPart {
  std::string_view effect, reason;
  std::vector<std::string_view> fields{};
};

const std::vector<StatedPart>& parts() {
  static const std::vector<StatedPart> all{
      {"agma", "a law to choose instead of another one, not a deviation"},
      {"torque_map", "a table that fits anything claims no cause"},
      {"friction_map", "a table that fits anything claims no cause"},
      {"load_map", "a table that fits anything claims no cause"},
      {"vibration", "a line that fits any claims no cause"},
      {"hard_stops", "stops are to be stated, not a deviation"},
      {"dc_motor",
       "a motor to choose instead of an ideal one; worm_viscous stands for its back-EMF",
       {"torque_constant", "resistance", "current_bandwidth"}},
      {"worm_lugre", "bristles in the bearings are to be stated, not a deviation", {"coulomb_torque", "stiffness"}},
      {"mesh_lugre", "bristles between the teeth are to be stated, not a deviation", {"stiffness"}},
      {"gearbox_heat",
       "friction_drift stands for what warming up does within recordings",
       {"friction_decay", "churning"}},
      {"holding_brake", "a brake to state, not a deviation; worm_coulomb stands for one that drags", {"torque"}},
      {"load_crank", "a crank is to be stated, not a deviation", {"mass", "angle"}},
      {"load_four_bar", "a linkage is to be stated, not a deviation", {"inertia", "angle"}},
      {"load_coupling", "gear_inertia stands for what hangs behind it"}};
  return all;
}

/// Whether a recorded command shows a number: without a gain of its own an amplifier gives the torque that is asked for
/// at standstill, whatever resistance and constant are, and in a current loop neither counts.
bool shows(const Effects<double>& stated, std::string_view effect, std::string_view field) {
  const auto& motor = std::get<std::optional<DcMotor<double>>>(stated.list);
  if (effect != DcMotor<double>::id || !motor) return true;
  if (motor->current_bandwidth) return field == "current_bandwidth";
  return field == "torque_constant" || motor->amplifier_gain;
}

/// A number that is stated, from a thirtieth of it to thirty times as much; an angle by any turn.
Coordinate stated_number(std::string_view effect, std::string_view field, const FieldOfEffect& stated) {
  constexpr double share = 0.03, decades = 30.0, turn = 2.0 * std::numbers::pi;
  const double x = stated.value;
  if (stated.unit.suffix == unit::degrees.suffix) {
    Coordinate angle = plain_coordinate(effect, field, share, x - turn, x + turn);
    angle.turns = true;
    return angle;
  }
  Coordinate number = plain_coordinate(effect, field, share * x, x / decades, x * decades);
  number.whole = x;
  return number;
}

}  // namespace

std::vector<Candidate> stated_parts(const Effects<double>& stated) {
  std::vector<Candidate> all;
  for (const StatedPart& part : parts()) {
    Candidate candidate;
    candidate.effect = part.effect;
    for (const std::string_view field : part.fields) {
      const FieldOfEffect found = field_of(stated, part.effect, field);
      if (!found.on || !shows(stated, part.effect, field)) continue;
      const Coordinate number = stated_number(part.effect, field, found);
      if (number.turns || found.value > 0.0) candidate.coordinates.push_back(number);
    }
    if (candidate.coordinates.empty()) continue;
    candidate.starts = {{std::vector<double>(candidate.coordinates.size()), {}}};
    all.push_back(std::move(candidate));
  }
  return all;
}

std::vector<NotExamined> parts_not_examined(const Effects<double>& stated) {
  const std::vector<Candidate> examined = stated_parts(stated);
  std::vector<NotExamined> list;
  for (const StatedPart& part : parts())
    if (std::ranges::none_of(examined, [&](const Candidate& c) { return c.effect == part.effect; }))
      list.push_back({part.effect, part.reason});
  return list;
}

}  // namespace wormdrive
