#include "diagnosis/candidates/catalogue.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>

#include "diagnosis/candidates/kinds.hpp"
#include "diagnosis/candidates/stated_parts.hpp"
#include "diagnosis/rules/evidence.hpp"

namespace wormdrive {

namespace {

using enum CoordinateForm;

/// What a fall over the speed gets wrong by the shape of its law, as a share of it.
constexpr double shape_error = 0.1;

/// An amplitude with a phase.
Candidate periodic(std::string_view effect, double scale, double most) {
  Candidate s;
  s.effect = effect;
  for (const CoordinateForm form : {in_phase, in_quadrature})
    s.coordinates.push_back(
        {.effect = effect, .field = "amplitude", .scale = scale, .low = -most, .high = most, .form = form});
  s.starts = {{{0.0, 0.0}, {}}};
  return s;
}

Candidate stribeck(const Magnitudes& m) {
  Candidate s = linear("stribeck", "drop", 0.08 * m.friction, -2.0 * m.friction, 2.0 * m.friction);
  // a fall within a smaller speed is passed within a few samples: that is friction of rest
  s.coordinates.push_back(
      plain_coordinate("stribeck", "speed", 0.06 * m.sliding_speed, 0.02 * m.sliding_speed, 3.0 * m.sliding_speed));
  s.finite = s.either_sign = s.falls = true;
  s.limiting_case = "static_friction";
  // the true law has another shape
  for (Coordinate& c : s.coordinates) c.model_error = {.of_value = shape_error, .of_scale = 0.0};
  s.starts.clear();
  // exponential [Tustin], bell [Bo & Pavelescu], Lorentzian [Hess & Soom]
  constexpr std::array<std::array<double, 2>, 3> shapes{{{1.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}}};
  for (const auto& [exponent, tail] : shapes)
    for (const double share : {0.04, 0.2, 0.75})
      s.starts.push_back({{0.04 * m.friction, share * m.sliding_speed},
                          {{"stribeck", "exponent", exponent}, {"stribeck", "tail", tail}}});
  s.choices = 2.0 * std::log(static_cast<double>(shapes.size()));
  s.frees = "mesh_friction";
  return s;
}

Candidate cogging(const Magnitudes& m) {
  Candidate s = periodic("cogging", 0.02 * m.torque, m.largest_torque);
  const std::vector<double> orders{1, 2, 3, 4, 6, 8, 12};
  s.starts.clear();
  for (const double order : orders) s.starts.push_back({{0.0, 0.0}, {{"cogging", "periods", order}}});
  s.choices = 2.0 * std::log(static_cast<double>(orders.size()));
  for (Coordinate& c : s.coordinates) c.tried = "periods";
  return s;
}

Candidate torque_saturation(const Magnitudes& m) {
  // a limit far above the true one cuts little, and what it leaves is taken for outliers
  Candidate s =
      finite("torque_saturation", "limit", 0.02 * m.largest_torque, 0.1 * m.largest_torque, 1.2 * m.largest_torque,
             {0.97 * m.largest_torque, m.rare_torques[0], m.rare_torques[1], m.rare_torques[2]});
  s.resizable = false;
  s.is_limit = true;
  s.coordinates[0].model_error = {.of_value = 7e-4, .of_scale = 0.0};  // it is met in the fastest motions
  return s;
}

Candidate static_friction(const Magnitudes& m) {
  Candidate s = finite("static_friction", "rise", 0.04 * m.friction, 0.0, 2.0 * m.friction,
                       {0.05 * m.friction, 0.12 * m.friction, 0.25 * m.friction, 0.36 * m.friction, 0.5 * m.friction,
                        0.7 * m.friction, m.friction, 1.4 * m.friction});
  s.coordinates[0].stepwise = true;
  return s;
}

/// Teeth that bounce leave a likelihood with many maxima: a fit starts at many sizes, up to the widest gap.
Candidate backlash(const Magnitudes& m) {
  std::vector<double> starts;
  for (double gap = m.widest_gap / rules::gap_step; gap > rules::least_gap * m.widest_gap;
       gap /= std::pow(rules::gap_step, 3))
    starts.insert(starts.begin(), gap);
  Candidate s = finite("backlash", "gap", 0.04 * m.widest_gap, 0.0, m.widest_gap, starts);
  s.impacts = true;
  // how an impact goes on; loaded teeth yield by 2e-5 rad, which makes a gap seem wider
  s.coordinates[0].model_error = {.of_value = 0.05, .of_scale = 0.0, .size = 2e-5};
  return s;
}

/// Teeth that yield are seen as a worm that lags behind; their stiffness without the effect is infinite.
Candidate tooth_compliance(const Magnitudes& m) {
  const double per_turn = 1e-4 * m.gear_arm * m.gear_arm;  // [m/N], of 1e-4 rad/(N m) at the gear
  Candidate s = linear("tooth_compliance", "stiffness", per_turn, 0.0, 300.0 * per_turn);
  s.coordinates[0].form = inverse;
  return s;
}

/// Values of a stated parameter at which a slip may have put it: a tenth to ten times, or any eighth of a turn.
std::vector<double> far_values(const Coordinate& c) {
  std::vector<double> values;
  if (c.turns)
    for (const double eighths : {-3.0, -2.0, -1.0, 1.0, 2.0, 3.0, 4.0})
      values.push_back(c.centre + eighths * 0.25 * std::numbers::pi);
  if (c.whole > 0.0)
    for (const double factor : {0.1, 0.3, 3.0, 10.0}) values.push_back(c.centre + (factor - 1.0) * c.whole);
  std::erase_if(values, [&](double x) { return x < c.low || x > c.high; });
  return values;
}

/// Whether the scenario takes friction over the sliding speed from a standard, which leaves no room for another fall.
bool has_standard_friction(const Effects<double>& stated) {
  return std::get<std::optional<Agma<double>>>(stated.list).has_value();
}

/// An effect that the scenario has already is sought as a change of what it states.
void start_from_stated(Candidate& s, const Effects<double>& stated) {
  if (!field_of(stated, s.effect, s.coordinates[0].field).on) return;
  CandidateStart start{std::vector<double>(s.coordinates.size()), {}};
  for (std::size_t k = 0; k < s.coordinates.size(); ++k) {
    Coordinate& c = s.coordinates[k];
    start.values[k] = coordinate_value(stated, c);
    c.centre = start.values[k];
  }
  s.starts = {start};
  if (!s.finite) return;
  // its signature is what another size would do: none, half of it, twice as much
  s.resizable = false;
  const Coordinate& size = s.coordinates[0];
  s.starts.clear();
  for (const double x : {size.none_at_low ? size.low : 0.0, 0.5 * size.centre, 2.0 * size.centre}) {
    if (x < size.low || x > size.high) continue;
    start.values[0] = x;
    s.starts.push_back(start);
  }
}

}  // namespace

std::vector<Candidate> candidates(const Effects<double>& stated, const Magnitudes& m,
                                  const std::vector<Coordinate>& toleranced) {
  std::vector<Candidate> all;
  const double friction_per_speed = m.torque / m.worm_speed;
  all.push_back(linear("worm_coulomb", "torque", 0.04 * m.torque, 0.0, 2.0 * m.largest_torque));
  all.push_back(linear("worm_viscous", "coefficient", 0.02 * friction_per_speed, 0.0, 3.0 * friction_per_speed));
  // its torque is that of torque_offset
  all.push_back(linear("bearing_asymmetry", "coefficient", 0.02 * friction_per_speed, -3.0 * friction_per_speed,
                       3.0 * friction_per_speed));
  all.push_back(cogging(m));
  all.push_back(late("actuator_lag", "time_constant", m.period, 0.02 * m.period));
  all.push_back(late("actuator_delay", "delay", m.period, 0.0));
  all.back().twins = {{"encoder_delay", "delay"}};
  all.push_back(torque_saturation(m));
  all.push_back(linear("encoder_scale", "share", 0.01, -0.3, 0.3));
  if (m.has_teeth) {
    const double gear_torque = m.torque * m.worm_speed / m.gear_speed;
    if (!has_standard_friction(stated)) all.push_back(stribeck(m));
    all.push_back(linear("friction_asymmetry", "change", 0.04 * m.friction, -0.6 * m.friction, 0.6 * m.friction));
    all.push_back(periodic("position_friction", 0.05, 0.7));
    all.push_back(periodic("thread_friction", 0.05, 0.7));
    all.push_back(linear("friction_drift", "share", 0.05, -0.7, 2.0));
    all.back().starts[0].chosen = {{"friction_drift", "time", m.duration}};
    all.push_back(static_friction(m));
    all.push_back(periodic("transmission_error", 5e-4, 0.02));
    if (!is_followed_with_states(stated)) {
      all.push_back(backlash(m));
      if (m.has_worm_encoder) all.push_back(tooth_compliance(m));
    }
    all.push_back(linear("gear_coulomb", "torque", 0.02 * gear_torque, 0.0, gear_torque));
    all.push_back(
        linear("gear_viscous", "coefficient", 0.01 * gear_torque / m.gear_speed, 0.0, gear_torque / m.gear_speed));
  }
  if (m.load_torque > 0.0 && !m.has_teeth) all.push_back(linear("friction_under_load", "share", 0.02, 0.0, 1.0));
  if (m.load_torque > 0.0 || !m.has_teeth) {
    const double torque = m.has_teeth ? m.load_torque : m.torque;
    all.push_back(linear("load_spring", "stiffness", 0.03 * torque, -3.0 * torque, 3.0 * torque));
    all.back().coordinates.push_back(plain_coordinate("load_spring", "angle", 0.1, -10.0, 10.0));
    all.back().starts[0].values.push_back(0.0);
  }
  std::ranges::move(stated_parts(stated), std::back_inserter(all));
  for (const Coordinate& c : toleranced) {
    Candidate s = linear(c.effect, c.field, c.scale, c.low, c.high);
    s.coordinates[0] = c;
    s.starts[0].values = {c.centre};
    s.far = far_values(c);
    s.toleranced = c.tolerance > 0.0;
    if (c.effect == LoadAngle<double>::id) s.twins = {{"encoder_offset", "angle"}};
    all.push_back(s);
  }
  for (Candidate& s : all) start_from_stated(s, stated);
  return all;
}

void withdraw(Effects<double>& effects, const Effects<double>& stated, const Candidate& candidate) {
  if (!field_of(stated, candidate.effect, candidate.coordinates.front().field).on)
    return switch_off(effects, candidate.effect);
  std::vector<double> values;
  for (const Coordinate& c : candidate.coordinates) values.push_back(c.centre);
  apply(effects, candidate.coordinates, values);
}

std::string why_not_diagnosed(const Effects<double>& stated) {
  if (!stated.twisting_coupling()) return "";
  return "a diagnosis follows no load that swings by itself, which nothing that is recorded shows, but "
         "effect.load_coupling twists; leave its stiffness out";
}

std::vector<NotExamined> not_examined(const Effects<double>& stated, const Magnitudes& m) {
  std::vector<NotExamined> list = parts_not_examined(stated);
  if (is_followed_with_states(stated) && m.has_teeth)
    for (const std::string_view effect : {"backlash", "tooth_compliance"})
      list.push_back({effect, "where effects have states, or the inertia depends on the angle, teeth are rigid"});
  if (m.has_teeth && has_standard_friction(stated))
    list.push_back({"stribeck", "effect.agma states already how friction falls with the sliding speed"});
  if (m.has_teeth && !m.has_worm_encoder && !is_followed_with_states(stated))
    list.push_back({"tooth_compliance", "only an encoder on the worm shows it", true});
  if (!m.load_turns)
    list.push_back({"encoder_offset", "nothing in the drive depends on where the zero of the angle is"});
  if (!m.has_teeth)
    for (const std::string_view effect :
         {"stribeck", "friction_asymmetry", "position_friction", "thread_friction", "friction_drift", "static_friction",
          "transmission_error", "mesh_friction", "backlash", "tooth_compliance"})
      list.push_back({effect, "the drive has no teeth"});
  if (!m.has_teeth)
    for (const std::string_view effect : {"gear_coulomb", "gear_viscous", "gear_inertia"})
      list.push_back({effect, "without a gear the worm's side stands for both"});
  if (m.has_teeth)
    list.push_back({"friction_under_load", "the friction between the teeth grows with the load as well"});
  if (m.load_torque <= 0.0) {
    for (const std::string_view effect : {"load_magnitude", "load_angle"}) list.push_back({effect, "there is no load"});
    if (!m.has_teeth) list.push_back({"friction_under_load", "there is no load"});
  } else if (!m.load_turns)
    list.push_back({"load_angle", "the load does not depend on the angle"});
  return list;
}

bool is_kinematic(std::string_view effect) {
  return has_impacts(effect) || effect == ToothCompliance<double>::id || effect == TransmissionError<double>::id;
}

bool has_impacts(std::string_view effect) { return effect == Backlash<double>::id; }

}  // namespace wormdrive
