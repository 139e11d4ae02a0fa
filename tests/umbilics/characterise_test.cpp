// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include <Eigen/LU>

#include <umbilic/core/errors.h>
#include <umbilic/umbilics/find.h>
#include <umbilic/umbilics/sensitivity.h>

#include <support/surfaces.h>

namespace umbilic {
namespace {

/// Every control point moved by at most `reach` in a random direction, half of them by exactly that.
NurbsSurface displaced(const NurbsSurface& surface, double reach, std::mt19937& engine) {
    std::normal_distribution<double> number;
    std::uniform_real_distribution<double> share(-1.0, 1.0);
    std::vector<Vector3> poles = surface.poles();
    for (Vector3& pole : poles) {
        const Vector3 direction(number(engine), number(engine), number(engine));
        pole += reach * std::min(1.0, 1.0 + share(engine)) * direction.normalized();
    }
    return NurbsSurface(surface.u_knots(), surface.v_knots(), std::move(poles), surface.weights());
}

const Umbilic* nearest(const FaceUmbilics& found, const Vector3& point) {
    const auto it = std::ranges::min_element(found.umbilics, {},
                                             [&](const Umbilic& umbilic) { return (umbilic.point - point).norm(); });
    return it == found.umbilics.end() ? nullptr : &*it;
}

std::vector<NurbsSurface> surfaces() {
    return {support::table_3_1_patch(),
            support::monge_patch(0.3, 2, 0.3, -2, 0.4),
            support::smooth_bicubic(10, 3),
            support::rough_bicubic(8, 5),
            support::random_surface(3, 4, 7, 7, 8, 0.1, 5.0),
            support::random_surface(5, 5, 8, 8, 9, 0.1)};
}

TEST(Sensitivity, BoundsWhatSmallDisplacementsDo) {
    std::mt19937 engine(21);
    constexpr double reach = 1e-9;
    double closest = 0.0;
    int compared = 0;
    for (const NurbsSurface& surface : surfaces()) {
        const FaceUmbilics base = find_umbilics(surface);
        for (int trial = 0; trial < 30; ++trial) {
            const FaceUmbilics moved = find_umbilics(displaced(surface, reach, engine));
            for (const Umbilic& umbilic : base.umbilics) {
                if (umbilic.on_knot_line) continue;
                const Umbilic* other = nearest(moved, umbilic.point);
                ASSERT_NE(other, nullptr);
                const UmbilicSensitivity bound =
                    umbilic_sensitivity(surface, umbilic.at.u, umbilic.at.v, Side::right, Side::right);
                const double rounding = 1e-11 * (1 + std::sqrt(umbilic.cubic.squared_norm()));
                EXPECT_LE(std::abs(other->kappa - umbilic.kappa), 1.01 * bound.kappa * reach + 1e-13);
                EXPECT_LE((other->point - umbilic.point).norm(), 1.01 * (bound.way + 1) * reach + 1e-13);
                // Each cubic is given in its own frame; what turns with no frame is compared.
                const double change =
                    std::abs(std::sqrt(other->cubic.squared_norm()) - std::sqrt(umbilic.cubic.squared_norm()));
                EXPECT_LE(change, 1.01 * bound.cubic * reach + rounding);
                if (change > 100 * rounding) closest = std::max(closest, change / (bound.cubic * reach));
                ++compared;
            }
        }
    }
    EXPECT_GT(compared, 500);
    EXPECT_GT(closest, 0.05) << "a bound that is never approached says nothing";
}

TEST(Characterise, NoTypeChangesWithinTheAccuracyClaimed) {
    std::mt19937 engine(22);
    int generic = 0, non_generic = 0;
    for (const double accuracy : {1e-8, 1e-6, 1e-5, 1e-4, 1e-3})
        for (const NurbsSurface& surface : surfaces()) {
            UmbilicOptions options;
            options.accuracy = accuracy;
            const FaceUmbilics base = find_umbilics(surface, options);
            for (int trial = 0; trial < 20; ++trial) {
                const FaceUmbilics moved = find_umbilics(displaced(surface, accuracy, engine));
                for (const Umbilic& umbilic : base.umbilics) {
                    if (umbilic.kind.type == UmbilicType::non_generic) {
                        ++non_generic;
                        continue;
                    }
                    // One that may leave the patch says nothing.
                    const ParameterBox domain = surface.domain();
                    if (umbilic.at.u < domain.u.low + 0.02 || umbilic.at.u > domain.u.high - 0.02 ||
                        umbilic.at.v < domain.v.low + 0.02 || umbilic.at.v > domain.v.high - 0.02)
                        continue;
                    ++generic;
                    const Umbilic* other = nearest(moved, umbilic.point);
                    ASSERT_NE(other, nullptr);
                    EXPECT_EQ(other->kind.type, umbilic.kind.type) << accuracy;
                    EXPECT_EQ(other->kind.star, umbilic.kind.star) << accuracy;
                    EXPECT_EQ(other->index, umbilic.index);
                    EXPECT_LE(std::abs(other->kind.delta - umbilic.kind.delta), umbilic.kind.uncertainty.delta);
                    EXPECT_LE(std::abs(other->kind.zeta - umbilic.kind.zeta), umbilic.kind.uncertainty.zeta);
                    EXPECT_LE(std::abs(other->kappa - umbilic.kappa), umbilic.kappa_error);
                }
            }
        }
    EXPECT_GT(generic, 3000);
    EXPECT_GT(non_generic, 300);
}

TEST(Characterise, TheMarginInMillimetresIsKept) {
    std::mt19937 engine(23);
    int compared = 0;
    for (const NurbsSurface& surface : surfaces())
        for (const Umbilic& umbilic : find_umbilics(surface).umbilics) {
            if (umbilic.kind.type == UmbilicType::non_generic) continue;
            EXPECT_GT(umbilic.margin, 0.0);
            for (int trial = 0; trial < 10; ++trial) {
                const FaceUmbilics moved = find_umbilics(displaced(surface, umbilic.margin, engine));
                const Umbilic* other = nearest(moved, umbilic.point);
                ASSERT_NE(other, nullptr);
                if ((other->point - umbilic.point).norm() > 0.1) continue;  // left the patch
                EXPECT_EQ(other->kind.type, umbilic.kind.type);
                EXPECT_EQ(other->kind.star, umbilic.kind.star);
                ++compared;
            }
        }
    EXPECT_GT(compared, 300);
}

TEST(Characterise, TheAccuracyDecidesWhetherATypeIsTold) {
    const NurbsSurface surface = support::table_3_1_patch();
    const FaceUmbilics exact = find_umbilics(surface);
    ASSERT_EQ(exact.umbilics.size(), 5u);
    for (const Umbilic& umbilic : exact.umbilics) {
        UmbilicOptions options;
        options.accuracy = 0.5 * umbilic.margin;
        EXPECT_EQ(nearest(find_umbilics(surface, options), umbilic.point)->kind.type, umbilic.kind.type);
        options.accuracy = 2.0 * umbilic.margin;
        const FaceUmbilics rough = find_umbilics(surface, options);
        const Umbilic& open = *nearest(rough, umbilic.point);
        EXPECT_EQ(open.kind.type, UmbilicType::non_generic);
        EXPECT_EQ(open.margin, 0.0);
        EXPECT_TRUE(open.certified) << "existence is about the surface as given";
        const GenericType type = *generic_type(umbilic.kind.type, umbilic.kind.star);
        EXPECT_NE(std::ranges::find(open.kind.neighbours, type), open.kind.neighbours.end());
    }
    EXPECT_THROW(find_umbilics(surface, {.accuracy = -1.0}), InvalidInput);
    EXPECT_THROW(find_umbilics(surface, {.accuracy = std::nan("")}), InvalidInput);
}

TEST(Characterise, AFaceAddsTheErrorOfItsConversion) {
    Model model = support::model_of({support::table_3_1_patch()});
    for (const Umbilic& umbilic : find_umbilics(model.faces[0]).umbilics)
        EXPECT_NE(umbilic.kind.type, UmbilicType::non_generic);
    model.faces[0].conversion_error = 0.1;
    for (const Umbilic& umbilic : find_umbilics(model.faces[0]).umbilics)
        EXPECT_EQ(umbilic.kind.type, UmbilicType::non_generic);
}

TEST(Characterise, MarginsScaleAndErrorsStayBounds) {
    const NurbsSurface surface = support::table_3_1_patch();
    const FaceUmbilics base = find_umbilics(surface);
    for (const double scale : {0.1, 25.4, 1000.0}) {
        const SimilarityTransform t = support::random_similarity(7, scale, false);
        const FaceUmbilics moved = find_umbilics(support::transformed(surface, t));
        for (const Umbilic& umbilic : base.umbilics) {
            const Umbilic* other = nearest(moved, t.apply(umbilic.point));
            ASSERT_NE(other, nullptr);
            EXPECT_EQ(other->kind.type, umbilic.kind.type);
            // Bounds along axes that were turned.
            EXPECT_NEAR(other->margin / scale, umbilic.margin, 0.05 * umbilic.margin);
            EXPECT_LE(std::abs(other->kappa * scale - umbilic.kappa), other->kappa_error * scale + umbilic.kappa_error);
            EXPECT_EQ(other->flat, umbilic.flat);
        }
    }
}

/// Graph over [-1, 1]^2 of a x^3 + 3 c x y^2 over 6 for x < 0, with `jump` more in a for x > 0, as a cubic spline with
/// a knot at x = 0.
NurbsSurface jumping_surface(double a, double c, double jump) {
    const KnotVector u({3, {-1, -1, -1, -1, 0, 1, 1, 1, 1}}), v({3, {-1, -1, -1, -1, 1, 1, 1, 1}});
    const auto collocation = [](const KnotVector& knots, const std::vector<double>& at) {
        Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(knots.pole_count(), knots.pole_count());
        for (int i = 0; i < knots.pole_count(); ++i) {
            double basis[4];
            const int span = knots.span(at[i]);
            knots.basis(span, at[i], 0, basis);
            for (int k = 0; k < 4; ++k) matrix(i, span - 3 + k) = basis[k];
        }
        return matrix;
    };
    const std::vector<double> x = {-1, -0.5, 0, 0.5, 1}, y = {-1, -0.4, 0.4, 1};
    const Eigen::MatrixXd in_u = collocation(u, x).inverse(), in_v = collocation(v, y).inverse();
    Eigen::MatrixXd height(5, 4), place_x(5, 4), place_y(5, 4);
    for (int i = 0; i < 5; ++i)
        for (int j = 0; j < 4; ++j) {
            const double cube = x[i] * x[i] * x[i];
            height(i, j) = (a * cube + 3 * c * x[i] * y[j] * y[j] + jump * std::max(0.0, cube)) / 6;
            place_x(i, j) = x[i];
            place_y(i, j) = y[j];
        }
    const auto poles_of = [&](const Eigen::MatrixXd& values) {
        return Eigen::MatrixXd(in_u * values * in_v.transpose());
    };
    const Eigen::MatrixXd px = poles_of(place_x), py = poles_of(place_y), pz = poles_of(height);
    std::vector<Vector3> poles;
    for (int i = 0; i < 5; ++i)
        for (int j = 0; j < 4; ++j) poles.emplace_back(px(i, j), py(i, j), pz(i, j));
    return NurbsSurface(u, v, poles);
}

TEST(Characterise, AcrossAJumpOfThirdDerivativesBothSidesCount) {
    // Elliptic star on the left, hyperbolic on the right.
    const FaceUmbilics found = find_umbilics(jumping_surface(2, -2, -3));
    const Umbilic* umbilic = nearest(found, Vector3::Zero());
    ASSERT_NE(umbilic, nullptr);
    EXPECT_NEAR(umbilic->point.norm(), 0.0, 1e-12);
    EXPECT_TRUE(umbilic->on_knot_line);
    EXPECT_EQ(umbilic->index, -0.5);
    EXPECT_EQ(umbilic->kind.type, UmbilicType::non_generic);
    EXPECT_EQ(umbilic->kind.neighbours, (std::vector{GenericType::elliptic_star, GenericType::hyperbolic_star}));
    EXPECT_FALSE(umbilic->kind.ridges);
    EXPECT_EQ(umbilic->margin, 0.0);
    const UmbilicClass left = classify({2, 0, -2, 0}, 0.0), right = classify({-1, 0, -2, 0}, 0.0);
    EXPECT_NEAR(umbilic->kind.uncertainty.delta, std::abs(left.delta - right.delta), 1e-5);
    EXPECT_NEAR(umbilic->kind.uncertainty.zeta, std::abs(left.zeta - right.zeta), 1e-5);

    // The same type on both sides stays told, with the jump as its uncertainty.
    const FaceUmbilics mild = find_umbilics(jumping_surface(2, -2, 1));
    umbilic = nearest(mild, Vector3::Zero());
    ASSERT_NE(umbilic, nullptr);
    EXPECT_TRUE(umbilic->on_knot_line);
    EXPECT_EQ(umbilic->kind.type, UmbilicType::star);
    EXPECT_EQ(umbilic->kind.star, StarKind::elliptic);
    EXPECT_EQ(umbilic->kind.ridges, 3);
    EXPECT_NEAR(umbilic->kind.uncertainty.delta,
                classify({2, 0, -2, 0}, 0.0).delta - classify({3, 0, -2, 0}, 0.0).delta, 1e-5);
}

TEST(Characterise, QuadricsHaveNoOmegaButAType) {
    for (const auto& [a, b, c] : {std::array{3.0, 2.0, 1.0}, std::array{30.0, 2.0, 1.5}}) {
        const FaceUmbilics found = find_umbilics(support::ellipsoid_octant(a, b, c));
        const Vector3 expected(a * std::sqrt((a * a - b * b) / (a * a - c * c)), 0.0,
                               c * std::sqrt((b * b - c * c) / (a * a - c * c)));
        const Umbilic* umbilic = nearest(found, expected);
        ASSERT_NE(umbilic, nullptr);
        EXPECT_NEAR((umbilic->point - expected).norm(), 0.0, 1e-11 * a);
        EXPECT_EQ(umbilic->kind.type, UmbilicType::lemon);
        EXPECT_FALSE(umbilic->kind.omega);
        EXPECT_FALSE(umbilic->kind.uncertainty.omega);
        EXPECT_NEAR(umbilic->kind.delta, -1.0, 1e-12);
        EXPECT_EQ(umbilic->kind.ridges, 1);
        EXPECT_LE(std::abs(umbilic->kappa - a * c / (b * b * b)), umbilic->kappa_error);
    }
}

}  // namespace
}  // namespace umbilic
