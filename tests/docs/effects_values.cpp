#include <fstream>
#include <map>
#include <regex>

#include <fmt/format.h>

#include "catch.hpp"
#include "cli/program.hpp"
#include "core/elastic/compliant_drive.hpp"
#include "core/elastic/elastic_teeth.hpp"
#include "description/build.hpp"
#include "simulation/load_scenario.hpp"
#include "support.hpp"

// The worked values of docs/effects.md: parameters, what they are at, and what they give, against the program.

using namespace wormdrive;
using namespace wormdrive::test;

namespace {

struct WorkedValue {
  std::string effect, with, at, gives;
};

std::vector<WorkedValue> worked_values() {
  std::ifstream page(WORMDRIVE_DOCS "/effects.md");
  std::vector<WorkedValue> found;
  const std::regex heading("## `(\\w+)`"), row("\\| (.* = .*) \\| (.* = .*) \\| (.* = .*) \\|");
  std::string effect;
  for (std::string line; std::getline(page, line);) {
    std::smatch part;
    if (std::regex_match(line, part, heading)) effect = part[1];
    if (std::regex_match(line, part, row)) found.push_back({effect, part[1], part[2], part[3]});
  }
  return found;
}

/// "a = 1, b = 2" as {a: "1", b: "2"}.
std::map<std::string, std::string> assignments(const std::string& text) {
  std::map<std::string, std::string> found;
  const std::regex assignment("([^ ,]+) = (\\[[^\\]]*\\]|[^ ,]+)");
  for (std::sregex_iterator it(text.begin(), text.end(), assignment); it != std::sregex_iterator(); ++it)
    found[(*it)[1]] = (*it)[2];
  return found;
}

/// Numbers of a row by name, 0 where it says nothing.
class Numbers {
 public:
  explicit Numbers(const std::string& text) {
    for (const auto& [name, value] : assignments(text)) numbers_[name] = std::stod(value);
  }
  bool has(const std::string& name) const { return numbers_.count(name) != 0; }
  double operator[](const std::string& name) const { return has(name) ? numbers_.at(name) : 0.0; }

 private:
  std::map<std::string, double> numbers_;
};

Scenario stated(const WorkedValue& value, double u) {
  std::vector<std::string> words{"load.torque_Nm=0.1",
                                 fmt::format("motor.torque={{kind=\"constant\",torque_Nm={}}}", u)};
  if (value.effect == "bearing_asymmetry")
    words.insert(words.end(),
                 {"effect.worm_coulomb.torque_Nm=0.001", "effect.worm_viscous.coefficient_Nms_per_rad=5e-6"});
  if (value.effect == "backlash")
    words.insert(words.end(),
                 {"effect.tooth_compliance.stiffness_N_per_m=1e7", "effect.tooth_compliance.damping_s_per_m=0"});
  for (const auto& [key, number] : assignments(value.with))
    words.push_back(fmt::format("effect.{}.{}={}", value.effect, key, number));
  return load_scenario(shipped("fig09_switching.toml"), words, Purpose::run);
}

/// What the bearings of one effect add, without those that it only comes along with.
Effects<double> alone(const std::string& id, const Effects<double>& all) {
  Effects<double> on = all;
  on.for_each([&]<class Effect>(std::optional<Effect>& effect) {
    if (Effect::id != id) effect.reset();
  });
  return on;
}

/// The quantity that a row gives.
double evaluated(const WorkedValue& value, const std::string& quantity) {
  const Numbers at(value.at);
  const Scenario scenario = stated(value, at["u"]);
  auto drive = make_drive(scenario);
  drive.enter(0.0);
  for (double knot = drive.next_knot(0.0); knot <= at["t"]; knot = drive.next_knot(knot)) drive.enter(knot);
  const GearMesh<double>& mesh = drive.mesh();
  const double omega_g = at.has("v") ? at["v"] * std::cos(mesh.lambda) / mesh.lw / mesh.i : at["omega_g"];
  Moment<double> moment = drive.moment(at["t"], at["theta_g"], omega_g);
  if (at.has("rest")) moment.rest = at["rest"];
  const Motion motion = omega_g > 0.0 ? Motion::forward : omega_g < 0.0 ? Motion::backward : Motion::stuck;
  if (at.has("h")) {  // the first state of the effect
    std::size_t place = 0;
    StateLayout<EffectList<double>>::for_each([&](std::string_view id, const EffectState& state, std::size_t k) {
      if (id == value.effect && state.name == "friction") place = k;
    });
    const auto with_states = make_drive<true>(scenario);
    MomentOfEffects<double> bent{moment, {}};
    bent.states[place] = at["h"];
    if (quantity == "mu") return with_states.friction(bent, motion);
    if (quantity == "h'") return with_states.state_rates(bent, Mode{motion, Flank::left})[place];
  }
  const Effects<double> on = alone(value.effect, drive.effects());
  if (quantity == "tau_m") return drive.inputs(moment, motion).worm;
  if (quantity == "tau_l") return drive.inputs(moment, motion).gear;
  if (quantity == "tau_w") return on.worm_torque(moment, motion);
  if (quantity == "tau_g") return on.gear_torque(drive.inputs(moment, motion).gear, moment, motion);
  if (quantity == "mu") return drive.friction(moment, motion == Motion::stuck ? Motion::forward : motion);
  if (quantity == "P") {
    const auto impact = impact_on_stop(drive, moment, motion);
    return impact.stopping + impact.driving;
  }
  if (quantity == "rebound") return impact_on_stop(drive, moment, motion).speed;
  if (quantity == "Jw") return mesh.Jw;
  if (quantity == "Jg") return drive.Jg(moment);
  if (quantity == "theta_w") return moment.theta_w;
  if (quantity == "omega_w") return moment.omega_w;
  if (quantity == "theta_seen") return on.measured_angle(at["theta_g"]);
  if (quantity == "t_seen") {
    Timetable timetable(0.0, 1.0, 1.0, {.period = 1.0, .offset = at["t"], .age = on.measuring_delay()});
    timetable.pop();  // the inputs' knot at the begin
    return timetable.next_time();
  }
  const ToothContact<double> contact = tooth_contact(drive.effects());
  if (quantity == "Wn") return contact.force(at["d"], at["d'"]);
  if (quantity == "d") {
    const CompliantDrive elastic(drive, contact);
    const double deflection = at["deflection"];
    return elastic.penetration(Moment<double>{0.0, deflection, 0.0, 0.0}, deflection < 0.0 ? Flank::right : Flank::left)
        .first;
  }
  FAIL("the page gives a quantity that this test does not know: " << quantity);
  return 0.0;
}

}  // namespace

TEST_CASE("every effect has three worked values in docs/effects.md, and the program gives them") {
  std::map<std::string, int> count;
  for (const WorkedValue& value : worked_values()) {
    INFO(value.effect << ": " << value.with << "; " << value.at << "; " << value.gives);
    ++count[value.effect];
    for (const auto& [quantity, number] : assignments(value.gives))
      REQUIRE(std::abs(evaluated(value, quantity) - std::stod(number)) <= 1e-8 * std::abs(std::stod(number)) + 1e-15);
  }
  Effects<double>{}.for_each([&]<class Effect>(const std::optional<Effect>&) {
    INFO(Effect::id);
    REQUIRE(count[std::string(Effect::id)] == 3);
  });
}
