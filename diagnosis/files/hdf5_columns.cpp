#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "diagnosis/files/stored_columns.hpp"
#include "output/hdf5/stored_table.hpp"

namespace wormdrive {
namespace {

constexpr int deepest = 8;                   ///< groups in groups
constexpr std::size_t most_members = 10000;  ///< hard links may lead in circles

const std::string cannot = "cannot be read";

/// The text of an attribute: a string of either kind, alone or as an array of one.
std::string attribute_text(hid_t object, const char* name) {
  constexpr std::size_t longest = 1000;
  if (H5Aexists(object, name) <= 0) return "";
  const Hdf5Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose, cannot),
      type(H5Aget_type(attribute), H5Tclose, cannot), space(H5Aget_space(attribute), H5Sclose, cannot);
  if (H5Tget_class(type) != H5T_STRING || H5Sget_simple_extent_npoints(space) != 1) return "";
  std::string text;
  if (H5Tis_variable_str(type) > 0) {
    char* read = nullptr;
    if (H5Aread(attribute, type, &read) < 0) return "";
    text = read ? read : "";
    H5free_memory(read);
  } else {
    const std::size_t size = H5Tget_size(type);
    if (size > longest) return "";
    text.resize(size);
    if (H5Aread(attribute, type, text.data()) < 0) return "";
    text.resize(std::min(text.find('\0'), size));
    text.erase(text.find_last_not_of(' ') + 1);
  }
  text.resize(std::min(text.size(), longest));
  return text;
}

/// Why a dataset lies elsewhere or is packed in a way that does not tell its size; empty if it is neither.
std::string packing_defect(hid_t properties) {
  const H5D_layout_t layout = H5Pget_layout(properties);
  if ((layout != H5D_CONTIGUOUS && layout != H5D_CHUNKED && layout != H5D_COMPACT) ||
      H5Pget_external_count(properties) > 0)
    return "lies in another file or is made of other columns";
  for (int k = 0; k < H5Pget_nfilters(properties); ++k) {
    unsigned flags = 0;
    std::size_t values = 0;
    const H5Z_filter_t filter =
        H5Pget_filter2(properties, static_cast<unsigned>(k), &flags, &values, nullptr, 0, nullptr, nullptr);
    if (filter != H5Z_FILTER_DEFLATE && filter != H5Z_FILTER_SHUFFLE && filter != H5Z_FILTER_FLETCHER32)
      return "is compressed in another way than gzip";
  }
  return "";
}

/// How many values a column has, or why it is none.
struct Extent {
  std::size_t rows = 0;
  std::string defect;
};
Extent extent_of(hid_t dataset) {
  const Hdf5Handle space(H5Dget_space(dataset), H5Sclose, cannot);
  const int rank = H5Sget_simple_extent_ndims(space);
  if (H5Sget_simple_extent_type(space) == H5S_NULL) return {0, "is empty"};
  if (rank == 0) return {0, "is a single value, not a column"};
  hsize_t size[H5S_MAX_RANK] = {};
  if (rank < 0 || H5Sget_simple_extent_dims(space, size, nullptr) != rank) return {0, cannot};
  hsize_t rows = 1;
  std::string shape;
  bool line = true;  // all dimensions but one are 1
  for (int k = 0; k < rank; ++k) {
    line = line && (size[k] == 1 || rows == 1);
    rows = size[k] == 0 ? 0 : line ? rows * size[k] : rows;
    shape += fmt::format("{}{}", k > 0 ? " x " : "", size[k]);
    if (rows == 0) return {0, "is empty"};
  }
  if (!line) return {0, fmt::format("has {} values; a column has one dimension", shape)};
  return {static_cast<std::size_t>(rows), ""};
}

StoredNumbers read_dataset(hid_t dataset, std::string name, std::uint64_t file_bytes) {
  StoredNumbers column{std::move(name), stated_unit(dataset), attribute_text(dataset, "COMMENT"), {}, ""};
  if (column.comment.empty()) column.comment = attribute_text(dataset, "long_name");
  const Hdf5Handle type(H5Dget_type(dataset), H5Tclose, cannot),
      properties(H5Dget_create_plist(dataset), H5Pclose, cannot);
  const H5T_class_t kind = H5Tget_class(type);
  const std::size_t size = H5Tget_size(type);
  if (kind == H5T_COMPOUND) column.defect = "is complex or has several values in a row";
  if (kind != H5T_COMPOUND && kind != H5T_INTEGER && kind != H5T_FLOAT) column.defect = "holds no numbers";
  if (column.defect.empty()) column.defect = packing_defect(properties);
  const Extent extent = extent_of(dataset);
  if (column.defect.empty()) column.defect = extent.defect;
  if (!column.defect.empty()) return column;
  const std::uint64_t stored = std::min<std::uint64_t>(H5Dget_storage_size(dataset), file_bytes);
  const bool packed = H5Pget_nfilters(properties) > 0;
  if (size == 0 || extent.rows > (packed ? deflated * stored : stored) / size) {
    column.defect = fmt::format("states {} rows, but the file contains only {} bytes of it", extent.rows, stored);
    return column;
  }
  column.values.resize(extent.rows);
  if (H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, column.values.data()) < 0) {
    column.values.clear();
    column.defect = cannot;
  }
  return column;
}

/// What MATLAB notes about a dataset that is not just numbers.
void apply_class(hid_t dataset, StoredNumbers& column, StoredContents& found) {
  if (H5Aexists(dataset, "MATLAB_empty") > 0) column.defect = "is empty";
  if (attribute_text(dataset, "MATLAB_class") != "char") return;
  std::string& text = found.texts[column.name];
  if (column.defect.empty())
    for (const double character : column.values) append_character(text, static_cast<std::uint16_t>(character));
  column.defect = "is a text; a column holds numbers";
}

struct Walk {
  hid_t file;
  std::uint64_t bytes;  ///< of the file
  bool matlab;
  StoredContents found{};
  std::size_t seen = 0;
};

void collect(Walk& walk, const std::string& group, int depth) {
  for (const std::string& member : members_of(walk.file, group)) {
    if (++walk.seen > most_members || depth > deepest) return;
    if (walk.matlab && member.starts_with('#')) continue;  // what cells and objects refer to
    const std::string path = group == "/" ? member : group + "/" + member;
    Hdf5Handle object;
    try {
      object = open_object(walk.file, path);
    } catch (const OutputFault&) {  // a link
      continue;
    }
    if (H5Iget_type(object) == H5I_GROUP) collect(walk, path, depth + 1);
    if (H5Iget_type(object) != H5I_DATASET) continue;
    std::string name = path;
    if (walk.matlab) std::replace(name.begin(), name.end(), '/', '.');
    StoredNumbers column = read_dataset(object, name, walk.bytes);
    if (walk.matlab) apply_class(object, column, walk.found);
    walk.found.columns.push_back(std::move(column));
  }
}

StoredContents contents(const std::string& path, bool matlab) {
  try {
    const Hdf5Handle file = open_hdf5(path);
    Walk walk{file, std::filesystem::file_size(path), matlab};
    collect(walk, "/", 0);
    return std::move(walk.found);
  } catch (const OutputFault& fault) {
    reject({path}, fault.what());
  }
}

}  // namespace

std::string stated_unit(hid_t object) {
  const std::string unit = attribute_text(object, "UNIT");
  return unit.empty() ? attribute_text(object, "units") : unit;
}

StoredContents hdf5_columns(const std::string& path) { return contents(path, false); }

StoredContents mat73_columns(const std::string& path) { return contents(path, true); }

}  // namespace wormdrive
