#include "output/run_columns.hpp"

#include <fmt/format.h>

namespace wormdrive {
namespace {

const std::vector<std::int8_t> signs{-1, 0, 1};
constexpr const char* motions = "backward stuck forward";
constexpr const char* flanks = "right none left";

/// The columns of a table, with more behind them where there is what they show.
template <class Source>
std::vector<RunColumn<Source>> joined(std::vector<RunColumn<Source>> columns, bool shown,
                                      const std::vector<RunColumn<Source>>& more) {
  if (shown) columns.insert(columns.end(), more.begin(), more.end());
  return columns;
}
/// Whose speed has the sign of the motion.
std::string sign_of_speed(bool elastic) { return elastic ? "sign of the worm speed" : "sign of the gear speed"; }
/// A shaft without dry friction has no mode of its own: it moves as its speed says.
int sign_of(Motion mode, double speed) {
  return mode == Motion::stuck || speed == 0.0 ? sign(mode) : speed > 0.0 ? 1 : -1;
}
int motion(const Observation& at) { return sign_of(at.mode.motion, at.teeth ? at.teeth->omega_w : at.omega_g); }
int gear_motion(const Observation& at) { return sign_of(at.teeth->gear, at.omega_g); }

}  // namespace

StateColumn state_column(std::string_view id, const EffectState& state, std::size_t place) {
  return {{fmt::format("{}_{}", id, state.name), std::string(state.unit.symbol), std::string(state.meaning)}, place};
}

std::vector<RunColumn<Row>> trajectory_columns(const RunContents& contents) {
  const bool elastic = contents.elastic;
  std::vector<RunColumn<Row>> columns{
      {{"time", "s", "time"}, [](const Row& r) { return r.t; }},
      {{"gear_angle", "rad", "gear angle theta_g"}, [](const Row& r) { return r.at.theta_g; }},
      {{"gear_speed", "rad/s", "gear speed theta_g'"}, [](const Row& r) { return r.at.omega_g; }},
      {{"gear_acceleration", "rad/s^2", "gear acceleration theta_g''"}, [](const Row& r) { return r.at.alpha_g; }},
      {{"motor_torque", "N m", "motor torque tau_m on the worm"}, [](const Row& r) { return r.at.tau_m; }},
      {{"load_torque", "N m", "load torque tau_l on the gear"}, [](const Row& r) { return r.at.tau_l; }},
      {{"normal_force", "N", "normal force Wn between the teeth"}, [](const Row& r) { return r.at.normal_force; }},
      {{"motion", "", sign_of_speed(elastic), motions, signs}, [](const Row& r) { return motion(r.at); }},
      {{"flank", "", "flank that carries the load", flanks, signs},
       [](const Row& r) { return sign(r.at.mode.flank); }}};
  columns = joined(columns, elastic,
                   {{{"worm_angle", "rad", "worm angle theta_w"}, [](const Row& r) { return r.at.teeth->theta_w; }},
                    {{"worm_speed", "rad/s", "worm speed theta_w'"}, [](const Row& r) { return r.at.teeth->omega_w; }},
                    {{"worm_acceleration", "rad/s^2", "worm acceleration theta_w''"},
                     [](const Row& r) { return r.at.teeth->alpha_w; }},
                    {{"deflection", "rad", "gear ahead of worm, theta_g - theta_w / i"},
                     [](const Row& r) { return r.at.teeth->deflection; }},
                    {{"friction_force", "N", "friction force Wf between the teeth, positive against forward motion"},
                     [](const Row& r) { return r.at.teeth->friction; }},
                    {{"gear_motion", "", "sign of the gear speed", motions, signs},
                     [](const Row& r) { return gear_motion(r.at); }}});
  columns = joined(
      columns, contents.winding,
      {{{"motor_voltage", "V", "voltage U on the motor's winding"}, [](const Row& r) { return r.at.winding->voltage; }},
       {{"motor_current", "A", "current I through the motor's winding"},
        [](const Row& r) { return r.at.winding->current; }},
       {{"electrical_power", "W", "power U I out of the supply"}, [](const Row& r) { return r.at.winding->power(); }},
       {{"winding_loss", "W", "heat in the motor's winding"}, [](const Row& r) { return r.at.winding->loss; }},
       {{"winding_temperature_rise", "K", "temperature of the motor's winding above its surroundings"},
        [](const Row& r) { return r.at.winding->warmth; }}});
  for (const auto& [description, state] : contents.states)
    columns.push_back({description, [state = state](const Row& r) { return r.at.states[state]; }});
  return columns;
}

namespace {

/// The kinds of event that a drive can have, as flags.
ColumnDescription kinds_column(const RunContents& contents) {
  ColumnDescription column{"kind", "", "what happened", "", {}};
  for (const EventKind kind : event_kinds) {
    if (!can_happen(kind, contents)) continue;
    column.flag_meanings += fmt::format("{}{}", column.flag_meanings.empty() ? "" : " ", name(kind));
    column.flag_values.push_back(static_cast<std::int8_t>(kind));
  }
  return column;
}

std::vector<RunColumn<Event>> make_event_columns(const RunContents& contents) {
  const bool elastic = contents.elastic;
  std::vector<RunColumn<Event>> columns{
      {{"time", "s", "time"}, [](const Event& e) { return e.t; }},
      {kinds_column(contents), [](const Event& e) { return static_cast<double>(e.kind()); }},
      {{"motion_before", "", fmt::format("{} before", sign_of_speed(elastic)), motions, signs},
       [](const Event& e) { return motion(e.before); }},
      {{"motion_after", "", fmt::format("{} after", sign_of_speed(elastic)), motions, signs},
       [](const Event& e) { return motion(e.after); }},
      {{"flank_before", "", "flank that carried the load before", flanks, signs},
       [](const Event& e) { return sign(e.before.mode.flank); }},
      {{"flank_after", "", "flank that carries the load after", flanks, signs},
       [](const Event& e) { return sign(e.after.mode.flank); }},
      {{"gear_angle", "rad", "gear angle theta_g"}, [](const Event& e) { return e.after.theta_g; }},
      {{"gear_speed", "rad/s", "gear speed theta_g'"}, [](const Event& e) { return e.after.omega_g; }},
      {{"acceleration_before", "rad/s^2", "gear acceleration just before"},
       [](const Event& e) { return e.before.alpha_g; }},
      {{"acceleration_after", "rad/s^2", "gear acceleration just after"},
       [](const Event& e) { return e.after.alpha_g; }},
      {{"motor_torque_before", "N m", "motor torque just before"}, [](const Event& e) { return e.before.tau_m; }},
      {{"motor_torque_after", "N m", "motor torque just after"}, [](const Event& e) { return e.after.tau_m; }},
      {{"load_torque_before", "N m", "load torque just before"}, [](const Event& e) { return e.before.tau_l; }},
      {{"load_torque_after", "N m", "load torque just after"}, [](const Event& e) { return e.after.tau_l; }}};
  columns = joined(
      columns, contents.stops,
      {{{"gear_speed_before", "rad/s", "gear speed just before"}, [](const Event& e) { return e.before.omega_g; }}});
  return joined(
      columns, elastic,
      {{{"worm_angle", "rad", "worm angle theta_w"}, [](const Event& e) { return e.after.teeth->theta_w; }},
       {{"worm_speed", "rad/s", "worm speed theta_w'"}, [](const Event& e) { return e.after.teeth->omega_w; }},
       {{"gear_motion_before", "", "sign of the gear speed before", motions, signs},
        [](const Event& e) { return gear_motion(e.before); }},
       {{"gear_motion_after", "", "sign of the gear speed after", motions, signs},
        [](const Event& e) { return gear_motion(e.after); }}});
}

}  // namespace

bool can_happen(EventKind kind, const RunContents& contents) {
  return kind <= EventKind::flank_change || contents.elastic || (contents.stops && kind == EventKind::impact);
}

const std::vector<RunColumn<Event>>& event_columns(const RunContents& contents) {
  static const std::vector<RunColumn<Event>> columns[] = {make_event_columns({}), make_event_columns({.elastic = true}),
                                                          make_event_columns({.stops = true})};
  return columns[contents.elastic ? 1 : contents.stops ? 2 : 0];
}

const std::vector<RunColumn<ControlRecord>>& controller_columns() {
  using C = ControlRecord;
  static const std::vector<RunColumn<C>> columns{
      {{"time", "s", "time of the sample"}, [](const C& c) { return c.measured.t; }},
      {{"reference_angle", "rad", "reference theta_d"}, [](const C& c) { return c.measured.desired.angle; }},
      {{"reference_speed", "rad/s", "reference speed theta_d'"}, [](const C& c) { return c.measured.desired.speed; }},
      {{"gear_angle", "rad", "true gear angle theta_g"}, [](const C& c) { return c.gear_angle; }},
      {{"measured_angle", "rad", "gear angle as the encoder shows it"}, [](const C& c) { return c.measured.angle; }},
      {{"measured_speed", "rad/s", "gear speed as the controller knows it"},
       [](const C& c) { return c.measured.speed; }},
      {{"sliding_variable", "rad/s", "sliding variable s, 0 for other controllers"},
       [](const C& c) { return c.decided.s; }},
      {{"input", "N m", "input u = tau_m - (Jw i/Jg) tau_l_hat of the sliding law, 0 for other controllers"},
       [](const C& c) { return c.decided.u; }},
      {{"compensation", "N m", "part of the torque that is break-in compensation"},
       [](const C& c) { return c.decided.compensation; }},
      {{"torque", "N m", "motor torque that the controller decided"}, [](const C& c) { return c.decided.torque; }},
      {{"applied_torque", "N m", "command that the motor has from this sample on: delayed, limited"},
       [](const C& c) { return c.applied; }},
      {{"disturbance_torque", "N m", "random torque on the worm's shaft from this sample on"},
       [](const C& c) { return c.disturbance; }}};
  return columns;
}

}  // namespace wormdrive
