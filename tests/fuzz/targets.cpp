#include "fuzz/targets.hpp"

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <unistd.h>

#include "description/toml/parse_scenario.hpp"
#include "description/toml/write_scenario.hpp"
#include "diagnosis/data/read_recording.hpp"
#include "events/simulation_failure.hpp"
#include "fuzz/damaged_result.hpp"
#include "fuzz/loop_calls.hpp"
#include "fuzz/plant_calls.hpp"
#include "scenario_texts.hpp"
#include "sweep/study/load_study.hpp"

namespace wormdrive::fuzz {
namespace {

namespace fs = std::filesystem;

using test::good_scenario;
const std::string scenarios = WORMDRIVE_SCENARIOS;

Bytes contents(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  const std::string all = text.str();
  return {all.begin(), all.end()};
}
Bytes bytes(const std::string& text) { return {text.begin(), text.end()}; }
std::string text_of(const std::uint8_t* data, std::size_t size) { return {reinterpret_cast<const char*>(data), size}; }

/// What is accepted is written so that it is read as the same.
void round_trip(const Scenario& scenario) {
  const std::string once = to_toml(scenario);
  std::string twice;
  try {
    twice = to_toml(parse_scenario(once, "s.toml", {}, Purpose::look));
  } catch (const InputFault& fault) {
    throw std::logic_error(std::string("what was written is refused: ") + fault.what());
  }
  if (once != twice) throw std::logic_error("what was written reads as something else:\n" + once + "\n" + twice);
}

std::vector<Bytes> files_in(const fs::path& folder, const std::string& extension) {
  std::vector<Bytes> all;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == extension) all.push_back(contents(entry.path()));
  return all;
}

void take_scenario(const std::uint8_t* data, std::size_t size) {
  refusable([&] { round_trip(parse_scenario(text_of(data, size), scenarios + "/s.toml", {}, Purpose::run)); });
}

void take_override(const std::uint8_t* data, std::size_t size) {
  refusable([&] { round_trip(parse_scenario(good_scenario, "s.toml", {text_of(data, size)}, Purpose::look)); });
}

void take_study(const std::uint8_t* data, std::size_t size) {
  refusable([&] { parse_study(text_of(data, size), good_scenario, "study.toml"); });
}

void take_recording(const std::uint8_t* data, std::size_t size) {
  static const Scenario scenario = parse_scenario(good_scenario, "s.toml", {}, Purpose::look);
  static const std::string path = (fs::temp_directory_path() / ("wormdrive_fuzz_" + std::to_string(getpid()))).string();
  std::ofstream(path, std::ios::binary) << text_of(data, size);
  refusable([&] { read_recording(path, scenario); });
  fs::remove(path);
}

std::vector<Bytes> recordings() {
  std::string even = "time_s,motor_torque_Nm,gear_angle_rad,worm_angle_rad\n";
  for (int k = 0; k < 450; ++k)
    even += std::to_string(0.01 * k) + "," + std::to_string(0.05 * (k % 40 - 20)) + "," + std::to_string(1e-3 * k) +
            "," + std::to_string(0.06 * k) + "\n";
  return {bytes(even), bytes("time_s,motor_torque_Nm,gear_angle_deg\n0,1,2\n0.1,nan,3\n"), bytes("a,b\n1,2\n")};
}

const std::vector<std::string> toml_words{"[[motor.torque]]",
                                          "[effect.stribeck]",
                                          "[controller]",
                                          "kind = \"samples\"",
                                          "kind = \"csv\"",
                                          "nan",
                                          "-inf",
                                          "1e308",
                                          "-1e-320",
                                          "0",
                                          "-0.0",
                                          "[",
                                          "]",
                                          "{",
                                          "}",
                                          "\"\"\"",
                                          "'''",
                                          "\n",
                                          "=",
                                          ".",
                                          "true",
                                          "1979-05-27",
                                          "0x7fffffffffffffff",
                                          "[reference]",
                                          "[sensor]",
                                          "counts = 240000",
                                          "[tolerance]",
                                          "[data]",
                                          "distribution = \"grid\"",
                                          "levels = 3",
                                          "[[correlation]]",
                                          "design = \"saltelli\"",
                                          "design = \"shapley\"\npermutations = 9",
                                          "trials = 1000000000000",
                                          "metrics",
                                          "above_rad",
                                          "file = \"example_bench.csv\""};
const std::vector<std::string> csv_words{
    "time_s", "motor_torque_Nm", "gear_angle_rad", "nan", "inf", ",", "\n", "\"", "1e400", "-", "\r\n",
    "0x10",   "\xEF\xBB\xBF"};

}  // namespace

const std::vector<Target>& targets() {
  static const std::vector<Target> all{
      {"scenario", [](const fs::path&) { return files_in(scenarios, ".toml"); }, take_scenario, toml_words},
      {"study", [](const fs::path&) { return files_in(scenarios + "/studies", ".toml"); }, take_study, toml_words},
      {"recording", [](const fs::path&) { return recordings(); }, take_recording, csv_words},
      {"override",
       [](const fs::path&) {
         return std::vector<Bytes>{bytes("mesh.friction=0.1"), bytes("load={kind=\"gravity_arm\",mass_kg=1,arm_m=0.1}"),
                                   bytes("motor.torque[1].torque_Nm=3"), bytes("effect.stribeck.drop=0.1")};
       },
       take_override, toml_words},
      {"result_file", result_file_seeds, take_damaged_result, {}, 10},
      {"sweep_file", sweep_file_seeds, take_damaged_sweep, {}, 10},
      {"plant", plant_seeds, take_plant_calls, {}},
      {"loop", loop_seeds, take_loop_calls, {}}};
  return all;
}

}  // namespace wormdrive::fuzz
