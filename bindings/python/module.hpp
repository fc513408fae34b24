#pragma once
#include <pybind11/pybind11.h>

namespace wormdrive {

// Parts of the module, each with the functions and classes of one subject.
void add_sweep(pybind11::module_& m);
void add_diagnosis(pybind11::module_& m);
void add_stepping(pybind11::module_& m);

}  // namespace wormdrive
