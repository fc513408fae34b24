#include "fuzz/loop_calls.hpp"

#include <algorithm>
#include <fstream>
#include <string>

#include "bindings/fmi/fmi3.h"
#include "bindings/fmi/json/plant_json.hpp"
#include "fuzz/byte_source.hpp"
#include "simulation/load_scenario.hpp"

namespace wormdrive::fuzz {
namespace {

std::string folder_of_loop, token;

/// Longer steps are as good as these and take as much longer [s].
constexpr double longest_step = 0.02;

void ask_for_the_end(fmi3InstanceEnvironment, fmi3Float64, fmi3Boolean, fmi3Boolean, fmi3Boolean, fmi3Boolean,
                     fmi3Boolean* early, fmi3Float64* until) {
  *early = true;
  *until = 0.0;
}

void serialize(fmi3Instance loop, fmi3FMUState kept, ByteSource& source) {
  size_t size = 0;
  if (fmi3SerializedFMUStateSize(loop, kept, &size) != fmi3OK) return;
  std::vector<fmi3Byte> bytes(size);
  if (fmi3SerializeFMUState(loop, kept, bytes.data(), size) != fmi3OK) return;
  if (const std::uint8_t damage = source.byte(); damage > 0) bytes[damage % size] ^= damage;
  fmi3FMUState again = nullptr;
  if (fmi3DeserializeFMUState(loop, bytes.data(), size, &again) != fmi3OK) return;
  fmi3SetFMUState(loop, again);
  fmi3FreeFMUState(loop, &again);
}

void call(fmi3Instance loop, ByteSource& source, fmi3FMUState& kept, double& now) {
  fmi3Float64 values[8] = {};
  fmi3Int32 whole[8] = {};
  fmi3ValueReference references[8] = {};
  fmi3Clock clocks[8] = {};
  fmi3IntervalQualifier qualifiers[8] = {};
  bool a = false, b = false, c = false, d = false, e = false;
  double next = 0.0;
  const std::uint8_t what = source.byte();
  const std::size_t count = source.byte() % 8;
  for (std::size_t k = 0; k < count; ++k) references[k] = source.byte();
  switch (what % 20) {
    case 0: fmi3EnterInitializationMode(loop, false, 0.0, now = source.number(), false, 0.0); break;
    case 1: fmi3ExitInitializationMode(loop); break;
    case 2: fmi3GetFloat64(loop, references, count, values, count); break;
    case 3:
      for (double& value : values) value = source.number();
      fmi3SetFloat64(loop, references, count, values, count);
      break;
    case 4: fmi3GetInt32(loop, references, count, whole, count); break;
    case 5: fmi3EnterEventMode(loop); break;
    case 6: fmi3UpdateDiscreteStates(loop, &a, &b, &c, &d, &e, &next); break;
    case 7: fmi3EnterStepMode(loop); break;
    case 8:
    case 9:
    case 10: fmi3DoStep(loop, now, std::min(source.number(), longest_step), true, &a, &b, &c, &now); break;
    case 11:
      for (bool& clock : clocks) clock = source.byte() % 4 != 0;
      fmi3SetClock(loop, references, count, clocks);
      break;
    case 12: fmi3GetClock(loop, references, count, clocks); break;
    case 13: fmi3GetIntervalDecimal(loop, references, count, values, qualifiers); break;
    case 14: fmi3GetShiftDecimal(loop, references, count, values); break;
    case 15: fmi3GetFMUState(loop, &kept); break;
    case 16:
      if (kept) fmi3SetFMUState(loop, kept);
      break;
    case 17:
      if (kept) serialize(loop, kept, source);
      break;
    case 18:
      for (int& order : whole) order = source.byte() % 3;
      fmi3GetOutputDerivatives(loop, references, count, whole, values, count);
      break;
    case 19: fmi3Reset(loop); break;
  }
}

}  // namespace

std::vector<std::vector<std::uint8_t>> loop_seeds(const std::filesystem::path& folder) {
  folder_of_loop = (folder / "loop/").string();
  std::filesystem::create_directories(folder_of_loop);
  const std::string loop = plant_to_json(
      carried(load_scenario(WORMDRIVE_SCENARIOS "/fig10_sliding_014rad_bare.toml", {}, Purpose::run), FmuKind::loop));
  std::ofstream(folder_of_loop + "plant.json", std::ios::binary) << loop;
  token = guid_of(loop);
  // set-up, initialisation, a tick of the clock, steps, an event: as an importer does
  return {{1,   0,  0, 128, 13, 1, 30, 1, 0, 11, 1, 30,  1,  2, 1, 15, 6, 0,   7,  0, 8,  0, 129, 8, 0,
           129, 15, 0, 5,   0,  6, 0,  7, 0, 8,  0, 129, 17, 0, 0, 8,  0, 129, 16, 0, 18, 1, 0,   1},
          {0, 0, 0, 129, 1, 0, 6, 0, 7, 0, 8, 0, 140, 19, 0}};
}

void take_loop_calls(const std::uint8_t* data, std::size_t size) {
  ByteSource source(data, std::min<std::size_t>(size, 500));
  const std::uint8_t kind = source.byte();
  const fmi3Instance loop = fmi3InstantiateCoSimulation("drive", token.c_str(), folder_of_loop.c_str(), false, false,
                                                        kind % 2 != 0, kind % 3 != 0, nullptr, 0, nullptr, nullptr,
                                                        kind % 5 == 0 ? ask_for_the_end : nullptr);
  if (!loop) std::abort();
  fmi3FMUState kept = nullptr;
  double now = 0.0;
  while (!source.empty()) call(loop, source, kept, now);
  if (kept) fmi3FreeFMUState(loop, &kept);
  fmi3FreeInstance(loop);
}

}  // namespace wormdrive::fuzz
