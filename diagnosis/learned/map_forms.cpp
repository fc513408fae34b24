#include "diagnosis/learned/map_forms.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "description/build.hpp"
#include "diagnosis/rules/verdict.hpp"

namespace wormdrive {

namespace {

template <class Map>
std::optional<Map>& map_in(RecordedDrive& drive) {
  return std::get<std::optional<Map>>(drive.effects.list);
}

template <MapAxis over, MapShaft shaft>
void put_torque(RecordedDrive& drive, CubicTable table) {
  map_in<TorqueMap<double>>(drive) = {over, 1.0, std::move(table), shaft};
}

template <FrictionAxis over>
void put_friction(RecordedDrive& drive, CubicTable table) {
  map_in<FrictionMap<double>>(drive) = {over, FrictionValue::share, 1.0, std::move(table)};
}

template <LoadAxis over>
void put_load(RecordedDrive& drive, CubicTable table) {
  map_in<LoadMap<double>>(drive) = {over, 1.0, std::move(table)};
}

}  // namespace

std::vector<MapForm> map_forms(const RecordedDrive& drive, const Magnitudes& sizes, double ratio) {
  using enum MapArgument;
  constexpr std::string_view torque = TorqueMap<double>::id, friction = FrictionMap<double>::id,
                             load = LoadMap<double>::id;
  const double on_worm = rules::test_torque * sizes.torque, on_gear = on_worm * ratio, share = rules::test_torque;
  std::vector<MapForm> forms{
      {torque, "torque on the worm", worm_speed, on_worm, put_torque<MapAxis::worm_speed, MapShaft::worm>},
      {torque, "torque on the worm", gear_angle, on_worm, put_torque<MapAxis::gear_angle, MapShaft::worm>},
      {torque, "torque on the worm", time, on_worm, put_torque<MapAxis::time, MapShaft::worm>}};
  if (sizes.has_teeth) {  // else one shaft is both
    forms.push_back(
        {torque, "torque on the gear", worm_speed, on_gear, put_torque<MapAxis::worm_speed, MapShaft::gear>});
    forms.push_back(
        {torque, "torque on the gear", gear_angle, on_gear, put_torque<MapAxis::gear_angle, MapShaft::gear>});
  }
  if (sizes.stated_friction > 0.0) {
    forms.push_back(
        {friction, "share of the friction", sliding_speed, share, put_friction<FrictionAxis::sliding_speed>});
    forms.push_back({friction, "share of the friction", gear_angle, share, put_friction<FrictionAxis::gear_angle>});
    forms.push_back({friction, "share of the friction", time, share, put_friction<FrictionAxis::time>});
  }
  if (sizes.load_torque > 0.0) {
    forms.push_back({load, "share of the load", time, share, put_load<LoadAxis::time>});
    forms.push_back({load, "share of the load", gear_angle, share, put_load<LoadAxis::gear_angle>});
  }
  std::erase_if(forms, [&](const MapForm& form) { return field_of(drive, form.effect, "scale").on; });
  return forms;
}

std::string_view name(MapArgument over) {
  switch (over) {
    case MapArgument::worm_speed: return "worm speed";
    case MapArgument::sliding_speed: return "sliding speed";
    case MapArgument::gear_angle: return "gear angle";
    case MapArgument::time: return "time";
  }
  return {};
}

std::vector<double> values_of(MapArgument over, const Evaluation& evaluation, const Hypothesis& h) {
  std::vector<double> all;
  std::vector<FilteredStates> states;
  if (!evaluation.innovations(extended(h), h.noise, {}, &states)) return all;
  const GearMesh<double> mesh = stated_mesh(evaluation.scenario());
  const auto value = [&](const PreparedRecording& recording, const FilteredStates& state, std::size_t k) {
    switch (over) {
      case MapArgument::worm_speed: return mesh.i * state.speed[k];
      case MapArgument::sliding_speed: return mesh.sliding_speed(mesh.i * std::abs(state.speed[k]));
      case MapArgument::gear_angle: return state.angle[k];
      case MapArgument::time: return recording.data.time(k);
    }
    return 0.0;
  };
  for (std::size_t r = 0; r < states.size(); ++r) {
    const PreparedRecording& recording = evaluation.layout().recordings[r];
    for (std::size_t k = 0; k < recording.samples(); ++k)
      if (recording.moving[k]) all.push_back(value(recording, states[r], k));
  }
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace wormdrive
