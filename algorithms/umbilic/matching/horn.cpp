// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/horn.h>

#include <algorithm>
#include <cmath>
#include <string>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <umbilic/core/errors.h>

namespace umbilic {

namespace {

struct CentredSets {
    Vector3 original = Vector3::Zero();  ///< centroid
    Vector3 suspect = Vector3::Zero();
    double original_square = 0.0;  ///< weighted sum of squared distances from the centroid
    double suspect_square = 0.0;
    Matrix3 correlation = Matrix3::Zero();  ///< sum w m n^T, m of the suspect, n of the original
};

void check_numbers(std::span<const PointPair> pairs) {
    if (pairs.size() < 3)
        throw InvalidInput("corresponding points: " + std::to_string(pairs.size()) +
                           " pairs are too few; give at least three that do not lie on a line");
    for (const PointPair& pair : pairs)
        if (!pair.original.allFinite() || !pair.suspect.allFinite() || !std::isfinite(pair.weight) || pair.weight <= 0)
            throw InvalidInput("corresponding points: coordinates must be finite and weights positive");
}

void check_extent(const Matrix3& scatter, const char* which) {
    const Vector3 extent = Eigen::SelfAdjointEigenSolver<Matrix3>(scatter, Eigen::EigenvaluesOnly).eigenvalues();
    if (!(extent[1] > collinear_extent * collinear_extent * extent[2]))
        throw InvalidInput(std::string("corresponding points: those of the ") + which +
                           " coincide or lie on a line; add a pair beside it");
}

/// Throws if either set is collinear.
CentredSets centre(std::span<const PointPair> pairs) {
    CentredSets sets;
    double weight = 0.0;
    for (const PointPair& pair : pairs) {
        sets.original += pair.weight * pair.original;
        sets.suspect += pair.weight * pair.suspect;
        weight += pair.weight;
    }
    sets.original /= weight;
    sets.suspect /= weight;
    Matrix3 original_scatter = Matrix3::Zero(), suspect_scatter = Matrix3::Zero();
    for (const PointPair& pair : pairs) {
        const Vector3 n = pair.original - sets.original, m = pair.suspect - sets.suspect;
        original_scatter += pair.weight * n * n.transpose();
        suspect_scatter += pair.weight * m * m.transpose();
        sets.correlation += pair.weight * m * n.transpose();
    }
    check_extent(original_scatter, "original");
    check_extent(suspect_scatter, "suspect");
    sets.original_square = original_scatter.trace();
    sets.suspect_square = suspect_scatter.trace();
    return sets;
}

Matrix3 best_rotation(const Matrix3& m) {
    Eigen::Matrix4d horn;
    horn << m.trace(), m(1, 2) - m(2, 1), m(2, 0) - m(0, 2), m(0, 1) - m(1, 0),  //
        0, m(0, 0) - m(1, 1) - m(2, 2), m(0, 1) + m(1, 0), m(2, 0) + m(0, 2),    //
        0, 0, -m(0, 0) + m(1, 1) - m(2, 2), m(1, 2) + m(2, 1),                   //
        0, 0, 0, -m(0, 0) - m(1, 1) + m(2, 2);
    horn.triangularView<Eigen::StrictlyLower>() = horn.transpose();
    const Vector4 q = Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d>(horn).eigenvectors().col(3);
    return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
}

}  // namespace

void check_pairs(std::span<const PointPair> pairs) {
    check_numbers(pairs);
    centre(pairs);
}

PointFit fit_points(std::span<const PointPair> pairs, const PointFitOptions& options) {
    check_numbers(pairs);
    const CentredSets sets = centre(pairs);

    SimilarityTransform pose;
    pose.mirrored = options.mirrored;
    const Matrix3 mirror = pose.orthogonal();
    const Matrix3 correlation = mirror * sets.correlation;
    pose.rotation = best_rotation(correlation);
    if (options.free_scale) {
        const double agreement = (pose.rotation * correlation).trace();
        // The greatest eigenvalue is not negative; zero means that the sets have nothing in common.
        if (!(agreement > collinear_extent * std::sqrt(sets.original_square * sets.suspect_square)))
            throw InvalidInput(
                "corresponding points: no rotation brings the two sets closer; check the order of pairs");
        pose.scale = sets.original_square / agreement;
    }
    pose.translation = sets.original - pose.scale * (pose.orthogonal() * sets.suspect);

    PointFit fit{.original_suspect = pose};
    double square = 0.0, weight = 0.0;
    for (const PointPair& pair : pairs) {
        const double residual = (pose.apply(pair.suspect) - pair.original).norm();
        fit.residuals.push_back(residual);
        fit.max = std::max(fit.max, residual);
        square += pair.weight * residual * residual;
        weight += pair.weight;
    }
    fit.rms = std::sqrt(square / weight);
    return fit;
}

}  // namespace umbilic
