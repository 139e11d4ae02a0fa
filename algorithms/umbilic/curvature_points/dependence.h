// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>

#include <umbilic/model/model.h>

namespace umbilic {

/// Why points with given Gaussian and mean curvature are not isolated on a surface: it is a plane, sphere, cylinder,
/// cone, torus, surface of revolution or extrusion within `recognition` (see RecognitionOptions::tolerance), or K and H
/// are found to depend on each other everywhere (developables, surfaces of constant curvature, helical sweeps). A
/// clause without full stop; none if they are independent somewhere.
std::optional<std::string> curvature_dependence(const NurbsSurface& surface, double recognition = 1e-6);
/// The same of a face, whose kind in its file counts too.
std::optional<std::string> curvature_dependence(const Face& face, double recognition = 1e-6);

}  // namespace umbilic
