#include "fuzz/plant_calls.hpp"

#include <fstream>
#include <memory>
#include <string>

#include "bindings/fmi/fmi2.h"
#include "bindings/fmi/json/plant_json.hpp"
#include "fuzz/byte_source.hpp"
#include "simulation/load_scenario.hpp"

namespace wormdrive::fuzz {
namespace {

std::string folder_of_plant, guid;

void be_silent(fmi2ComponentEnvironment, fmi2String, fmi2Status, fmi2String, fmi2String, ...) {}
constexpr fmi2CallbackFunctions callbacks{be_silent, calloc, free, nullptr, nullptr};

void call(fmi2Component plant, ByteSource& source, fmi2FMUstate& kept) {
  fmi2Real values[8] = {};
  fmi2Integer whole[8] = {};
  fmi2ValueReference references[8] = {};
  fmi2Boolean a = 0, b = 0;
  fmi2EventInfo info{};
  const std::uint8_t what = source.byte();
  const std::size_t count = source.byte() % 8;
  for (std::size_t k = 0; k < count; ++k) references[k] = source.byte();
  switch (what % 19) {
    case 0: fmi2SetupExperiment(plant, 0, 0.0, source.number(), 0, source.number()); break;
    case 1: fmi2EnterInitializationMode(plant); break;
    case 2: fmi2ExitInitializationMode(plant); break;
    case 3: fmi2GetReal(plant, references, count, values); break;
    case 4:
      for (double& value : values) value = source.number();
      fmi2SetReal(plant, references, count, values);
      break;
    case 5: fmi2GetInteger(plant, references, count, whole); break;
    case 6: fmi2SetInteger(plant, references, count, whole); break;
    case 7: fmi2EnterEventMode(plant); break;
    case 8: fmi2NewDiscreteStates(plant, &info); break;
    case 9: fmi2EnterContinuousTimeMode(plant); break;
    case 10: fmi2CompletedIntegratorStep(plant, 1, &a, &b); break;
    case 11: fmi2SetTime(plant, source.number()); break;
    case 12:
      for (double& value : values) value = source.number();
      fmi2SetContinuousStates(plant, values, count);
      break;
    case 13: fmi2GetDerivatives(plant, values, count); break;
    case 14: fmi2GetEventIndicators(plant, values, count); break;
    case 15: fmi2GetContinuousStates(plant, values, count); break;
    case 16: fmi2GetFMUstate(plant, &kept); break;
    case 17:
      if (kept) fmi2SetFMUstate(plant, kept);
      break;
    case 18: fmi2Reset(plant); break;
  }
}

}  // namespace

std::vector<std::vector<std::uint8_t>> plant_seeds(const std::filesystem::path& folder) {
  folder_of_plant = folder.string();
  const std::string motor = "effect.dc_motor={resistance_ohm=1.2,torque_constant_Nm_per_A=0.025,inductance_H=1e-3}";
  const std::string plant = plant_to_json(
      carried(load_scenario(WORMDRIVE_SCENARIOS "/fig09_switching.toml", {motor}, Purpose::run), FmuKind::plant));
  std::ofstream(folder / "plant.json", std::ios::binary) << plant;
  guid = guid_of(plant);
  // set-up, initialisation, an event, the time that goes on: as an importer does
  return {{0,   0,   1, 1, 1, 0, 2, 0, 7,  0, 8, 0, 9, 0, 11, 0, 130, 12, 4, 0, 1,  2, 3,
           140, 150, 0, 0, 0, 0, 0, 0, 13, 4, 0, 0, 0, 0, 14, 4, 0,   0,  0, 0, 10, 0},
          {1, 0, 2, 0, 16, 0, 7, 0, 8, 0, 17, 0, 18, 0}};
}

void take_plant_calls(const std::uint8_t* data, std::size_t size) {
  const fmi2Component plant = fmi2Instantiate("drive", fmi2ModelExchange, guid.c_str(),
                                              ("file://" + folder_of_plant).c_str(), &callbacks, 0, 0);
  if (!plant) std::abort();
  fmi2FMUstate kept = nullptr;
  ByteSource source(data, std::min<std::size_t>(size, 2000));
  while (!source.empty()) call(plant, source, kept);
  if (kept) fmi2FreeFMUstate(plant, &kept);
  fmi2FreeInstance(plant);
}

}  // namespace wormdrive::fuzz
