#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "catch.hpp"
#include "cli/program.hpp"
#include "description/keys.hpp"
#include "simulation/load_scenario.hpp"
#include "simulation/run_scenario.hpp"
#include "support.hpp"

// Off is absent: an effect that is not on leaves every bit of a run alone, and one of size zero changes nothing.

namespace wormdrive::test::scenarios_effects_off {

namespace {

/// Calls visit.template operator()<Effect>() for every effect of the catalogue.
template <class Visit>
void for_each_effect(Visit&& visit) {
  Effects<double>{}.for_each([&]<class Effect>(const std::optional<Effect>&) { visit.template operator()<Effect>(); });
}

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

void require_same(const Trajectory& a, const Trajectory& b) {
  REQUIRE(a.rows.size() == b.rows.size());
  REQUIRE(a.events.size() == b.events.size());
  for (std::size_t k = 0; k < a.rows.size(); ++k) {
    const Observation &x = a.rows[k].at, &y = b.rows[k].at;
    REQUIRE(same_bits(a.rows[k].t, b.rows[k].t));
    REQUIRE((same_bits(x.theta_g, y.theta_g) && same_bits(x.omega_g, y.omega_g) && same_bits(x.alpha_g, y.alpha_g)));
    REQUIRE((same_bits(x.tau_m, y.tau_m) && same_bits(x.tau_l, y.tau_l) && same_bits(x.normal_force, y.normal_force)));
    REQUIRE(x.mode == y.mode);
  }
}

/// An effect that is on and without effect; its other numbers are 1.
template <class Effect>
Effect of_size_zero() {
  Effect effect;
  for_each_field<Effect>([&](const auto& field) { effect.*field.member = field.bounds.contain(0.0) ? 0.0 : 1.0; });
  if constexpr (requires { effect.rod; }) effect.rod = 2.0;  // it is longer than the crank
  return effect;
}

}  // namespace

TEST_CASE("a run with any effect stated but off is the run without it to the last bit, by both solvers") {
  for (const std::string solver : {"cvode", "taylor"}) {
    const std::vector<std::string> by{fmt::format("run.solver={}", solver)};
    const Trajectory without = simulate_scenario(load_scenario(shipped("fig09_switching.toml"), by, Purpose::run));
    REQUIRE(without.events.size() == 12);
    for_each_effect([&]<class Effect>() {
      INFO(Effect::id << " by " << solver);
      std::vector<std::string> words = by;
      words.push_back(fmt::format("effect.{}.on=false", Effect::id));
      for_each_field<Effect>([&](const auto& field) {
        words.push_back(fmt::format("effect.{}.{}={}", Effect::id,
                                    spellings(field.name, field.unit, Axis::rotary).front().key,
                                    field.bounds.contain(1.0) ? 1.0 : 0.5));
      });
      if (const auto columns = possible_columns<Effect>(); !columns.empty())
        for (const ColumnName& name : {columns.front().points, columns.front().values})
          words.push_back(fmt::format("effect.{}.{}=[0,1,2,3]", Effect::id,
                                      spellings(name.stem, name.unit, Axis::rotary).front().key));
      require_same(without, simulate_scenario(load_scenario(shipped("fig09_switching.toml"), words, Purpose::run)));
    });
  }
}

TEST_CASE("an effect of size zero is on and changes no bit of a run by cvode, and rounding by taylor") {
  const auto by = [](By solver, const Effects<double>& on) {
    return run(drive(table1(), fig9_load(), fig9_motor(), on), Timetable(0, 1, 0.1), {}, tight(solver));
  };
  for_each_effect([&]<class Effect>() {
    if (std::is_same_v<Effect, TorqueSaturation<double>> || std::is_same_v<Effect, ActuatorLag<double>> ||
        std::is_same_v<Effect, Agma<double>> || std::is_same_v<Effect, DcMotor<double>> ||
        std::is_same_v<Effect, WormLuGre<double>> || std::is_same_v<Effect, LoadCoupling<double>> ||
        std::is_same_v<Effect, LoadFourBar<double>>)
      return;  // have no size zero
    INFO(Effect::id);
    const Effects<double> on = effects(of_size_zero<Effect>());
    const auto bare = by(bdf, {}), idle = by(bdf, on);
    REQUIRE(bare.rows.size() == idle.rows.size());
    for (std::size_t k = 0; k < bare.rows.size(); ++k) {
      REQUIRE(same_bits(bare.rows[k].now.x[0], idle.rows[k].now.x[0]));
      REQUIRE(same_bits(bare.rows[k].now.x[1], idle.rows[k].now.x[1]));
      REQUIRE(same_bits(bare.rows[k].seen.normal_force, idle.rows[k].seen.normal_force));
    }
    const auto fast = by(taylor, {}), slow = by(taylor, on);
    REQUIRE(fast.modes() == slow.modes());
    REQUIRE((fast.end.x - slow.end.x).cwiseAbs().maxCoeff() <= 1e-12);
  });
}

}  // namespace wormdrive::test::scenarios_effects_off
