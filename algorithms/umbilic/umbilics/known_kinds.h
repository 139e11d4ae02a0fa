// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>

#include <umbilic/umbilics/find.h>

namespace umbilic {

/// The umbilics of a face whose kind of surface tells them: planes and spheres are umbilic everywhere, cylinders, cones
/// and tori nowhere. NURBS surfaces are recognised as planes and spheres within UmbilicOptions::recognition, and as the
/// others where they are so exactly (an approximation is searched, which proves more). None for all other faces. The
/// face's number is not set.
std::optional<FaceUmbilics> known_umbilics(const Face& face, const UmbilicOptions& options);

}  // namespace umbilic
