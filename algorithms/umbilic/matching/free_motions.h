// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <umbilic/core/similarity_transform.h>

namespace umbilic {

enum class FreeMotionKind {
    turn,              ///< about an axis
    slide,             ///< along a line
    slide_in_plane,    ///< in every direction of a plane
    turn_about_point,  ///< every rotation about a point
    screw,             ///< about an axis and along it at the same time
    size,              ///< shrinking or growing about a point
    spiral             ///< shrinking or growing about a point while turning about an axis through it
};

/// A motion of the suspect that leaves it on the original, to first order: what a pose leaves open.
struct FreeMotion {
    FreeMotionKind kind = FreeMotionKind::turn;
    /// mm of the original: on the axis or line, in the plane, or the fixed point; where many would do, the one nearest
    /// to the middle of what coincides.
    Vector3 point = Vector3::Zero();
    /// Unit, of the axis or line, or normal to the plane; its largest coordinate is positive. Zero for turn_about_point
    /// and size.
    Vector3 direction = Vector3::Zero();
    /// mm along the axis per radian of a screw; radians per unit of log(scale) of a spiral; 0 otherwise.
    double pitch = 0.0;

    /// The same motion of things that are moved by `transform`.
    FreeMotion seen_through(const SimilarityTransform& transform) const;
    /// The motion by `amount`: radians of turns and screws (about x where any axis would do), mm of slides, log of the
    /// scale of sizes and spirals.
    SimilarityTransform by(double amount) const;
    /// The amount by which it comes near to a motion of the original's space that it may be; nothing for
    /// slide_in_plane and turn_about_point, which have more than one.
    std::optional<double> amount_of(const SimilarityTransform& motion) const;
};

/// The motions of surfaces within themselves, read from the normal equations of a refinement (see
/// Refinement::normal_matrix, about `centre`, lengths over `radius`, both mm): combinations of the eigenvectors that
/// change distances by less than `sensitivity` mm (root mean square) per mm of motion. They form a group of motions
/// (plane: sliding, turning, any size; cylinder: turn and slide; cone: turn and size; sphere: turns about its centre;
/// revolution: turn; extrusion: slide; helicoid: screw), which is named by its simplest members. Without `free_scale`
/// size and spirals take no part.
std::vector<FreeMotion> free_motions(const Eigen::Matrix<double, 7, 7>& normal_matrix, const Vector3& centre,
                                     double radius, double sensitivity, bool free_scale);

/// "turn", "slide", "slide_in_plane", "turn_about_point", "screw", "size", "spiral".
const char* name(FreeMotionKind kind);

/// A clause of which the moved thing is the subject: "turns about the axis through (0, 0, 5) along (0, 0, 1)".
std::string in_words(const FreeMotion& motion);
/// All of them, joined.
std::string in_words(const std::vector<FreeMotion>& motions);

}  // namespace umbilic
