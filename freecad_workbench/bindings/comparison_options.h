// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <umbilic/similarity/compare.h>

namespace umbilic::python {

/// Options from keyword arguments by the names of the command line (method, scale, mirror, scope, initial, pairs,
/// algorithm, distance, kappa, direction, umbilic_distance, cell, seed). Those absent or None keep their default.
/// Throws InvalidInput on an unknown name, an unknown word, or a number outside its range.
CompareOptions comparison_options(const pybind11::dict& keywords);

}  // namespace umbilic::python
