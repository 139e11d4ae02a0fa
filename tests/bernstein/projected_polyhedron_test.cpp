// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/bernstein/projected_polyhedron.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <random>
#include <vector>

#include <bernstein/planted_systems.h>
#include <umbilic/core/errors.h>

namespace umbilic {
namespace {

using support::constant;
using support::Exact;
using support::linear_factor;
using System = std::vector<MultivariatePolynomial>;

SystemRoots solve(const System& system, const ProjectedPolyhedronOptions& options = {}) {
    return solve_projected_polyhedron(system, options);
}

bool holds(const std::vector<Interval>& box, const std::vector<Exact>& at) {
    for (std::size_t j = 0; j < at.size(); ++j)
        if (at[j] < Exact(box[j].low) || at[j] > Exact(box[j].high)) return false;
    return true;
}

/// The true solution next to a reported one, found in 100 digits, lies within the radius.
void expect_true_roots(const System& system, const SystemRoots& found) {
    for (const SystemRoot& root : found.roots) {
        ASSERT_TRUE(root.exists);
        std::vector<Exact> at(root.at.begin(), root.at.end());
        ASSERT_TRUE(support::exact_newton(system, at));
        for (std::size_t j = 0; j < at.size(); ++j) {
            ASSERT_LE(abs(at[j] - Exact(root.at[j])), Exact(root.radius[j]));
            ASSERT_LE(root.radius[j], 1e-9);
        }
        ASSERT_TRUE(holds(root.box, at));
    }
}

/// Every solution that Newton's method meets from a grid of starts is within a root's radius or an undecided box.
int expect_none_missed(const System& system, const SystemRoots& found, int per_side) {
    const int l = system[0].unknowns();
    int total = 1, met = 0;
    for (int j = 0; j < l; ++j) total *= per_side;
    for (int start = 0; start < total; ++start) {
        std::vector<Exact> at;
        for (int j = 0, rest = start; j < l; ++j, rest /= per_side) at.emplace_back((rest % per_side + 0.5) / per_side);
        if (!support::exact_newton(system, at)) continue;
        const auto in_domain = [](const Exact& x) { return x >= 0 && x <= 1; };
        if (!std::all_of(at.begin(), at.end(), in_domain)) continue;
        ++met;
        bool known = false;
        for (const SystemRoot& root : found.roots) {
            bool near = true;
            for (int j = 0; j < l; ++j) near = near && abs(at[j] - Exact(root.at[j])) <= Exact(root.radius[j]);
            known = known || near;
        }
        for (const UndecidedBox& undecided : found.undecided) known = known || holds(undecided.box, at);
        EXPECT_TRUE(known);
    }
    return met;
}

System planted_system(int l, int degree, const std::vector<double>& root, std::mt19937_64& engine) {
    System system;
    for (int k = 0; k < l; ++k) {
        std::vector<int> degrees;
        for (int j = 0; j < l; ++j) degrees.push_back(std::uniform_int_distribution<int>(1, degree)(engine));
        system.push_back(support::vanishing_at(support::random_polynomial(degrees, engine), root));
    }
    return system;
}

bool reported(const SystemRoots& found, const std::vector<double>& at, double within) {
    return std::any_of(found.roots.begin(), found.roots.end(), [&](const SystemRoot& root) {
        for (std::size_t j = 0; j < at.size(); ++j)
            if (std::abs(root.at[j] - at[j]) > within) return false;
        return true;
    });
}

class PlantedRoots : public testing::TestWithParam<bool> {};

TEST_P(PlantedRoots, AreFoundAndTheirRadiiAreTrue) {
    std::mt19937_64 engine(20);
    std::uniform_real_distribution<double> number(0.0, 1.0);
    ProjectedPolyhedronOptions options;
    options.precondition = GetParam();
    int roots = 0, met = 0;
    const auto run = [&](int l, int degree, int times, int per_side) {
        for (int k = 0; k < times; ++k) {
            SCOPED_TRACE(testing::Message() << l << " unknowns, system " << k);
            std::vector<double> root;
            for (int j = 0; j < l; ++j) root.push_back(number(engine));
            const System system = planted_system(l, degree, root, engine);
            const SystemRoots found = solve(system, options);
            EXPECT_TRUE(found.undecided.empty());
            EXPECT_FALSE(found.statistics.exhausted);
            EXPECT_TRUE(reported(found, root, 1e-9));
            expect_true_roots(system, found);
            if (k % 4 == 0) met += expect_none_missed(system, found, per_side);
            roots += static_cast<int>(found.roots.size());
        }
    };
    run(1, 12, 150, 12);
    run(2, 6, 150, 4);
    run(3, 3, 60, 2);
    run(4, 2, 8, 2);
    // Random systems have more roots than the planted one, and Newton's method meets some of them.
    EXPECT_GT(roots, 450);
    EXPECT_GT(met, 200);
}

INSTANTIATE_TEST_SUITE_P(ProjectedPolyhedron, PlantedRoots, testing::Bool(),
                         [](const auto& info) { return info.param ? "preconditioned" : "plain"; });

TEST(ProjectedPolyhedron, JacobianSignsAlternateAlongALine) {
    // Wilkinson-like: simple roots k / 8 of one polynomial.
    MultivariatePolynomial f = constant(1, 1.0);
    for (int k = 1; k < 8; ++k) f = f * linear_factor(1, 0, k / 8.0);
    const SystemRoots found = solve({f});
    ASSERT_EQ(found.roots.size(), 7u);
    EXPECT_TRUE(found.undecided.empty());
    for (int k = 1; k < 8; ++k) {
        EXPECT_NEAR(found.roots[k - 1].at[0], k / 8.0, found.roots[k - 1].radius[0]);
        EXPECT_EQ(found.roots[k - 1].jacobian_sign, k % 2 == 1 ? 1 : -1);
    }
}

TEST(ProjectedPolyhedron, JacobianSignOfPlaneSystems) {
    std::mt19937_64 engine(8);
    for (int k = 0; k < 50; ++k) {
        const System system = planted_system(2, 4, {0.4, 0.7}, engine);
        for (const SystemRoot& root : solve(system).roots) {
            const std::vector<Exact> at(root.at.begin(), root.at.end());
            const auto d = [&](int f, int j) { return support::exact_value(system[f], at, j); };
            const Exact determinant = d(0, 0) * d(1, 1) - d(0, 1) * d(1, 0);
            EXPECT_EQ(root.jacobian_sign, determinant > 0 ? 1 : -1);
        }
    }
}

TEST(ProjectedPolyhedron, RootsOnTheBorderAndOnSplitsAppearOnce) {
    // Sides and corners of the domain, its middle, and simple fractions where a split could fall.
    const std::array<double, 6> places = {0.0, 0.25, 0.4871, 0.5, 0.75, 1.0};
    MultivariatePolynomial f = constant(2, 1.0), g = constant(2, 1.0);
    for (const double place : places) {
        f = f * linear_factor(2, 0, place);
        g = g * linear_factor(2, 1, place);
    }
    // Sheared, so that the system does not fall apart into single unknowns.
    for (const bool precondition : {true, false}) {
        ProjectedPolyhedronOptions options;
        options.precondition = precondition;
        const SystemRoots found = solve({f + 0.5 * g, g - 0.5 * f}, options);
        EXPECT_TRUE(found.undecided.empty());
        ASSERT_EQ(found.roots.size(), 36u);
        for (const double x : places)
            for (const double y : places) EXPECT_TRUE(reported(found, {x, y}, 1e-11)) << x << ' ' << y;
    }
}

TEST(ProjectedPolyhedron, RootsOutsideAreNotReported) {
    MultivariatePolynomial f;
    f.degrees = {1};
    // Zeros at -1e-9 and 1 + 1e-9: outside by more than rounding.
    f.coefficients = {1e-9, 1.0 + 1e-9};
    EXPECT_TRUE(solve({f}).roots.empty());
    EXPECT_TRUE(solve({f}).undecided.empty());
    f.coefficients = {-1.0 - 1e-9, -1e-9};
    EXPECT_TRUE(solve({f}).roots.empty());
    EXPECT_TRUE(solve({f}).undecided.empty());
}

TEST(ProjectedPolyhedron, NoRootAtAll) {
    std::mt19937_64 engine(2);
    for (int k = 0; k < 50; ++k) {
        MultivariatePolynomial f = support::random_polynomial({4, 4}, engine);
        const MultivariatePolynomial g = support::random_polynomial({4, 4}, engine);
        // A sum of squares and a little more has none, though its control points change sign.
        const SystemRoots found = solve({f * f + g * g + constant(2, 1e-3), f - g});
        EXPECT_TRUE(found.roots.empty());
        EXPECT_TRUE(found.undecided.empty());
        EXPECT_LT(found.statistics.boxes, 20000);
    }
}

TEST(ProjectedPolyhedron, DoubleRootEndsInOneSmallCluster) {
    for (const double tolerance : {1e-4, 1e-8, 1e-12}) {
        ProjectedPolyhedronOptions options;
        options.tolerance = tolerance;
        // (x - 0.3)^2 = 0 in one unknown, and a parabola that touches a line in two.
        const MultivariatePolynomial x = linear_factor(1, 0, 0.3);
        const SystemRoots one = solve({x * x}, options);
        EXPECT_TRUE(one.roots.empty());
        EXPECT_EQ(one.clusters, 1);
        EXPECT_LT(one.undecided.size(), 10u);
        EXPECT_LT(one.statistics.boxes, 500);

        const MultivariatePolynomial u = linear_factor(2, 0, 0.3), v = linear_factor(2, 1, 0.6);
        const SystemRoots two = solve({v - u * u, v + 0.5 * u * u}, options);
        EXPECT_TRUE(two.roots.empty());
        EXPECT_EQ(two.clusters, 1);
        EXPECT_LT(two.undecided.size(), 100u);
        EXPECT_LT(two.statistics.boxes, 2000);
        bool covered = false;
        for (const UndecidedBox& undecided : two.undecided) {
            covered = covered || (undecided.box[0].contains(0.3) && undecided.box[1].contains(0.6));
            // Within the square root of the rounding all is 0, and no finer answer is possible.
            for (const Interval& side : undecided.box) {
                EXPECT_LE(side.high - side.low, std::max(tolerance, 1e-7));
            }
        }
        EXPECT_TRUE(covered);
    }
}

TEST(ProjectedPolyhedron, ClusteredRootsAreToldApart) {
    // Roots 1e-6 apart: a circle of radius 5e-7 and a line through its centre.
    const MultivariatePolynomial u = linear_factor(2, 0, 0.4), v = linear_factor(2, 1, 0.7);
    const System system = {u * u + v * v - constant(2, 25e-14), u - 0.75 * v};
    const SystemRoots found = solve(system);
    EXPECT_TRUE(found.undecided.empty());
    ASSERT_EQ(found.roots.size(), 2u);
    for (const double side : {-1.0, 1.0}) EXPECT_TRUE(reported(found, {0.4 + side * 3e-7, 0.7 + side * 4e-7}, 1e-9));
    for (const SystemRoot& root : found.roots) {
        std::vector<Exact> at(root.at.begin(), root.at.end());
        ASSERT_TRUE(support::exact_newton(system, at));
        // The polynomials are multiplied out with errors, so the given circle has another size within them.
        EXPECT_LE(abs(at[0] - Exact(root.at[0])), Exact(root.radius[0]));
        // Coefficients of size 1 with some dozens of roundings, divided by a derivative of 6e-7.
        EXPECT_LT(root.radius[0], 1e-7);
    }
    EXPECT_LT(found.statistics.boxes, 3000);
}

TEST(ProjectedPolyhedron, CurveOfRootsIsCoveredByBoxesWithinTheBudget) {
    // x^2 + y^2 = 0.49 twice: dependent equations.
    const MultivariatePolynomial u = linear_factor(2, 0, 0.0), v = linear_factor(2, 1, 0.0);
    const MultivariatePolynomial circle = u * u + v * v - constant(2, 0.49);
    ProjectedPolyhedronOptions options;
    for (const double tolerance : {1e-2, 1e-3, 1e-9}) {
        options.tolerance = tolerance;
        options.boxes = 20000;
        const SystemRoots found = solve({circle, (u + constant(2, 1.0)) * circle}, options);
        EXPECT_TRUE(found.roots.empty());
        EXPECT_EQ(found.clusters, 1);
        EXPECT_EQ(found.statistics.exhausted, tolerance == 1e-9);
        EXPECT_LE(found.statistics.boxes, options.boxes);
        if (!found.statistics.exhausted) {
            EXPECT_LT(found.undecided.size(), 10 / tolerance);
        }
        for (int k = 0; k <= 1000; ++k) {
            const std::vector<double> at = {0.7 * std::cos(k * 1.5707963267948966e-3),
                                            0.7 * std::sin(k * 1.5707963267948966e-3)};
            EXPECT_TRUE(std::any_of(found.undecided.begin(), found.undecided.end(), [&](const UndecidedBox& undecided) {
                for (int j = 0; j < 2; ++j)
                    if (at[j] < undecided.box[j].low - 1e-15 || at[j] > undecided.box[j].high + 1e-15) return false;
                return true;
            })) << k;
        }
        for (const UndecidedBox& undecided : found.undecided) {
            const double nearest = std::hypot(undecided.box[0].low, undecided.box[1].low);
            const double farthest = std::hypot(undecided.box[0].high, undecided.box[1].high);
            EXPECT_LE(nearest, 0.7 + 1e-9);
            EXPECT_GE(farthest, 0.7 - 1e-9);
        }
    }
}

TEST(ProjectedPolyhedron, LineAlongAnUnknownIsNotCutAcross) {
    // x = 0.37 whatever y: y never varies, so one long box says it all.
    const SystemRoots found = solve({linear_factor(2, 0, 0.37), constant(2, 0.0)});
    EXPECT_TRUE(found.roots.empty());
    EXPECT_EQ(found.clusters, 1);
    EXPECT_LT(found.undecided.size(), 5u);
    for (const UndecidedBox& undecided : found.undecided) {
        EXPECT_TRUE(undecided.box[0].contains(0.37));
        EXPECT_EQ(undecided.box[1].high - undecided.box[1].low, 1.0);
    }
}

TEST(ProjectedPolyhedron, IdenticallyZeroIsOneBox) {
    const SystemRoots found = solve({constant(2, 0.0), constant(2, 0.0)});
    EXPECT_TRUE(found.roots.empty());
    ASSERT_EQ(found.undecided.size(), 1u);
    EXPECT_TRUE(found.undecided[0].zero);
    EXPECT_EQ(found.statistics.boxes, 1);
    // Zero within the error stated.
    std::mt19937_64 engine(1);
    MultivariatePolynomial f = 1e-13 * support::random_polynomial({5, 5}, engine);
    f.error = 2e-13;
    const SystemRoots noise = solve({f, f});
    ASSERT_EQ(noise.undecided.size(), 1u);
    EXPECT_TRUE(noise.undecided[0].zero);
}

TEST(ProjectedPolyhedron, OverDeterminedConsistentGivesACandidate) {
    std::mt19937_64 engine(5);
    for (int k = 0; k < 100; ++k) {
        const std::vector<double> root = {0.1 + 0.008 * k, 0.9 - 0.007 * k};
        System system = planted_system(2, 5, root, engine);
        // A consequence of the other two: consistent to the last digit, within the product's error.
        const MultivariatePolynomial a = support::random_polynomial({2, 2}, engine);
        const MultivariatePolynomial b = support::random_polynomial({2, 2}, engine);
        system.push_back(a * system[0] + b * system[1]);
        const SystemRoots found = solve(system);
        EXPECT_TRUE(found.undecided.empty());
        ASSERT_TRUE(reported(found, root, 1e-9)) << k;
        for (const SystemRoot& candidate : found.roots) {
            EXPECT_FALSE(candidate.exists);
            EXPECT_EQ(candidate.jacobian_sign, 0);
            std::vector<Exact> at(candidate.at.begin(), candidate.at.end());
            ASSERT_TRUE(support::exact_newton(std::span(system).first(2), at));
            for (int j = 0; j < 2; ++j) EXPECT_LE(abs(at[j] - Exact(candidate.at[j])), Exact(candidate.radius[j]));
        }
    }
}

TEST(ProjectedPolyhedron, OverDeterminedInconsistentHasNothing) {
    std::mt19937_64 engine(6);
    for (int k = 0; k < 100; ++k) {
        System system = planted_system(2, 5, {0.3, 0.6}, engine);
        // Vanishes at another place only, or misses by a little.
        system.push_back(linear_factor(2, 0, k % 2 == 0 ? 0.31 : 0.3 + 1e-7) + linear_factor(2, 1, 0.6));
        const SystemRoots found = solve(system);
        EXPECT_FALSE(reported(found, {0.3, 0.6}, 1e-6));
        EXPECT_TRUE(found.undecided.empty());
        EXPECT_LT(found.statistics.boxes, 20000);
    }
}

TEST(ProjectedPolyhedron, UnderDeterminedIsCovered) {
    // A sphere's octant in three unknowns.
    const MultivariatePolynomial x = linear_factor(3, 0, 0.0), y = linear_factor(3, 1, 0.0),
                                 z = linear_factor(3, 2, 0.0);
    ProjectedPolyhedronOptions options;
    options.tolerance = 0.05;
    const SystemRoots found = solve({x * x + y * y + z * z - constant(3, 0.5)}, options);
    EXPECT_TRUE(found.roots.empty());
    EXPECT_FALSE(found.statistics.exhausted);
    EXPECT_EQ(found.clusters, 1);
    std::mt19937_64 engine(9);
    std::uniform_real_distribution<double> number(0.01, 1.0);
    for (int k = 0; k < 500; ++k) {
        std::array<double, 3> at = {number(engine), number(engine), number(engine)};
        const double scale = std::sqrt(0.5) / std::hypot(at[0], at[1], at[2]);
        EXPECT_TRUE(std::any_of(found.undecided.begin(), found.undecided.end(), [&](const UndecidedBox& undecided) {
            for (int j = 0; j < 3; ++j) {
                const double c = at[j] * scale;
                if (c < undecided.box[j].low - 1e-14 || c > undecided.box[j].high + 1e-14) return false;
            }
            return true;
        }));
    }
}

TEST(ProjectedPolyhedron, ErrorsOfTheCoefficientsWidenTheRadius) {
    std::mt19937_64 engine(12);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    for (int k = 0; k < 50; ++k) {
        const System exact = planted_system(2, 4, {0.45, 0.55}, engine);
        System rounded = exact;
        for (MultivariatePolynomial& f : rounded) {
            f.error = 1e-7;
            for (double& c : f.coefficients) c += 0.999e-7 * number(engine);
        }
        const SystemRoots found = solve(rounded);
        for (const SystemRoot& root : found.roots) {
            std::vector<Exact> at(root.at.begin(), root.at.end());
            ASSERT_TRUE(support::exact_newton(exact, at));
            for (int j = 0; j < 2; ++j) EXPECT_LE(abs(at[j] - Exact(root.at[j])), Exact(root.radius[j]));
        }
        const bool found_it = reported(found, {0.45, 0.55}, 1e-3) ||
                              std::any_of(found.undecided.begin(), found.undecided.end(), [](const UndecidedBox& box) {
                                  return box.box[0].contains(0.45) && box.box[1].contains(0.55);
                              });
        EXPECT_TRUE(found_it);
    }
}

TEST(ProjectedPolyhedron, SizeOfThePolynomialsDoesNotMatter) {
    std::mt19937_64 engine(13);
    const System system = planted_system(2, 5, {0.2, 0.9}, engine);
    const SystemRoots plain = solve(system);
    const SystemRoots scaled = solve({0x1p-300 * system[0], 0x1p400 * system[1]});
    ASSERT_EQ(plain.roots.size(), scaled.roots.size());
    for (std::size_t k = 0; k < plain.roots.size(); ++k)
        EXPECT_NEAR(plain.roots[k].at[0], scaled.roots[k].at[0], 1e-12);
}

TEST(ProjectedPolyhedron, BudgetLeavesTheRestUndecided) {
    std::mt19937_64 engine(14);
    const System system = planted_system(2, 6, {0.2, 0.9}, engine);
    ProjectedPolyhedronOptions options;
    options.boxes = 3;
    options.precondition = false;
    const SystemRoots found = solve(system, options);
    EXPECT_TRUE(found.statistics.exhausted);
    EXPECT_EQ(found.statistics.boxes, 3);
    const bool kept = reported(found, {0.2, 0.9}, 1e-9) ||
                      std::any_of(found.undecided.begin(), found.undecided.end(), [](const UndecidedBox& box) {
                          return box.box[0].contains(0.2) && box.box[1].contains(0.9);
                      });
    EXPECT_TRUE(kept);
}

TEST(ProjectedPolyhedron, WhatIsNoSystemIsRefused) {
    EXPECT_THROW(solve({}), InvalidInput);
    EXPECT_THROW(solve({constant(1, 1.0), constant(2, 1.0)}), InvalidInput);
    EXPECT_THROW(solve({constant(1, std::numeric_limits<double>::quiet_NaN())}), InvalidInput);
    EXPECT_THROW(solve({MultivariatePolynomial{{2}, {1.0}, 0.0}}), InvalidInput);
    ProjectedPolyhedronOptions options;
    for (const double tolerance : {0.0, -1.0, 2.0, std::numeric_limits<double>::quiet_NaN()}) {
        options.tolerance = tolerance;
        EXPECT_THROW(solve({constant(1, 1.0)}, options), InvalidInput);
    }
    options = {};
    options.boxes = 0;
    EXPECT_THROW(solve({constant(1, 1.0)}, options), InvalidInput);
}

TEST(ProjectedPolyhedron, CanBeCancelled) {
    const MultivariatePolynomial u = linear_factor(2, 0, 0.2), v = linear_factor(2, 1, 0.3);
    int calls = 0;
    const Progress progress([&](double fraction, std::string_view) {
        EXPECT_GE(fraction, 0.0);
        EXPECT_LE(fraction, 1.0);
        return ++calls < 3;
    });
    EXPECT_THROW(solve_projected_polyhedron(System{u * u + v * v - constant(2, 0.1)}, {}, progress), Cancelled);
    EXPECT_EQ(calls, 3);
}

}  // namespace
}  // namespace umbilic
