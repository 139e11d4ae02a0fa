// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <support/random_faces.h>
#include <support/surfaces.h>
#include <umbilic/bernstein/subdivision.h>
#include <umbilic/differential/curvature.h>
#include <umbilic/nurbs/bezier_patch.h>
#include <umbilic/umbilics/equations.h>

namespace umbilic {
namespace {

double value(const TensorPolynomial& polynomial, double u, double v) {
    std::vector<double> c(polynomial.scaled.size()), bu(polynomial.u_degree + 1), bv(polynomial.v_degree + 1);
    std::vector<double> unused(std::max(bu.size(), bv.size()));
    polynomial.bernstein_coefficients(c);
    bernstein_basis(polynomial.u_degree, u, bu.data(), unused.data());
    bernstein_basis(polynomial.v_degree, v, bv.data(), unused.data());
    double result = 0.0;
    for (std::size_t i = 0; i < bu.size(); ++i)
        for (std::size_t j = 0; j < bv.size(); ++j) result += bu[i] * bv[j] * c[i * bv.size() + j];
    return result;
}

void expect_curvatures(const NurbsSurface& surface, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0.1, 0.9);
    const InputRounding input = input_rounding(surface);
    const BezierPatches patches = bezier_patches(surface);
    for (const BezierPatch& patch : patches.patches) {
        UmbilicEquations forms;
        forms.form_fundamental(patch, input);
        CurvatureEquations equations;
        forms.form_curvature(equations);
        const EquationScale scale = equation_scale(patch);
        const double unit = scale.position / scale.weight, a = share(random), b = share(random);
        const Curvature c = curvature(surface, patch.domain.u.low + a * patch.domain.u.length(),
                                      patch.domain.v.low + b * patch.domain.v.length());
        const double q = value(equations.q, a, b), s = value(equations.s, a, b), t = value(equations.t, a, b);
        const double w = equations.rational ? value(equations.w, a, b) : 1.0;
        const double gaussian = q * std::pow(w, 4) / (t * t) * unit * unit;
        const double mean = -s * w / (2 * t * std::sqrt(t)) * unit;
        const double rho = std::hypot(c.kappa_max, c.kappa_min);
        EXPECT_NEAR(gaussian, c.gaussian(), 1e-8 * rho * rho);
        EXPECT_NEAR(mean, c.mean(), 1e-8 * rho);
    }
}

TEST(CurvatureEquations, GiveTheCurvaturesAtRandomPoints) {
    for (unsigned seed = 1; seed <= 40; ++seed) {
        SCOPED_TRACE(seed);
        expect_curvatures(support::random_face(seed).surface, seed);
    }
}

TEST(CurvatureEquations, HaveTheDegreesSaid) {
    const auto degree = [](const NurbsSurface& surface) {
        const BezierPatches patches = bezier_patches(surface);
        UmbilicEquations forms;
        forms.form_fundamental(patches.patches[0], input_rounding(surface));
        CurvatureEquations equations;
        forms.form_curvature(equations);
        EXPECT_EQ(equations.s.u_degree, equations.q.u_degree);
        EXPECT_EQ(equations.t.v_degree, equations.q.v_degree);
        return std::pair(equations.q.u_degree, equations.q.v_degree);
    };
    EXPECT_EQ(degree(support::random_surface(3, 3, 4, 4, 1, 0.3)), std::pair(14, 14));
    EXPECT_EQ(degree(support::random_surface(3, 3, 4, 4, 1, 0.3, 2.0)), std::pair(19, 19));
}

TEST(CurvatureEquations, AreDividedAtPoles) {
    // The octant's side v = 1 is one point: q, s and t keep no factor of the distance from it.
    const NurbsSurface octant = support::ellipsoid_octant(1.0, 1.3, 2.0);
    expect_curvatures(octant, 3);
    const BezierPatches patches = bezier_patches(octant);
    UmbilicEquations forms;
    forms.form_fundamental(patches.patches[0], input_rounding(octant));
    CurvatureEquations equations;
    forms.form_curvature(equations);
    EXPECT_GT(edge_magnitude(equations.t, PatchEdge::v_high), 1e-3 * equations.t.magnitude);
    EXPECT_GT(edge_magnitude(equations.q, PatchEdge::v_high), 1e-3 * equations.q.magnitude);
}

}  // namespace
}  // namespace umbilic
