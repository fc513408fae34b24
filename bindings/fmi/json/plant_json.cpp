#include "bindings/fmi/json/plant_json.hpp"

#include <cmath>
#include <stdexcept>

#include <boost/uuid/name_generator.hpp>
#include <boost/uuid/uuid_io.hpp>
#include <fmt/format.h>

#include "bindings/fmi/json/control_json.hpp"
#ifndef _WIN32
#include "output/classic_locale.hpp"
#endif

namespace wormdrive {
namespace {

LoadParameters load_from_json(Json& at, Axis axis) {
  if (at.is_array()) return load_of(terms_from_json<LoadTerm>(at, axis));
  std::optional<LoadParameters> load;
  for_each_load([&]<class Load>() {
    if (at.at("kind").get<std::string>() != Load::kind) return;
    Load parameters;
    transfer(Reader{axis}, at, parameters);
    load = load_of({parameters});
  });
  if (!load) throw std::invalid_argument("a load of an unknown kind");
  return *load;
}

}  // namespace

std::string plant_to_json(const FmuModel& model) {
  const Scenario& scenario = model.scenario;
  const Writer write{scenario.axis};
  Json plant{{"axis", scenario.axis == Axis::linear ? "linear" : "rotary"}, {"effect", Json::object()}};
  std::visit(
      [&]<class Mesh>(const Mesh& mesh) {
        plant["mesh"] = {{"kind", std::is_same_v<Mesh, MeshParameters<double>> ? "worm" : "none"}};
        transfer(write, plant["mesh"], mesh);
      },
      scenario.mesh);
  std::visit(
      [&]<class Load>(const Load& load) {
        if constexpr (requires { load.terms; })
          plant["load"] = terms_to_json(load.terms, scenario.axis);
        else
          plant["load"] = kind_to_json(load, scenario.axis);
      },
      scenario.load);
  scenario.effects.for_each([&](const auto& effect) {
    if (!effect) return;
    Json& at = plant["effect"][std::string(effect->id)] = Json::object();
    transfer(write, at, *effect);
  });
  plant["initial"] = Json::object();
  transfer(write, plant["initial"], scenario.initial);
  plant["run"] = {{"duration_s", scenario.run.duration}, {"relative_tolerance", scenario.run.relative_tolerance}};
  if (scenario.run.absolute_tolerance) plant["run"]["absolute_tolerance"] = *scenario.run.absolute_tolerance;
  if (std::isfinite(scenario.run.max_step)) plant["run"]["max_step_s"] = scenario.run.max_step;
  if (model.kind == FmuKind::loop) {
    plant["motor"] = terms_to_json(scenario.motor.terms, scenario.axis);
    if (scenario.control) plant["control"] = control_to_json(*scenario.control, scenario.axis);
  }
  return plant.dump(1) + "\n";
}

FmuModel plant_from_json(const std::string& text) {
#ifndef _WIN32  // whose threads have no locale; the reader asks which decimal point its numbers are to have
  const ClassicLocale read_so;
#endif
  Json plant = Json::parse(text);
  FmuModel model{plant.contains("motor") ? FmuKind::loop : FmuKind::plant, {}, {}};
  Scenario& scenario = model.scenario;
  scenario.axis = plant.at("axis") == "linear" ? Axis::linear : Axis::rotary;
  const Reader read{scenario.axis};
  if (plant.at("mesh").at("kind") == "none") scenario.mesh = SingleInertia<double>{};
  std::visit([&](auto& mesh) { transfer(read, plant.at("mesh"), mesh); }, scenario.mesh);
  scenario.load = load_from_json(plant.at("load"), scenario.axis);
  scenario.effects.for_each([&]<class Effect>(std::optional<Effect>& effect) {
    const auto found = plant.at("effect").find(Effect::id);
    if (found == plant.at("effect").end()) return;
    effect.emplace();
    transfer(read, *found, *effect);
  });
  transfer(read, plant.at("initial"), scenario.initial);
  const Json& run = plant.at("run");
  run.at("duration_s").get_to(scenario.run.duration);
  run.at("relative_tolerance").get_to(scenario.run.relative_tolerance);
  if (const auto stated = run.find("absolute_tolerance"); stated != run.end())
    scenario.run.absolute_tolerance = stated->get<double>();
  if (const auto stated = run.find("max_step_s"); stated != run.end()) stated->get_to(scenario.run.max_step);
  if (model.kind == FmuKind::loop) scenario.motor.terms = terms_from_json<SignalTerm>(plant.at("motor"), scenario.axis);
  if (const auto control = plant.find("control"); control != plant.end())
    scenario.control = control_from_json(*control, scenario.axis);
  return model;
}

std::string guid_of(const std::string& plant) {
  const auto name_space = boost::uuids::ns::oid();
  return fmt::format("{{{}}}", boost::uuids::to_string(boost::uuids::name_generator_sha1(name_space)(plant)));
}

}  // namespace wormdrive
