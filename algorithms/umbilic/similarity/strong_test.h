// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>
#include <vector>

#include <umbilic/similarity/assessment.h>
#include <umbilic/similarity/nodes.h>

namespace umbilic {

/// Relative error of the cubic forms within which two umbilics of different types may still be the same one, if both
/// may have one type: re-approximation moves omega by a few percent.
inline constexpr double type_margin = 0.05;

/// The isolated umbilics inside a model's faces, in the order of faces and then of the search: the indices in
/// StrongTest refer to this list.
std::vector<const Umbilic*> umbilics_inside(std::span<const FaceUmbilics> faces);

/// Strong test (thesis 4.4.3): isolated generic umbilics of the two models coincide in place (within umbilic_distance,
/// mm of the original) and type. Expected to have a partner are the certified ones that lie in the overlap (within
/// `distance` of the other model; under global scope all) and farther than umbilic_distance from trimming edges of
/// either model and from knot lines across which third derivatives jump. Types compare as they stand: neither a mirror
/// image nor reversed normals change them.
StrongTest strong_test(const PlacedModel& original, const PlacedModel& suspect, MatchScope scope, double distance,
                       double umbilic_distance);

}  // namespace umbilic
