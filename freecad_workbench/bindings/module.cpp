// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bind.h"

PYBIND11_MODULE(_native, module) {
    module.doc() = "Compiled part of the package umbilic; use the package, which documents units and errors.";
    umbilic::python::bind_errors(module);
    umbilic::python::bind_model(module);
    umbilic::python::bind_umbilics(module);
    umbilic::python::bind_wireframe(module);
    umbilic::python::bind_curves(module);
    umbilic::python::bind_points(module);
    umbilic::python::bind_comparison(module);
}
