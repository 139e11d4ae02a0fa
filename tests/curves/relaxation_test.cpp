// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/curves/relaxation.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <support/surfaces.h>
#include <umbilic/core/errors.h>
#include <umbilic/curves/geodesic_path.h>

namespace umbilic {
namespace {

/// y'' = exp(y), y(0) = y(1) = 0 (Bratu's problem): y = ln(2 c^2) - 2 ln cos(c (x - 1/2)), c from the ends.
double bratu(double x) {
    double c = 0.7;
    for (int i = 0; i < 100; ++i)
        c -= (std::log(2 * c * c) - 2 * std::log(std::cos(c / 2))) / (2 / c + std::tan(c / 2));
    return std::log(2 * c * c) - 2 * std::log(std::cos(c * (x - 0.5)));
}

BoundaryValueProblem bratu_problem() {
    BoundaryValueProblem problem;
    problem.rate = [](const Eigen::VectorXd& y, Eigen::VectorXd& g) {
        g[0] = y[1];
        g[1] = std::exp(y[0]);
        return true;
    };
    problem.at_start = {{0, 0.0}};
    problem.at_end = {{0, 0.0}};
    problem.scale = Eigen::Vector2d(1, 1);
    problem.distance = [](const Eigen::VectorXd& a, const Eigen::VectorXd& b) { return std::abs(a[0] - b[0]); };
    return problem;
}

double largest_error(const Relaxation& relaxation) {
    double error = 0.0;
    for (Eigen::Index k = 0; k < relaxation.states.cols(); ++k)
        error = std::max(
            error, std::abs(relaxation.states(0, k) - bratu(static_cast<double>(k) / (relaxation.states.cols() - 1))));
    return error;
}

TEST(Relaxation, ErrorFallsWithTheSquareOfTheMeshWidth) {
    double before = 0.0;
    for (const int points : {9, 17, 33, 65}) {
        const Relaxation relaxation = relax(bratu_problem(), Eigen::MatrixXd::Zero(2, points), {.epsilon = 1e-10});
        ASSERT_TRUE(relaxation.converged);
        const double error = largest_error(relaxation);
        if (before > 0.0) {
            EXPECT_NEAR(before / error, 4.0, 0.1);
        }
        before = error;
    }
}

TEST(Relaxation, RefinesUntilTheStatedErrorIsMet) {
    for (const double tolerance : {1e-4, 1e-6}) {
        const Relaxation relaxation =
            relax(bratu_problem(), Eigen::MatrixXd::Zero(2, 5), {.epsilon = 1e-10, .tolerance = tolerance});
        ASSERT_TRUE(relaxation.converged);
        EXPECT_LE(relaxation.error, tolerance);
        EXPECT_LE(largest_error(relaxation), relaxation.error);
    }
    const Relaxation limited =
        relax(bratu_problem(), Eigen::MatrixXd::Zero(2, 5), {.epsilon = 1e-10, .tolerance = 1e-12, .most_points = 33});
    EXPECT_FALSE(limited.converged);
}

TEST(Relaxation, GeodesicOfTheThesisFigureConvergesInAtMostFiveIterations) {
    // Fig. 3-2: a bicubic patch of 4 x 4 control points, ends (0.2, 0.3) and (0.8, 0.9), 33 mesh points, 1e-5. Its
    // control points are not printed; these have rises of up to a third of the side.
    for (unsigned seed = 1; seed <= 12; ++seed) {
        const Model model = support::model_of({support::smooth_bicubic(4, seed, 0.35)});
        const Face& face = model.faces[0];
        const Vector2 from(0.2, 0.3), to(0.8, 0.9);
        const Relaxation relaxation =
            relax(geodesic_problem(face, from, to), straight_guess(from, to, 33), {.epsilon = 1e-5});
        ASSERT_TRUE(relaxation.converged) << seed;
        EXPECT_LE(relaxation.iterations, 5) << seed;
    }
}

TEST(Relaxation, GeodesicHasConstantSpeedAndMeetsTheGreatCircle) {
    Model model = support::model_of({support::full_sphere(2.0)});
    const Face& face = model.faces[0];
    const Vector2 from(0.2, 0.3), to(0.9, 0.8);  // no knot line between: second derivatives jump there
    const Relaxation relaxation =
        relax(geodesic_problem(face, from, to), straight_guess(from, to, 33), {.epsilon = 1e-8, .tolerance = 1e-6});
    ASSERT_TRUE(relaxation.converged);
    const Vector3 a = face.surface.value(0.2, 0.3), b = face.surface.value(0.9, 0.8);
    const double angle = std::acos(a.dot(b) / 4);
    for (Eigen::Index k = 0; k < relaxation.states.cols(); ++k) {
        const double x = static_cast<double>(k) / (relaxation.states.cols() - 1);
        const Vector3 expected = (std::sin((1 - x) * angle) * a + std::sin(x * angle) * b) / std::sin(angle);
        const Eigen::VectorXd y = relaxation.states.col(k);
        EXPECT_LE((face.surface.value(y[0], y[1]) - expected).norm(), relaxation.error);
        const SurfaceDerivatives d = face.surface.derivatives(y[0], y[1], 1);
        EXPECT_NEAR((d.r_u() * y[2] + d.r_v() * y[3]).norm(), 2 * angle, 1e-5);
    }
}

TEST(Relaxation, ReportsWhatCannotBeRelaxedAndRefusesWhatDoesNotFit) {
    BoundaryValueProblem problem = bratu_problem();
    problem.rate = [](const Eigen::VectorXd& y, Eigen::VectorXd& g) {
        g[0] = y[1];
        g[1] = -4 * std::exp(y[0]);  // has no solution above 3.514 instead of 4
        return true;
    };
    EXPECT_FALSE(relax(problem, Eigen::MatrixXd::Zero(2, 17)).converged);
    EXPECT_THROW(relax(bratu_problem(), Eigen::MatrixXd::Zero(2, 1)), InvalidInput);
    EXPECT_THROW(relax(bratu_problem(), Eigen::MatrixXd::Zero(3, 9)), InvalidInput);
    problem.at_end.clear();
    EXPECT_THROW(relax(problem, Eigen::MatrixXd::Zero(2, 9)), InvalidInput);
}

}  // namespace
}  // namespace umbilic
