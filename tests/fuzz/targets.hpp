#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "description/diagnostics.hpp"
#include "output/hdf5/hdf5.hpp"

namespace wormdrive::fuzz {

using Bytes = std::vector<std::uint8_t>;

/// Something that takes bytes of whoever. It may refuse them; it must not crash, hang, or break its own promises, which
/// it tells by std::logic_error.
struct Target {
  std::string name;
  std::vector<Bytes> (*seeds)(const std::filesystem::path& folder);  ///< good inputs; folder: an empty one, for files
  void (*take)(const std::uint8_t* data, std::size_t size);
  std::vector<std::string> words;  ///< that inputs are made of
  long slower = 1;                 ///< how many times longer an input takes than a text
};

const std::vector<Target>& targets();

/// What bad input may answer with.
template <class Take>
void refusable(Take&& take) {
  try {
    take();
  } catch (const InputFault&) {
  } catch (const OutputFault&) {
  }
}

}  // namespace wormdrive::fuzz
