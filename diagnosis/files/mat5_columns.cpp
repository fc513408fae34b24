#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <matio.h>

#include "diagnosis/files/stored_columns.hpp"

namespace wormdrive {
namespace {

using MatVariable = std::unique_ptr<matvar_t, decltype(&Mat_VarFree)>;
using MatHandle = std::unique_ptr<mat_t, decltype(&Mat_Close)>;

constexpr int deepest_struct = 8;  ///< structs in structs

/// A file of version 5 is a row of variables, each with its size before it. matio reads zeros beyond the end.
void require_whole(const std::string& path, std::uint64_t bytes) {
  constexpr std::uint64_t header = 128, tag = 8;
  std::ifstream file(path, std::ios::binary);
  std::array<char, 4> marks{};
  file.seekg(124).read(marks.data(), 4);
  const bool swapped = marks[2] == 'M' && marks[3] == 'I';  // written on a machine of the other order of bytes
  std::uint64_t at = header;
  for (int variable = 1; at < bytes; ++variable) {
    std::array<unsigned char, 8> words{};
    file.seekg(static_cast<std::streamoff>(at)).read(reinterpret_cast<char*>(words.data()), tag);
    if (swapped) std::reverse(words.begin() + 4, words.end());
    std::uint32_t size = 0;
    std::memcpy(&size, words.data() + 4, sizeof size);
    if (!file || size > bytes - at - tag)
      reject({path}, fmt::format("is damaged or ends early: its variable {} states {} bytes, {} are left", variable,
                                 size, bytes - std::min(bytes, at + tag)));
    at += tag + size;
  }
}

const char* kind_in_words(matio_classes kind) {
  switch (kind) {
    case MAT_C_CELL: return "is a cell array; a column holds numbers";
    case MAT_C_CHAR: return "is a text; a column holds numbers";
    case MAT_C_SPARSE: return "is sparse; a column holds a number in every row";
    case MAT_C_STRUCT: return "is an array of structs; a column holds numbers";
    case MAT_C_EMPTY: return "is empty";
    case MAT_C_OBJECT:
    case MAT_C_FUNCTION:
    case MAT_C_OPAQUE: return "is an object or a function; a column holds numbers";
    case MAT_C_DOUBLE:
    case MAT_C_SINGLE:
    case MAT_C_INT8:
    case MAT_C_UINT8:
    case MAT_C_INT16:
    case MAT_C_UINT16:
    case MAT_C_INT32:
    case MAT_C_UINT32:
    case MAT_C_INT64:
    case MAT_C_UINT64: return nullptr;
  }
  return "is of no class that MATLAB has";
}

/// How many values an array states that it has, and how it is shaped; nothing if that is more than there are numbers.
struct Shape {
  std::optional<std::uint64_t> values;
  std::string text;
  bool line = true;  ///< all dimensions but one are 1
};
Shape shape_of(const matvar_t& variable) {
  Shape shape{1, "", true};
  for (int k = 0; k < variable.rank; ++k) {
    const std::uint64_t size = variable.dims[k];
    shape.text += fmt::format("{}{}", k > 0 ? " x " : "", size);
    if (!shape.values) continue;
    shape.line = shape.line && (size == 1 || *shape.values == 1);
    if (size != 0 && *shape.values > std::numeric_limits<std::uint64_t>::max() / size)
      shape.values = std::nullopt;
    else
      *shape.values *= size;
  }
  return shape;
}

/// Why a variable is no column, as far as can be told before its values are read; empty if it can be one.
std::string defect_of(const matvar_t& variable, std::uint64_t file_bytes) {
  if (const char* const other = kind_in_words(variable.class_type)) return other;
  if (variable.isComplex) return "is complex; a column is real";
  const Shape shape = shape_of(variable);
  const std::size_t size = Mat_SizeOfClass(variable.class_type);
  if (shape.values == 0u || variable.rank == 0) return "is empty";
  if (!shape.values || *shape.values > deflated * file_bytes / size)
    return fmt::format("states {} values, which a file of {} bytes cannot hold", shape.text, file_bytes);
  if (!shape.line) return fmt::format("has {} values; a column has one dimension", shape.text);
  return "";
}

template <class Number>
std::vector<double> converted(const matvar_t& variable) {
  const auto* const first = static_cast<const Number*>(variable.data);
  return {first, first + variable.nbytes / sizeof(Number)};
}

std::vector<double> numbers_of(const matvar_t& variable) {
  switch (variable.class_type) {
    case MAT_C_DOUBLE: return converted<double>(variable);
    case MAT_C_SINGLE: return converted<float>(variable);
    case MAT_C_INT8: return converted<std::int8_t>(variable);
    case MAT_C_UINT8: return converted<std::uint8_t>(variable);
    case MAT_C_INT16: return converted<std::int16_t>(variable);
    case MAT_C_UINT16: return converted<std::uint16_t>(variable);
    case MAT_C_INT32: return converted<std::int32_t>(variable);
    case MAT_C_UINT32: return converted<std::uint32_t>(variable);
    case MAT_C_INT64: return converted<std::int64_t>(variable);
    case MAT_C_UINT64: return converted<std::uint64_t>(variable);
    case MAT_C_EMPTY:
    case MAT_C_CELL:
    case MAT_C_STRUCT:
    case MAT_C_OBJECT:
    case MAT_C_CHAR:
    case MAT_C_SPARSE:
    case MAT_C_FUNCTION:
    case MAT_C_OPAQUE: break;
  }
  return {};
}

/// A text, of a length that a unit, a comment or a scenario may have.
std::string text_of(const matvar_t& variable) {
  std::string text;
  if (!variable.data) return text;
  constexpr std::size_t longest = 1 << 20;
  const bool wide = variable.data_type == MAT_T_UINT16 || variable.data_type == MAT_T_UTF16;
  const auto* const bytes = static_cast<const unsigned char*>(variable.data);
  for (std::size_t k = 0; k + (wide ? 2 : 1) <= std::min(variable.nbytes, longest); k += wide ? 2 : 1) {
    std::uint16_t character = bytes[k];
    if (wide) std::memcpy(&character, bytes + k, 2);
    if (wide)
      append_character(text, character);
    else
      text += static_cast<char>(character);
  }
  return text;
}

bool is_one_struct(const matvar_t& variable) {
  return variable.class_type == MAT_C_STRUCT && shape_of(variable).values == 1u;
}

/// Whether a variable, or anything in it, states a size that the file cannot hold: matio would ask for that much
/// memory.
bool states_too_much(const matvar_t& variable, std::uint64_t file_bytes, int depth) {
  const Shape shape = shape_of(variable);
  if (!shape.values || *shape.values > deflated * file_bytes || depth > deepest_struct) return true;
  if (variable.class_type != MAT_C_STRUCT && variable.class_type != MAT_C_CELL) return false;
  const auto* const parts = static_cast<matvar_t* const*>(variable.data);
  for (std::size_t k = 0; parts && k < variable.nbytes / sizeof(matvar_t*); ++k)
    if (parts[k] && states_too_much(*parts[k], file_bytes, depth + 1)) return true;
  return false;
}

void collect(const matvar_t& variable, const std::string& name, std::uint64_t file_bytes, StoredContents& found) {
  if (is_one_struct(variable)) {
    const unsigned count = Mat_VarGetNumberOfFields(const_cast<matvar_t*>(&variable));
    char* const* const names = Mat_VarGetStructFieldnames(&variable);
    for (unsigned k = 0; names && k < count; ++k) {
      const matvar_t* const field = Mat_VarGetStructFieldByIndex(const_cast<matvar_t*>(&variable), k, 0);
      if (field && names[k]) collect(*field, fmt::format("{}.{}", name, names[k]), file_bytes, found);
    }
    return;
  }
  if (variable.class_type == MAT_C_CHAR) found.texts[name] = text_of(variable);
  StoredNumbers column{name, "", "", {}, defect_of(variable, file_bytes)};
  if (column.defect.empty()) {
    if (variable.data && variable.nbytes == *shape_of(variable).values * Mat_SizeOfClass(variable.class_type))
      column.values = numbers_of(variable);
    else
      column.defect = "cannot be read";
  }
  found.columns.push_back(std::move(column));
}

}  // namespace

StoredContents mat5_columns(const std::string& path) {
  const std::uint64_t bytes = std::filesystem::file_size(path);
  require_whole(path, bytes);
  const MatHandle file(Mat_Open(path.c_str(), MAT_ACC_RDONLY), Mat_Close);
  if (!file) reject({path}, "cannot be opened as a MAT-file");
  StoredContents found;
  for (;;) {
    const MatVariable variable(Mat_VarReadNextInfo(file.get()), Mat_VarFree);
    if (!variable) break;
    const std::string name = variable->name ? variable->name : "";
    if (states_too_much(*variable, bytes, 0)) {
      found.columns.push_back(
          {name, "", "", {}, fmt::format("states more values than a file of {} bytes can hold", bytes)});
      continue;
    }
    if (const std::string defect =
            is_one_struct(*variable) || variable->class_type == MAT_C_CHAR ? "" : defect_of(*variable, bytes);
        !defect.empty()) {
      found.columns.push_back({name, "", "", {}, defect});
      continue;
    }
    const bool read = Mat_VarReadDataAll(file.get(), variable.get()) == 0;
    collect(*variable, name, bytes, found);
    if (!read)
      for (StoredNumbers& column : found.columns)
        if (column.name == name || column.name.starts_with(name + "."))
          column = {column.name, "", "", {}, "cannot be read"};
  }
  return found;
}

}  // namespace wormdrive
