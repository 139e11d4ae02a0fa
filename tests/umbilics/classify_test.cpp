// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include <umbilic/umbilics/umbilic.h>

namespace umbilic {
namespace {

using Complex = std::complex<double>;
constexpr double margin = 1e-6;
constexpr double pi = std::numbers::pi;

/// Cubic with alpha = 1 and beta = omega.
Cubic cubic_of(Complex omega) {
    return {6 * omega.real() + 2, 2 * omega.imag(), 2 * omega.real() - 2, 6 * omega.imag()};
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
    const auto type = [](double omega) { return classify(cubic_of(omega), margin); };
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
    const UmbilicClass result = classify({6, 0, -6, 0}, margin);
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
    const UmbilicClass result = classify({-0.544638, 0, -0.544638 / 3, 0}, margin);
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
        const Cubic cubic = cubic_of({number(engine), number(engine)});
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
        const UmbilicClass before = classify(cubic, margin), after = classify(cubic.rotated(turn), margin);
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

TEST(Classify, DividingCurvesAreNonGeneric) {
    for (int k = 0; k < 12; ++k) {
        const double t = 0.2 + k * pi / 6;
        const Complex gamma = 2.0 * std::polar(1.0, t) + std::polar(1.0, -2 * t);
        EXPECT_EQ(classify(cubic_of(std::polar(1.0, t)), margin).type, UmbilicType::non_generic);
        EXPECT_EQ(classify(cubic_of(gamma / 3.0), margin).type, UmbilicType::non_generic);
        EXPECT_EQ(classify(cubic_of(-gamma), margin).type, UmbilicType::non_generic);
    }
    const UmbilicClass nothing = classify({}, margin);
    EXPECT_EQ(nothing.type, UmbilicType::non_generic);
    EXPECT_TRUE(nothing.angles.empty());
    EXPECT_FALSE(nothing.omega);
}

}  // namespace
}  // namespace umbilic
