// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/analytic_features.h>

#include <gtest/gtest.h>

#include <umbilic/matching/analytic_constraints.h>

#include "mechanical_shapes.h"

namespace umbilic {
namespace {

using support::cylinder;
using support::frustum;
using support::model_of;
using support::rectangle;

std::vector<AnalyticFeature> features_of(const Model& model) {
    return analytic_features(model, area_samples(model, {.count = 800}));
}

TEST(AnalyticFeatures, AreReadFromNurbsFaces) {
    const Model model =
        model_of({rectangle({1, 2, 3}, {4, 0, 0}, {0, 2, 0}), cylinder({1, 0, 0}, {0, 0, 5}, 0.75),
                  frustum({0, 0, 2}, {0, 3, 0}, 1, 2.5), support::full_torus(3, 0.5), support::full_sphere(1.5)});
    const std::vector<AnalyticFeature> features = features_of(model);
    ASSERT_EQ(features.size(), 5u);
    for (std::size_t i = 1; i < features.size(); ++i) EXPECT_GE(features[i - 1].area, features[i].area);
    for (const AnalyticFeature& f : features) {
        ASSERT_EQ(f.faces.size(), 1u);
        switch (f.faces[0]) {
            case 1:
                EXPECT_EQ(f.kind, SurfaceKind::plane);
                EXPECT_LT((f.direction - Vector3::UnitZ()).norm(), 1e-9);
                EXPECT_NEAR(f.point.z(), 3.0, 1e-9);
                break;
            case 2:
                EXPECT_EQ(f.kind, SurfaceKind::cylinder);
                EXPECT_NEAR(f.radius, 0.75, 1e-9);
                EXPECT_LT(f.direction.cross(Vector3::UnitZ()).norm(), 1e-9);
                EXPECT_LT((f.point - Vector3(1, 0, 2.5)).norm(), 0.2);
                EXPECT_EQ(f.side, 1);
                break;
            case 3:
                EXPECT_EQ(f.kind, SurfaceKind::cone);
                EXPECT_LT((f.point - Vector3(0, -2, 2)).norm(), 1e-8);
                EXPECT_LT((f.direction - Vector3::UnitY()).norm(), 1e-9);
                EXPECT_NEAR(std::tan(f.semi_angle), 0.5, 1e-9);
                break;
            case 4:
                EXPECT_EQ(f.kind, SurfaceKind::torus);
                EXPECT_NEAR(f.radius, 3.0, 1e-8);
                EXPECT_NEAR(f.minor_radius, 0.5, 1e-8);
                EXPECT_LT(f.point.norm(), 1e-8);
                break;
            case 5:
                EXPECT_EQ(f.kind, SurfaceKind::sphere);
                EXPECT_NEAR(f.radius, 1.5, 1e-9);
                break;
        }
        EXPECT_LT(f.error, 1e-8);
    }
}

TEST(AnalyticFeatures, FacesOnOneSurfaceAreOneFeature) {
    Model model = model_of({rectangle({0, 0, 1}, {1, 0, 0}, {0, 1, 0}), rectangle({5, 5, 1}, {1, 0, 0}, {0, 2, 0}),
                            rectangle({9, 9, 1}, {0, 1, 0}, {1, 0, 0}), rectangle({0, 0, 1.01}, {1, 0, 0}, {0, 1, 0}),
                            cylinder({0, 0, 2}, {0, 0, 1}, 0.5), cylinder({0, 0, 5}, {0, 0, -1}, 0.5),
                            cylinder({0, 0, 7}, {0, 0, 1}, 0.6)});
    model.faces[5].reversed = model.faces[4].reversed;
    std::vector<std::vector<int>> faces;
    for (const AnalyticFeature& feature : features_of(model)) faces.push_back(feature.faces);
    std::sort(faces.begin(), faces.end());
    // The third rectangle faces the other way.
    EXPECT_EQ(faces, (std::vector<std::vector<int>>{{1, 2}, {3}, {4}, {5, 6}, {7}}));
}

TEST(AnalyticConstraints, NullSpaceHoldsTheMotionsOfTheSurface) {
    const Model model = model_of({cylinder({1, 2, 0}, {0, 0, 5}, 0.75)});
    const AnalyticFeature feature = features_of(model).front();
    const Vector3 centre(0.5, 0.5, 0.5);
    const auto matrix = feature_constraints(feature, centre, 2.0);
    using Vector7 = Eigen::Matrix<double, 7, 1>;
    Vector7 turn = Vector7::Zero(), slide = Vector7::Zero(), size = Vector7::Zero();
    turn.head<3>() = Vector3::UnitZ();
    turn.segment<3>(3) = -Vector3::UnitZ().cross(Vector3(1, 2, 0) - centre) / 2.0;
    slide[5] = 1.0;
    size[6] = 1.0;
    EXPECT_LT((matrix * turn).norm(), 1e-9);
    EXPECT_LT((matrix * slide).norm(), 1e-9);
    EXPECT_GT((matrix * size).norm(), 1e-2);
}

TEST(AnalyticConstraints, BasesFixASimilarityWhereTheFeaturesDo) {
    const auto bases_of = [](const std::vector<NurbsSurface>& faces, bool known_scale) {
        const std::vector<AnalyticFeature> features = features_of(model_of(faces));
        return choose_bases(features, std::vector<int>(features.size(), 10), known_scale, 4);
    };
    const auto bases = bases_of(support::bracket(), false);
    ASSERT_EQ(bases.size(), 4u);
    for (const AnalyticBasis& basis : bases) {
        EXPECT_TRUE(basis.determined);
        EXPECT_LE(basis.features.size(), 6u);
    }
    // Two holes in a plate.
    EXPECT_TRUE(bases_of({rectangle({0, 0, 0}, {5, 0, 0}, {0, 5, 0}), cylinder({1, 1, 0}, {0, 0, 1}, 1),
                          cylinder({-2, 1, 0}, {0, 0, 1}, 1)},
                         false)
                    .front()
                    .determined);
    // One hole turns; three planes have no size unless it is known.
    EXPECT_FALSE(bases_of({rectangle({0, 0, 0}, {5, 0, 0}, {0, 5, 0}), cylinder({1, 1, 0}, {0, 0, 1}, 1)}, false)
                     .front()
                     .determined);
    const std::vector<NurbsSurface> corner = {rectangle({0, 0, 0}, {5, 0, 0}, {0, 5, 0}),
                                              rectangle({0, 0, 0}, {0, 5, 0}, {0, 0, 5}),
                                              rectangle({0, 0, 0}, {5, 0, 0}, {0, 0, 5})};
    EXPECT_FALSE(bases_of(corner, false).front().determined);
    EXPECT_TRUE(bases_of(corner, true).front().determined);
}

}  // namespace
}  // namespace umbilic
