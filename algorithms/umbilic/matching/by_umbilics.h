// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <complex>
#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/matching/choices.h>
#include <umbilic/matching/pose_hypothesis.h>
#include <umbilic/matching/prepared_model.h>

namespace umbilic {

/// An umbilic as one model shows it: orientation of the model applied, in its own orthonormal frame.
struct UmbilicMark {
    Vector3 point = Vector3::Zero();
    Vector3 normal = Vector3::UnitZ();
    Vector3 x = Vector3::UnitX();
    Vector3 y = Vector3::UnitY();      ///< normal cross x; the opposite in a mirrored mark
    double kappa = 0.0;                ///< 1/mm
    std::complex<double> alpha, beta;  ///< complex form of the cubic in (x, y), 1/mm^2
    double delta = 0.0;                ///< see UmbilicClass
    std::complex<double> zeta;

    /// sqrt(|alpha|^2 + 3 |beta|^2), 1/mm^2: invariant to rotation.
    double cubic_norm() const;
    /// arctan(kappa |kappa| / cubic norm), in (-pi/2, pi/2): how curved the umbilic is for the size of its cubic,
    /// invariant to scale.
    double bend() const;
};

/// All isolated umbilics inside the faces of a model, with the faces' outward sides applied; those whose cubic vanishes
/// are left out.
std::vector<UmbilicMark> umbilic_marks(const Model& model, const Features& features);

/// The mark seen from the other side of the surface: normal, kappa and cubic change sign, (alpha, beta) become
/// -conj(alpha, beta).
UmbilicMark flipped(const UmbilicMark& mark);
/// The mark in a left-handed frame: (alpha, beta) become their conjugates.
UmbilicMark mirrored(const UmbilicMark& mark);

/// Similarities that carry one suspect umbilic onto one of the original's: point, normal and scale are unique
/// (scale = sqrt(|C_suspect| / |C_original|)), and so is the rotation unless beta is small; then up to three differ
/// little in how well the cubics agree. Only those whose cubics differ by less than `misfit` of their norm.
std::vector<SimilarityTransform> poses_from_pair(const UmbilicMark& original, const UmbilicMark& suspect,
                                                 double misfit);

/// Poses from the umbilics of both models (thesis 4.6.1, 4.7.1, steps 100-110; NUMERICS in docs/numerics.md): pairs
/// that agree in the scale-free invariants delta, zeta and bend, under each hypothesis of hand and orientation that
/// holds for the whole model; one pair gives a whole similarity, and those that carry most umbilics onto partners come
/// first, improved by least squares over them. Throws Cancelled.
Proposals poses_by_umbilics(const PreparedModel& original, const PreparedModel& suspect, const ScaleChoice& scale,
                            MirrorChoice mirror, double invariant_tolerance, const Progress& progress = {});

}  // namespace umbilic
