// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <vector>

#include <umbilic/nurbs/nurbs_surface.h>

namespace umbilic::support {

/// An umbilic found by sampling.
struct SampledUmbilic {
    Vector2 at = Vector2::Zero();
    /// Index from the sense in which the traceless shape operator turns around it: +1/2 or -1/2.
    double index = 0.0;
    /// Smaller over larger singular value of the operator's derivative along the surface: 0 for a double umbilic.
    double condition = 0.0;
};

struct SampledUmbilics {
    std::vector<SampledUmbilic> umbilics;
    /// Cells at the last depth that were neither excluded nor led to an umbilic: near misses, degenerate ones.
    long unresolved = 0;
    long cells = 0;
};

/// A second search, in another formulation and without proofs: every polynomial piece in centred powers, in extended
/// precision; the traceless part of the shape operator, (h_xx - h_yy) / 2 and h_xy in an orthonormal tangent frame,
/// sampled on cells; cells are excluded by a linear model whose remainder is estimated from second differences (with a
/// safety factor), and split otherwise; Newton's method ends in extended precision. Nothing of the polynomials, the
/// Bernstein basis or the bounds of the search under test enters. Umbilics common to pieces are listed once.
SampledUmbilics sample_umbilics(const NurbsSurface& surface);

/// Accuracy that extended precision gives to an umbilic, relative to the piece, unless curvatures hardly vary.
inline constexpr double polished_accuracy = 1e-12;

/// Newton's method from `at` on the piece there, in extended precision; none if its steps do not fall below `accuracy`
/// within a thousandth of the domain.
std::optional<Vector2> polished_umbilic(const NurbsSurface& surface, const Vector2& at,
                                        double accuracy = polished_accuracy);

/// Umbilics listed by sample_umbilics() nearer than this, relative to the domain, are one.
inline constexpr double sampled_distance = 1e-9;

}  // namespace umbilic::support
