#include <random>

#include <fmt/format.h>

#include "cli/bad_input.hpp"
#include "core/effects.hpp"
#include "description/keys.hpp"

// What a scenario may state is one rule for every command, whether the drive has teeth or is one mass.

namespace wormdrive::test::cli_accepted_effects {

namespace {

const std::string sledge = sledge_of_two_kilograms + R"([motor.torque]
kind = "constant"
force_N = 3.5
[run]
duration_s = 0.01
)";
const std::string wheel =
    "title = \"A wheel\"\n[mesh]\nkind = \"none\"\ninertia_kgm2 = 2\n"
    "[motor.torque]\nkind = \"constant\"\ntorque_Nm = 3.5\n[run]\nduration_s = 0.01\n";

/// A value about as large as the sledge's mass, within the bounds of its field or just outside of them.
double draw(const Bounds& bounds, std::mt19937& random) {
  const double value = std::uniform_real_distribution(-2.5, 2.5)(random);
  return std::uniform_int_distribution(0, 9)(random) == 0 ? value : std::clamp(value, bounds.low, bounds.high);
}

/// A few effects with random values, as tables of a scenario.
std::string random_effects(Axis axis, std::mt19937& random) {
  std::string text;
  Effects<double>{}.for_each([&]<class Effect>(const std::optional<Effect>&) {
    const bool inertia = Effect::id == "worm_inertia" || Effect::id == "gear_inertia";
    if (std::uniform_int_distribution(0, inertia ? 1 : 12)(random) != 0) return;
    text += fmt::format("[effect.{}]\n", Effect::id);
    for_each_field<Effect>([&](const auto& field) {
      const Spelling s = spellings(field.name, field.unit, axis).front();
      const double value = draw(field.bounds, random);
      text += fmt::format("{} = {}\n", s.key, field.name == "exponent" || field.name == "tail" ? 2.0 : value);
    });
    if (const auto columns = possible_columns<Effect>(); !columns.empty())
      for (const ColumnName& name : {columns.back().points, columns.back().values})
        text += fmt::format("{} = [0, 1, 2, 3]\n", spellings(name.stem, name.unit, axis).front().key);
    for_each_choice<Effect>([&](const auto& one) { text += fmt::format("{} = \"{}\"\n", one.key, one.words.back()); });
  });
  return text;
}

}  // namespace

TEST_CASE("check, run and fmu accept the same random effects on a linear axis", "[slow]") {
  std::mt19937 random(7);
  const Folder folder;
  int accepted = 0, refused = 0;
  for (int k = 0; k < 100; ++k) {
    const bool linear = k % 3 != 0;
    const std::string text = (linear ? sledge : wheel) + random_effects(linear ? Axis::linear : Axis::rotary, random);
    folder.write("s.toml", text);
    const Outcome check = folder.run({"check", "s.toml", "-q"}), run = folder.run({"run", "s.toml", "-q"});
    INFO(text << check.err << run.err);
    CHECK(check.exit == run.exit);
    CHECK(check.err == run.err);
    CHECK((check.exit == 0 || check.exit == 2));
    if (check.exit == 2) CHECK(folder.run({"steady", "s.toml", "-q"}).err == check.err);
    (check.exit == 0 ? accepted : refused) += 1;
  }
  CHECK(accepted >= 10);
  CHECK(refused >= 10);
}

TEST_CASE("without teeth inertias of either side count against the whole moving inertia") {
  const Folder folder;
  const auto with = [](const std::string& on_worm, const std::string& on_gear) {
    return sledge + "[effect.worm_inertia]\nmass_kg = " + on_worm + "\n[effect.gear_inertia]\nmass_kg = " + on_gear +
           "\n";
  };
  for (const auto& [worm, gear] : {std::pair{"-0.5", "0"}, {"-3", "1.5"}, {"1", "-2.5"}, {"-1", "-0.5"}}) {
    folder.write("s.toml", with(worm, gear));
    const Outcome run = folder.run({"run", "s.toml", "-q"});
    INFO(worm << " " << gear << "\n" << run.err);
    REQUIRE(run.exit == 0);
    const double mass = 2.0 + std::stod(worm) + std::stod(gear);
    const Hdf5Handle file = open_hdf5(folder / "s.h5");
    CHECK(std::abs(read_column(file, "trajectory/gear_acceleration").back() - 3.5 / mass) <= 1e-12);
  }
  std::filesystem::remove(folder / "s.h5");
  check_rejected(folder, {
                             {"all of it", with("-2", "0"),
                              "s.toml:11:1: error: effect.worm_inertia leaves no mass that moves: 2 + -2 kg"},
                             {"more than all", with("1", "-3"),
                              "s.toml:13:1: error: effect.gear_inertia leaves no mass that moves: 3 + -3 kg"},
                             {"both", with("-1.5", "-1"),
                              "s.toml:11:1: error: effect.worm_inertia leaves no mass that moves: 1 + -1.5 kg\n"
                              "s.toml:13:1: error: effect.gear_inertia leaves no mass that moves: 0.5 + -1 kg"},
                             {"a wheel", wheel + "[effect.worm_inertia]\ninertia_kgm2 = -2.5\n",
                              "s.toml:10:1: error: effect.worm_inertia leaves no inertia that moves: 2 + -2.5 kg m^2"},
                         });
}

TEST_CASE("the inertia of the load counts on the gear side") {
  const Folder folder;
  const std::string arm = edited(good_scenario, "kind = \"constant\"\ntorque_Nm = 0.02",
                                 "kind = \"gravity_arm\"\nmass_kg = 0.5\narm_m = 0.1");
  folder.write("s.toml", arm + "[effect.gear_inertia]\ninertia_kgm2 = -2e-3\n");
  for (const char* const command : {"check", "run", "steady", "statics"})
    CHECK(folder.run({command, "s.toml", "-q"}).exit == 0);
  std::filesystem::remove(folder / "s.h5");
  check_rejected(folder,
                 {{"more than load and gear", arm + "[effect.gear_inertia]\ninertia_kgm2 = -6e-3\n",
                   "s.toml:20:1: error: effect.gear_inertia leaves no inertia on the gear side: 0.005739 + -0.006 kg "
                   "m^2"}});
}

TEST_CASE("every command that reads a scenario rejects an impossible effect") {
  const Folder folder;
  folder.write("s.toml", good_scenario + "[effect.backlash]\ngap_deg = 0.1\n");
  folder.write("b.csv", "load_torque_Nm,motor_torque_Nm\n0.2,0.01\n");
  const Outcome run = folder.run({"run", "s.toml"});
  CHECK(run.exit == 2);
  CHECK(run.err.starts_with("s.toml:19:1: error: effect.backlash needs elastic teeth; "));
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"check", "s.toml"},
                                             {"statics", "s.toml"},
                                             {"steady", "s.toml"},
                                             {"fmu", "s.toml"},
                                             {"diagnose", "s.toml", "b.csv", "-o", "out"}}) {
    const Outcome other = folder.run(words);
    INFO(words.front());
    CHECK(other.exit == 2);
    CHECK(other.err == run.err);
  }
}

TEST_CASE("bearings whose viscous friction drives in one direction are taken, with a warning") {
  const Folder folder;
  folder.write("s.toml", good_scenario + "[effect.bearing_asymmetry]\ntorque_Nm = 0\ncoefficient_Nms_per_rad = 1e-5\n");
  const Outcome run = folder.run({"run", "s.toml", "-o", "o.h5"});
  INFO(run.err);
  CHECK(run.exit == 0);
  const std::string warning = "effect.bearing_asymmetry has a coefficient greater than that of worm_viscous: ";
  CHECK(run.out.find(warning) != std::string::npos);
  const Outcome check = folder.run({"check", "s.toml", "--set", "effect.worm_viscous.coefficient_Nms_per_rad=1e-5"});
  CHECK(check.exit == 0);
  CHECK(check.out.find(warning) == std::string::npos);
}

}  // namespace wormdrive::test::cli_accepted_effects
