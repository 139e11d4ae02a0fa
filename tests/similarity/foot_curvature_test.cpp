// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <similarity/shapes.h>
#include <support/surfaces.h>
#include <umbilic/similarity/foot_curvature.h>

namespace umbilic {
namespace {

TEST(FootCurvature, AwayFromKnotsThereIsOneCurvature) {
    const Model model = support::model_of({test::half_flat()});
    EXPECT_EQ(curvatures_within(model.faces[0], 0.5, 0.5, 0.1).size(), 1u);
}

TEST(FootCurvature, BesideAKnotWhereItJumpsBothSidesAreOffered) {
    const Model model = support::model_of({test::half_flat()});
    const auto found = curvatures_within(model.faces[0], 0.001, 0.5, 0.01);
    ASSERT_GE(found.size(), 2u);
    const auto has = [&](double kappa_max) {
        return std::ranges::any_of(found,
                                   [&](const Curvature& c) { return std::abs(c.kappa_max - kappa_max) < 1e-12; });
    };
    EXPECT_TRUE(has(2.0));
    EXPECT_TRUE(has(0.0));
}

TEST(FootCurvature, ReversedFacesLookAtTheOtherSide) {
    Model model = support::model_of({test::half_flat()});
    model.faces[0].reversed = true;
    const Curvature c = curvatures_within(model.faces[0], -0.5, 0.5, 0.0).front();
    const Curvature plain = curvature(model.faces[0].surface, -0.5, 0.5);
    EXPECT_DOUBLE_EQ(c.kappa_min, -plain.kappa_max);
    EXPECT_LT((c.normal + plain.normal).norm(), 1e-15);
}

TEST(FootCurvature, SimpleKnotsOfCubicsJumpInTheThirdDerivativeOnly) {
    const NurbsSurface surface = support::smooth_bicubic(5, 3);  // one interior knot, at 1/2
    EXPECT_FALSE(near_knot_line(surface, 0.5, 0.2, 0.01, curvature_continuity));
    EXPECT_TRUE(near_knot_line(surface, 0.5, 0.2, 0.01, cubic_form_continuity));
    EXPECT_FALSE(near_knot_line(surface, 0.25, 0.2, 0.01, cubic_form_continuity));
}

}  // namespace
}  // namespace umbilic
