// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <complex>
#include <string>
#include <vector>

#include <umbilic/matching/prepared_shape.h>

namespace umbilic {

/// The omega plane (thesis 2.1.4, Fig. 6-4) as an SVG element: the dividing curves |omega| = 1, Gamma_1 and Gamma_2
/// with the isolated umbilics of both models (measured points have none). All are seen from the outward side of their
/// face, those of a mirrored suspect mirrored back, so that corresponding umbilics coincide. Umbilics without an omega
/// (alpha = 0) are not in the picture.
std::string omega_plane_svg(const PreparedShape& original, const PreparedShape& suspect, bool mirrored);

/// An umbilic in the plane.
struct OmegaMark {
    std::complex<double> omega;
    double uncertainty = 0.0;  ///< radius around `omega`, drawn where it is larger than the mark
    UmbilicType type = UmbilicType::non_generic;
    std::string label;  ///< empty: none
};

/// The omega plane with the umbilics of one model, each at its three values (thesis Fig. 2-2); those out of the
/// picture's range are arrows at its border.
std::string omega_plane_svg(const std::vector<OmegaMark>& marks);

}  // namespace umbilic
