// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include <support/surfaces.h>
#include <umbilic/umbilics/find.h>

namespace umbilic {
namespace {

struct Expected {
    double u, v, kappa, a, b, c, d;
    UmbilicType type;
    double alpha, beta;
    std::complex<double> omega_cubed;
    std::vector<double> angles;
};

constexpr double pi = std::numbers::pi;

/// Umbilics of the patch of Table 3.1 with the digits of Patrikalakis, Maekawa and Cho, section 9.6, in the order of u,
/// then v; angles in [0, pi).
const std::vector<Expected>& expected() {
    static const double low = (3 - std::sqrt(3.0)) / 6;
    static const std::vector<Expected> result = {
        {low,
         0.051522680936,
         1.197251827,
         4.147402,
         -18.305899,
         0,
         -2.337282,
         UmbilicType::star,
         6.592966,
         2.631961,
         {-0.0553340, -0.0313958},
         {0.671, pi / 2, pi - 0.592}},
        {low,
         0.983837821065,
         0.267423775,
         0.926383,
         14.669484,
         0,
         1.411270,
         UmbilicType::star,
         5.325907,
         2.013427,
         {-0.0534151, 0.0081215},
         {0.617, pi / 2, pi - 0.638}},
        {0.5,
         0.440183509410,
         0.0,
         6.513791,
         0,
         4.276321,
         0,
         UmbilicType::monstar,
         0.789397,
         1.348764,
         {-4.987949, 0.0},
         {0.0, 0.604, pi - 0.604}},
        {1 - low,
         0.051522680936,
         -1.197251827,
         4.147402,
         18.305899,
         0,
         2.337282,
         UmbilicType::star,
         6.592966,
         2.631961,
         {-0.0553340, 0.0313958},
         {0.592, pi / 2, pi - 0.671}},
        {1 - low,
         0.983837821065,
         -0.267423775,
         0.926383,
         -14.669484,
         0,
         -1.411270,
         UmbilicType::star,
         5.325907,
         2.013427,
         {-0.0534151, -0.0081215},
         {0.638, pi / 2, pi - 0.617}},
    };
    return result;
}

TEST(Table31, FiveUmbilicsWithTheirPublishedDigits) {
    FaceUmbilics found = find_umbilics(support::table_3_1_patch());
    ASSERT_EQ(found.umbilics.size(), expected().size());
    EXPECT_TRUE(found.undecided.empty());
    EXPECT_TRUE(found.lines.empty());
    EXPECT_TRUE(found.regions.empty());
    // Two pairs share one u; their order by u is left to rounding.
    std::sort(found.umbilics.begin(), found.umbilics.end(), [](const Umbilic& a, const Umbilic& b) {
        return std::abs(a.at.u - b.at.u) > 1e-9 ? a.at.u < b.at.u : a.at.v < b.at.v;
    });
    for (std::size_t k = 0; k < expected().size(); ++k) {
        const Umbilic& umbilic = found.umbilics[k];
        const Expected& wanted = expected()[k];
        SCOPED_TRACE(k);
        EXPECT_NEAR(umbilic.at.u, wanted.u, 1e-10);
        EXPECT_NEAR(umbilic.at.v, wanted.v, 1e-10);
        EXPECT_TRUE(umbilic.certified);
        EXPECT_LE(umbilic.radius, 1e-10);
        EXPECT_NEAR(umbilic.kappa, wanted.kappa, 1e-9);
        EXPECT_EQ(umbilic.flat, wanted.kappa == 0.0);
        // Half a unit of the last printed digit, and one of the source's digits off by one.
        EXPECT_NEAR(umbilic.cubic.a, wanted.a, 1e-6);
        EXPECT_NEAR(umbilic.cubic.b, wanted.b, 1e-6);
        EXPECT_NEAR(umbilic.cubic.c, wanted.c, 1e-6);
        EXPECT_NEAR(umbilic.cubic.d, wanted.d, 1e-6);
        EXPECT_EQ(umbilic.kind.type, wanted.type);
        EXPECT_EQ(umbilic.kind.star, wanted.type == UmbilicType::star ? StarKind::hyperbolic : StarKind::none);
        EXPECT_EQ(umbilic.index, wanted.type == UmbilicType::star ? -0.5 : 0.5);
        EXPECT_NEAR(std::abs(umbilic.kind.alpha), wanted.alpha, 1e-6);
        EXPECT_NEAR(std::abs(umbilic.kind.beta), wanted.beta, 1e-6);
        ASSERT_TRUE(umbilic.kind.omega);
        EXPECT_NEAR(std::abs(std::pow(*umbilic.kind.omega, 3) - wanted.omega_cubed), 0.0, 2e-6);
        ASSERT_EQ(umbilic.kind.angles.size(), wanted.angles.size());
        for (std::size_t i = 0; i < wanted.angles.size(); ++i)
            // One unit of the last printed digit: the printed 0.617 is 0.6163 by the printed cubic itself.
            EXPECT_NEAR(std::sin(umbilic.kind.angles[i] - wanted.angles[i]), 0.0, 1e-3);
        ASSERT_EQ(umbilic.directions.size(), wanted.angles.size());
        for (const Vector3& direction : umbilic.directions) EXPECT_NEAR(direction.dot(umbilic.normal), 0.0, 1e-12);
    }
}

TEST(Table31, IndexSumEqualsTheWindingAlongTheBorder) {
    const FaceUmbilics found = find_umbilics(support::table_3_1_patch());
    ASSERT_TRUE(found.certificate.complete);
    EXPECT_TRUE(*found.certificate.complete);
    EXPECT_EQ(found.certificate.boundary_winding, -1.5);
    EXPECT_EQ(found.certificate.index_sum, -1.5);
}

TEST(Table31, EveryBoxOfTheThesisHoldsOneUmbilic) {
    const FaceUmbilics found = find_umbilics(support::table_3_1_patch());
    struct Box {
        Vector2 low, high;
    };
    // Lower left and upper right corners as printed, to half a unit of the last digit; 0.9807 is printed for
    // 251/256 = 0.98047.
    const std::array<Box, 5> boxes = {{{{0.2109, 0.0508}, {0.2148, 0.0547}},
                                       {{0.2109, 0.9805}, {0.2148, 0.9844}},
                                       {{0.7852, 0.0508}, {0.7891, 0.0547}},
                                       {{0.7852, 0.9805}, {0.7891, 0.9844}},
                                       {{0.4961, 0.4375}, {0.5039, 0.4414}}}};
    for (const Box& box : boxes) {
        int inside = 0;
        for (const Umbilic& umbilic : found.umbilics) {
            const Vector2 at(umbilic.at.u, umbilic.at.v);
            inside += (at.array() >= box.low.array() - 5e-5).all() && (at.array() <= box.high.array() + 5e-5).all();
        }
        EXPECT_EQ(inside, 1) << box.low.transpose();
    }
}

}  // namespace
}  // namespace umbilic
