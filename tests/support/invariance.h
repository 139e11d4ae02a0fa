// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <umbilic/core/similarity_transform.h>
#include <umbilic/model/model.h>

namespace umbilic::support {

/// A copy of a model and how its points correspond to the original's. What is intrinsic must come out of it as it came
/// out of the original, changed only by `space` and `normal_sign`.
struct ModelCopy {
    Model model;
    /// p_copy = space.apply(p_original), within rounding and `deviation`.
    SimilarityTransform space;
    /// Where a point of the original lies on the copy: one place on the copy of its face, several on cuts between
    /// pieces, none if it was cut off. No function where a file in between leaves only space to compare.
    std::function<std::vector<SurfacePoint>(const SurfacePoint&)> parameters;
    /// The copy's r_u x r_v is this times space.apply_direction(the original's r_u x r_v). `Face::reversed` follows, so
    /// outward sides stay outward.
    double normal_sign = 1.0;
    /// Largest distance (mm of the copy) between the image of the original and the copy; 0 if only rounding separates
    /// them.
    double deviation = 0.0;
    bool part = false;     ///< some of the original is missing
    bool foreign = false;  ///< the copy also holds what the original does not
};

/// A way to make a copy that no result about the shape may depend on.
struct Invariance {
    std::string name;  ///< letters, digits and underscores
    std::function<ModelCopy(const Model&)> copy;
};

/// Moved, scaled by 0.1, 25.4 and 1000, mirrored.
std::vector<Invariance> similarities(unsigned seed = 1);

/// The same shape with the same faces, described otherwise: u and v exchanged, each reversed, degrees raised in u, v
/// and both, random knots inserted, Bezier form, Moebius maps of both parameters, polynomial made rational with unequal
/// weights, two pieces joined with a knot of full multiplicity and unequal speed, elementary faces as NURBS. Faces
/// become B-spline faces; trimming curves that the map of parameters bends become cubic pieces, accurate to 1e-11 of
/// the domain.
std::vector<Invariance> reparametrisations(unsigned seed = 1);

/// The last of the reparametrisations: elementary faces as B-spline faces, all loops in surface parameters.
Invariance elementary_as_nurbs();

/// Untrimmed faces split in 2 x 2 pieces each (trimmed ones stay whole).
Invariance split();
/// Untrimmed faces trimmed to a rectangle each; without any, the second half of the faces is left out.
Invariance trimmed_to_part();
/// A face of foreign material beside the model, as large as it.
Invariance with_foreign_material(unsigned seed = 1);
/// Every face interpolated by a bi-quintic polynomial surface within this share of the model's size (Model::size).
Invariance reapproximated_within(double relative_deviation);

/// All of the above but the last, which needs a deviation.
std::vector<Invariance> invariances(unsigned seed = 1);

}  // namespace umbilic::support
