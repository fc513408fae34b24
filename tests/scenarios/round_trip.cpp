#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "catch.hpp"
#include "cli/program.hpp"
#include "core/rigid_drive.hpp"
#include "description/diagnostics.hpp"
#include "description/toml/write_scenario.hpp"
#include "simulation/load_scenario.hpp"

// The resolved scenario that every result carries: text and struct are the same after reading and writing.

namespace wormdrive::test::scenarios_round_trip {

namespace {

/// Every bit of a scenario as text, one value a line.
class Bits {
 public:
  explicit Bits(const Scenario& s) {
    text_ = s.title + "\n" + std::to_string(s.mesh.index()) + std::to_string(static_cast<int>(s.axis)) +
            std::to_string(static_cast<int>(s.run.solver)) + std::to_string(static_cast<int>(s.run.method)) + "\n";
    std::visit([&](const auto& mesh) { fields(mesh); }, s.mesh);
    signal(s.motor);
    std::visit([&](const auto& load) { this->load(load); }, s.load);
    s.effects.for_each([&](const auto& effect) {
      text_ += effect ? "on\n" : "off\n";
      if (effect) fields(*effect);
    });
    fields(s.initial);
    fields(s.run);
    text_ += s.tolerance ? "tolerance\n" : "";
    if (s.tolerance) fields(*s.tolerance);
    for (const auto& [usual, called] : s.columns) text_ += usual + " is " + called + "\n";
  }
  const std::string& text() const { return text_; }

 private:
  void value(double x) { text_ += fmt::format("{:016x} {}\n", std::bit_cast<std::uint64_t>(x), x); }
  void value(const std::optional<double>& x) {
    text_ += x ? "" : "nothing\n";
    if (x) value(*x);
  }
  void values(const std::vector<double>& list) {
    text_ += std::to_string(list.size()) + "\n";
    for (const double x : list) value(x);
  }
  template <class Parameters>
  void fields(const Parameters& parameters) {
    if constexpr (requires { Parameters::fields(); })
      for_each_field<Parameters>([&](const auto& field) { value(parameters.*field.member); });
    for_each_choice<Parameters>([&](const auto& one) { text_ += std::string(one.word(parameters)) + "\n"; });
    if constexpr (requires { parameters.table; }) {
      values(parameters.table.points());
      values(parameters.table.values());
    }
  }
  void signal(const Signal& signal) { terms(signal); }
  template <class Sum>
  void terms(const Sum& sum) {
    for (const auto& term : sum.terms)
      std::visit(
          [&](const auto& t) {
            text_ += std::string(t.kind) + "\n";
            if constexpr (requires { t.times; }) {
              values(t.times);
              values(t.values);
              text_ += t.interpolation == Interpolation::linear ? "linear\n" : "hold\n";
            } else {
              fields(t);
            }
          },
          term);
  }
  void load(const Signal& s) { signal(s); }
  void load(const LoadSum& sum) { terms(sum); }
  void load(const GravityArm& arm) { fields(arm); }
  void load(const AngleTable& table) { fields(table); }
  std::string text_;
};

/// Fills parameters with numbers of many digits and sizes, each within its bounds.
class Filler {
 public:
  template <class Parameters>
  Parameters make() {
    Parameters parameters;
    for_each_field<Parameters>([&](const auto& field) {
      parameters.*field.member = continuous(field) ? next(field.bounds) : field.bounds.high;
    });
    for_each_choice<Parameters>([&](const auto& one) { one.set(parameters, one.words.back()); });
    if constexpr (requires { parameters.table; })
      parameters.table = CubicTable({-0.1, 0.0, 0.1, 33.3 * unit::degree}, {1.0 / 3.0, 0.0, -0.2, 5e-324});
    return parameters;
  }

 private:
  double next(const Bounds& bounds) {
    constexpr double awkward[] = {1.0 / 3.0,     -0.1,   33.3 * unit::degree, 2.53e-5, 1e-300,
                                  123456789.125, 5e-324, -7.0 / 9.0,          4.0,     0.7,
                                  1e22,          6.02e-9};
    for (std::size_t tries = 0; tries < std::size(awkward); ++tries) {
      const double x = awkward[taken_++ % std::size(awkward)];
      if (bounds.contain(x)) return x;
    }
    throw std::logic_error("no number within these bounds");
  }
  std::size_t taken_ = 0;
};

const Samples samples{{-1.0 / 3.0, 0.1, 0.3, 1e3}, {1e-9, -0.0, 0.1, 2.0 / 3.0}, Interpolation::linear};

/// A scenario with every torque, every effect, and a number in every field.
Scenario full(Filler& filler, const LoadParameters& load) {
  Scenario s;
  s.title = "Everything: \"quotes\", 'primes', \\ backslash, \t tab, \n line break, \xC3\xBC, [table], # no comment";
  s.mesh = filler.make<MeshParameters<double>>();
  s.motor.terms = {filler.make<Constant>(), filler.make<Sinusoid>(),  filler.make<Ramp>(),
                   filler.make<Step>(),     filler.make<Staircase>(), samples};
  s.load = load;
  s.effects.for_each(
      [&](auto& effect) { effect = filler.make<typename std::decay_t<decltype(effect)>::value_type>(); });
  s.initial = filler.make<InitialState<double>>();
  s.run = filler.make<RunSettings>();
  s.run.report_interval = s.run.duration / 7.0;
  s.run.solver = SolverKind::taylor;
  s.run.method = Method::adams;
  s.tolerance = filler.make<Tolerances>();
  s.limits = filler.make<ExperimentLimits>();
  std::tie(s.limits->low, s.limits->high) = std::minmax({*s.limits->low, *s.limits->high});
  s.columns = {{"motor_torque_Nm", "u \"raw\", N m"}, {"gear_angle_rad", "q"}};
  return s;
}

void require_round_trip(const Scenario& scenario) {
  const std::string text = to_toml(scenario);
  INFO(text);
  const Scenario read = parse_scenario(text, "text", {}, Purpose::show);  // all effects at once cannot be
  REQUIRE(Bits(read).text() == Bits(scenario).text());
  REQUIRE(to_toml(read) == text);
}

}  // namespace

TEST_CASE("every shipped scenario is the same after it was written and read") {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(WORMDRIVE_SCENARIOS)) {
    if (entry.path().extension() != ".toml") continue;
    ++files;
    INFO(entry.path());
    require_round_trip(load_scenario(entry.path().string(), {}, Purpose::look));
  }
  REQUIRE(files >= 11);
}

TEST_CASE("a scenario with every torque, load, effect and axis is the same after it was written and read") {
  Filler filler;
  GravityArm by_torque, by_mass;
  by_torque.amplitude = 1.0 / 3.0;
  by_torque.offset = 33.3 * unit::degree;
  by_torque.own_inertia = 0.1;
  by_mass.mass = 1.0 / 3.0;
  by_mass.arm = -0.07;
  Signal timed{{filler.make<Staircase>(), samples, filler.make<Sinusoid>()}};
  const AngleTable table{{-0.1, 0.0, 0.1, 33.3 * unit::degree}, {1.0 / 3.0, 0.0, -0.2, 5e-324}};
  const auto turns = [](const LoadParameters& load) {
    const auto* const sum = std::get_if<LoadSum>(&load);
    return std::holds_alternative<GravityArm>(load) ||
           (sum && std::any_of(sum->terms.begin(), sum->terms.end(),
                               [](const LoadTerm& term) { return std::holds_alternative<GravityArm>(term); }));
  };
  const LoadSum turning{{by_mass, filler.make<Fan>(), table, samples, by_torque}};
  const LoadSum sum{{table, filler.make<Fan>(), filler.make<Sinusoid>(), samples}};
  for (const LoadParameters& load :
       {LoadParameters(by_torque), LoadParameters(by_mass), LoadParameters(timed), LoadParameters(LoadSum{{table}}),
        LoadParameters(Signal{}), LoadParameters(turning), LoadParameters(sum),
        LoadParameters(LoadSum{{sum.terms[1]}})}) {
    Scenario s = full(filler, load);
    require_round_trip(s);
    s.mesh = filler.make<SingleInertia<double>>();
    require_round_trip(s);
    if (turns(load)) continue;  // it turns: no linear axis has one
    s.axis = Axis::linear;
    s.columns = {{"motor_force_N", "u \"raw\", N"}, {"position_m", "q"}};
    require_round_trip(s);
  }
}

TEST_CASE("an angle is written in degrees only if it comes back with the same bits") {
  Scenario s = load_scenario(shipped("fig09_switching.toml"), {}, Purpose::look);
  auto& mesh = std::get<MeshParameters<double>>(s.mesh);
  int in_degrees = 0, in_radians = 0;
  for (int k = 7; k < 7800; k += 7) {
    mesh.lambda = 1e-4 * k;
    const std::string text = to_toml(s);
    text.find("lead_angle_deg = ") != std::string::npos ? ++in_degrees : ++in_radians;
    require_round_trip(s);
  }
  REQUIRE((in_degrees > 500 && in_radians > 50));  // both ways are taken
}

TEST_CASE(
    "an angle stated in degrees is written as it was stated, though it does not survive the way to radians and back") {
  Scenario s = load_scenario(shipped("fig09_switching.toml"), {}, Purpose::look);
  auto& mesh = std::get<MeshParameters<double>>(s.mesh);
  int changed = 0;
  for (int k = 1; k < 450; ++k) {
    mesh.lambda = k / 10.0 * unit::degree;
    if (mesh.lambda / unit::degree != k / 10.0) ++changed;
    REQUIRE(to_toml(s).find(fmt::format("lead_angle_deg = {:.1f}\n", k / 10.0)) != std::string::npos);
    require_round_trip(s);
  }
  REQUIRE(changed > 10);  // 7.3, 15, 30 ...
}

TEST_CASE("a result is simulated again to the last bit, also when the CSV file of its torque is gone") {
  const Folder folder;
  std::filesystem::create_directory(folder / "data");
  std::string csv = "time_s,motor_torque_Nm\n";
  for (int k = 0; k < 40; ++k) csv += std::to_string(0.05 * k) + "," + std::to_string(0.06 * std::sin(0.37 * k)) + "\n";
  folder.write("data/torque.csv", csv);
  std::string text = good_but("kind = \"constant\"\ntorque_Nm = -0.05",
                              "kind = \"samples\"\nfile = \"torque.csv\"\ninterpolation = \"linear\"");
  text = edited(text, "kind = \"constant\"\ntorque_Nm = 0.02",
                "kind = \"gravity_arm\"\ntorque_Nm = 0.0196\nangle_offset_deg = 33.3");
  folder.write("data/s.toml", edited(text, "duration_s = 0.01", "duration_s = 2"));

  const Outcome first =
      folder.run({"run", "data/s.toml", "-q", "-o", "first.h5", "--set", "mesh.pressure_angle_deg=30.1"});
  INFO(first.err);
  REQUIRE(first.exit == 0);
  std::filesystem::remove_all(folder / "data");
  REQUIRE(folder.run({"run", "first.h5", "-q", "-o", "again.h5"}).exit == 0);
  REQUIRE(folder.run({"run", "again.h5", "-q"}).exit == 0);  // named after what it was read from
  REQUIRE(folder.names() == std::set<std::string>{"again.h5", "again_again.h5", "first.h5"});

  const Hdf5Handle one = open_hdf5(folder / "first.h5");
  REQUIRE(read_column(one, "events/time").size() >= 4);
  for (const std::string name : {"again.h5", "again_again.h5"}) {
    const Hdf5Handle two = open_hdf5(folder / name);
    REQUIRE(read_text_attribute(one, "scenario") == read_text_attribute(two, "scenario"));
    for (const std::string group : {"trajectory", "events"}) {
      REQUIRE(bytes(one, group).size() >= 9);
      REQUIRE(bytes(one, group) == bytes(two, group));
    }
  }
}

TEST_CASE("every shipped scenario is simulated again to the last bit from its result", "[slow]") {
  const Folder folder;
  for (const auto& entry : std::filesystem::directory_iterator(WORMDRIVE_SCENARIOS)) {
    if (entry.path().extension() != ".toml") continue;
    INFO(entry.path());
    REQUIRE(folder.run({"run", entry.path().string(), "-q", "-o", "first.h5"}).exit == 0);
    REQUIRE(folder.run({"run", "first.h5", "-q", "-o", "again.h5"}).exit == 0);
    const Hdf5Handle one = open_hdf5(folder / "first.h5"), two = open_hdf5(folder / "again.h5");
    for (const std::string group : {"trajectory", "events"}) REQUIRE(bytes(one, group) == bytes(two, group));
  }
}

TEST_CASE("an override replaces what a file states in another unit") {
  const std::string file = shipped("fig09_switching.toml");
  const auto lead_angle = [&](const std::vector<std::string>& overrides) {
    return std::get<MeshParameters<double>>(load_scenario(file, overrides, Purpose::look).mesh).lambda;
  };
  CHECK(lead_angle({"mesh.lead_angle_rad=0.1"}) == 0.1);
  CHECK(lead_angle({"mesh.lead_angle_deg=5"}) == 5.0 * unit::degree);
  CHECK_THROWS_AS(lead_angle({"mesh.lead_angle_rad=0.1", "mesh.lead_angle_deg=5"}), InputFault);
}

}  // namespace wormdrive::test::scenarios_round_trip
