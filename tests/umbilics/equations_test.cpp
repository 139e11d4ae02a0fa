// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/umbilics/equations.h>

#include <gtest/gtest.h>

#include <algorithm>

#include <support/surfaces.h>
#include <umbilic/nurbs/bezier_patch.h>

namespace umbilic {
namespace {

NurbsSurface shifted(const NurbsSurface& surface, unsigned seed, double reach) {
    return support::transformed(surface, support::random_similarity(seed, 1.0, seed % 2 == 1, reach));
}

TEST(UmbilicEquations, RoundedTiltedPlaneIsZeroWithinTheInput) {
    const NurbsSurface plane = shifted(support::smooth_bicubic(6, 1, 0.0), 5, 1e3);
    for (const BezierPatch& patch : bezier_patches(plane).patches) {
        UmbilicEquations equations;
        equations.form_fundamental(patch, input_rounding(plane));
        equations.form_umbilic();
        EXPECT_LE(equations.a().magnitude, 4 * equations.a().bound.input);
        EXPECT_LE(equations.b().magnitude, 4 * equations.b().bound.input);
    }
}

TEST(UmbilicEquations, CollapsedEdgesAreSeen) {
    const NurbsSurface octant = support::ellipsoid_octant(3, 2, 1);
    UmbilicEquations equations;
    equations.form_fundamental(bezier_patches(octant).patches[0], input_rounding(octant));
    EXPECT_TRUE(equations.singular(PatchEdge::v_high));
    EXPECT_FALSE(equations.singular(PatchEdge::v_low));
    EXPECT_FALSE(equations.singular(PatchEdge::u_low));
    EXPECT_FALSE(equations.singular(PatchEdge::u_high));
    equations.form_umbilic();
    const int before = equations.a().v_degree;
    equations.divide_by_singular_edges();
    EXPECT_LT(equations.a().v_degree, before);
    // The pole of a triaxial ellipsoid is no umbilic: the divided forms do not vanish together on the edge.
    EXPECT_GT(std::max(edge_magnitude(equations.a(), PatchEdge::v_high), edge_magnitude(equations.b(), PatchEdge::v_high)), 1e-3);
}

}  // namespace
}  // namespace umbilic
