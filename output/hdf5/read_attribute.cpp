#include <algorithm>

#include <fmt/format.h>

#include "output/hdf5/hdf5.hpp"

namespace wormdrive {
namespace {

/// An attribute that has to be one value, not a list of them.
Hdf5Handle open_scalar(hid_t object, const std::string& name, const std::string& wanted) {
  const std::string file = file_of(object);
  if (H5Aexists(object, name.c_str()) <= 0) throw ReadFault(file, fmt::format("it has no attribute '{}'", name));
  const std::string action = fmt::format("its attribute '{}' cannot be read", name);
  Hdf5Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose, action);
  const Hdf5Handle space(H5Aget_space(attribute), H5Sclose, action);
  if (H5Sget_simple_extent_type(space) != H5S_SCALAR)
    throw ReadFault(file, fmt::format("its attribute '{}' is not {}", name, wanted));
  return attribute;
}

/// A scalar of one of two types, which differ in the order of their bytes only.
template <class Value>
Value read_scalar(hid_t object, const std::string& name, const std::string& wanted, hid_t little, hid_t big,
                  hid_t native) {
  const Hdf5Handle attribute = open_scalar(object, name, wanted);
  const std::string action = fmt::format("its attribute '{}' cannot be read", name);
  const Hdf5Handle type(H5Aget_type(attribute), H5Tclose, action);
  if (H5Tequal(type, little) <= 0 && H5Tequal(type, big) <= 0)
    throw ReadFault(file_of(object), fmt::format("its attribute '{}' is not {}", name, wanted));
  Value value{};
  if (H5Aread(attribute, native, &value) < 0) throw ReadFault(file_of(object), action);
  return value;
}

/// A path from a place as a path from the file.
std::string in_file(hid_t place, const std::string& path) {
  std::string name(static_cast<std::size_t>(std::max<ssize_t>(H5Iget_name(place, nullptr, 0), 0)), ' ');
  H5Iget_name(place, name.data(), name.size() + 1);
  return name.size() > 1 ? name.substr(1) + "/" + path : path;
}

}  // namespace

std::int64_t read_integer_attribute(hid_t object, const std::string& name) {
  return read_scalar<std::int64_t>(object, name, "a whole number of 64 bits", H5T_STD_I64LE, H5T_STD_I64BE,
                                   H5T_NATIVE_INT64);
}

double read_number_attribute(hid_t object, const std::string& name) {
  return read_scalar<double>(object, name, "a number of 64 bits", H5T_IEEE_F64LE, H5T_IEEE_F64BE, H5T_NATIVE_DOUBLE);
}

std::string read_text_attribute(hid_t object, const std::string& name) {
  const Hdf5Handle attribute = open_scalar(object, name, "a text");
  const std::string action = fmt::format("its attribute '{}' cannot be read", name);
  const Hdf5Handle type(H5Aget_type(attribute), H5Tclose, action);
  if (H5Tis_variable_str(type) <= 0)
    throw ReadFault(file_of(object), fmt::format("its attribute '{}' is not a text", name));
  char* text = nullptr;
  if (H5Aread(attribute, type, &text) < 0) throw ReadFault(file_of(object), action);
  std::string copy(text ? text : "");
  H5free_memory(text);
  return copy;
}

Hdf5Handle open_object(hid_t place, const std::string& path) {
  const auto reject = [&](fmt::format_string<std::string> what, const std::string& part) {
    throw ReadFault(file_of(place), fmt::format(what, in_file(place, part)));
  };
  for (std::size_t end = path.find('/', 1); path != "/"; end = path.find('/', end + 1)) {
    const std::string part = path.substr(0, end);
    H5L_info_t link;
    if (H5Lget_info(place, part.c_str(), &link, H5P_DEFAULT) < 0) reject("it has no '{}'", part);
    if (link.type != H5L_TYPE_HARD) reject("its '{}' is a link, which no result contains", part);
    if (end == std::string::npos) break;
  }
  const hid_t object = H5Oopen(place, path.c_str(), H5P_DEFAULT);
  if (object < 0) reject("its '{}' cannot be opened", path);
  return {object, H5Oclose, "cannot open " + path};
}

}  // namespace wormdrive
