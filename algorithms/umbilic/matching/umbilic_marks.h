// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <complex>
#include <optional>
#include <vector>

#include <umbilic/matching/choices.h>
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
    std::optional<std::complex<double>> omega;  ///< see UmbilicClass; defined up to cube roots of unity
    UmbilicType type = UmbilicType::non_generic;
    bool flat = false;                ///< kappa is 0 within its error
    std::vector<Vector3> directions;  ///< unit tangents of the lines of curvature that run into it
    double delta_error = 0.0, zeta_error = 0.0, bend_error = 0.0;

    /// sqrt(|alpha|^2 + 3 |beta|^2), 1/mm^2: invariant to rotation.
    double cubic_norm() const;
    /// arctan(kappa |kappa| / cubic norm), in (-pi/2, pi/2): how curved the umbilic is for the size of its cubic,
    /// invariant to scale.
    double bend() const;
    /// 4 ||alpha| - |beta||, 1/mm^2: the least change of the difference of the principal curvatures per distance from
    /// the umbilic. An error e of that difference displaces the umbilic by up to e over this.
    double steadiness() const;
};

/// All isolated umbilics inside the faces of a model, with the faces' outward sides applied; those whose cubic vanishes
/// are left out.
std::vector<UmbilicMark> umbilic_marks(const Model& model, const Features& features);

/// The mark seen from the other side of the surface: normal, kappa and cubic change sign, (alpha, beta) become
/// -conj(alpha, beta).
UmbilicMark flipped(const UmbilicMark& mark);
/// The mark in a left-handed frame: (alpha, beta) become their conjugates.
UmbilicMark mirrored(const UmbilicMark& mark);

/// The marks of a suspect under one choice of hand and orientation, which holds for the whole model.
struct UmbilicReading {
    bool flip = false, mirror = false;
    std::vector<UmbilicMark> marks;
};

/// All choices that are open: mirror images if they are tried, both orientations unless both models are oriented.
std::vector<UmbilicReading> umbilic_readings(const std::vector<UmbilicMark>& suspect, bool oriented,
                                             MirrorChoice mirror);

}  // namespace umbilic
