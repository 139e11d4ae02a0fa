// SPDX-License-Identifier: LGPL-2.1-or-later
// The table of docs/conventions.md: curvatures here against the kernel's, whose sign is the opposite.
#include <gtest/gtest.h>

#include <cmath>

#include <GeomLProp_SLProps.hxx>
#include <Geom_BSplineSurface.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <gp_Dir.hxx>

#include <support/surfaces.h>
#include <umbilic/differential/curvature.h>

namespace umbilic {
namespace {

Handle(Geom_BSplineSurface) kernel_surface(const NurbsSurface& surface) {
    TColgp_Array2OfPnt poles(1, surface.u_pole_count(), 1, surface.v_pole_count());
    TColStd_Array2OfReal weights(1, surface.u_pole_count(), 1, surface.v_pole_count());
    for (int i = 0; i < surface.u_pole_count(); ++i)
        for (int j = 0; j < surface.v_pole_count(); ++j) {
            const Vector3& p = surface.pole(i, j);
            poles.SetValue(i + 1, j + 1, gp_Pnt(p.x(), p.y(), p.z()));
            weights.SetValue(i + 1, j + 1, surface.weight(i, j));
        }
    const auto knots = [](const KnotVector& v) {
        const int count = static_cast<int>(v.breaks().size());
        TColStd_Array1OfReal values(1, count);
        TColStd_Array1OfInteger multiplicities(1, count);
        for (int i = 0; i < count; ++i) {
            values.SetValue(i + 1, v.breaks()[i]);
            multiplicities.SetValue(i + 1, i == 0 || i == count - 1 ? v.degree() + 1 : v.degree() - v.continuity(i));
        }
        return std::pair(values, multiplicities);
    };
    const auto [u_values, u_multiplicities] = knots(surface.u_knots());
    const auto [v_values, v_multiplicities] = knots(surface.v_knots());
    return new Geom_BSplineSurface(poles, weights, u_values, v_values, u_multiplicities, v_multiplicities,
                                   surface.u_degree(), surface.v_degree());
}

TEST(CurvatureConvention, IsTheOppositeOfTheKernels) {
    for (unsigned seed = 0; seed < 8; ++seed) {
        const NurbsSurface surface =
            support::random_surface(2 + seed % 4, 3 + seed % 3, 8, 9, seed, 0.3, seed % 2 ? 4.0 : 1.0);
        const Handle(Geom_BSplineSurface) theirs = kernel_surface(surface);
        for (const auto& [u, v] : {std::pair{0.13, 0.42}, {0.57, 0.91}, {0.88, 0.21}}) {
            GeomLProp_SLProps properties(theirs, u, v, 2, 1e-12);
            ASSERT_TRUE(properties.IsCurvatureDefined());
            const Curvature ours = curvature(surface, u, v);
            const double size = std::hypot(ours.kappa_max, ours.kappa_min);
            EXPECT_NEAR(ours.kappa_max, -properties.MinCurvature(), 1e-9 * size);
            EXPECT_NEAR(ours.kappa_min, -properties.MaxCurvature(), 1e-9 * size);
            EXPECT_NEAR(ours.mean(), -properties.MeanCurvature(), 1e-9 * size);
            EXPECT_NEAR(ours.gaussian(), properties.GaussianCurvature(), 1e-9 * size * size);
            gp_Dir most, least;
            properties.CurvatureDirections(most, least);
            const Vector3 expected(least.X(), least.Y(), least.Z());
            EXPECT_NEAR(std::abs(ours.direction_max.dot(expected)), 1.0, 1e-9);
            const gp_Dir normal = properties.Normal();
            EXPECT_NEAR(ours.normal.dot(Vector3(normal.X(), normal.Y(), normal.Z())), 1.0, 1e-12);
        }
    }
}

}  // namespace
}  // namespace umbilic
