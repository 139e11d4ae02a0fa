// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/quadric.h>

#include <cmath>

#include <Eigen/Eigenvalues>

namespace umbilic {

namespace {

using Row = Eigen::Matrix<double, 10, 1>;
using Form = Eigen::Matrix<double, 10, 10>;

/// Directions in which the gradients' form is below this part of its greatest are constants and multiples of planes.
constexpr double negligible_gradient = 1e-12;

Row monomials(const Vector3& p) {
    Row row;
    row << p.x() * p.x(), p.y() * p.y(), p.z() * p.z(), p.x() * p.y(), p.y() * p.z(), p.z() * p.x(), p.x(), p.y(),
        p.z(), 1.0;
    return row;
}

Eigen::Matrix<double, 10, 3> gradients(const Vector3& p) {
    Eigen::Matrix<double, 10, 3> g = Eigen::Matrix<double, 10, 3>::Zero();
    g(0, 0) = 2 * p.x(), g(1, 1) = 2 * p.y(), g(2, 2) = 2 * p.z();
    g(3, 0) = p.y(), g(3, 1) = p.x();
    g(4, 1) = p.z(), g(4, 2) = p.y();
    g(5, 2) = p.x(), g(5, 0) = p.z();
    g(6, 0) = g(7, 1) = g(8, 2) = 1.0;
    return g;
}

}  // namespace

double departure_from_quadric(std::span<const Vector3> points) {
    if (points.size() < 10) return 0.0;
    Vector3 centre = Vector3::Zero();
    for (const Vector3& p : points) centre += p / static_cast<double>(points.size());
    double square = 0.0;
    for (const Vector3& p : points) square += (p - centre).squaredNorm() / static_cast<double>(points.size());
    const double size = std::sqrt(square);
    if (!(size > 0.0)) return 0.0;
    Form values = Form::Zero(), slopes = Form::Zero();
    for (const Vector3& p : points) {
        const Vector3 local = (p - centre) / size;
        const Row row = monomials(local);
        const auto gradient = gradients(local);
        values += row * row.transpose() / static_cast<double>(points.size());
        slopes += gradient * gradient.transpose() / static_cast<double>(points.size());
    }
    // min c^T V c / c^T S c: the constant, on which S vanishes, is eliminated first.
    const Eigen::Matrix<double, 9, 9> reduced =
        values.topLeftCorner<9, 9>() - values.block<9, 1>(0, 9) * values.block<1, 9>(9, 0) / values(9, 9);
    Eigen::Matrix<double, 9, 9> metric = slopes.topLeftCorner<9, 9>();
    metric += negligible_gradient * metric.trace() * Eigen::Matrix<double, 9, 9>::Identity();
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix<double, 9, 9>> solver(reduced, metric,
                                                                                       Eigen::EigenvaluesOnly);
    return size * std::sqrt(std::max(solver.eigenvalues()[0], 0.0));
}

}  // namespace umbilic
