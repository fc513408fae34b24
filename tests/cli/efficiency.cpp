#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "cli/program.hpp"
#include "support.hpp"

namespace wormdrive::test::cli_efficiency {

TEST_CASE("efficiency prints, stores, reports and draws what it finds, and says what it cannot find") {
  const Folder folder;
  const std::string drive = shipped("measured_worm_drive.toml");
  const Outcome shown =
      folder.run({"efficiency", drive, "-o", "e.h5", "--set", "mesh.friction=0.02", "--max-load", "1.5"});
  INFO(shown.out << shown.err);
  REQUIRE(shown.exit == 0);
  CHECK(shown.out.find("  motor    drives the load with up to ") != std::string::npos);
  CHECK(shown.out.find("  load     returns up to ") != std::string::npos);
  CHECK(folder.run({"plot", "e.h5"}).exit == 0);
  CHECK(folder.run({"report", "e.h5"}).exit == 0);
  CHECK(folder.run({"efficiency", drive})
            .out.find("  load     returns nothing at any of these loads: the motor has to help it along\n") !=
        std::string::npos);

  const auto map = nlohmann::json::parse(
      folder.run({"efficiency", drive, "--json", "--points", "3", "--max-speed", "50", "--max-load", "0.5"}).out);
  CHECK(map.at("worm_speed_rad_per_s") == nlohmann::json({-50.0, -30.0, -10.0, 10.0, 30.0, 50.0}));
  CHECK(map.at("load_torque_Nm").size() == 6);
  CHECK(map.at("efficiency").size() == 6);
  CHECK(map.at("efficiency").at(5).at(5) == 0.0);

  CHECK(folder.run({"efficiency", shipped("measured_servo_axis.toml")}).err ==
        shipped("measured_servo_axis.toml") + ": error: efficiency needs teeth, but mesh.kind is \"none\"\n");
  CHECK(folder.run({"efficiency", drive, "--points", "1"}).exit == 2);
}

}  // namespace wormdrive::test::cli_efficiency
