#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "diagnosis/files/data_table.hpp"
#include "output/hdf5/hdf5.hpp"

namespace wormdrive {

/// What may be a column in a file that is no text, and the texts beside them by their names.
struct StoredContents {
  std::vector<StoredNumbers> columns;
  std::map<std::string, std::string> texts;
};

/// Bytes that deflate makes of one at most: what states more is no size of anything in a file.
inline constexpr std::uint64_t deflated = 1032;

/// An HDF5 file, its units and comments those of the attributes UNIT and COMMENT, or of units and long_name where it
/// has none of these. Throws InputFault.
StoredContents hdf5_columns(const std::string& path);

/// The same of a MAT-file of version 7.3, which is HDF5 as MATLAB writes it: structs are groups, named with dots.
StoredContents mat73_columns(const std::string& path);

/// The same of a MAT-file of version 5.
StoredContents mat5_columns(const std::string& path);

/// The columns with the units and comments that stand in structs `units` and `meanings` of the same shape as the data,
/// as `wormdrive export` writes them.
std::vector<StoredNumbers> with_stated_units(StoredContents contents);

/// The unit that an HDF5 object states in UNIT, or else in units; empty if in neither.
std::string stated_unit(hid_t object);

/// Adds a character of MATLAB's, 16 bits, to a text in UTF-8.
void append_character(std::string& text, std::uint16_t character);

}  // namespace wormdrive
