#include "output/hdf5/stored_column.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

namespace wormdrive {
namespace {

const std::string cannot = "cannot be read";

std::optional<StoredColumn::Type> type_of(hid_t type) {
  using enum StoredColumn::Type;
  if (H5Tequal(type, H5T_IEEE_F64LE) > 0 || H5Tequal(type, H5T_IEEE_F64BE) > 0) return number;
  if (H5Tequal(type, H5T_STD_I8LE) > 0 || H5Tequal(type, H5T_STD_I8BE) > 0) return flag;
  if (H5Tget_class(type) != H5T_STRING) return std::nullopt;
  return H5Tis_variable_str(type) > 0 ? text : padded_text;
}

/// Whether the values lie in this file as they are: whatever is computed from others, compressed or kept elsewhere may
/// be any size.
bool is_plain(hid_t properties) {
  const H5D_layout_t layout = H5Pget_layout(properties);
  return (layout == H5D_CONTIGUOUS || layout == H5D_CHUNKED || layout == H5D_COMPACT) &&
         H5Pget_external_count(properties) == 0 && H5Pget_nfilters(properties) == 0;
}

}  // namespace

void StoredColumn::reject(const std::string& what) const {
  throw ReadFault(file_, fmt::format("its column '{}' {}", path_, what));
}

StoredColumn::StoredColumn(hid_t place, const std::string& name, const std::string& path)
    : file_(file_of(place)), path_(path), dataset_(open_object(place, name)) {
  if (H5Iget_type(dataset_) != H5I_DATASET) reject("is a group or a type instead of a column");
  const Hdf5Handle space(H5Dget_space(dataset_), H5Sclose, cannot), type(H5Dget_type(dataset_), H5Tclose, cannot),
      properties(H5Dget_create_plist(dataset_), H5Pclose, cannot), whole(H5Iget_file_id(place), H5Fclose, cannot);
  if (const int rank = H5Sget_simple_extent_ndims(space); H5Sis_simple(space) <= 0 || rank != 1)
    reject(fmt::format("has {} dimensions instead of one", rank));
  const std::optional<Type> known = type_of(type);
  if (!known) reject("holds neither numbers of 64 bits nor flags of 8 bits nor texts");
  type_ = *known;
  if (!is_plain(properties)) reject("is compressed or outside the file, unlike any result");
  hsize_t rows = 0, bytes = 0;
  if (H5Sget_simple_extent_dims(space, &rows, nullptr) != 1 || H5Fget_filesize(whole, &bytes) < 0) reject(cannot);
  rows_ = rows;
  bytes_ = bytes;
  // All rows of a result are written, and none is compressed: a file that states more than it holds is none.
  const hsize_t size = H5Tget_size(type), stored = std::min<hsize_t>(H5Dget_storage_size(dataset_), bytes);
  if (size == 0 || rows > stored / size)
    reject(fmt::format("states {} rows of {} bytes, but the file contains only {} bytes", rows, size, stored));
  bytes_per_row_ = size;
}

std::vector<double> StoredColumn::values(std::uint64_t first, std::uint64_t count) const {
  if (type_ != Type::number && type_ != Type::flag) reject("holds texts instead of numbers");
  if (first > rows_ || count > rows_ - first)
    reject(fmt::format("has {} rows, but {} are needed", rows_, first + count));
  std::vector<double> values(count);
  if (count == 0) return values;
  const hsize_t begin = first, size = count;
  const Hdf5Handle space(H5Dget_space(dataset_), H5Sclose, cannot),
      memory(H5Screate_simple(1, &size, nullptr), H5Sclose, cannot);
  if (H5Sselect_hyperslab(space, H5S_SELECT_SET, &begin, nullptr, &size, nullptr) < 0) reject(cannot);
  const auto read = [&](hid_t as, void* into) {
    if (H5Dread(dataset_, as, memory, space, H5P_DEFAULT, into) < 0) reject(cannot);
  };
  if (type_ == Type::number) {
    read(H5T_NATIVE_DOUBLE, values.data());
  } else {  // converted here: to convert a single flag, HDF5 clears a megabyte
    std::vector<std::int8_t> flags(count);
    read(H5T_NATIVE_INT8, flags.data());
    std::copy(flags.begin(), flags.end(), values.begin());
  }
  return values;
}

std::vector<std::string> StoredColumn::texts() const {
  switch (type_) {
    case Type::number:
    case Type::flag: break;
    case Type::text: return read_texts();
    case Type::padded_text: return read_padded_texts();
  }
  reject("holds numbers instead of texts");
}

/// One by one: many rows may share a long text, and are then longer than the file.
std::vector<std::string> StoredColumn::read_texts() const {
  const Hdf5Handle space(H5Dget_space(dataset_), H5Sclose, cannot), type(H5Dget_type(dataset_), H5Tclose, cannot),
      memory(H5Screate(H5S_SCALAR), H5Sclose, cannot);
  std::vector<std::string> texts;
  std::uint64_t length = 0;
  for (hsize_t row = 0; row < rows_; ++row) {
    const hsize_t one = 1;
    char* text = nullptr;
    if (H5Sselect_hyperslab(space, H5S_SELECT_SET, &row, nullptr, &one, nullptr) < 0 ||
        H5Dread(dataset_, type, memory, space, H5P_DEFAULT, &text) < 0)
      reject(cannot);
    texts.emplace_back(text ? text : "");
    H5free_memory(text);
    length += texts.back().size();
    if (length > bytes_) reject("holds more text than the file is long");
  }
  return texts;
}

std::vector<std::string> StoredColumn::read_padded_texts() const {
  const Hdf5Handle type(H5Dget_type(dataset_), H5Tclose, cannot);
  const std::size_t length = H5Tget_size(type);
  std::string all(rows_ * length, '\0');
  if (rows_ > 0 && H5Dread(dataset_, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, all.data()) < 0) reject(cannot);
  std::vector<std::string> texts;
  for (std::size_t row = 0; row < rows_; ++row) {
    texts.push_back(all.substr(row * length, length));
    texts.back().resize(std::min(texts.back().find('\0'), length));
  }
  return texts;
}

std::vector<double> read_column(hid_t file, const std::string& path) { return StoredColumn(file, path).values(); }

}  // namespace wormdrive
