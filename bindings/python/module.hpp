#pragma once
#include <algorithm>

#include <pybind11/pybind11.h>

namespace wormdrive {

/// Lets a class that has py::pickle be pickled by protocols 0 and 1 as by 2: theirs would leave out its construction.
template <class Class>
void pickle_by_every_protocol(Class& described) {
  described.def("__reduce_ex__", [](const pybind11::object& self, int protocol) {
    return pybind11::module_::import("builtins").attr("object").attr("__reduce_ex__")(self, std::max(protocol, 2));
  });
}

// Parts of the module, each with the functions and classes of one subject.
void add_sweep(pybind11::module_& m);
void add_diagnosis(pybind11::module_& m);
void add_stepping(pybind11::module_& m);

}  // namespace wormdrive
