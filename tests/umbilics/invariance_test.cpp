// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include <support/surfaces.h>
#include <umbilic/umbilics/find.h>

namespace umbilic {
namespace {

using Complex = std::complex<double>;

struct Cubics {
    const char* name;
    double kappa;
    Complex omega;
    UmbilicType type;
    StarKind star;
};

const Cubics kinds[] = {
    {"elliptic star", 0.7, {0.1, 0.05}, UmbilicType::star, StarKind::elliptic},
    {"near the cusp", 0.7, {0.8, 0.0}, UmbilicType::star, StarKind::elliptic},
    {"hyperbolic star", -0.4, {-0.8, 0.1}, UmbilicType::star, StarKind::hyperbolic},
    {"monstar", 0.3, {-1.7, 0.2}, UmbilicType::monstar, StarKind::none},
    {"lemon", 0.3, {1.7, 0.3}, UmbilicType::lemon, StarKind::none},
    {"lemon beyond the cusp", 0.5, {-3.5, 0.1}, UmbilicType::lemon, StarKind::none},
    {"flat", 0.0, {0.3, 0.2}, UmbilicType::star, StarKind::elliptic},
};

/// The polynomial of the umbilic generator with alpha = 1 and beta = omega.
std::function<double(double, double)> height(const Cubics& k) {
    const double a = 6 * k.omega.real() + 2, b = 2 * k.omega.imag(), c = 2 * k.omega.real() - 2, d = 6 * k.omega.imag();
    const double kappa = k.kappa;
    return [=](double x, double y) {
        return -0.5 * kappa * (x * x + y * y) +
               (a * x * x * x + 3 * b * x * x * y + 3 * c * x * y * y + d * y * y * y) / 6;
    };
}

Umbilic at_point(const NurbsSurface& surface, const Vector3& point) {
    const FaceUmbilics found = find_umbilics(surface);
    const auto nearest = std::min_element(
        found.umbilics.begin(), found.umbilics.end(),
        [&](const Umbilic& a, const Umbilic& b) { return (a.point - point).norm() < (b.point - point).norm(); });
    EXPECT_NE(nearest, found.umbilics.end());
    return nearest == found.umbilics.end() ? Umbilic() : *nearest;
}

void expect_same(const Umbilic& base, const Umbilic& other, double scale, double kappa_sign, bool conjugate) {
    EXPECT_EQ(base.kind.type, other.kind.type);
    EXPECT_EQ(base.kind.star, other.kind.star);
    EXPECT_EQ(base.index, other.index);
    EXPECT_EQ(base.flat, other.flat);
    EXPECT_EQ(base.directions.size(), other.directions.size());
    EXPECT_NEAR(other.kappa, kappa_sign * base.kappa / scale, 1e-10 / scale);
    EXPECT_NEAR(other.kind.delta, base.kind.delta, 1e-10);
    const Complex zeta = conjugate ? std::conj(base.kind.zeta) : base.kind.zeta;
    EXPECT_NEAR(std::abs(other.kind.zeta - zeta), 0.0, 1e-10);
    EXPECT_NEAR(other.cubic.squared_norm() * std::pow(scale, 4), base.cubic.squared_norm(),
                1e-9 * base.cubic.squared_norm());
}

class Generated : public testing::TestWithParam<Cubics> {
protected:
    NurbsSurface surface = support::graph_patch(3, 3, height(GetParam()));
    Umbilic base = at_point(surface, Vector3::Zero());
};

TEST_P(Generated, IsWhatWasAskedFor) {
    const Cubics& k = GetParam();
    EXPECT_NEAR(base.at.u, 0.5, 1e-12);
    EXPECT_NEAR(base.at.v, 0.5, 1e-12);
    EXPECT_TRUE(base.certified);
    EXPECT_NEAR(base.kappa, k.kappa, 1e-12);
    EXPECT_EQ(base.flat, k.kappa == 0.0);
    EXPECT_EQ(base.kind.type, k.type);
    EXPECT_EQ(base.kind.star, k.star);
    EXPECT_NEAR(std::abs(base.kind.alpha - 1.0), 0.0, 1e-11);
    EXPECT_NEAR(std::abs(base.kind.beta - k.omega), 0.0, 1e-11);
}

TEST_P(Generated, TurnsMovesAndScales) {
    for (const double scale : {0.1, 1.0, 25.4, 1000.0}) {
        const SimilarityTransform t = support::random_similarity(static_cast<unsigned>(scale), scale, false);
        const Umbilic moved = at_point(support::transformed(surface, t), t.translation);
        expect_same(base, moved, scale, 1.0, false);
        EXPECT_NEAR((moved.point - t.apply(base.point)).norm(), 0.0, 1e-11 * scale);
        EXPECT_NEAR((moved.normal - t.apply_direction(base.normal)).norm(), 0.0, 1e-10);
    }
}

TEST_P(Generated, MirrorFlipsTheNormalOfTheParametrisation) {
    // Mirrored and flipped: (-kappa, omega).
    const SimilarityTransform t = support::random_similarity(4, 2.0, true);
    expect_same(base, at_point(support::transformed(surface, t), t.translation), 2.0, -1.0, false);
}

TEST_P(Generated, ExchangedAndReversedParameters) {
    // Flipped normal: (-kappa, conj omega).
    expect_same(base, at_point(surface.swapped(), Vector3::Zero()), 1.0, -1.0, true);
    expect_same(base, at_point(surface.u_reversed(), Vector3::Zero()), 1.0, -1.0, true);
    expect_same(base, at_point(surface.u_reversed().swapped(), Vector3::Zero()), 1.0, 1.0, false);
}

TEST_P(Generated, RaisedDegree) {
    expect_same(base, at_point(support::graph_patch(4, 3, height(GetParam())), Vector3::Zero()), 1.0, 1.0, false);
    expect_same(base, at_point(support::graph_patch(4, 5, height(GetParam())), Vector3::Zero()), 1.0, 1.0, false);
}

TEST_P(Generated, TurnedFrame) {
    const auto f = height(GetParam());
    const double co = std::cos(0.4), si = std::sin(0.4);
    const auto turned = [&](double x, double y) { return f(co * x - si * y, si * x + co * y); };
    expect_same(base, at_point(support::graph_patch(3, 3, turned), Vector3::Zero()), 1.0, 1.0, false);
}

INSTANTIATE_TEST_SUITE_P(Kinds, Generated, testing::ValuesIn(kinds), [](const auto& info) {
    std::string name = info.param.name;
    std::replace(name.begin(), name.end(), ' ', '_');
    return name;
});

}  // namespace
}  // namespace umbilic
