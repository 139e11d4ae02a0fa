// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/by_umbilics.h>

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <support/surfaces.h>

namespace umbilic {
namespace {

/// Mark from a cubic in the given frame (thesis (2.28)-(2.29)).
UmbilicMark mark(const Vector3& point, const Vector3& normal, const Vector3& x, double kappa, const Cubic& c) {
    UmbilicMark result{.point = point, .normal = normal, .x = x, .y = normal.cross(x), .kappa = kappa};
    result.alpha = {(c.a - 3 * c.c) / 8, (c.d - 3 * c.b) / 8};
    result.beta = {(c.a + c.c) / 8, (c.b + c.d) / 8};
    const double square = std::norm(result.alpha) + std::norm(result.beta);
    result.delta = (std::norm(result.alpha) - std::norm(result.beta)) / square;
    result.zeta = result.alpha * std::pow(result.beta, 3) / (square * square);
    return result;
}

struct Random {
    std::mt19937 engine;
    std::normal_distribution<double> normal;
    double operator()() { return normal(engine); }
};

/// The umbilic of a moved copy, in a tangent frame turned by `angle`, from the transformed surface itself: the cubic is
/// rebuilt from heights, not from the rules under test.
UmbilicMark copied(const UmbilicMark& m, const Cubic& cubic, const SimilarityTransform& pose, double angle,
                   bool other_side) {
    const Matrix3 q = pose.orthogonal();
    const Vector3 normal = (other_side ? -1.0 : 1.0) * (q * m.normal);
    const Vector3 x = q * Vector3(std::cos(angle) * m.x + std::sin(angle) * m.y);
    const Vector3 y = normal.cross(x);
    // Height of the copy over its tangent plane at p = x' x + y' y: pull back to the old frame.
    const auto height = [&](double s, double t) {
        const Vector3 old = q.transpose() * Vector3(s * x + t * y) / pose.scale;
        const double u = old.dot(m.x), v = old.dot(m.y);
        const double h = cubic.a * u * u * u + 3 * cubic.b * u * u * v + 3 * cubic.c * u * v * v + cubic.d * v * v * v;
        return (other_side ? -1.0 : 1.0) * pose.scale * h;
    };
    const double a = height(1, 0), d = height(0, 1), plus = height(1, 1), minus = height(1, -1);
    // plus = a + 3 b + 3 c + d, minus = a - 3 b + 3 c - d
    const Cubic turned{a, (plus - minus - 2 * d) / 6, (plus + minus - 2 * a) / 6, d};
    const double kappa = (other_side ? -1.0 : 1.0) * m.kappa / pose.scale;
    return mark(pose.apply(m.point), normal, x, kappa, turned);
}

double difference(const SimilarityTransform& a, const SimilarityTransform& b) {
    return (a.scale * a.orthogonal() - b.scale * b.orthogonal()).norm() / b.scale +
           (a.translation - b.translation).norm() / (1.0 + b.translation.norm());
}

TEST(UmbilicPair, OneUmbilicGivesTheWholeSimilarity) {
    Random random{std::mt19937(1)};
    for (unsigned seed = 0; seed < 200; ++seed) {
        const Cubic cubic{random(), random(), random(), random()};
        const auto frame = support::random_similarity(seed + 1000, 1.0, false);
        const double kappa = seed % 5 == 0 ? 0.0 : random();
        const UmbilicMark suspect = mark(frame.translation, frame.rotation.col(2), frame.rotation.col(0), kappa, cubic);
        for (const bool mirror : {false, true})
            for (const bool flip : {false, true}) {
                const auto pose = support::random_similarity(seed, std::exp(random()), mirror);
                const UmbilicMark original = copied(suspect, cubic, pose, random(), flip);
                UmbilicMark read = flip ? flipped(suspect) : suspect;
                if (mirror) read = mirrored(read);
                EXPECT_NEAR(std::abs(original.zeta - read.zeta), 0.0, 1e-12);
                EXPECT_NEAR(original.delta, read.delta, 1e-12);
                EXPECT_NEAR(original.bend(), read.bend(), 1e-12);
                double least = INFINITY;
                for (const SimilarityTransform& found : poses_from_pair(original, read, 0.4))
                    least = std::min(least, difference(found, pose));
                EXPECT_LT(least, 1e-10) << "seed " << seed << " mirror " << mirror << " flip " << flip;
            }
    }
}

TEST(UmbilicPair, NumberOfRotationsFollowsTheSymmetryOfTheCubic) {
    const Vector3 o = Vector3::Zero(), z = Vector3::UnitZ(), x = Vector3::UnitX();
    // beta = 0: x^3 - 3 x y^2 is the same after a third of a turn.
    const UmbilicMark three = mark(o, z, x, 1.0, {1, 0, -1, 0});
    EXPECT_EQ(poses_from_pair(three, three, 0.4).size(), 3u);
    // alpha = 0, as on every quadric: x (x^2 + y^2) has one direction only.
    const UmbilicMark one = mark(o, z, x, 1.0, {3, 0, 1, 0});
    const auto poses = poses_from_pair(one, one, 0.4);
    ASSERT_EQ(poses.size(), 1u);
    EXPECT_LT((poses[0].rotation - Matrix3::Identity()).norm(), 1e-12);
    // They do not fit each other.
    EXPECT_TRUE(poses_from_pair(one, three, 0.4).empty());
}

}  // namespace
}  // namespace umbilic
