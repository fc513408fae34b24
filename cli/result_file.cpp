#include "cli/result_file.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include <fmt/format.h>

#include "scenarios/faults.hpp"

namespace wormdrive {

ResultFile::ResultFile(const std::string& path) : path_(path) {
  if (std::error_code why; !std::filesystem::exists(path, why))
    refuse({path}, fmt::format("cannot be read: {}", std::strerror(ENOENT)));
  if (!is_hdf5(path)) refuse({path}, "is no result file (HDF5); wormdrive run writes one");
  try {
    file_ = open_hdf5(path);
  } catch (const OutputFault& fault) {
    refuse({path}, fault.what());
  }
}

std::vector<std::string> ResultFile::columns(const std::string& table) const {
  const std::string action = "cannot read " + table;
  const Hdf5Handle group(H5Gopen2(file_, table.c_str(), H5P_DEFAULT), H5Gclose, action);
  H5G_info_t info;
  check_hdf5(H5Gget_info(group, &info), action);
  std::vector<std::string> names;
  for (hsize_t k = 0; k < info.nlinks; ++k) {
    std::string name(256, '\0');
    const ssize_t length =
        H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, k, name.data(), name.size(), H5P_DEFAULT);
    check_hdf5(length < 0 ? -1 : 0, action);
    name.resize(static_cast<std::size_t>(length));
    const Hdf5Handle dataset(H5Dopen2(group, name.c_str(), H5P_DEFAULT), H5Dclose, action);
    const Hdf5Handle type(H5Dget_type(dataset), H5Tclose, action);
    if (H5Tget_class(type) != H5T_STRING) names.push_back(name);
  }
  return names;
}

std::vector<std::string> ResultFile::texts(const std::string& name) const {
  const std::string action = "cannot read " + name;
  const Hdf5Handle dataset(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose, action);
  const Hdf5Handle type(H5Dget_type(dataset), H5Tclose, action), space(H5Dget_space(dataset), H5Sclose, action);
  if (H5Tis_variable_str(type) <= 0) throw OutputFault(action + ": it holds no texts");
  std::vector<char*> pointers(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  check_hdf5(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers.data()), action);
  const std::vector<std::string> copies(pointers.begin(), pointers.end());
  check_hdf5(H5Dvlen_reclaim(type, space, H5P_DEFAULT, pointers.data()), action);
  return copies;
}

std::vector<std::pair<std::string, double>> ResultFile::numbers(const std::string& object) const {
  const std::string action = "cannot read " + object;
  const Hdf5Handle at(H5Oopen(file_, object.c_str(), H5P_DEFAULT), H5Oclose, action);
  const int count = H5Aget_num_attrs(at);
  check_hdf5(count, action);
  std::vector<std::pair<std::string, double>> list;
  for (hsize_t k = 0; k < static_cast<hsize_t>(count); ++k) {
    const Hdf5Handle one(H5Aopen_by_idx(at, ".", H5_INDEX_NAME, H5_ITER_INC, k, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                         action);
    const Hdf5Handle type(H5Aget_type(one), H5Tclose, action), space(H5Aget_space(one), H5Sclose, action);
    if (H5Tget_class(type) == H5T_STRING || H5Sget_simple_extent_npoints(space) != 1) continue;
    std::string name(256, '\0');
    const ssize_t length = H5Aget_name(one, name.size(), name.data());
    check_hdf5(length < 0 ? -1 : 0, action);
    name.resize(static_cast<std::size_t>(length));
    double value = 0.0;
    check_hdf5(H5Aread(one, H5T_NATIVE_DOUBLE, &value), action);
    list.push_back({name, value});
  }
  return list;
}

std::string ResultFile::attribute(const std::string& object, const std::string& name) const {
  const Hdf5Handle at(H5Oopen(file_, object.c_str(), H5P_DEFAULT), H5Oclose, "cannot read " + object);
  return H5Aexists(at, name.c_str()) > 0 ? read_text_attribute(at, name) : "";
}

}  // namespace wormdrive
