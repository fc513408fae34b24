#pragma once
#include <string>
#include <utility>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "output/table.hpp"

namespace wormdrive {

/// A column that Python owns: the vector lives as long as an array looks into it.
template <class T>
pybind11::array own(std::vector<T>&& values) {
  auto* const kept = new std::vector<T>(std::move(values));
  const pybind11::capsule owner(kept, [](void* p) { delete static_cast<std::vector<T>*>(p); });
  return pybind11::array_t<T>(static_cast<pybind11::ssize_t>(kept->size()), kept->data(), owner);
}

/// (name, units, long_name, flag_meanings, flag_values, array): a column as wormdrive/__init__.py takes it.
inline pybind11::tuple described(const ColumnDescription& d, pybind11::array array) {
  return pybind11::make_tuple(d.name, d.units, d.long_name, d.flag_meanings,
                              std::vector<int>(d.flag_values.begin(), d.flag_values.end()), std::move(array));
}

}  // namespace wormdrive
