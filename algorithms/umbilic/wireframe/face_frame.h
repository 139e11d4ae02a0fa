// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <vector>

#include <umbilic/model/model.h>
#include <umbilic/wireframe/border_nodes.h>

namespace umbilic {

/// Points with weights that depend on the shape alone.
struct WeightedPoints {
    std::vector<Vector3> points;
    std::vector<double> weights;

    Vector3 centroid() const;
};

/// The border of a face, weighted by its length.
WeightedPoints border_points(const FaceBorder& border);

/// What decides between choices that are equally good on a face: its centroid and a direction that the shape determines
/// as far as it can, from third moments, the place of the face in its model, and its farthest corners. Where the shape
/// is symmetric the direction is one of several that its symmetries carry into one another, so that copies are meshed
/// alike up to such a symmetry.
struct FaceFrame {
    Vector3 centroid = Vector3::Zero();    ///< of the border's length; of the area of a surface without border
    std::optional<Vector3> area_centroid;  ///< of a face that has a border and is not trimmed
    double radius = 0.0;                   ///< greatest distance of the border, or surface, from it, mm
    Vector3 lean = Vector3::Zero();        ///< the direction, unit
    /// From the centroid to the farthest node of the border; along `lean` without border.
    Vector3 corner = Vector3::Zero();
    WeightedPoints points;  ///< of the border, or of the area

    /// In [-1, 1]: of choices that are equally good the one at the place with the greater value is taken.
    double preference(const Vector3& place) const { return radius > 0.0 ? lean.dot(place - centroid) / radius : 0.0; }
};

/// `model_centroid` is that of the lengths of all borders of the model, if it has any, `model_size` its Model::size.
FaceFrame face_frame(const Face& face, const FaceBorder& border, const std::optional<Vector3>& model_centroid,
                     double model_size);

}  // namespace umbilic
