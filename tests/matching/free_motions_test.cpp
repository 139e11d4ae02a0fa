// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/free_motions.h>

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <support/surfaces.h>

namespace umbilic {
namespace {

using Matrix7 = Eigen::Matrix<double, 7, 7>;
using Points = std::vector<std::pair<Vector3, Vector3>>;  // with unit normals

constexpr double sensitivity = 1e-4;

/// Points of a surface over [0, 1]^2 with normals by differences, moved by `pose`.
Points points_of(const std::function<Vector3(double, double)>& surface, const SimilarityTransform& pose) {
    Points points;
    constexpr double h = 1e-5;
    for (int i = 0; i < 12; ++i)
        for (int j = 0; j < 12; ++j) {
            const double u = (i + 0.5) / 12, v = (j + 0.5) / 12;
            const Vector3 along_u = surface(u + h, v) - surface(u - h, v),
                          along_v = surface(u, v + h) - surface(u, v - h);
            points.emplace_back(pose.apply(surface(u, v)), pose.apply_direction(along_u.cross(along_v).normalized()));
        }
    return points;
}

struct Open {
    std::vector<FreeMotion> motions;
    Points points;

    const FreeMotion* find(FreeMotionKind kind) const {
        for (const FreeMotion& motion : motions)
            if (motion.kind == kind) return &motion;
        return nullptr;
    }
};

Open open_motions(const std::vector<std::function<Vector3(double, double)>>& surfaces, const SimilarityTransform& pose,
                  bool free_scale = true) {
    Open result;
    for (const auto& surface : surfaces) {
        const Points points = points_of(surface, pose);
        result.points.insert(result.points.end(), points.begin(), points.end());
    }
    Vector3 centre = Vector3::Zero();
    for (const auto& [point, normal] : result.points) centre += point / result.points.size();
    double square = 0.0;
    for (const auto& [point, normal] : result.points) square += (point - centre).squaredNorm() / result.points.size();
    const double radius = std::sqrt(square);
    Matrix7 sum = Matrix7::Zero();
    for (const auto& [point, normal] : result.points) {
        const Vector3 arm = (point - centre) / radius;
        Eigen::Matrix<double, 7, 1> row;
        row << arm.cross(normal), normal, normal.dot(arm);
        sum += row * row.transpose() / result.points.size();
    }
    result.motions = free_motions(sum, centre, radius, sensitivity, free_scale);
    return result;
}

/// How far a small motion takes the points along their normals, relative to how far it takes them at all.
double leaves_surface(const FreeMotion& motion, const Points& points, double size) {
    const bool slides = motion.kind == FreeMotionKind::slide || motion.kind == FreeMotionKind::slide_in_plane;
    const SimilarityTransform moved = motion.by(slides ? 1e-6 * size : 1e-6);
    double along = 0.0, greatest = 0.0;
    for (const auto& [point, normal] : points) {
        const Vector3 way = moved.apply(point) - point;
        along = std::max(along, std::abs(way.dot(normal)));
        greatest = std::max(greatest, way.norm());
    }
    return along / greatest;
}

const auto plane = [](double u, double v) { return Vector3(u, 1.4 * v, 0.5); };
const auto cylinder = [](double u, double v) { return Vector3(2 * std::cos(u), 2 * std::sin(u), 3 * v); };
const auto cone = [](double u, double v) {
    return Vector3((1 + v) * std::cos(2 * u), (1 + v) * std::sin(2 * u), 2 * v);
};
const auto sphere = [](double u, double v) {
    return Vector3(3 * std::cos(u) * std::cos(v), 3 * std::sin(u) * std::cos(v), 3 * std::sin(v));
};
const auto torus = [](double u, double v) {
    return Vector3((3 + std::cos(2 * v)) * std::cos(u), (3 + std::cos(2 * v)) * std::sin(u), std::sin(2 * v));
};
const auto extrusion = [](double u, double v) { return Vector3(u, u * u * u - 0.4 * u, 2 * v); };
const auto helicoid = [](double u, double v) {
    return Vector3((0.5 + v) * std::cos(3 * u), (0.5 + v) * std::sin(3 * u), 0.7 * 3 * u);
};
const auto general_cone = [](double u, double v) {
    return Vector3((1 + v) * Vector3(u, 0.3 * u * u * u - u * u, 1 + 0.2 * u));
};
const auto spiral_shell = [](double u, double v) {
    const Vector3 profile(1 + 0.5 * v, 0.2 * v * v, 0.4 * v);
    return Vector3(std::exp(u) * (Eigen::AngleAxisd(1.5 * u, Vector3::UnitZ()) * profile));
};
const auto saddle = [](double u, double v) { return Vector3(u, v, u * u - 0.7 * v * v + 0.5 * u * u * v); };

struct Case {
    const char* name;
    std::vector<std::function<Vector3(double, double)>> surfaces;
    std::vector<FreeMotionKind> motions;
};

using enum FreeMotionKind;

class FreeMotions : public testing::TestWithParam<Case> {};

TEST_P(FreeMotions, AreThoseOfTheShapeWhereverItStands) {
    for (unsigned seed = 0; seed < 4; ++seed) {
        const SimilarityTransform pose = support::random_similarity(seed, seed % 2 ? 0.05 : 30.0, seed > 1, 20.0);
        const Open open = open_motions(GetParam().surfaces, pose);
        std::vector<FreeMotionKind> kinds;
        for (const FreeMotion& motion : open.motions) {
            kinds.push_back(motion.kind);
            EXPECT_LT(leaves_surface(motion, open.points, pose.scale), 1e-4) << in_words(motion);
        }
        EXPECT_EQ(kinds, GetParam().motions) << in_words(open.motions);
        // Nothing but size and spirals needs a free scale.
        std::vector<FreeMotionKind> fixed;
        for (const FreeMotion& motion : open_motions(GetParam().surfaces, pose, false).motions)
            fixed.push_back(motion.kind);
        std::erase_if(kinds, [](FreeMotionKind kind) { return kind == size || kind == spiral; });
        EXPECT_EQ(fixed, kinds);
    }
}

INSTANTIATE_TEST_SUITE_P(, FreeMotions,
                         testing::Values(Case{"plane", {plane}, {turn, slide_in_plane, size}},
                                         Case{"cylinder", {cylinder}, {turn, slide}},
                                         Case{"cone", {cone}, {turn, size}},
                                         Case{"sphere", {sphere}, {turn_about_point}}, Case{"torus", {torus}, {turn}},
                                         Case{"extrusion", {extrusion}, {slide}}, Case{"helicoid", {helicoid}, {screw}},
                                         Case{"general_cone", {general_cone}, {size}},
                                         Case{"spiral_shell", {spiral_shell}, {spiral}}, Case{"saddle", {saddle}, {}},
                                         Case{"hole_in_a_plate", {plane, cylinder}, {turn}},
                                         Case{"cylinder_beside_a_saddle", {saddle, cylinder}, {}}),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(FreeMotion, HasTheAxisOfACylinderAndTheApexOfACone) {
    const SimilarityTransform pose = support::random_similarity(7, 3.0, false, 20.0);
    const Open tube = open_motions({cylinder}, pose);
    const FreeMotion* turn_of_tube = tube.find(turn);
    ASSERT_NE(turn_of_tube, nullptr);
    const Vector3 axis = pose.apply_direction(Vector3::UnitZ());
    EXPECT_LT(turn_of_tube->direction.cross(axis).norm(), 1e-9);
    EXPECT_LT((turn_of_tube->point - pose.translation).cross(axis).norm(), 1e-8);

    const Open funnel = open_motions({cone}, pose);
    const FreeMotion* grows = funnel.find(size);
    ASSERT_NE(grows, nullptr);
    EXPECT_LT((grows->point - pose.apply(Vector3(0, 0, -2))).norm(), 1e-6);
}

TEST(FreeMotion, ScrewsOfMirrorImagesTurnTheOtherWay) {
    const SimilarityTransform pose = support::random_similarity(8, 2.0, true);
    const Open there = open_motions({helicoid}, SimilarityTransform()), here = open_motions({helicoid}, pose);
    ASSERT_EQ(there.motions.size(), 1u);
    ASSERT_EQ(here.motions.size(), 1u);
    EXPECT_NEAR(there.motions[0].pitch, 0.7, 1e-6);
    const FreeMotion moved = there.motions[0].seen_through(pose);
    EXPECT_NEAR(moved.pitch, -1.4, 1e-6);
    EXPECT_NEAR(here.motions[0].pitch, moved.pitch, 1e-6);
    EXPECT_LT((here.motions[0].direction - moved.direction).norm(), 1e-6);
}

TEST(FreeMotion, KnowsTheAmountOfAMotionThatItMade) {
    const Vector3 point(3, -1, 2), axis = Vector3(1, 2, 2) / 3.0;
    for (const FreeMotionKind kind : {FreeMotionKind::turn, FreeMotionKind::slide, FreeMotionKind::screw,
                                      FreeMotionKind::size, FreeMotionKind::spiral}) {
        const bool pitched = kind == FreeMotionKind::screw || kind == FreeMotionKind::spiral;
        const FreeMotion motion{kind, point, kind == FreeMotionKind::size ? Vector3(0, 0, 0) : axis,
                                pitched ? 0.7 : 0.0};
        for (const double amount : {-1.2, -0.1, 0.4, 2.5}) {
            const std::optional<double> found = motion.amount_of(motion.by(amount));
            ASSERT_TRUE(found) << name(kind);
            EXPECT_NEAR(*found, amount, 1e-12) << name(kind);
        }
    }
    EXPECT_FALSE(FreeMotion{FreeMotionKind::turn_about_point}.amount_of(SimilarityTransform()));
    EXPECT_FALSE(FreeMotion{FreeMotionKind::slide_in_plane}.amount_of(SimilarityTransform()));
}

TEST(FreeMotion, IsSaidInWords) {
    const FreeMotion axis{turn, Vector3(0, 0, 5), Vector3::UnitZ()};
    EXPECT_EQ(in_words(axis), "turns about the axis through (0, 0, 5) along (0, 0, 1)");
    const FreeMotion line{slide, Vector3::Zero(), Vector3::UnitX()};
    EXPECT_EQ(in_words(std::vector{axis, line, FreeMotion{size}}),
              "turns about the axis through (0, 0, 5) along (0, 0, 1), slides along the direction (1, 0, 0) and takes "
              "any size about the point (0, 0, 0)");
}

}  // namespace
}  // namespace umbilic
