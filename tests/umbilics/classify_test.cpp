// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <Eigen/Eigenvalues>

#include <umbilic/core/types.h>
#include <umbilic/umbilics/umbilic.h>

namespace umbilic {
namespace {

using Complex = std::complex<double>;
constexpr double error = 1e-6;
constexpr double pi = std::numbers::pi;

/// Cubic of the lines of curvature, b x^3 + (2c - a) x^2 y + (d - 2b) x y^2 - c y^3, as k.a x^3 + 3 k.b x^2 y + ...
Cubic direction_cubic(const Cubic& k) {
    return {k.b, (2 * k.c - k.a) / 3, (k.d - 2 * k.b) / 3, -k.c};
}

/// Number of real root lines of a cubic form from the eigenvalues of its companion matrix.
int companion_root_lines(const Cubic& cubic) {
    // Turned so that the coefficient of x^3 is the largest of a few.
    Cubic k = cubic;
    for (int turn = 1; turn < 8; ++turn)
        if (const Cubic turned = cubic.rotated(turn * pi / 8); std::abs(turned.a) > std::abs(k.a)) k = turned;
    Matrix3 companion;
    companion << 0, 0, -k.d / k.a, 1, 0, -3 * k.c / k.a, 0, 1, -3 * k.b / k.a;
    int real = 0;
    const Eigen::EigenSolver<Matrix3> solver(companion, false);
    for (const Complex root : solver.eigenvalues()) real += std::abs(root.imag()) < 1e-9 * (1 + std::abs(root));
    return real;
}

Cubic sum(const Cubic& k, const Cubic& l) {
    return {k.a + l.a, k.b + l.b, k.c + l.c, k.d + l.d};
}

/// Random form of the given norm.
Cubic random_form(std::mt19937& engine, double norm) {
    std::normal_distribution<double> number;
    const Cubic k{number(engine), number(engine), number(engine), number(engine)};
    const double factor = norm / std::sqrt(k.squared_norm());
    return {factor * k.a, factor * k.b, factor * k.c, factor * k.d};
}

/// Number of sign changes along the half circle of a cubic form or of its derivative along the circle: real root lines,
/// counted without any formula.
int root_lines(const Cubic& k, bool derivative) {
    const int steps = 20000;
    int changes = 0;
    double last = 0.0;
    for (int i = 0; i <= steps; ++i) {
        const double t = 0.123 + pi * i / steps, x = std::cos(t), y = std::sin(t);
        const double value =
            derivative ? k.b * x * x * x + (2 * k.c - k.a) * x * x * y + (k.d - 2 * k.b) * x * y * y - k.c * y * y * y
                       : k.a * x * x * x + 3 * k.b * x * x * y + 3 * k.c * x * y * y + k.d * y * y * y;
        if (i > 0 && value * last < 0.0) ++changes;
        last = value;
    }
    return changes;
}

TEST(Classify, TypesOfKnownOmegas) {
    const auto type = [](double omega) { return classify(cubic_of_omega(omega), error); };
    EXPECT_EQ(type(0.0).type, UmbilicType::star);
    EXPECT_EQ(type(0.0).star, StarKind::elliptic);
    EXPECT_EQ(type(0.8).star, StarKind::elliptic);
    EXPECT_EQ(type(-0.8).type, UmbilicType::star);
    EXPECT_EQ(type(-0.8).star, StarKind::hyperbolic);
    EXPECT_EQ(type(-1.7).type, UmbilicType::monstar);
    EXPECT_EQ(type(1.7).type, UmbilicType::lemon);
    EXPECT_EQ(type(-3.5).type, UmbilicType::lemon);
    EXPECT_EQ(type(-3.5).star, StarKind::none);
}

TEST(Classify, MonkeySaddleHasThreeDirections) {
    // x^3 - 3 x y^2: lines at 0, 60 and 120 degrees.
    const UmbilicClass result = classify({6, 0, -6, 0}, error);
    EXPECT_EQ(result.type, UmbilicType::star);
    ASSERT_EQ(result.angles.size(), 3u);
    EXPECT_NEAR(std::sin(3 * result.angles[0]), 0.0, 1e-15);
    EXPECT_NEAR(result.angles[1], pi / 3, 1e-15);
    EXPECT_NEAR(result.angles[2], 2 * pi / 3, 1e-15);
    EXPECT_EQ(result.delta, 1.0);
    EXPECT_EQ(std::abs(result.zeta), 0.0);
}

TEST(Classify, QuadricsHaveNoOmega) {
    // (linear form)(x^2 + y^2): alpha = 0, as at every umbilic of a quadric.
    const UmbilicClass result = classify({-0.544638, 0, -0.544638 / 3, 0}, error);
    EXPECT_FALSE(result.omega);
    EXPECT_EQ(result.type, UmbilicType::lemon);
    EXPECT_NEAR(result.delta, -1.0, 1e-15);
    ASSERT_EQ(result.angles.size(), 1u);
    EXPECT_NEAR(std::sin(result.angles[0]), 0.0, 1e-15);
}

TEST(Classify, AgreesWithCountedRootLinesOnRandomForms) {
    std::mt19937 engine(11);
    std::uniform_real_distribution<double> number(-3.0, 3.0);
    int stars = 0, monstars = 0, lemons = 0;
    for (int k = 0; k < 300; ++k) {
        const Cubic cubic = cubic_of_omega({number(engine), number(engine)});
        const UmbilicClass result = classify(cubic, 1e-3);
        if (result.type == UmbilicType::non_generic) continue;
        const double jacobian = cubic.a * cubic.c + cubic.b * cubic.d - cubic.b * cubic.b - cubic.c * cubic.c;
        EXPECT_EQ(result.type == UmbilicType::star, jacobian < 0.0);
        EXPECT_EQ(result.angles.size(), static_cast<std::size_t>(root_lines(cubic, true)));
        EXPECT_EQ(result.type == UmbilicType::lemon, result.angles.size() == 1);
        if (result.type == UmbilicType::star) {
            EXPECT_EQ(result.star == StarKind::elliptic, root_lines(cubic, false) == 3);
        }
        for (const double t : result.angles) {
            const double x = std::cos(t), y = std::sin(t);
            EXPECT_NEAR(cubic.b * x * x * x + (2 * cubic.c - cubic.a) * x * x * y +
                            (cubic.d - 2 * cubic.b) * x * y * y - cubic.c * y * y * y,
                        0.0, 1e-12);
            EXPECT_GE(t, 0.0);
            EXPECT_LT(t, pi);
        }
        stars += result.type == UmbilicType::star;
        monstars += result.type == UmbilicType::monstar;
        lemons += result.type == UmbilicType::lemon;
    }
    EXPECT_GT(stars, 10);
    EXPECT_GT(monstars, 10);
    EXPECT_GT(lemons, 10);
}

TEST(Classify, InvariantsTurnWithNoFrame) {
    std::mt19937 engine(12);
    std::uniform_real_distribution<double> number(-3.0, 3.0);
    for (int k = 0; k < 200; ++k) {
        const Cubic cubic{number(engine), number(engine), number(engine), number(engine)};
        const double turn = number(engine);
        const UmbilicClass before = classify(cubic, error), after = classify(cubic.rotated(turn), error);
        EXPECT_EQ(before.type, after.type);
        EXPECT_EQ(before.star, after.star);
        EXPECT_NEAR(before.delta, after.delta, 1e-14);
        EXPECT_NEAR(std::abs(before.zeta - after.zeta), 0.0, 1e-14);
        EXPECT_NEAR(std::abs(after.alpha - before.alpha * std::polar(1.0, 3 * turn)), 0.0, 1e-13);
        EXPECT_NEAR(std::abs(after.beta - before.beta * std::polar(1.0, -turn)), 0.0, 1e-13);
        ASSERT_TRUE(before.omega && after.omega);
        // Compared as cubes: the representative jumps by a third of a turn.
        EXPECT_NEAR(std::abs(std::pow(*before.omega, 3) - std::pow(*after.omega, 3)) /
                        (1 + std::pow(std::abs(*before.omega), 3)),
                    0.0, 1e-13);
        EXPECT_GE(std::arg(*before.omega), -pi / 3 - 1e-15);
        EXPECT_LT(std::arg(*before.omega), pi / 3 + 1e-15);
        for (const double angle : after.angles) {
            double nearest = pi;
            for (const double other : before.angles)
                nearest = std::min(nearest, std::abs(std::sin(angle + turn - other)));
            EXPECT_NEAR(nearest, 0.0, 1e-10);
        }
    }
}

TEST(Classify, AgreesWithTheRootsOfTwentyThousandForms) {
    std::mt19937 engine(13);
    std::uniform_real_distribution<double> number(-3.0, 3.0);
    int generic = 0;
    for (int k = 0; k < 20000; ++k) {
        const Cubic cubic = cubic_of_omega({number(engine), number(engine)});
        const UmbilicClass result = classify(cubic, error);
        if (result.type == UmbilicType::non_generic) continue;
        ++generic;
        // The traceless second form turns with the sign of this determinant, the direction field half as often.
        const double jacobian = cubic.a * cubic.c + cubic.b * cubic.d - cubic.b * cubic.b - cubic.c * cubic.c;
        const int ridges = companion_root_lines(cubic), lines = companion_root_lines(direction_cubic(cubic));
        ASSERT_EQ(result.type == UmbilicType::star, jacobian < 0.0) << k;
        ASSERT_EQ(result.ridges, ridges) << k;
        ASSERT_EQ(static_cast<int>(result.angles.size()), lines) << k;
        ASSERT_EQ(result.star == StarKind::elliptic, ridges == 3) << k;
        ASSERT_EQ(result.type == UmbilicType::lemon, lines == 1) << k;
    }
    EXPECT_GT(generic, 19900);
}

TEST(Classify, OmegaBackFromTheForm) {
    std::mt19937 engine(14);
    std::uniform_real_distribution<double> number(-3.0, 3.0);
    for (int k = 0; k < 1000; ++k) {
        const Complex omega(number(engine), number(engine));
        const UmbilicClass result = classify(cubic_of_omega(omega), 0.0);
        EXPECT_NEAR(std::abs(result.alpha - 1.0), 0.0, 1e-15);
        EXPECT_NEAR(std::abs(result.beta - omega), 0.0, 1e-15);
        EXPECT_NEAR(std::abs(std::pow(*result.omega, 3) - std::pow(omega, 3)), 0.0,
                    1e-13 * (1 + std::norm(omega) * std::abs(omega)));
    }
}

TEST(Classify, FlipMirrorAndScaleChangeNoType) {
    std::mt19937 engine(15);
    for (int k = 0; k < 2000; ++k) {
        const Cubic cubic = random_form(engine, 1.0);
        const UmbilicClass base = classify(cubic, 1e-4);
        // From the other side (height and y change sign), in a mirror (y changes sign), twice as large.
        const Cubic flipped{-cubic.a, cubic.b, -cubic.c, cubic.d}, mirrored{cubic.a, -cubic.b, cubic.c, -cubic.d},
            scaled{cubic.a / 4, cubic.b / 4, cubic.c / 4, cubic.d / 4};
        for (const Cubic& other : {flipped, mirrored, scaled}) {
            const UmbilicClass result = classify(other, 1e-4);
            EXPECT_EQ(result.type, base.type);
            EXPECT_EQ(result.star, base.star);
            EXPECT_EQ(result.neighbours, base.neighbours);
            EXPECT_EQ(result.ridges, base.ridges);
            EXPECT_EQ(result.angles.size(), base.angles.size());
            EXPECT_NEAR(result.margin, base.margin, 1e-12);
            EXPECT_NEAR(result.delta, base.delta, 1e-14);
        }
        EXPECT_NEAR(std::abs(classify(flipped, 0.0).zeta - std::conj(base.zeta)), 0.0, 1e-14);
        EXPECT_NEAR(std::abs(classify(mirrored, 0.0).zeta - std::conj(base.zeta)), 0.0, 1e-14);
        EXPECT_NEAR(std::abs(classify(scaled, 0.0).zeta - base.zeta), 0.0, 1e-14);
    }
}

TEST(Classify, NoFormWithinTheErrorHasAnotherTypeOrLeavesTheUncertainty) {
    std::mt19937 engine(16);
    std::uniform_real_distribution<double> decades(-4.0, -0.5);
    int generic = 0;
    for (int k = 0; k < 20000; ++k) {
        const Cubic cubic = random_form(engine, 1.0);
        const double reach = std::pow(10.0, decades(engine));
        const UmbilicClass result = classify(cubic, reach),
                           other = classify(sum(cubic, random_form(engine, reach)), 0.0);
        ASSERT_LE(std::abs(other.delta - result.delta), result.uncertainty.delta) << k;
        ASSERT_LE(std::abs(other.zeta - result.zeta), result.uncertainty.zeta) << k;
        if (result.uncertainty.omega) {
            double difference = 1e300;
            for (int turn = 0; turn < 3; ++turn)
                difference =
                    std::min(difference, std::abs(*result.omega - *other.omega * std::polar(1.0, turn * 2 * pi / 3)));
            ASSERT_LE(difference, *result.uncertainty.omega) << k;
        }
        EXPECT_EQ(result.type == UmbilicType::non_generic, result.margin < reach) << k;
        const GenericType found = *generic_type(other.type, other.star);
        if (result.type == UmbilicType::non_generic) {
            ASSERT_GE(result.neighbours.size(), 2u) << k;
            EXPECT_NE(std::ranges::find(result.neighbours, found), result.neighbours.end()) << k;
            continue;
        }
        ++generic;
        ASSERT_EQ(found, *generic_type(result.type, result.star)) << k;
        if (result.ridges) {
            ASSERT_EQ(*other.ridges, *result.ridges) << k;
        }
    }
    EXPECT_GT(generic, 5000);
}

TEST(Classify, TheMarginIsNotMuchTooSmall) {
    // Steepest descent on the discriminants meets a dividing curve within a few margins.
    std::mt19937 engine(17);
    int met = 0;
    const int forms = 300;
    for (int k = 0; k < forms; ++k) {
        const Cubic cubic = random_form(engine, 1.0);
        const UmbilicClass base = classify(cubic, 0.0);
        bool changed = false;
        for (int trial = 0; trial < 300 && !changed; ++trial) {
            const UmbilicClass other = classify(sum(cubic, random_form(engine, 4 * base.margin)), 0.0);
            changed = other.type != base.type || other.star != base.star;
        }
        met += changed;
    }
    EXPECT_GT(met, forms / 2);
}

TEST(Classify, DividingCurvesAreNonGenericAndNameTheTypesBesideThem) {
    using enum GenericType;
    for (int k = 0; k < 12; ++k) {
        const double t = 0.2 + k * pi / 6;
        const Complex gamma = 2.0 * std::polar(1.0, t) + std::polar(1.0, -2 * t);
        const UmbilicClass circle = classify(cubic_of_omega(std::polar(1.0, t)), error);
        EXPECT_EQ(circle.type, UmbilicType::non_generic);
        EXPECT_EQ(circle.neighbours, (std::vector{hyperbolic_star, monstar}));
        EXPECT_EQ(circle.ridges, 1);
        const UmbilicClass inner = classify(cubic_of_omega(gamma / 3.0), error);
        EXPECT_EQ(inner.type, UmbilicType::non_generic);
        EXPECT_EQ(inner.neighbours, (std::vector{elliptic_star, hyperbolic_star}));
        EXPECT_FALSE(inner.ridges);
        const UmbilicClass outer = classify(cubic_of_omega(-gamma), error);
        EXPECT_EQ(outer.type, UmbilicType::non_generic);
        EXPECT_EQ(outer.neighbours, (std::vector{monstar, lemon}));
    }
    // All curves meet at the cusps of Gamma_1.
    EXPECT_EQ(classify(cubic_of_omega(1.0), error).neighbours,
              (std::vector{elliptic_star, hyperbolic_star, monstar, lemon}));
    const UmbilicClass nothing = classify({}, error);
    EXPECT_EQ(nothing.type, UmbilicType::non_generic);
    EXPECT_EQ(nothing.neighbours.size(), 4u);
    EXPECT_TRUE(nothing.angles.empty());
    EXPECT_FALSE(nothing.omega);
    EXPECT_FALSE(nothing.ridges);
    EXPECT_EQ(nothing.margin, 0.0);
}

}  // namespace
}  // namespace umbilic
