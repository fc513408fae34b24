#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace wormdrive::fuzz {

// Bytes are calls of the functions of an FMU in any order, with any numbers.

std::vector<std::vector<std::uint8_t>> plant_seeds(const std::filesystem::path& folder);
void take_plant_calls(const std::uint8_t* data, std::size_t size);

}  // namespace wormdrive::fuzz
