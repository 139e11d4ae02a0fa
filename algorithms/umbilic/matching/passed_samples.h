// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <umbilic/core/similarity_transform.h>
#include <umbilic/matching/prepared_points.h>

namespace umbilic {

/// How measured points pass one sample of the original, in the original's frame and unit.
struct PassedSample {
    double distance = 0.0;         ///< mm; of a mesh beside the height of its chords
    double signed_distance = 0.0;  ///< mm, positive where the points lie on the outward side of the original
    bool past_border = false;      ///< the points do not reach the sample
    double chord = 0.0;            ///< depth of a triangle below the surface that its corners lie on, mm; 0 of clouds
};

/// How the suspect, moved by `original_suspect`, passes samples of the original. The surface of a cloud is the
/// paraboloid of the nearest jet, and does not reach farther than PrincipalFrameTable::border_steps. That of a mesh is
/// known by its triangles, whose corners are measured and whose insides are chords: the corners of the triangle nearest
/// to a sample are held against the original's osculating paraboloid there, and their heights over it are averaged as
/// the nearest point divides the triangle. A mesh whose corners lie on the original has distance 0 up to the third
/// order in the triangle's size, whatever its chords; a triangle that passes over what the original has and the corners
/// do not know of has not.
std::vector<PassedSample> passed_samples(const std::vector<AreaSample>& original, const PreparedPoints& suspect,
                                         const SimilarityTransform& original_suspect);

}  // namespace umbilic
