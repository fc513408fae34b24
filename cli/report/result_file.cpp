#include "cli/report/result_file.hpp"

#include <fmt/format.h>

#include "description/diagnostics.hpp"
#include "description/toml/document.hpp"
#include "description/toml/parse_scenario.hpp"
#include "output/check_result.hpp"
#include "output/hdf5/read_ahead.hpp"

namespace wormdrive {

ResultFile::ResultFile(const std::string& path, Writer writer) : path_(path) {
  if (const auto why = why_unreadable(path)) reject({path}, *why);
  if (!is_hdf5(path)) reject({path}, "not an HDF5 file; wormdrive run writes one");
  try {
    if (writer == Writer::anybody) read_ahead(path);
    file_ = open_hdf5(path);
    check_result(file_);
  } catch (const OutputFault& fault) {
    reject({path}, fault.what());
  }
}

Scenario ResultFile::scenario() const {
  try {
    return parse_scenario(read_text_attribute(file_, "scenario"), path_, {}, Purpose::show);
  } catch (const OutputFault& fault) {
    reject({path_}, fault.what());
  }
}

std::vector<std::string> ResultFile::columns(const std::string& table) const {
  return StoredTable(file_, table).numbers();
}

std::vector<std::string> ResultFile::texts(const std::string& name) const { return StoredColumn(file_, name).texts(); }

std::vector<std::pair<std::string, double>> ResultFile::numbers(const std::string& table) const {
  const Hdf5Handle at = open_object(file_, table);
  std::vector<std::string> names;
  const auto take = [](hid_t, const char* name, const H5A_info_t*, void* list) {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return herr_t{0};
  };
  check_hdf5(H5Aiterate2(at, H5_INDEX_NAME, H5_ITER_INC, nullptr, take, &names), "cannot read " + table);
  std::vector<std::pair<std::string, double>> list;
  for (const std::string& name : names) {
    const Hdf5Handle one(H5Aopen(at, name.c_str(), H5P_DEFAULT), H5Aclose, "cannot read " + name);
    const Hdf5Handle type(H5Aget_type(one), H5Tclose, "cannot read " + name);
    switch (H5Tget_class(type)) {
      case H5T_FLOAT: list.emplace_back(name, read_number_attribute(at, name)); break;
      case H5T_INTEGER: list.emplace_back(name, static_cast<double>(read_integer_attribute(at, name))); break;
      default: break;  // of another type than a number
    }
  }
  return list;
}

std::string ResultFile::attribute(const std::string& object, const std::string& name) const {
  const Hdf5Handle at = open_object(file_, object);
  return H5Aexists(at, name.c_str()) > 0 ? read_text_attribute(at, name) : "";
}

std::vector<ResultFile> open_results(const std::vector<std::string>& paths) {
  std::vector<ResultFile> files;
  Diagnostics faults;
  for (const std::string& path : paths) {
    try {
      files.emplace_back(path);
    } catch (const InputFault& fault) {
      for (const Fault& f : fault.faults) faults.add(f.where, f.what);
    }
  }
  faults.raise();
  return files;
}

}  // namespace wormdrive
