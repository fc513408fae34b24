// Directional derivatives of an FMU, judged by central differences through the same FMU, and by the equations of the
// paper; over random drives, states and torques.
#include <algorithm>
#include <map>
#include <random>
#include <sstream>

#include "fmi/exported.hpp"
#include "fmi/importer3.hpp"

namespace wormdrive::test::fmi_derivatives {

namespace {

using Names = std::vector<std::string>;

std::vector<unsigned> references(const Fmu& fmu, const Names& names) {
  std::vector<unsigned> list;
  for (const std::string& name : names) list.push_back(fmu.reference(name));
  return list;
}

/// A plant in continuous-time mode, wherever its parameters and its initial state were set before.
class Plant {
 public:
  explicit Plant(const Fmu& fmu) : model(fmu) {
    for (const std::string shaft : {"worm", "gear"})
      if (fmu.references().contains(shaft + "_angle")) {
        states.insert(states.end(), {shaft + "_angle", shaft + "_speed"});
        unknowns.insert(unknowns.end(), {"der(" + shaft + "_angle)", "der(" + shaft + "_speed)"});
      }
    std::map<unsigned, std::string> of_effects;
    for (const auto& [name, reference] : fmu.references())
      if (name.starts_with("der(effect.")) of_effects[reference] = name;
    for (const auto& [reference, name] : of_effects) {
      states.push_back(name.substr(4, name.size() - 5));
      unknowns.push_back(name);
    }
    knowns = states;
    knowns.emplace_back("motor_torque");
    unknowns.insert(unknowns.end(), {"normal_force", "measured_angle"});
    for (const auto& [name, reference] : fmu.references())
      if (name.starts_with("indicator.")) unknowns.push_back(name);
  }
  void start() {
    model.call<decltype(fmi2EnterInitializationMode)>("fmi2EnterInitializationMode");
    model.call<decltype(fmi2ExitInitializationMode)>("fmi2ExitInitializationMode");
    fmi2EventInfo info{};
    model.call<decltype(fmi2NewDiscreteStates)>("fmi2NewDiscreteStates", &info);
    model.call<decltype(fmi2EnterContinuousTimeMode)>("fmi2EnterContinuousTimeMode");
  }
  /// Values of all unknowns where knowns have these values.
  std::vector<double> at(std::vector<double> values) {
    model.set("motor_torque", values.back());
    model.call<decltype(fmi2SetContinuousStates)>("fmi2SetContinuousStates", static_cast<const double*>(values.data()),
                                                  states.size());
    std::vector<double> found;
    for (const std::string& name : unknowns) found.push_back(model.real(name));
    return found;
  }
  std::vector<double> here() {
    std::vector<double> values;
    for (const std::string& name : knowns) values.push_back(model.real(name));
    return values;
  }
  /// Derivatives of all unknowns along a direction.
  std::vector<double> along(const std::vector<double>& seed) {
    const std::vector<unsigned> of = references(model.fmu(), unknowns), by = references(model.fmu(), knowns);
    std::vector<double> found(of.size());
    model.call<decltype(fmi2GetDirectionalDerivative)>("fmi2GetDirectionalDerivative", of.data(), of.size(), by.data(),
                                                       by.size(), seed.data(), found.data());
    return found;
  }
  double derivative(const std::string& of, const std::string& by) {
    std::vector<double> seed(knowns.size(), 0.0);
    seed[static_cast<std::size_t>(std::find(knowns.begin(), knowns.end(), by) - knowns.begin())] = 1.0;
    return along(seed)[static_cast<std::size_t>(std::find(unknowns.begin(), unknowns.end(), of) - unknowns.begin())];
  }

  Instance model;
  Names states, knowns, unknowns;
};

/// Parameters of a drive that draws choose, between a low and a high value.
struct Range {
  std::string name;
  double low, high;
};

/// Derivatives along random directions against central differences, for so many drives; how many were at rest.
int differences(const Exported& exported, const std::vector<Range>& ranges, double torque, int draws, bool moving) {
  std::mt19937 random(24);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  int at_rest = 0;
  for (int draw = 0; draw < draws; ++draw) {
    Plant plant(*exported.fmu);
    for (const Range& range : ranges) plant.model.set(range.name, between(range.low, range.high));
    if (!moving) plant.model.set("initial.gear_speed_rad_per_s", 0.0);
    plant.model.set("motor_torque", between(-torque, torque));
    plant.start();
    at_rest += plant.model.integer("motion") == 0;
    const std::vector<double> x = plant.here();
    std::vector<double> seed(x.size());
    for (double& one : seed) one = between(-1.0, 1.0);
    const std::vector<double> exact = plant.along(seed);
    const double h = 1e-6;
    const auto moved = [&](double by) {
      std::vector<double> there = x;
      for (std::size_t k = 0; k < x.size(); ++k) there[k] += by * seed[k];
      return plant.at(there);
    };
    const std::vector<double> right = moved(h), left = moved(-h);
    for (std::size_t k = 0; k < exact.size(); ++k) {
      INFO("draw " << draw << ", " << plant.unknowns[k] << ", mode " << plant.model.integer("motion") << ' '
                   << plant.model.integer("flank"));
      const double difference = (right[k] - left[k]) / (2.0 * h);
      const double rounding = 1e-13 * (std::abs(right[k]) + std::abs(left[k]) + 1.0) / h;
      CHECK(std::abs(exact[k] - difference) < 1e-7 * std::abs(exact[k]) + rounding);
    }
  }
  return at_rest;
}

const std::vector<Range> of_a_mesh{{"mesh.friction", 0.05, 0.4},
                                   {"mesh.lead_angle_rad", 0.05, 0.2},
                                   {"mesh.gear_inertia_kgm2", 5e-4, 1e-3},
                                   {"initial.gear_angle_rad", -3.0, 3.0},
                                   {"initial.gear_speed_rad_per_s", -5.0, 5.0}};

const Names everything{"initial.gear_speed_rad_per_s=0.1",
                       "effect.torque_gain.share=0.1",
                       "effect.torque_offset.torque_Nm=0.0005",
                       "effect.cogging.amplitude_Nm=0.0005",
                       "effect.cogging.periods=3",
                       "effect.cogging.phase_deg=20",
                       "effect.worm_viscous.coefficient_Nms_per_rad=1e-5",
                       "effect.worm_coulomb.torque_Nm=0.002",
                       "effect.stribeck.drop=0.04",
                       "effect.stribeck.speed_m_per_s=0.1",
                       "effect.position_friction.amplitude=0.05",
                       "effect.position_friction.phase_deg=0",
                       "effect.transmission_error.amplitude_deg=0.05",
                       "effect.transmission_error.phase_deg=10",
                       "effect.gear_viscous.coefficient_Nms_per_rad=1e-4",
                       "effect.load_spring.stiffness_Nm_per_rad=0.01",
                       "effect.load_spring.angle_deg=0",
                       "effect.load_crank={mass_kg=0.1,crank_m=0.03,rod_m=0.08,angle_deg=40}",
                       "effect.load_four_bar={inertia_kgm2=1e-4,crank_m=0.03,coupler_m=0.07,rocker_m=0.06,base_m=0.08}",
                       "effect.encoder_scale.share=0.01"};

/// Effects with states: a current loop whose supply does not end its voltage, a winding and a gearbox that warm up,
/// bristles of bearings and teeth, and a crank behind a coupling.
const Names with_states{
    "effect.dc_motor={resistance_ohm=1.2,torque_constant_Nm_per_A=0.025,inductance_H=0.5,current_bandwidth_Hz=2,"
    "supply_voltage_V=1000,heat_capacity_J_per_K=2,temperature_coefficient_per_K=0.004}",
    "effect.worm_lugre={coulomb_torque_Nm=0.002,stiffness_Nm_per_rad=0.01,damping_Nms_per_rad=1e-4}",
    "effect.mesh_lugre={stiffness_per_m=500,damping_s_per_m=0.5}",
    "effect.gearbox_heat={friction_decay_per_K=0.01,churning_Nms_per_rad=1e-5,churning_decay_per_K=0.02,"
    "heat_capacity_J_per_K=0.5,thermal_resistance_K_per_W=2,starting_rise_K=20}",
    "effect.load_coupling={inertia_kgm2=1e-3,stiffness_Nm_per_rad=3,damping_Nms_per_rad=0.01}",
    "effect.load_crank={mass_kg=0.5,crank_m=0.03,rod_m=0.08,angle_deg=40}"};

}  // namespace

TEST_CASE("directional derivatives are what central differences through the FMU give, whatever effects are on") {
  const Exported bare(shipped("fig09_switching.toml"), {"initial.gear_speed_rad_per_s=0.1"});
  const Exported full(shipped("fig09_switching.toml"), everything);
  for (const Exported* exported : {&bare, &full}) {
    CHECK(differences(*exported, of_a_mesh, 0.1, 40, true) == 0);
    CHECK(differences(*exported, of_a_mesh, 0.003, 20, false) > 3);  // derivatives of rest are those of rest
  }
}

TEST_CASE("directional derivatives of elastic teeth and of one mass are what central differences give") {
  const Exported teeth(shipped("fig09_backlash.toml"), {"initial.gear_speed_rad_per_s=0.1"});
  CHECK(differences(teeth, of_a_mesh, 0.1, 40, true) == 0);
  CHECK(differences(teeth, of_a_mesh, 0.003, 20, false) > 3);
  const Exported axis(shipped("measured_servo_axis.toml"), {"initial.speed_m_per_s=0.1"});
  CHECK(differences(axis, {{"initial.speed_m_per_s", -1.0, 1.0}}, 50.0, 10, true) == 0);
}

TEST_CASE("directional derivatives of effects with states are what central differences give, by these states too") {
  Names words = everything;
  words.insert(words.end(), with_states.begin(), with_states.end());
  const Exported full(shipped("fig09_switching.toml"), words);
  REQUIRE(Plant(*full.fmu).states.size() == 9);
  CHECK(differences(full, of_a_mesh, 0.1, 40, true) == 0);
  CHECK(differences(full, of_a_mesh, 0.003, 20, false) > 3);
}

TEST_CASE("the derivatives of a bare drive are those of the paper's equations") {
  const Exported exported(shipped("fig09_switching.toml"), {"initial.gear_speed_rad_per_s=0.1"});
  std::mt19937 random(7);
  for (int draw = 0; draw < 50; ++draw) {
    Plant plant(*exported.fmu);
    const auto between = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    for (const Range& range : of_a_mesh) plant.model.set(range.name, between(range.low, range.high));
    if (draw % 3 == 0) plant.model.set("initial.gear_speed_rad_per_s", 0.0);
    plant.model.set("motor_torque", between(-0.05, 0.05));
    plant.start();
    const auto mesh = [&](const std::string& name) { return plant.model.real("mesh." + name); };
    const double lambda = mesh("lead_angle_rad"), phi = mesh("pressure_angle_rad"), lw = mesh("worm_pitch_radius_m"),
                 lg = mesh("gear_pitch_radius_m"), Jg = mesh("gear_inertia_kgm2");
    const int motion = plant.model.integer("motion"), flank = plant.model.integer("flank");
    const double amplitude = plant.model.real("load.torque_Nm"), angle = plant.model.real("gear_angle");
    const double slope = -amplitude * std::sin(angle);  // of the load over the angle
    double a_by_torque = 0.0, a_by_angle = 0.0, force_by_torque = 0.0, force_by_angle = 0.0;
    if (motion == 0) {  // eq. 6-7
      const double sum = amplitude * std::cos(angle) / lg * std::cos(lambda) -
                         plant.model.real("motor_torque") / lw * std::sin(lambda);
      const double side = (sum < 0.0 ? -1.0 : 1.0) / std::cos(phi);
      force_by_torque = -side * std::sin(lambda) / lw;
      force_by_angle = side * slope * std::cos(lambda) / lg;
    } else {  // eq. 18-19, with the force of eq. 12 and 14
      const double m = motion * flank * mesh("friction");
      const double arm = (std::cos(phi) * std::cos(lambda) + m * std::sin(lambda)) * lg;
      const double C = lw * (std::cos(phi) * std::sin(lambda) - m * std::cos(lambda)) / arm;
      a_by_torque = 1.0 / (mesh("worm_inertia_kgm2") * mesh("ratio") + C * Jg);
      a_by_angle = a_by_torque * C * slope;
      force_by_torque = -flank * Jg * a_by_torque / arm;
      force_by_angle = flank * (slope - Jg * a_by_angle) / arm;
    }
    const auto is = [&](const std::string& of, const std::string& by, double expected) {
      INFO(of << " by " << by << ", motion " << motion);
      CHECK(std::abs(plant.derivative(of, by) - expected) <= 1e-12 * std::abs(expected));
    };
    is("der(gear_speed)", "motor_torque", a_by_torque);
    is("der(gear_speed)", "gear_angle", a_by_angle);
    is("der(gear_speed)", "gear_speed", 0.0);
    is("der(gear_angle)", "gear_speed", motion == 0 ? 0.0 : 1.0);
    is("normal_force", "motor_torque", force_by_torque);
    is("normal_force", "gear_angle", force_by_angle);
  }
}

TEST_CASE("beyond the limit of the motor nothing depends on its torque") {
  const Exported exported(shipped("fig09_switching.toml"),
                          {"initial.gear_speed_rad_per_s=1", "effect.torque_saturation.limit_Nm=0.02"});
  for (const auto& [torque, follows] : {std::pair{0.019, true}, {0.021, false}, {-0.021, false}}) {
    Plant plant(*exported.fmu);
    plant.model.set("motor_torque", torque);
    plant.start();
    CHECK((plant.derivative("der(gear_speed)", "motor_torque") != 0.0) == follows);
  }
}

TEST_CASE("FMI 3.0: adjoint derivatives are the transpose of the directional ones, of an output too") {
  const Exported exported(shipped("fig09_backlash.toml"), {"initial.gear_speed_rad_per_s=0.1"}, {"--fmi", "3"});
  Instance3 model(*exported.fmu, false);
  model.initialize(1.0);
  model.update();
  const std::vector<unsigned> of = references(*exported.fmu, {"der(worm_speed)", "normal_force", "gear_angle"}),
                              by =
                                  references(*exported.fmu, {"gear_angle", "motor_torque", "worm_speed", "worm_angle"});
  const std::vector<double> v{0.3, -1.7, 0.9, 2.2}, u{-0.4, 1.1, 0.8};
  std::vector<double> forward(of.size()), backward(by.size());
  model.call<decltype(fmi3GetDirectionalDerivative)>("fmi3GetDirectionalDerivative", of.data(), of.size(), by.data(),
                                                     by.size(), v.data(), v.size(), forward.data(), forward.size());
  model.call<decltype(fmi3GetAdjointDerivative)>("fmi3GetAdjointDerivative", of.data(), of.size(), by.data(), by.size(),
                                                 u.data(), u.size(), backward.data(), backward.size());
  double one = 0.0, other = 0.0;
  for (std::size_t k = 0; k < of.size(); ++k) one += u[k] * forward[k];
  for (std::size_t k = 0; k < by.size(); ++k) other += v[k] * backward[k];
  CHECK(std::abs(one - other) < 1e-12 * std::abs(one));
  CHECK(forward[2] == v[0]);
  CHECK_THROWS_WITH((model.call<decltype(fmi3GetAdjointDerivative)>("fmi3GetAdjointDerivative", of.data(), of.size(),
                                                                    by.data(), by.size(), u.data(), std::size_t{2},
                                                                    backward.data(), backward.size())),
                    "there are fewer values than variables");
}

TEST_CASE("an unknown depends on nothing but what the description states") {
  for (const std::string file : {"fig09_switching", "fig09_backlash"}) {
    const Exported exported(shipped(file + ".toml"), {"initial.gear_speed_rad_per_s=0.1"});
    Plant plant(*exported.fmu);
    plant.start();
    boost::property_tree::ptree xml;
    read_xml(exported.folder / "modelDescription.xml", xml);
    Names names{""};
    for (const auto& [tag, variable] : xml.get_child("fmiModelDescription.ModelVariables"))
      names.push_back(variable.get<std::string>("<xmlattr>.name"));
    int stated = 0;
    for (const std::string group : {"Outputs", "Derivatives"})
      for (const auto& [tag, unknown] : xml.get_child("fmiModelDescription.ModelStructure." + group)) {
        const auto list = unknown.get_optional<std::string>("<xmlattr>.dependencies");
        const std::string name = names[unknown.get<std::size_t>("<xmlattr>.index")];
        if (!list || std::find(plant.unknowns.begin(), plant.unknowns.end(), name) == plant.unknowns.end()) continue;
        Names on;
        std::istringstream indices(*list);
        for (std::size_t k; indices >> k;) on.push_back(names[k]);
        for (const std::string& known : plant.knowns) {
          INFO(name << " by " << known);
          const bool depends = std::find(on.begin(), on.end(), known) != on.end();
          CHECK((plant.derivative(name, known) != 0.0) == depends);
          stated += depends;
        }
      }
    CHECK(stated >= 2);
    CHECK(xml.get<bool>("fmiModelDescription.ModelExchange.<xmlattr>.providesDirectionalDerivative"));
  }
}

TEST_CASE("what has no derivative is refused in one line") {
  const Exported exported(shipped("fig09_switching.toml"));
  Plant plant(*exported.fmu);
  const auto ask = [&](Instance& model, const std::string& of, const std::string& by) {
    const unsigned unknown = exported.fmu->reference(of), known = exported.fmu->reference(by);
    double seed = 1.0, found = 0.0;
    model.call<decltype(fmi2GetDirectionalDerivative)>("fmi2GetDirectionalDerivative", &unknown, size_t{1}, &known,
                                                       size_t{1}, static_cast<const double*>(&seed), &found);
    return found;
  };
  CHECK_THROWS_WITH(ask(plant.model, "normal_force", "gear_angle"),
                    "fmi2GetDirectionalDerivative must not be called before the initialization mode");
  plant.start();
  CHECK_THROWS_WITH(ask(plant.model, "normal_force", "mesh.friction"),
                    "value reference " + std::to_string(exported.fmu->reference("mesh.friction")) +
                        " is no state and no input to differentiate by");
  CHECK_THROWS_WITH(ask(plant.model, "motion", "gear_angle"),
                    "value reference 20 is no continuous output, rate or event indicator to differentiate");
  const Exported motor(shipped("current_loop.toml"));
  Plant wound(*motor.fmu);
  wound.start();
  const unsigned bristles = motor.fmu->reference("effect.dc_motor.current") + 2;  // of an effect that is off
  for (const auto& [unknown, known] :
       {std::pair{bristles, bristles}, {motor.fmu->reference("normal_force"), bristles}}) {
    double seed = 1.0, found = 0.0;
    CHECK_THROWS_WITH(wound.model.call<decltype(fmi2GetDirectionalDerivative)>(
                          "fmi2GetDirectionalDerivative", &unknown, size_t{1}, &known, size_t{1},
                          static_cast<const double*>(&seed), &found),
                      "there is no variable with the value reference " + std::to_string(bristles));
  }
  Instance inside(*exported.fmu, "", fmi2CoSimulation);
  inside.call<decltype(fmi2EnterInitializationMode)>("fmi2EnterInitializationMode");
  inside.call<decltype(fmi2ExitInitializationMode)>("fmi2ExitInitializationMode");
  CHECK_THROWS_WITH(ask(inside, "normal_force", "gear_angle"),
                    "fmi2GetDirectionalDerivative must not be called in step mode");
}

}  // namespace wormdrive::test::fmi_derivatives
