// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/outward_normals.h>

#include <umbilic/differential/fundamental_forms.h>

namespace umbilic {

OutwardNormals::OutwardNormals(const Model& model) {
    for (const Face& face : model.faces) {
        if (static_cast<int>(faces_.size()) <= face.number) faces_.resize(face.number + 1, nullptr);
        faces_[face.number] = &face;
    }
}

std::optional<Vector3> OutwardNormals::at(const SurfacePoint& point) const {
    const Face& face = *faces_[point.face];
    const SurfaceDerivatives d = face.surface.derivatives(point.u, point.v, 1);
    if (!regular(d)) return {};
    const Vector3 normal = unit_normal(d);
    return face.reversed ? Vector3(-normal) : normal;
}

}  // namespace umbilic
