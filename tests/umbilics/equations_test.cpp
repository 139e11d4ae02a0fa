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
    equations.divide_by_edges({false, false, false, true});
    EXPECT_LT(equations.a().v_degree, before);
    // The pole of a triaxial ellipsoid is no umbilic: the divided forms do not vanish together on the edge.
    EXPECT_GT(
        std::max(edge_magnitude(equations.a(), PatchEdge::v_high), edge_magnitude(equations.b(), PatchEdge::v_high)),
        1e-3);
}

TEST(UmbilicEquations, UmbilicEdgesAreSeen) {
    // A bicubic plate, flat but for the control points i >= 4: flat on the first of its spans, next to which B vanishes
    // once and A twice.
    const NurbsSurface flat = support::smooth_bicubic(6, 1, 0.0);
    std::vector<Vector3> poles = flat.poles();
    for (int i = 4; i < 6; ++i)
        for (int j = 0; j < 6; ++j) poles[i * 6 + j].z() = 0.1 + 0.02 * j * j;
    const NurbsSurface surface(flat.u_knots(), flat.v_knots(), poles);
    const BezierPatches patches = bezier_patches(surface);
    UmbilicEquations equations;
    const auto form = [&](int i) {
        equations.form_fundamental(patches.patches[i * patches.v_count + 1], input_rounding(surface));
        equations.form_umbilic();
    };
    form(0);
    for (const PatchEdge edge : {PatchEdge::u_low, PatchEdge::u_high, PatchEdge::v_low, PatchEdge::v_high})
        EXPECT_FALSE(equations.umbilic(edge));
    form(1);
    EXPECT_TRUE(equations.umbilic(PatchEdge::u_low));
    EXPECT_FALSE(equations.umbilic(PatchEdge::u_high));
    EXPECT_FALSE(equations.umbilic(PatchEdge::v_low));
    equations.divide_by_edges({true, false, false, false});
    EXPECT_GT(edge_magnitude(equations.b(), PatchEdge::u_low), 1e-6);
}

}  // namespace
}  // namespace umbilic
