#include "output/hdf5/fixed_table.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace wormdrive {
namespace {

/// Contiguous, its room in the file taken at once: no index of chunks that could be torn.
Hdf5Handle fixed_layout(const std::string& action) {
  Hdf5Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, action);
  check_hdf5(H5Pset_layout(properties, H5D_CONTIGUOUS), action);
  check_hdf5(H5Pset_alloc_time(properties, H5D_ALLOC_TIME_EARLY), action);
  return properties;
}

Hdf5Handle text_type(const std::string& action) {
  Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose, action);
  H5Tset_size(type, FixedTexts::longest);
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return type;
}

/// Some rows of a dataset, for reading or writing.
Hdf5Handle rows_of(hid_t dataset, hsize_t first, hsize_t count, const std::string& action) {
  Hdf5Handle space(H5Dget_space(dataset), H5Sclose, action);
  check_hdf5(H5Sselect_hyperslab(space, H5S_SELECT_SET, &first, nullptr, &count, nullptr), action);
  return space;
}

void write_rows(hid_t dataset, hid_t type, hsize_t first, hsize_t count, const void* values,
                const std::string& action) {
  const Hdf5Handle memory(H5Screate_simple(1, &count, nullptr), H5Sclose, action),
      file = rows_of(dataset, first, count, action);
  check_hdf5(H5Dwrite(dataset, type, memory, file, H5P_DEFAULT, values), action);
}

/// So much of a text that no character is cut in two.
std::string_view shortened(std::string_view text) {
  if (text.size() <= FixedTexts::longest) return text;
  std::size_t end = FixedTexts::longest;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
  return text.substr(0, end);
}

}  // namespace

void FixedTable::create(hid_t parent, const std::string& group, const std::vector<ColumnDescription>& columns,
                        std::uint64_t rows) {
  const std::string action = "cannot create table " + group + " in " + file_of(parent);
  const hsize_t size = rows;
  const Hdf5Handle table = create_group(parent, group);
  const Hdf5Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose, action), properties = fixed_layout(action);
  const Hdf5Handle first = create_column(table, columns.front(), space, properties, H5I_INVALID_HID, action);
  for (std::size_t k = 1; k < columns.size(); ++k) create_column(table, columns[k], space, properties, first, action);
}

FixedTable::FixedTable(hid_t parent, const std::string& group, const std::vector<ColumnDescription>& columns)
    : group_(group) {
  for (const ColumnDescription& column : columns) {
    const std::string path = group + "/" + column.name;
    const std::string action = "cannot open " + path + " of " + file_of(parent);
    datasets_.emplace_back(H5Dopen2(parent, path.c_str(), H5P_DEFAULT), H5Dclose, action);
  }
}

void FixedTable::write(std::size_t column, std::uint64_t row, const std::vector<double>& values) {
  if (values.empty()) return;
  write_rows(datasets_[column], H5T_NATIVE_DOUBLE, row, values.size(), values.data(),
             "cannot write " + file_of(datasets_[column]));
}

void FixedTexts::create(hid_t parent, const std::string& name, const std::string& long_name, std::uint64_t rows) {
  const std::string action = "cannot create " + name + " in " + file_of(parent);
  const hsize_t size = rows;
  const Hdf5Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose, action);
  const Hdf5Handle dataset(
      H5Dcreate2(parent, name.c_str(), text_type(action), space, H5P_DEFAULT, fixed_layout(action), H5P_DEFAULT),
      H5Dclose, action);
  write_attribute(dataset, "long_name", long_name);
}

FixedTexts::FixedTexts(hid_t parent, const std::string& name) {
  const std::string action = "cannot open " + name + " of " + file_of(parent);
  dataset_ = Hdf5Handle(H5Dopen2(parent, name.c_str(), H5P_DEFAULT), H5Dclose, action);
}

void FixedTexts::write(std::uint64_t row, const std::string& text) {
  const std::string action = "cannot write " + file_of(dataset_);
  std::string padded(shortened(text));
  padded.resize(longest);
  write_rows(dataset_, text_type(action), row, 1, padded.data(), action);
}

void check_fixed_texts(const StoredColumn& column, std::uint64_t rows) {
  if (column.type() != StoredColumn::Type::padded_text || column.bytes_per_row() != FixedTexts::longest)
    column.reject(fmt::format("does not hold texts of {} bytes", FixedTexts::longest));
  if (column.rows() != rows) column.reject(fmt::format("has {} rows instead of {}", column.rows(), rows));
}

std::vector<std::string> read_fixed_texts(hid_t parent, const std::string& name) {
  std::vector<std::string> texts = StoredColumn(parent, name).texts();
  texts.erase(std::find(texts.begin(), texts.end(), ""), texts.end());
  return texts;
}

}  // namespace wormdrive
