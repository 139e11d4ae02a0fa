// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/evidence.h>

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include <support/surfaces.h>

namespace umbilic {
namespace {

constexpr double tolerance = 1e-3, far = 1.0;

/// What the samples say if just those that are `covered` lie on the other model.
int equations(const Model& model, const std::function<bool(const Vector3&)>& covered) {
    const PreparedModel prepared = prepare(model);
    std::vector<double> distances;
    for (const AreaSample& sample : prepared.features.samples)
        distances.push_back(covered(sample.curvature.point) ? 0.0 : far);
    return satisfied_equations(prepared, distances, tolerance, 1.0);
}

bool everywhere(const Vector3&) {
    return true;
}

Model graph(double (*height)(double, double)) {
    return support::model_of({support::graph_patch(4, 4, height)});
}

double wavy(double x, double y) {
    return 0.3 * x * x - 0.2 * x * y * y + 0.1 * y * y * y;
}

TEST(Evidence, OfACurvedSurfaceThatLiesOnTheOtherOverAnAreaIsOfFreeForm) {
    EXPECT_EQ(equations(graph(wavy), everywhere), free_form_equations);
    EXPECT_EQ(equations(graph(wavy), [](const Vector3& p) { return p.head<2>().norm() < 0.5; }), free_form_equations);
}

TEST(Evidence, OfSurfacesThatOnlyCrossIsNone) {
    // Some forty samples a side: the band holds single samples, here and there two in a row.
    const auto crossing = [](const Vector3& p) { return std::abs(p.x() - 0.3 * p.y()) < 0.01; };
    EXPECT_EQ(equations(graph(wavy), crossing), 0);
}

TEST(Evidence, OfOnePlaneIsNoneEvenWithRipplesWithinTheTolerance) {
    EXPECT_EQ(equations(graph([](double, double) { return 0.0; }), everywhere), 0);
    // A ripple of a thousandth whose curvature, over the whole width, would lift the surface by more than a tenth.
    const Model rippled =
        support::model_of({support::graph_patch(12, 1, [](double x, double) { return 1e-3 * std::cos(7.0 * x); })});
    EXPECT_EQ(equations(rippled, everywhere), 0);
}

TEST(Evidence, OfACylinderIsItsAxisAndRadius) {
    // Two for the axis, one for the radius, less the turn about it that nothing fixes.
    EXPECT_EQ(equations(support::model_of({support::full_cone(2.0, 2.0, 3.0)}), everywhere), 2);
}

}  // namespace
}  // namespace umbilic
