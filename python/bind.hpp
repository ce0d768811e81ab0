#pragma once
// The parts of the module.
#include <pybind11/pybind11.h>

namespace cnem::python {

void bind_errors();
void bind_case(pybind11::module_& module);
void bind_run(pybind11::module_& module);

} // namespace cnem::python
