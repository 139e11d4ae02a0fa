// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/points/point_jets.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/QR>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <umbilic/core/errors.h>

namespace umbilic {

namespace {

constexpr int degree = 4;
constexpr int coefficients = (degree + 1) * (degree + 2) / 2;
/// Standard deviation of the Gaussian weight, relative to the radius.
constexpr double weight_width = 0.5;
/// Fits in the frame of the last normal: the first from the regression plane, the others refine.
constexpr int rounds = 3;
/// Least ratio of the diagonal of R to its greatest: below it the neighbours lie on a curve.
constexpr double least_rank = 1e-8;
/// A fit whose heights rise faster than this over the plane is of another sheet or of nothing.
constexpr double steepest = 2.0;

using Coefficients = Eigen::Matrix<double, coefficients, 1>;
using Normals = Eigen::Matrix<double, coefficients, coefficients>;

constexpr std::array<std::array<int, 2>, coefficients> powers = [] {
    std::array<std::array<int, 2>, coefficients> result{};
    int k = 0;
    for (int n = 0; n <= degree; ++n)
        for (int j = 0; j <= n; ++j) result[k++] = {n - j, j};
    return result;
}();

/// Index of x^i y^j.
constexpr int term(int i, int j) {
    return (i + j) * (i + j + 1) / 2 + j;
}

constexpr double factorial(int n) {
    return n < 2 ? 1.0 : n * factorial(n - 1);
}

/// Polynomial height over a frame, in units of the radius.
struct Fit {
    Matrix3 frame;  ///< columns x, y, normal
    Coefficients height;
    Normals covariance;  ///< of the heights' coefficients, for residuals of standard deviation 1
    double residual = 0.0;
};

std::optional<Fit> fitted(const Vector3& centre, const Matrix3& frame, std::span<const Vector3> points,
                          const std::vector<Neighbour>& near, double radius) {
    const int count = static_cast<int>(near.size());
    Eigen::Matrix<double, Eigen::Dynamic, coefficients> rows(count, coefficients);
    Eigen::VectorXd heights(count), roots(count);
    for (int k = 0; k < count; ++k) {
        const Vector3 local = frame.transpose() * (points[near[k].index] - centre) / radius;
        roots[k] = std::exp(-0.25 * near[k].squared_distance / (radius * radius * weight_width * weight_width));
        double x[degree + 1] = {1.0}, y[degree + 1] = {1.0};
        for (int n = 0; n < degree; ++n) x[n + 1] = x[n] * local.x(), y[n + 1] = y[n] * local.y();
        for (int t = 0; t < coefficients; ++t) rows(k, t) = roots[k] * x[powers[t][0]] * y[powers[t][1]];
        heights[k] = roots[k] * local.z();
    }
    const Eigen::ColPivHouseholderQR<Eigen::Matrix<double, Eigen::Dynamic, coefficients>> qr(rows);
    const auto diagonal = qr.matrixR().diagonal().cwiseAbs();
    if (!(diagonal.minCoeff() > least_rank * diagonal.maxCoeff())) return {};
    Fit fit{.frame = frame, .height = qr.solve(heights)};
    if (!fit.height.allFinite()) return {};
    const Eigen::VectorXd residuals = heights - rows * fit.height;

    // Sandwich of weighted least squares with independent residuals; their variance from the weighted sum, whose
    // expectation is sigma^2 (trace W - trace (A^T W A)^-1 A^T W^2 A).
    const Normals inverse = (rows.transpose() * rows).inverse();
    const Normals middle = rows.transpose() * roots.array().square().matrix().asDiagonal() * rows;
    fit.covariance = inverse * middle * inverse;
    const double freedom = roots.squaredNorm() - (inverse * middle).trace();
    fit.residual = freedom > 0.0 ? residuals.norm() / std::sqrt(freedom) : 0.0;
    return fit;
}

Matrix3 frame_with_normal(const Vector3& normal) {
    Matrix3 frame;
    const Vector3 x = normal.unitOrthogonal();
    frame << x, normal.cross(x), normal;
    return frame;
}

Matrix3 regression_frame(std::span<const Vector3> points, const std::vector<Neighbour>& near, double radius) {
    Vector3 mean = Vector3::Zero();
    double total = 0.0;
    const auto weight = [&](const Neighbour& n) {
        return std::exp(-0.5 * n.squared_distance / (radius * radius * weight_width * weight_width));
    };
    for (const Neighbour& n : near) {
        mean += weight(n) * points[n.index];
        total += weight(n);
    }
    mean /= total;
    Matrix3 scatter = Matrix3::Zero();
    for (const Neighbour& n : near) {
        const Vector3 d = points[n.index] - mean;
        scatter += weight(n) * d * d.transpose();
    }
    return frame_with_normal(Eigen::SelfAdjointEigenSolver<Matrix3>(scatter).eigenvectors().col(0));
}

/// Largest angle around the point in which no neighbour lies.
double greatest_gap(const Vector3& centre, const Matrix3& frame, std::span<const Vector3> points,
                    const std::vector<Neighbour>& near) {
    std::vector<double> angles;
    for (const Neighbour& n : near) {
        if (n.squared_distance == 0.0) continue;
        const Vector3 local = frame.transpose() * (points[n.index] - centre);
        angles.push_back(std::atan2(local.y(), local.x()));
    }
    if (angles.empty()) return 2.0 * std::numbers::pi;
    std::sort(angles.begin(), angles.end());
    double gap = angles.front() + 2.0 * std::numbers::pi - angles.back();
    for (std::size_t i = 1; i < angles.size(); ++i) gap = std::max(gap, angles[i] - angles[i - 1]);
    return gap;
}

/// Every k-th neighbour, so that at most `most` are left, spread over the neighbourhood.
void thin_out(std::vector<Neighbour>& near, int most) {
    if (static_cast<int>(near.size()) <= most) return;
    const double stride = static_cast<double>(near.size()) / most;
    for (int k = 0; k < most; ++k) near[k] = near[static_cast<std::size_t>(k * stride)];
    near.resize(most);
}

std::vector<Neighbour> neighbourhood(const Vector3& centre, const Vector3* normal, const std::vector<Vector3>& normals,
                                     const Neighbours& neighbours, double radius, int fewest) {
    std::vector<Neighbour> near = neighbours.within(centre, radius);
    if (static_cast<int>(near.size()) < fewest) near = neighbours.nearest(centre, fewest);
    if (normal) std::erase_if(near, [&](const Neighbour& n) { return normals[n.index].dot(*normal) < 0.0; });
    return near;
}

PointJet jet_at(int index, const PointCloud& cloud, const std::vector<Vector3>& normals, const Neighbours& neighbours,
                double radius, const JetOptions& options) {
    PointJet jet{.index = index};
    const Vector3& centre = cloud.points[index];
    const Vector3* const normal = normals.empty() || normals[index].isZero() ? nullptr : &normals[index];
    std::vector<Neighbour> near = neighbourhood(centre, normal, normals, neighbours, radius, options.fewest_neighbours);
    if (static_cast<int>(near.size()) <= coefficients) return jet;
    // Where points are sparse the nearest ones reach farther than the radius.
    jet.radius = std::max(radius, std::sqrt(near.back().squared_distance));
    thin_out(near, options.most_neighbours);
    jet.neighbours = static_cast<int>(near.size());

    Matrix3 frame = regression_frame(cloud.points, near, jet.radius);
    std::optional<Fit> fit;
    for (int round = 0; round < rounds; ++round) {
        fit = fitted(centre, frame, cloud.points, near, jet.radius);
        if (!fit) return jet;
        const Vector2 slope(fit->height[term(1, 0)], fit->height[term(0, 1)]);
        if (!(slope.norm() < steepest)) return jet;
        if (round + 1 < rounds) frame = frame_with_normal((frame * Vector3(-slope.x(), -slope.y(), 1.0)).normalized());
    }
    if (normal && frame.col(2).dot(*normal) < 0.0) {
        frame = frame_with_normal(-frame.col(2));
        fit = fitted(centre, frame, cloud.points, near, jet.radius);
        if (!fit) return jet;
    }

    SurfaceDerivatives& d = jet.derivatives;
    d.order = 3;
    for (int k = 0; k <= 3; ++k)
        for (int l = 0; k + l <= 3; ++l) {
            const double height =
                fit->height[term(k, l)] * factorial(k) * factorial(l) * jet.radius / std::pow(jet.radius, k + l);
            d(k, l) = height * frame.col(2);
        }
    d(0, 0) += centre;
    d(1, 0) += frame.col(0);
    d(0, 1) += frame.col(1);
    jet.frame = curvature(d);
    if (!jet.frame.regular) return jet;
    jet.valid = true;
    jet.interior = greatest_gap(centre, frame, cloud.points, near) <= greatest_interior_gap;
    jet.residual = fit->residual * jet.radius;

    // kappa along (c, s) is -(2 a20 c^2 + 2 a11 c s + 2 a02 s^2) / radius where the slope is 0.
    const auto spread = [&](double xx, double xy, double yy) {
        Coefficients g = Coefficients::Zero();
        g[term(2, 0)] = xx, g[term(1, 1)] = xy, g[term(0, 2)] = yy;
        return fit->residual * std::sqrt(std::max(g.dot(fit->covariance * g), 0.0)) / jet.radius;
    };
    const double c = jet.frame.direction_max.dot(frame.col(0)), s = jet.frame.direction_max.dot(frame.col(1));
    jet.kappa_max_error = spread(2 * c * c, 2 * c * s, 2 * s * s);
    jet.kappa_min_error = spread(2 * s * s, -2 * c * s, 2 * c * c);
    const double mixed = spread(-2 * c * s, c * c - s * s, 2 * c * s);
    jet.direction_error =
        std::min(std::atan2(mixed, jet.frame.kappa_max - jet.frame.kappa_min), 0.5 * std::numbers::pi);
    return jet;
}

}  // namespace

double cloud_length(std::span<const Vector3> points) {
    if (points.empty()) return 0.0;
    Vector3 centroid = Vector3::Zero();
    for (const Vector3& p : points) centroid += p / static_cast<double>(points.size());
    double square = 0.0;
    for (const Vector3& p : points) square += (p - centroid).squaredNorm() / static_cast<double>(points.size());
    return 2.0 * std::sqrt(square);
}

std::vector<PointJet> point_jets(const PointCloud& cloud, const Neighbours& neighbours, std::span<const int> indices,
                                 const JetOptions& options, const Progress& progress) {
    const double radius = options.radius.value_or(default_jet_radius * cloud_length(cloud.points));
    if (options.radius && !(std::isfinite(radius) && radius > 0.0))
        throw InvalidInput("jets: the radius of the neighbourhood must be a positive length in mm");
    const std::vector<Vector3> normals = outward_normals(cloud);
    std::vector<PointJet> jets(indices.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, indices.size(), 16), [&](const auto& range) {
        progress.check();
        for (std::size_t i = range.begin(); i < range.end(); ++i)
            jets[i] = jet_at(indices[i], cloud, normals, neighbours, radius, options);
    });
    return jets;
}

double estimated_noise(std::span<const PointJet> jets) {
    std::vector<double> residuals;
    for (const PointJet& jet : jets)
        if (jet.valid && jet.interior) residuals.push_back(jet.residual);
    if (residuals.empty()) return 0.0;
    const auto middle = residuals.begin() + static_cast<std::ptrdiff_t>(residuals.size() / 2);
    std::nth_element(residuals.begin(), middle, residuals.end());
    return *middle;
}

}  // namespace umbilic
