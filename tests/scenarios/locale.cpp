#include <cstdlib>
#include <locale>

#include "catch.hpp"
#include "cli/program.hpp"
#include "description/number_text.hpp"
#include "description/toml/write_scenario.hpp"
#include "simulation/load_scenario.hpp"

// A program that the module or the libraries are loaded into may have a locale with a decimal comma; numbers do not.

namespace wormdrive::test::scenarios_locale {

namespace {

/// tests/decimal_comma.py makes a locale, and all tests of the program are in it from their start.
[[maybe_unused]] const std::locale before =
    std::getenv("LOCPATH") ? std::locale::global(std::locale("")) : std::locale();

}  // namespace

TEST_CASE("a number is read with a decimal point in every locale, and with nothing beside it") {
  CHECK(number_in("1.5") == 1.5);
  CHECK(number_in("+1.5e3") == 1500.0);
  CHECK(number_in("-0.25") == -0.25);
  for (const char* const text : {"1,5", "1.5 ", "", "+", "+-1", "nan", "inf", "1e999", "0x10", "1.5 N m"})
    CHECK_FALSE(number_in(text));
}

TEST_CASE("a scenario is written and read with decimal points in every locale") {
  const Scenario scenario =
      load_scenario(shipped("fig09_switching.toml"), {"mesh.lead_angle_deg=30", "run.duration_s=0.1"}, Purpose::run);
  const std::string text = to_toml(scenario);
  CHECK(text.find("lead_angle_deg = 30.0\n") != std::string::npos);
  CHECK(text.find("worm_inertia_kgm2 = 2.53e-05\n") != std::string::npos);
  CHECK(to_toml(parse_scenario(text, "again", {}, Purpose::run)) == text);
}

}  // namespace wormdrive::test::scenarios_locale
