#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "cli/program.hpp"
#include "core/unit.hpp"
#include "diagnosis/data/speed_torque_records.hpp"
#include "support.hpp"

// Records at constant speed: which samples are left out of their means, and how well the model meets the rest.

namespace wormdrive::test::cli_steady_records {

namespace {

const std::string header = "record,worm_speed_rad_per_s,motor_torque_Nm\n";

std::optional<std::string> measured() { return reference_path("worm_drive/steady_speed.csv"); }

/// A sample left out: record, line, torque.
using Left = std::tuple<std::string, std::size_t, double>;

std::set<Left> left_out(const std::string& path) {
  std::set<Left> all;
  for (const SpeedTorqueRecord& record : read_speed_torque_records(path))
    for (const ImplausibleSample& sample : record.left_out) all.emplace(record.name, sample.line, sample.torque);
  return all;
}

const std::set<Left> overwritten{{"n1", 11002, 0.03936}, {"1", 11502, 0.11808}, {"2", 12002, 0.07872}};

/// Reads one record made of these torques.
SpeedTorqueRecord record_of(const std::vector<double>& torques, const std::string& format = "{}") {
  const Folder folder;
  std::string text = header;
  for (const double torque : torques) text += "a,1," + fmt::format(fmt::runtime(format), torque) + "\n";
  folder.write("d.csv", text);
  return read_speed_torque_records(folder / "d.csv").at(0);
}

}  // namespace

TEST_CASE("only the three overwritten samples of the measured records are left out", "[reference]") {
  const auto path = measured();
  if (!path) return;
  REQUIRE(left_out(*path) == overwritten);
  const std::vector<SpeedTorqueRecord> records = read_speed_torque_records(*path);
  REQUIRE(records.size() == 46);
  for (const SpeedTorqueRecord& record : records) REQUIRE(record.samples + record.left_out.size() == 500);
}

TEST_CASE("the model of the measured drive meets its 46 mean torques within 0.09 mN m", "[reference]") {
  const auto path = measured();
  if (!path) return;
  const Folder folder;
  const std::vector<std::string> words{"steady", shipped("measured_worm_drive.toml"), "--data", *path};
  const Outcome outcome = folder.run(words);
  INFO(outcome.out << outcome.err);
  REQUIRE(outcome.exit == 0);
  for (const std::string line :
       {":11002: record n1: motor_torque_Nm = 0.03936 is ", ":11502: record 1: motor_torque_Nm = 0.11808 is ",
        ":12002: record 2: motor_torque_Nm = 0.07872 is ",
        " robust standard deviations from its record's median (limit 20)\n",
        "  compared rms error 0.0900 mN m over 46 mean torques of rms 1.5458 mN m\n"})
    CHECK(outcome.out.find(line) != std::string::npos);

  std::vector<std::string> as_json = words;
  as_json.push_back("--json");
  const nlohmann::json said = nlohmann::json::parse(folder.run(as_json).out);
  // again from the records themselves
  double error = 0.0, torque = 0.0;
  for (const auto& record : said.at("records")) {
    const double measured_torque = record.at("motor_torque_Nm"), model = record.at("motor_torque_model_Nm");
    error += (measured_torque - model) * (measured_torque - model);
    torque += measured_torque * measured_torque;
  }
  REQUIRE(said.at("records").size() == 46);
  CHECK(std::abs(said.at("rms_error_Nm").get<double>() - std::sqrt(error / 46)) <= 1e-12);
  CHECK(std::abs(said.at("rms_torque_Nm").get<double>() - std::sqrt(torque / 46)) <= 1e-12);
  CHECK(said.at("rms_error_Nm").get<double>() <= 0.091e-3);
}

TEST_CASE("the published Stribeck term makes the model of the measured drive worse: rms 0.1052 mN m", "[reference]") {
  const auto path = measured();
  if (!path) return;
  // mu = 0.12 + 0.06 exp(-2 |w_worm|/0.688): 0.18 at rest, and the speed is that of the teeth at w_worm = 0.344 rad/s
  const double speed = 0.344 * 0.005 / std::cos(2.8625 * unit::degree);
  const Folder folder;
  const Outcome outcome = folder.run({"steady", shipped("measured_worm_drive.toml"), "--data", *path, "--json", "--set",
                                      "mesh.friction=0.18", "--set", "effect.stribeck.drop=0.06", "--set",
                                      fmt::format("effect.stribeck.speed_m_per_s={}", speed)});
  INFO(outcome.out << outcome.err);
  REQUIRE(outcome.exit == 0);
  CHECK(std::abs(nlohmann::json::parse(outcome.out).at("rms_error_Nm").get<double>() - 0.1052e-3) <= 0.0005e-3);
}

TEST_CASE("overwritten samples are found anywhere in the measured records", "[reference]") {
  const auto path = measured();
  if (!path) return;
  std::vector<std::string> lines;
  std::ifstream file(*path);
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  const Folder folder;
  std::mt19937 random(7);
  // The torques lie within 2.3 mN m, and 20 deviations are at most 4.7 mN m.
  for (const double size : {0.008, -0.008, 0.02, -0.04, 0.1, -0.3, 1.0, -5.0}) {
    std::vector<std::string> changed = lines;
    std::set<Left> expected = overwritten;
    for (int k = 0; k < 12; ++k) {
      const std::size_t at = std::uniform_int_distribution<std::size_t>(1, lines.size() - 1)(random);
      const std::string name = lines[at].substr(0, lines[at].find(','));
      if (expected.size() != overwritten.size() + static_cast<std::size_t>(k)) break;
      changed[at] = lines[at].substr(0, lines[at].rfind(',') + 1) + fmt::format("{}", size);
      std::erase_if(expected, [&](const Left& left) { return std::get<1>(left) == at + 1; });
      expected.emplace(name, at + 1, size);
    }
    std::string text;
    for (const std::string& line : changed) text += line + "\n";
    folder.write("d.csv", text);
    INFO("overwritten with " << size);
    CHECK(expected.size() >= 14);
    CHECK(left_out(folder / "d.csv") == expected);
  }
}

TEST_CASE("a record of coarse steps, most of them equal, keeps every sample") {
  std::mt19937 random(3);
  for (const double step : {9.84e-6, 1e-3, 0.1}) {
    for (const double spread : {0.05, 0.2, 0.4, 0.7}) {  // of the noise, in steps: the smaller, the more are equal
      std::normal_distribution<double> noise(0.3, spread);
      std::vector<double> torques(500);
      for (double& torque : torques) torque = step * std::round(100.0 + noise(random));
      INFO(step << " " << spread);
      CHECK(record_of(torques).left_out.empty());
      CHECK(record_of(torques, "{:.6g}").left_out.empty());
    }
  }
}

TEST_CASE("rounding in the last digit is not a step") {
  std::vector<double> torques(300, 0.00100000);
  for (const double other : {0.00100001, 0.00101968, 0.00101969, 0.00098032, 0.00098031, 0.00103936})
    torques.insert(torques.end(), 3, other);
  CHECK(record_of(torques).left_out.empty());
}

TEST_CASE("records of one, two and equal samples keep them") {
  CHECK(record_of({0.1}).samples == 1);
  CHECK(record_of({0.1, 5.0}).samples == 2);
  CHECK(record_of(std::vector<double>(50, 0.25)).samples == 50);
  CHECK(record_of(std::vector<double>(50, 0.25)).motor_torque == 0.25);
}

TEST_CASE("an outlier is left out with its line and its distance, and does not change the means") {
  std::mt19937 random(5);
  std::normal_distribution<double> noise(1e-3, 1e-4);
  std::vector<double> torques(200);
  for (double& torque : torques) torque = noise(random);
  const double clean = record_of(torques).motor_torque;
  torques.insert(torques.begin() + 77, -0.05);
  const SpeedTorqueRecord record = record_of(torques);
  REQUIRE(record.left_out.size() == 1);
  CHECK(record.left_out[0].line == 79);  // the header is line 1
  CHECK(record.left_out[0].torque == -0.05);
  CHECK(std::abs(record.left_out[0].deviations - 510.0) <= 100.0);
  CHECK(std::abs(record.motor_torque - clean) <= 1e-15);
  CHECK(record.samples == 200);
}

TEST_CASE("records are listed in the order of the file even if their lines are mixed") {
  const Folder folder;
  folder.write("d.csv", header + "b,2,0.2\na,1,0.1\nb,4,0.4\n");
  const std::vector<SpeedTorqueRecord> records = read_speed_torque_records(folder / "d.csv");
  REQUIRE(records.size() == 2);
  CHECK(records[0].name == "b");
  CHECK(records[0].worm_speed == 3.0);
  CHECK(records[1].samples == 1);
}

TEST_CASE("data that are not records are rejected with file and line") {
  const Folder folder;
  for (const auto& [text, message] :
       {std::pair<std::string, std::string>{header, "d.csv: error: there are no samples below the header line\n"},
        {"a,b\n1,2\n", "d.csv:1: error: no column 'record'; the header line names a, b\n"},
        {header + "a,1,x\n", "d.csv:2: error: motor_torque_Nm = 'x' is not a finite number\n"}}) {
    folder.write("d.csv", text);
    const Outcome outcome =
        folder.run({"steady", shipped("measured_worm_drive.toml"), "--data", "d.csv", "-o", "s.h5"});
    CHECK(outcome.exit == 2);
    CHECK(outcome.err == message);
    CHECK(folder.names() == std::set<std::string>{"d.csv"});
  }
}

}  // namespace wormdrive::test::cli_steady_records
