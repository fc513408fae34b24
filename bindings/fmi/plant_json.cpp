#include "bindings/fmi/plant_json.hpp"

#include <stdexcept>

#include <boost/uuid/name_generator.hpp>
#include <boost/uuid/uuid_io.hpp>
#include <nlohmann/json.hpp>

#include "bindings/fmi/plant_parameters.hpp"
#include "description/variant_kinds.hpp"
#include "output/classic_locale.hpp"

namespace wormdrive {
namespace {

using Json = nlohmann::json;

/// One description of the file for both directions: it puts what it is given into the JSON, or takes it from there.
struct Writer {
  static constexpr bool reads = false;
  Axis axis;
  void operator()(Json& at, std::string_view key, const double& value) const {
    if (std::isfinite(value)) at[std::string(key)] = value;  // an infinite default is stated by absence
  }
  void operator()(Json& at, std::string_view key, const std::optional<double>& value) const {
    if (value) at[std::string(key)] = *value;
  }
  void operator()(Json& at, std::string_view key, const std::vector<double>& values) const {
    at[std::string(key)] = values;
  }
};
struct Reader {
  static constexpr bool reads = true;
  Axis axis;
  void operator()(Json& at, std::string_view key, double& value) const {
    if (const auto found = at.find(key); found != at.end()) value = found->get<double>();
  }
  void operator()(Json& at, std::string_view key, std::optional<double>& value) const {
    if (const auto found = at.find(key); found != at.end()) value = found->get<double>();
  }
  void operator()(Json& at, std::string_view key, std::vector<double>& values) const { at.at(key).get_to(values); }
};

template <class Direction, class Parameters>
void transfer(const Direction& pass, Json& at, Parameters& parameters) {
  using P = std::remove_const_t<Parameters>;
  if constexpr (requires { P::fields(); }) {
    for_each_field<P>(
        [&](const auto& field) { pass(at, si_spelling(field, pass.axis).key, parameters.*field.member); });
  } else if constexpr (requires { parameters.interpolation; }) {
    pass(at, "times", parameters.times);
    pass(at, "values", parameters.values);
    if constexpr (Direction::reads)
      parameters.interpolation = at.at("linear").template get<bool>() ? Interpolation::linear : Interpolation::hold;
    else
      at["linear"] = parameters.interpolation == Interpolation::linear;
  } else {
    pass(at, "angles", parameters.angles);
    pass(at, "torques", parameters.torques);
  }
}

template <class Kind>
Json kind_to_json(const Kind& parameters, Axis axis) {
  Json at{{"kind", std::string(Kind::kind)}};
  transfer(Writer{axis}, at, parameters);
  return at;
}

LoadParameters load_from_json(Json& at, Axis axis) {
  if (at.is_array()) {
    std::vector<LoadTerm> terms;
    for (Json& one : at) {
      LoadTerm term = make_kind<LoadTerm>(one.at("kind").get<std::string>());
      std::visit([&](auto& parameters) { transfer(Reader{axis}, one, parameters); }, term);
      terms.push_back(std::move(term));
    }
    return load_of(std::move(terms));
  }
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

std::string plant_to_json(const Scenario& scenario) {
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
        if constexpr (requires { load.terms; }) {
          plant["load"] = Json::array();
          for (const auto& term : load.terms)
            plant["load"].push_back(std::visit([&](const auto& t) { return kind_to_json(t, scenario.axis); }, term));
        } else {
          plant["load"] = kind_to_json(load, scenario.axis);
        }
      },
      scenario.load);
  scenario.effects.for_each([&](const auto& effect) {
    if (!effect) return;
    Json& at = plant["effect"][std::string(effect->id)] = Json::object();
    transfer(write, at, *effect);
  });
  plant["initial"] = Json::object();
  transfer(write, plant["initial"], scenario.initial);
  return plant.dump(1) + "\n";
}

Scenario plant_from_json(const std::string& text) {
  const ClassicLocale read_so;
  Json plant = Json::parse(text);
  Scenario scenario;
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
  return scenario;
}

std::string guid_of(const std::string& plant) {
  const auto name_space = boost::uuids::ns::oid();
  return fmt::format("{{{}}}", boost::uuids::to_string(boost::uuids::name_generator_sha1(name_space)(plant)));
}

}  // namespace wormdrive
