// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>

#include <support/surfaces.h>

namespace umbilic::support {

/// Rectangle about `centre` with half sides u and v; normal u x v.
inline NurbsSurface rectangle(const Vector3& centre, const Vector3& u, const Vector3& v) {
    return NurbsSurface(KnotVector::bezier(1), KnotVector::bezier(1),
                        {centre - u - v, centre - u + v, centre + u - v, centre + u + v});
}

/// Cone frustum or cylinder from `foot` along `axis` (any length), radius r0 at the foot and r1 at its end.
inline NurbsSurface frustum(const Vector3& foot, const Vector3& axis, double r0, double r1) {
    SimilarityTransform place;
    place.rotation = Eigen::Quaterniond::FromTwoVectors(Vector3::UnitZ(), axis).toRotationMatrix();
    place.translation = foot;
    return transformed(full_cone(r0, r1, axis.norm()), place);
}

inline NurbsSurface cylinder(const Vector3& foot, const Vector3& axis, double radius) {
    return frustum(foot, axis, radius, radius);
}

/// Walls of a flange: rim, hub, bore, conical face, six holes; symmetric by six turns and six mirrors.
inline std::vector<NurbsSurface> flange() {
    std::vector<NurbsSurface> faces = {cylinder({0, 0, 0}, {0, 0, 14}, 60), cylinder({0, 0, 14}, {0, 0, 26}, 32),
                                       cylinder({0, 0, 0}, {0, 0, 40}, 20),
                                       // A flat cone as its face: a rectangle is not six-fold.
                                       frustum({0, 0, 13}, {0, 0, 1}, 58, 40)};
    for (int k = 0; k < 6; ++k) {
        const double angle = k * std::numbers::pi / 3;
        faces.push_back(cylinder({46 * std::cos(angle), 46 * std::sin(angle), 0}, {0, 0, 14}, 5.5));
    }
    return faces;
}

/// Faces of a bracket: planes, holes in two directions, a countersink.
inline std::vector<NurbsSurface> bracket() {
    return {rectangle({50, 30, 0}, {50, 0, 0}, {0, -30, 0}),
            rectangle({56, 30, 10}, {44, 0, 0}, {0, 30, 0}),
            rectangle({0, 30, 27.5}, {0, 30, 0}, {0, 0, -27.5}),
            rectangle({12, 30, 32.5}, {0, 30, 0}, {0, 0, 22.5}),
            rectangle({100, 30, 5}, {0, 30, 0}, {0, 0, 5}),
            cylinder({70, 28, 0}, {0, 0, 25}, 8),
            cylinder({70, 28, 10}, {0, 0, 15}, 14),
            cylinder({0, 18, 36}, {12, 0, 0}, 6),
            cylinder({30, 12, 0}, {0, 0, 10}, 4.5),
            frustum({30, 47, 6}, {0, 0, 4}, 4.5, 8.5)};
}

inline std::vector<NurbsSurface> all_moved(std::vector<NurbsSurface> faces, const SimilarityTransform& pose) {
    for (NurbsSurface& face : faces) face = transformed(face, pose);
    return faces;
}

}  // namespace umbilic::support
