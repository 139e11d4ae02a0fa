// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <vector>

#include <umbilic/model/model.h>

namespace umbilic {

/// Unit normals of a model's faces, towards their outward side. Keeps a reference to the model.
class OutwardNormals {
public:
    explicit OutwardNormals(const Model& model);

    const Face& face(int number) const { return *faces_[number]; }
    /// Nothing at singular points of the surface.
    std::optional<Vector3> at(const SurfacePoint& point) const;

private:
    std::vector<const Face*> faces_;  ///< by number
};

}  // namespace umbilic
