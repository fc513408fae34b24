#include "output/hdf5/table.hpp"

#include <algorithm>
#include <cmath>

#include <hdf5_hl.h>

namespace wormdrive {
namespace {

/// A column takes whole chunks. Beyond the most, chunks make nothing faster; below the least, the index of the chunks
/// takes more room than they do.
hsize_t rows_per_chunk(hsize_t expected_rows) { return std::clamp<hsize_t>(expected_rows, 256, 4096); }

}  // namespace

GrowingTable::GrowingTable(hid_t parent, const std::string& group, std::vector<ColumnDescription> columns,
                           hsize_t expected_rows)
    : descriptions_(std::move(columns)), group_(create_group(parent, group)) {
  const std::string action = "cannot create table " + group + " in " + file_of(parent);
  const hsize_t none = 0, unlimited = H5S_UNLIMITED;
  const Hdf5Handle space(H5Screate_simple(1, &none, &unlimited), H5Sclose, action);
  const Hdf5Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, action);
  const hsize_t chunk = rows_per_chunk(expected_rows);
  check_hdf5(H5Pset_chunk(properties, 1, &chunk), action);
  for (const ColumnDescription& column : descriptions_) {
    const hid_t scale = datasets_.empty() ? H5I_INVALID_HID : hid_t(datasets_.front());
    datasets_.push_back(create_column(group_, column, space, properties, scale, action));
  }
}

Hdf5Handle create_column(hid_t group, const ColumnDescription& column, hid_t space, hid_t properties, hid_t scale,
                         const std::string& action) {
  const hid_t type = column.is_flag() ? H5T_STD_I8LE : H5T_IEEE_F64LE;
  Hdf5Handle dataset(H5Dcreate2(group, column.name.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT),
                     H5Dclose, action);
  write_attribute(dataset, "long_name", column.long_name);  // as CF has it, and as SDF
  write_attribute(dataset, "COMMENT", column.long_name);
  if (column.is_flag()) {
    write_attribute(dataset, "flag_values", column.flag_values);
    write_attribute(dataset, "flag_meanings", column.flag_meanings);
  } else {
    write_attribute(dataset, "units", column.units);
    write_attribute(dataset, "UNIT", column.units);
  }
  if (scale < 0)
    check_hdf5(H5DSset_scale(dataset, column.name.c_str()), action);
  else
    check_hdf5(H5DSattach_scale(dataset, scale, 0), action);
  return dataset;
}

void GrowingTable::append(const std::vector<std::vector<double>>& columns) {
  const hsize_t count = columns.front().size(), total = rows_ + count;
  if (count == 0) return;
  for (std::size_t k = 0; k < datasets_.size(); ++k) {
    const std::string action = "cannot write " + descriptions_[k].name + " to " + file_of(group_);
    check_hdf5(H5Dset_extent(datasets_[k], &total), action);
    const Hdf5Handle memory(H5Screate_simple(1, &count, nullptr), H5Sclose, action);
    const Hdf5Handle file(H5Dget_space(datasets_[k]), H5Sclose, action);
    check_hdf5(H5Sselect_hyperslab(file, H5S_SELECT_SET, &rows_, nullptr, &count, nullptr), action);
    check_hdf5(H5Dwrite(datasets_[k], H5T_NATIVE_DOUBLE, memory, file, H5P_DEFAULT, columns[k].data()), action);
  }
  rows_ = total;
}

void write_texts(hid_t group, const std::string& name, const std::string& long_name,
                 const std::vector<std::string>& texts) {
  const std::string action = "cannot write " + name + " to " + file_of(group);
  const hsize_t count = texts.size();
  std::vector<const char*> pointers;
  for (const std::string& text : texts) pointers.push_back(text.c_str());
  const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose, action);
  H5Tset_size(type, H5T_VARIABLE);
  H5Tset_cset(type, H5T_CSET_UTF8);
  const Hdf5Handle space(H5Screate_simple(1, &count, nullptr), H5Sclose, action);
  const Hdf5Handle dataset(H5Dcreate2(group, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                           H5Dclose, action);
  write_attribute(dataset, "long_name", long_name);
  check_hdf5(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers.data()), action);
}

}  // namespace wormdrive
