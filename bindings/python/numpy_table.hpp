#pragma once
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "output/hdf5/table.hpp"

namespace wormdrive {

/// An array that looks into memory of C++, which its owner keeps. It is read-only: whoever else looks there is not to
/// see it change, and NumPy does not let it be made writable again.
template <class T>
pybind11::array view(std::span<const T> values, const pybind11::object& owner) {
  pybind11::array_t<T> array(static_cast<pybind11::ssize_t>(values.size()), values.data(), owner);
  pybind11::detail::array_proxy(array.ptr())->flags &= ~pybind11::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

/// A column that Python owns: the vector lives as long as an array looks into it.
template <class T>
pybind11::array own(std::vector<T>&& values) {
  auto kept = std::make_unique<std::vector<T>>(std::move(values));
  const std::vector<T>& column = *kept;
  const pybind11::capsule owner(kept.release(), [](void* p) { delete static_cast<std::vector<T>*>(p); });
  return view(std::span(column), owner);
}

/// (name, units, long_name, flag_meanings, flag_values, array): a column as wormdrive/__init__.py takes it.
inline pybind11::tuple described(const ColumnDescription& d, pybind11::array array) {
  return pybind11::make_tuple(d.name, d.units, d.long_name, d.flag_meanings,
                              std::vector<int>(d.flag_values.begin(), d.flag_values.end()), std::move(array));
}

}  // namespace wormdrive
