#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace wormdrive::fuzz {

// Bytes are orders how to damage a good result through HDF5 itself, one after the other: which object, what to do to
// it, with which number. So what is tried are files that HDF5 reads, and that no program of ours has written.

std::vector<std::vector<std::uint8_t>> result_file_seeds(const std::filesystem::path& folder);
void take_damaged_result(const std::uint8_t* data, std::size_t size);

std::vector<std::vector<std::uint8_t>> sweep_file_seeds(const std::filesystem::path& folder);
void take_damaged_sweep(const std::uint8_t* data, std::size_t size);

}  // namespace wormdrive::fuzz
