#include "tests/simulation/programs/stepped_gear.hpp"

#include <cstdlib>
#include <new>

#include <fmt/format.h>

#include "description/toml/parse_scenario.hpp"
#include "tests/scenario_texts.hpp"

long wormdrive::test::allocations = 0;

void* operator new(std::size_t bytes) {
  ++wormdrive::test::allocations;
  if (void* memory = std::malloc(bytes)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace wormdrive::test {

std::vector<Scenario> gears(std::size_t count, const std::vector<std::string>& overrides) {
  const std::string gear =
      mesh_of_the_paper + "[load]\nkind = \"gravity_arm\"\ntorque_Nm = 0.0196\n[run]\nduration_s = 1\n";
  std::vector<Scenario> all;
  for (std::size_t k = 0; k < count; ++k) {
    std::vector<std::string> own = overrides;
    own.push_back(fmt::format("mesh.friction={}", 0.2 + 0.05 * static_cast<double>(k) / static_cast<double>(count)));
    all.push_back(parse_scenario(gear, "gear", own, Purpose::run));
  }
  return all;
}

}  // namespace wormdrive::test
