#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace wormdrive::fuzz {

// Bytes are calls of the functions of FMI 3.0 of a loop with a controller in any order, with any numbers.

std::vector<std::vector<std::uint8_t>> loop_seeds(const std::filesystem::path& folder);
void take_loop_calls(const std::uint8_t* data, std::size_t size);

}  // namespace wormdrive::fuzz
