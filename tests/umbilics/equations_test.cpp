// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/umbilics/equations.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <support/reparametrisation.h>
#include <support/surfaces.h>
#include <umbilic/bernstein/subdivision.h>
#include <umbilic/nurbs/bezier_patch.h>

namespace umbilic {
namespace {

NurbsSurface shifted(const NurbsSurface& surface, unsigned seed, double reach) {
    return support::transformed(surface, support::random_similarity(seed, 1.0, seed % 2 == 1, reach));
}

double value_at(const TensorPolynomial& polynomial, const Vector2& at) {
    const int p = polynomial.u_degree, q = polynomial.v_degree;
    std::vector<double> c(polynomial.scaled.size()), u(p + 1), v(q + 1), slopes(std::max(p, q) + 1);
    polynomial.bernstein_coefficients(c);
    bernstein_basis(p, at.x(), u.data(), slopes.data());
    bernstein_basis(q, at.y(), v.data(), slopes.data());
    double sum = 0.0;
    for (int i = 0; i <= p; ++i)
        for (int j = 0; j <= q; ++j) sum += u[i] * v[j] * c[i * (q + 1) + j];
    return sum;
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

TEST(UmbilicEquations, PoleFactorsOfACollapsedEdgeCanBeDividedOut) {
    // Turned any way, so that all coordinates are rounded; also with a tip whose meridians have no common tangent
    // plane.
    const NurbsSurface octant =
        support::transformed(support::ellipsoid_octant(3, 2, 1), support::random_similarity(8, 1.0, false));
    std::vector<Vector3> tip = octant.poles();
    const int columns = octant.v_pole_count();
    for (int i = 0; i < octant.u_pole_count(); ++i) tip[i * columns + 1] += Vector3(0.3 * i, 0.2, 0.1 * i * i);
    for (const NurbsSurface& along_v :
         {octant, NurbsSurface(octant.u_knots(), octant.v_knots(), tip, octant.weights())})
        for (const bool swapped : {false, true}) {
            const NurbsSurface surface = swapped ? support::exchanged(along_v).surface : along_v;
            const BezierPatch patch = bezier_patches(surface).patches[0];
            const PatchEdge edge = swapped ? PatchEdge::u_high : PatchEdge::v_high;
            for (const PatchEdge other : {PatchEdge::u_low, PatchEdge::u_high, PatchEdge::v_low, PatchEdge::v_high})
                EXPECT_EQ(collapsed(surface, patch, other), other == edge);
            UmbilicEquations equations;
            equations.form_fundamental(patch, input_rounding(surface));
            equations.form_umbilic();
            for (int k = 0; k < 2; ++k) {
                TensorPolynomial polynomial = k == 0 ? equations.a() : equations.b();
                const int powers = k == 0 ? pole_powers(edge).a : pole_powers(edge).b;
                for (int power = 0; power < powers; ++power) {
                    EXPECT_LE(edge_magnitude(polynomial, edge), polynomial.bound.rounding);
                    divide_by_edge(polynomial, edge);
                }
            }
            // What is left agrees with the values of A and B.
            const Vector2 at(0.4, 0.7);
            const std::array<Interval, 2> values = equations.enclose(at);
            std::array<bool, 4> poles{};
            poles[static_cast<int>(edge)] = true;
            equations.divide_by_poles(poles);
            const double distance = 1.0 - (swapped ? at.x() : at.y());
            for (int k = 0; k < 2; ++k) {
                const TensorPolynomial& left = k == 0 ? equations.a() : equations.b();
                const double expected =
                    values[k].middle() / std::pow(distance, k == 0 ? pole_powers(edge).a : pole_powers(edge).b);
                EXPECT_NEAR(value_at(left, at), expected, 1e-11 * left.magnitude);
            }
        }
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
