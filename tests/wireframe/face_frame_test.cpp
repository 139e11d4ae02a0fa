// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include <support/invariance.h>
#include <support/surfaces.h>
#include <umbilic/wireframe/face_frame.h>

namespace umbilic {
namespace {

std::vector<FaceFrame> frames(const Model& model, double step) {
    const FaceAdjacency adjacency = face_adjacency(model);
    const std::vector<FaceBorder> borders = border_nodes(adjacency, {.step = step});
    std::vector<FaceFrame> result;
    for (std::size_t i = 0; i < model.faces.size(); ++i)
        result.push_back(face_frame(model.faces[i], borders[i], std::nullopt, model.size()));
    return result;
}

TEST(FaceFrame, MovesWithTheShapeHoweverItIsDescribed) {
    const Model model = support::model_of({support::smooth_bicubic(8, 2), support::torus_quarter(3, 1)});
    const double step = 0.05 * model.size();
    const std::vector<FaceFrame> original = frames(model, step);
    std::vector<support::Invariance> ways = support::similarities();
    for (support::Invariance& way : support::reparametrisations()) ways.push_back(std::move(way));
    for (const support::Invariance& way : ways) {
        SCOPED_TRACE(way.name);
        const support::ModelCopy copy = way.copy(model);
        const std::vector<FaceFrame> moved = frames(copy.model, step * copy.space.scale);
        // A quarter of a torus has planes of symmetry: its direction is settled up to them.
        const FaceFrame &before = original[0], &after = moved[0];
        EXPECT_LT((copy.space.apply(before.centroid) - after.centroid).norm(), 1e-6 * after.radius);
        EXPECT_NEAR(after.radius, before.radius * copy.space.scale, 1e-6 * after.radius);
        EXPECT_LT((copy.space.apply_direction(before.lean) - after.lean).norm(), 1e-5);
        EXPECT_NEAR(after.lean.norm(), 1.0, 1e-12);
        EXPECT_LT((copy.space.apply(before.centroid + before.corner) - after.centroid - after.corner).norm(),
                  1e-6 * after.radius);
    }
}

TEST(FaceFrame, OfASymmetricFacePrefersOnePlaceOfEachSet) {
    // The corners of a square, whichever of them is chosen, stand in the same order.
    const auto preferences = [](const Model& model) {
        const FaceFrame frame = frames(model, 0.1 * model.size()).front();
        std::array<double, 4> result{};
        const ParameterBox d = model.faces.front().surface.domain();
        const std::array<Vector2, 4> corners = {
            {{d.u.low, d.v.low}, {d.u.high, d.v.low}, {d.u.high, d.v.high}, {d.u.low, d.v.high}}};
        for (int i = 0; i < 4; ++i)
            result[i] = frame.preference(model.faces.front().surface.value(corners[i].x(), corners[i].y()));
        std::sort(result.begin(), result.end());
        return result;
    };
    const Model square = support::model_of({support::smooth_bicubic(6, 1, 0.0)});
    const std::array<double, 4> expected = preferences(square);
    for (int i = 1; i < 4; ++i) EXPECT_GT(expected[i] - expected[i - 1], 0.05);
    for (const support::Invariance& way : support::similarities()) {
        SCOPED_TRACE(way.name);
        const std::array<double, 4> found = preferences(way.copy(square).model);
        for (int i = 0; i < 4; ++i) EXPECT_NEAR(found[i], expected[i], 1e-6);
    }
}

TEST(FaceFrame, OfASphereKeepsAwayFromThePolesOfItsParametrisation) {
    const Model model = support::model_of({support::full_sphere(2.0)});
    const FaceFrame frame = frames(model, 0.2).front();
    EXPECT_LT(frame.centroid.norm(), 1e-9);
    EXPECT_NEAR(frame.radius, 2.0, 1e-9);
    for (const Vector3& direction : {frame.lean, Vector3(frame.corner.normalized())})
        EXPECT_LT(std::abs(direction.z()), 0.9);
}

}  // namespace
}  // namespace umbilic
