#include "tests/simulation/programs/stepped_gear.hpp"

#include <cstdlib>
#include <new>

#include <fmt/format.h>

#include "description/toml/parse_scenario.hpp"

long allocations = 0;

void* operator new(std::size_t bytes) {
  ++allocations;
  if (void* memory = std::malloc(bytes)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

std::vector<wormdrive::Scenario> gears(std::size_t count, const std::vector<std::string>& overrides) {
  std::vector<wormdrive::Scenario> all;
  for (std::size_t k = 0; k < count; ++k) {
    std::vector<std::string> own = overrides;
    own.push_back(fmt::format("mesh.friction={}", 0.2 + 0.05 * static_cast<double>(k) / static_cast<double>(count)));
    all.push_back(wormdrive::parse_scenario(gear, "gear", own, wormdrive::Purpose::run));
  }
  return all;
}
