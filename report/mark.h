// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include <umbilic/umbilics/umbilic.h>

namespace umbilic {

/// SVG path data of the mark of a type, about the origin, of about radius 1: a three-pointed star, a triangle
/// (monstar), a lens (lemon), a square (non-generic). The same shapes mark umbilics in the workbench.
std::string mark_path(UmbilicType type);

/// The mark as an SVG element at a place of a picture, in its type's colour; `classes` are added to its class.
std::string mark_svg(UmbilicType type, double x, double y, double radius, const std::string& classes = "");

}  // namespace umbilic
