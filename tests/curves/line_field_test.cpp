// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/curves/line_field.h>

#include <gtest/gtest.h>

#include <cmath>

#include <Eigen/Geometry>
#include <support/reparametrisation.h>
#include <support/surfaces.h>
#include <umbilic/core/errors.h>

namespace umbilic {
namespace {

TEST(LineField, OfATorusFollowsItsCirclesAndOfAReversedFaceTheOtherFamily) {
    Model model = support::model_of({support::full_torus(3.0, 1.0)});
    for (const bool reversed : {false, true}) {
        model.faces[0].reversed = reversed;
        const FaceLineField field(model.faces[0]);
        for (const Vector2& at : {Vector2(0.3, 0.4), Vector2(1.7, 2.9)}) {
            const FieldValue a = field.value(at, CurvatureFamily::maximum),
                             b = field.value(at, CurvatureFamily::minimum);
            ASSERT_FALSE(field.indeterminate(a));
            EXPECT_NEAR(a.tangent.dot(b.tangent), 0.0, 1e-12);
            // One family are the circles around the axis.
            const Vector3 around = Vector3::UnitZ().cross(a.point).normalized();
            const double share = std::max(std::abs(a.tangent.dot(around)), std::abs(b.tangent.dot(around)));
            EXPECT_NEAR(share, 1.0, 1e-12);
            const Vector2 rate = a.rates(a.tangent);
            EXPECT_LT((a.r_u * rate.x() + a.r_v * rate.y() - a.tangent).norm(), 1e-12);
            model.faces[0].reversed = !reversed;
            EXPECT_NEAR(std::abs(a.tangent.dot(field.value(at, CurvatureFamily::minimum).tangent)), 1.0, 1e-12);
            model.faces[0].reversed = reversed;
        }
    }
}

TEST(LineField, AlongAnAxisClimbsOnAPlane) {
    const Model model = support::model_of({support::graph_patch(3, 3, [](double u, double) { return 2.0 * u; })});
    const FaceLineField field(model.faces[0], {.axis = Vector3::UnitZ()});
    const FieldValue climbing = field.value({0.4, 0.6}, CurvatureFamily::maximum);
    EXPECT_LT((climbing.tangent - Vector3(1, 0, 2).normalized()).norm(), 1e-12);
    EXPECT_NEAR(climbing.spread, 2.0 / std::sqrt(5.0), 1e-12);
    EXPECT_NEAR(std::abs(field.value({0.4, 0.6}, CurvatureFamily::minimum).tangent.y()), 1.0, 1e-12);
    // A plane has no lines of curvature.
    const FaceLineField own(model.faces[0]);
    EXPECT_TRUE(own.indeterminate(own.value({0.4, 0.6}, CurvatureFamily::maximum)));
}

TEST(LineField, PiecesWithoutWidthAreCarriedByTheOneBefore) {
    const double knots[] = {0.5, 0.5 + 1e-10};
    const NurbsSurface surface =
        support::with_knots(support::graph_patch(3, 3, [](double u, double v) { return u * u - 0.5 * v * v; }), knots,
                            {})
            .surface;
    const Model model = support::model_of({surface});
    const FaceLineField field(model.faces[0]);
    ASSERT_EQ(field.breaks(0).size(), 4u);
    EXPECT_EQ(field.carrier(0, 0), 0);
    EXPECT_EQ(field.carrier(0, 1), 0);
    EXPECT_EQ(field.carrier(0, 2), 2);
    EXPECT_EQ(field.carried(0, 0), (std::array<int, 2>{0, 2}));
    EXPECT_EQ(field.piece_at({0.5 + 5e-11, 0.3}), (std::array<int, 2>{0, 0}));
}

TEST(LineField, RefusesAFaceWithoutExtent) {
    const NurbsSurface point(KnotVector::bezier(1), KnotVector::bezier(1), std::vector<Vector3>(4, Vector3::Ones()));
    Face face{.number = 3, .surface = point, .region = TrimmingRegion(point.domain())};
    EXPECT_THROW(FaceLineField{face}, InvalidInput);
}

}  // namespace
}  // namespace umbilic
