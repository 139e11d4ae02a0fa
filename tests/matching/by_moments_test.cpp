// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/by_moments.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <support/surfaces.h>

namespace umbilic {
namespace {

/// Solid box with the given sides, moved.
Solid box(const Vector3& sides, const SimilarityTransform& pose) {
    const double volume = sides.prod();
    const Vector3 square = sides.cwiseProduct(sides) / 12.0;
    const Matrix3 inertia =
        volume * Vector3(square.y() + square.z(), square.x() + square.z(), square.x() + square.y()).asDiagonal();
    Solid solid;
    solid.volume = volume * std::pow(pose.scale, 3);
    solid.centroid = pose.apply(0.5 * sides);
    solid.inertia = std::pow(pose.scale, 5) * pose.orthogonal() * inertia * pose.orthogonal().transpose();
    return solid;
}

/// Solid tetrahedron: covariance of a simplex is the scatter of its corners over 20.
Solid tetrahedron(const std::array<Vector3, 4>& corners) {
    Solid solid;
    Matrix3 edges;
    edges << corners[1] - corners[0], corners[2] - corners[0], corners[3] - corners[0];
    solid.volume = std::abs(edges.determinant()) / 6.0;
    for (const Vector3& c : corners) solid.centroid += c / 4.0;
    Matrix3 covariance = Matrix3::Zero();
    for (const Vector3& c : corners) covariance += (c - solid.centroid) * (c - solid.centroid).transpose() / 20.0;
    solid.inertia = solid.volume * (covariance.trace() * Matrix3::Identity() - covariance);
    return solid;
}

PreparedModel prepared(const Model& model) {
    return {model,
            {},
            ClosestPointTree(support::table_3_1_patch()),
            PrincipalFrameTable(std::vector<PrincipalFrameTable::Entry>(), 0.0)};
}

Model of_solids(std::vector<Solid> solids) {
    Model model;
    model.solids = std::move(solids);
    for (const Solid& solid : model.solids) model.volume += solid.volume;
    return model;
}

double difference(const SimilarityTransform& a, const SimilarityTransform& b) {
    return (a.scale * a.orthogonal() - b.scale * b.orthogonal()).norm() / b.scale +
           (a.translation - b.translation).norm() / (1.0 + b.translation.norm());
}

double least_difference(const Proposals& proposals, const SimilarityTransform& truth) {
    double least = INFINITY;
    for (const PoseHypothesis& hypothesis : proposals.poses)
        least = std::min(least, difference(hypothesis.original_suspect, truth));
    return least;
}

const std::array<Vector3, 4> corners = {Vector3(0, 0, 0), Vector3(3, 0.2, 0.1), Vector3(0.3, 2, 0.5),
                                        Vector3(0.1, 0.7, 1.1)};

Model moved_tetrahedron(const SimilarityTransform& original_suspect) {
    std::array<Vector3, 4> moved;
    for (int i = 0; i < 4; ++i) moved[i] = original_suspect.inverse().apply(corners[i]);
    return of_solids({tetrahedron(moved)});
}

TEST(Moments, ScaleIsTheCubeRootOfTheVolumeRatio) {
    const Model original = of_solids({tetrahedron(corners)});
    for (unsigned seed = 0; seed < 20; ++seed)
        for (const bool mirror : {false, true}) {
            const auto truth = support::random_similarity(seed, 1.6695 * (1 + seed), mirror);
            const Model suspect = moved_tetrahedron(truth);
            const Proposals proposals =
                poses_by_moments(prepared(original), prepared(suspect), {}, MirrorChoice::automatic);
            ASSERT_EQ(proposals.poses.size(), 8u);
            EXPECT_LT(least_difference(proposals, truth), 1e-10);
            for (const PoseHypothesis& hypothesis : proposals.poses)
                EXPECT_NEAR(hypothesis.original_suspect.scale / truth.scale, 1.0, 1e-12);
        }
}

TEST(Moments, FourProperOrientationsWithoutMirrorImages) {
    const Model original = of_solids({tetrahedron(corners)});
    const auto truth = support::random_similarity(3, 0.7, false);
    const Model suspect = moved_tetrahedron(truth);
    const Proposals proposals = poses_by_moments(prepared(original), prepared(suspect), {}, MirrorChoice::never);
    ASSERT_EQ(proposals.poses.size(), 4u);
    for (const PoseHypothesis& hypothesis : proposals.poses) {
        EXPECT_FALSE(hypothesis.original_suspect.mirrored);
        EXPECT_NEAR(hypothesis.original_suspect.rotation.determinant(), 1.0, 1e-12);
    }
    EXPECT_LT(least_difference(proposals, truth), 1e-10);
}

TEST(Moments, SolidsOfAnAssemblyCountTogether) {
    const auto place = support::random_similarity(5, 1.0, false);
    const SimilarityTransform identity;
    SimilarityTransform upper;
    upper.translation = Vector3(0, 0, 1);
    // Two halves of a box, one on the other, are the box.
    const Model halves = of_solids({box({3, 2, 1}, identity), box({3, 2, 1}, upper)});
    const Model whole = of_solids({box({3, 2, 2}, place.inverse())});
    const ShapeMoments a = volume_moments(halves), b = volume_moments(of_solids({box({3, 2, 2}, identity)}));
    EXPECT_NEAR(a.measure, b.measure, 1e-12);
    EXPECT_LT((a.centroid - b.centroid).norm(), 1e-12);
    EXPECT_LT((a.covariance - b.covariance).norm(), 1e-12);
    EXPECT_EQ(moment_symmetry(a), MomentSymmetry::two_smaller_equal);
    EXPECT_NEAR(poses_by_moments(prepared(halves), prepared(whole), {}, MirrorChoice::automatic)
                    .poses.front()
                    .original_suspect.scale,
                1.0, 1e-12);
}

TEST(Moments, EqualMomentsAreSampledAndSaidSo) {
    const auto place = support::random_similarity(8, 2.0, false);
    const SimilarityTransform identity;
    const Model cube = of_solids({box({2, 2, 2}, identity)});
    const Model moved = of_solids({box({2, 2, 2}, place.inverse())});
    EXPECT_EQ(moment_symmetry(volume_moments(cube)), MomentSymmetry::all_equal);
    const Proposals sampled = poses_by_moments(prepared(cube), prepared(moved), {}, MirrorChoice::never);
    EXPECT_NE(sampled.why.find("all rotations were sampled"), std::string::npos);
    double nearest = INFINITY;
    for (const PoseHypothesis& hypothesis : sampled.poses)
        nearest = std::min(nearest, rotation_angle_between(hypothesis.original_suspect.rotation, place.rotation));
    EXPECT_LT(nearest, 0.35);

    const Model plate = of_solids({box({4, 4, 1}, identity)});
    EXPECT_EQ(moment_symmetry(volume_moments(plate)), MomentSymmetry::two_greater_equal);
    const Model moved_plate = of_solids({box({4, 4, 1}, place.inverse())});
    const Proposals turned = poses_by_moments(prepared(plate), prepared(moved_plate), {}, MirrorChoice::never);
    EXPECT_NE(turned.why.find("two principal moments are equal"), std::string::npos);
    for (const double angle : {0.0, 0.3, 1.0, 2.0}) {
        const Matrix3 wanted = Eigen::AngleAxisd(angle, Vector3::UnitZ()) * place.rotation;
        double gap = INFINITY;
        for (const PoseHypothesis& hypothesis : turned.poses)
            gap = std::min(gap, rotation_angle_between(hypothesis.original_suspect.rotation, wanted));
        EXPECT_LT(gap, 0.14) << "angle " << angle;
    }
}

/// Solid prism over a regular polygon of n corners on a circle, along z: sum of its triangular prisms.
Solid prism(int n, double radius, double height, const SimilarityTransform& pose) {
    double area = 0.0;
    Matrix3 square = Matrix3::Zero();
    for (int k = 0; k < n; ++k) {
        const auto corner = [&](int i) {
            const double angle = 2.0 * std::numbers::pi * i / n;
            return Vector3(radius * std::cos(angle), radius * std::sin(angle), 0.0);
        };
        const Vector3 p = corner(k), q = corner(k + 1);
        const double triangle = 0.5 * p.cross(q).norm();
        area += triangle;
        square += triangle / 12.0 * (p * p.transpose() + q * q.transpose() + (p + q) * (p + q).transpose());
    }
    Matrix3 covariance = square / area;
    covariance(2, 2) = height * height / 12.0;
    Solid solid;
    solid.volume = area * height * std::pow(pose.scale, 3);
    solid.centroid = pose.translation;
    covariance = pose.scale * pose.scale * pose.orthogonal() * covariance * pose.orthogonal().transpose();
    solid.inertia = solid.volume * (covariance.trace() * Matrix3::Identity() - covariance);
    return solid;
}

TEST(Moments, NFoldPrismsAreSampledAboutTheirAxis) {
    const auto place = support::random_similarity(9, 0.4, false);
    for (const int n : {3, 4, 5, 6, 9})
        for (const double height : {0.7, 5.0}) {
            const Model original = of_solids({prism(n, 1.0, height, {})});
            const Model moved = of_solids({prism(n, 1.0, height, place.inverse())});
            EXPECT_EQ(moment_symmetry(volume_moments(original)),
                      height > 1.0 ? MomentSymmetry::two_smaller_equal : MomentSymmetry::two_greater_equal);
            const Proposals proposals = poses_by_moments(prepared(original), prepared(moved), {}, MirrorChoice::never);
            EXPECT_NE(proposals.why.find("two principal moments are equal"), std::string::npos);
            // Each of its turns, upright and upside down, has a proposal within half a step of 15 degrees.
            for (int k = 0; k < n; ++k)
                for (const bool turned_over : {false, true}) {
                    const Matrix3 turn =
                        Eigen::AngleAxisd(2.0 * std::numbers::pi * k / n, Vector3::UnitZ()).toRotationMatrix() *
                        (turned_over ? Matrix3(Vector3(1, -1, -1).asDiagonal()) : Matrix3::Identity());
                    double gap = INFINITY;
                    for (const PoseHypothesis& hypothesis : proposals.poses)
                        gap = std::min(
                            gap, rotation_angle_between(hypothesis.original_suspect.rotation, turn * place.rotation));
                    EXPECT_LT(gap, 0.14) << n << "-fold, turn " << k;
                }
        }
    // All three moments equal: height^2 / 12 = radius^2 / 4 (1 - 2/3 sin^2(pi / n)).
    const double height = std::sqrt(3.0 * (1.0 - 2.0 / 3.0 * std::pow(std::sin(std::numbers::pi / 5), 2)));
    EXPECT_EQ(moment_symmetry(volume_moments(of_solids({prism(5, 1.0, height, {})}))), MomentSymmetry::all_equal);
}

TEST(Moments, NearlyEqualOnesAreNeverGuessed) {
    const SimilarityTransform identity;
    const auto place = support::random_similarity(10, 1.8, false);
    // Across the limit of equality the true pose stays among the proposals: exactly by axes, within a step by sampling.
    for (const double excess : {1e-9, 1e-5, 1e-4, 4e-4, 9e-4, 1.2e-3, 1e-2}) {
        const Vector3 sides(2.0, 2.0 + excess, 1.0);
        const Model original = of_solids({box(sides, identity)}), moved = of_solids({box(sides, place.inverse())});
        const Proposals proposals = poses_by_moments(prepared(original), prepared(moved), {}, MirrorChoice::never);
        const bool sampled = moment_symmetry(volume_moments(original)) != MomentSymmetry::none;
        double gap = INFINITY;
        for (const PoseHypothesis& hypothesis : proposals.poses)
            gap = std::min(gap, rotation_angle_between(hypothesis.original_suspect.rotation, place.rotation));
        EXPECT_LT(gap, sampled ? 0.14 : 1e-5) << excess;
        // An axis that rounding gives is one of many: then they are sampled. The relative gap of the moments is about
        // the excess.
        EXPECT_EQ(sampled, excess < 1e-3) << excess;
    }

    // A lump on the suspect exchanges two axes 2 % apart: by their order its pose would be wrong by a quarter turn.
    SimilarityTransform corner;
    corner.translation = Vector3(1.9, 0.9, 0.4);
    const Vector3 sides(2.0, 2.02, 1.0);
    const Model original = of_solids({box(sides, identity)});
    const Model lumpy = of_solids({box(sides, identity), box({0.4, 0.4, 0.4}, corner)});
    const ShapeMoments with_lump = volume_moments(lumpy);
    ASSERT_GT(with_lump.covariance(0, 0), with_lump.covariance(1, 1));
    EXPECT_EQ(moment_symmetry(with_lump), MomentSymmetry::none);
    const Proposals proposals = poses_by_moments(prepared(original), prepared(lumpy), {}, MirrorChoice::never);
    EXPECT_NE(proposals.why.find("two principal moments are equal"), std::string::npos) << proposals.why;
    double gap = INFINITY;
    for (const PoseHypothesis& hypothesis : proposals.poses)
        gap = std::min(gap, rotation_angle_between(hypothesis.original_suspect.rotation, Matrix3::Identity()));
    EXPECT_LT(gap, 0.2);
}

TEST(Moments, EachModelMayLeaveAnotherPairOpen) {
    // Moments 1, 1 + e, 1 + 2 e with e at the limit: two pairs of equals, or one of them, or all three.
    const SimilarityTransform identity;
    const auto with_moments = [&](double first, double second, double third) {
        return of_solids({box(Vector3(std::sqrt(first), std::sqrt(second), std::sqrt(third)), identity)});
    };
    const Model smaller = with_moments(1.0, 1.0009, 1.0021), greater = with_moments(1.0, 1.0012, 1.0021);
    EXPECT_EQ(moment_symmetry(volume_moments(smaller)), MomentSymmetry::two_smaller_equal);
    EXPECT_EQ(moment_symmetry(volume_moments(greater)), MomentSymmetry::two_greater_equal);
    for (const auto& [a, b] : {std::pair(&smaller, &greater), std::pair(&greater, &smaller)}) {
        const Proposals proposals = poses_by_moments(prepared(*a), prepared(*b), {}, MirrorChoice::never);
        EXPECT_NE(proposals.why.find("all rotations were sampled"), std::string::npos) << proposals.why;
    }
}

TEST(Moments, DifferentWholesAndForbiddenScalesProposeNothing) {
    const SimilarityTransform identity;
    const Model a = of_solids({box({3, 2, 1}, identity)}), b = of_solids({box({3, 3, 1}, identity)});
    EXPECT_TRUE(poses_by_moments(prepared(a), prepared(b), {}, MirrorChoice::automatic).poses.empty());
    SimilarityTransform half;
    half.scale = 0.5;
    const Model small = of_solids({box({3, 2, 1}, half)});
    EXPECT_EQ(poses_by_moments(prepared(a), prepared(small), {}, MirrorChoice::never).poses.size(), 4u);
    const ScaleChoice fixed{ScaleChoice::Kind::fixed};
    const Proposals none = poses_by_moments(prepared(a), prepared(small), fixed, MirrorChoice::automatic);
    EXPECT_TRUE(none.poses.empty());
    EXPECT_FALSE(none.why.empty());
}

}  // namespace
}  // namespace umbilic
