// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <pybind11/pybind11.h>

namespace umbilic::python {

/// Each adds one area to the module `umbilic._native`.
void bind_errors(pybind11::module_& module);
void bind_model(pybind11::module_& module);
void bind_umbilics(pybind11::module_& module);
void bind_wireframe(pybind11::module_& module);
void bind_curves(pybind11::module_& module);
void bind_comparison(pybind11::module_& module);
void bind_points(pybind11::module_& module);

}  // namespace umbilic::python
