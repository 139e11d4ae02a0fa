// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <tbb/global_control.h>

#include <support/surfaces.h>
#include <umbilic/core/errors.h>
#include <umbilic/differential/fundamental_forms.h>
#include <umbilic/nurbs/bezier_patch.h>
#include <umbilic/umbilics/certificate.h>
#include <umbilic/umbilics/find.h>

namespace umbilic {
namespace {

constexpr double pi = std::numbers::pi;

/// Turns of the principal direction field along the border of the domain, followed step by step: angle of the line
/// of greatest curvature in the parameter plane.
double followed_winding(const NurbsSurface& surface) {
    const ParameterBox domain = surface.domain();
    const auto angle = [&](double u, double v) {
        const SurfaceDerivatives d = surface.derivatives(u, v, 2);
        const auto [E, F, G] = first_form(d);
        const auto [L, M, N] = second_form(d);
        // A du^2 + B du dv + C dv^2 = 0; the two lines follow each other around, so the angle of one is taken from the
        // quadratic form's eigen-direction in a metric-free way: Q(t) = A cos^2 + B cos sin + C sin^2 vanishes.
        const double a = E * M - F * L, b = E * N - G * L, c = F * N - G * M;
        const double phase = std::atan2(b / 2, (a - c) / 2), mean = (a + c) / 2;
        return 0.5 * (phase + std::acos(-mean / std::hypot(b / 2, (a - c) / 2)));
    };
    const int steps = 4000;
    double total = 0.0, last = angle(domain.u.low, domain.v.low);
    const Vector2 corners[5] = {{domain.u.low, domain.v.low},
                                {domain.u.high, domain.v.low},
                                {domain.u.high, domain.v.high},
                                {domain.u.low, domain.v.high},
                                {domain.u.low, domain.v.low}};
    for (int side = 0; side < 4; ++side)
        for (int k = 1; k <= steps; ++k) {
            const Vector2 at = corners[side] + (corners[side + 1] - corners[side]) * k / steps;
            const double next = angle(at.x(), at.y());
            total += std::remainder(next - last, pi);
            last = next;
        }
    return total / (2 * pi);
}

TEST(Certificate, WindingEqualsTheFollowedDirectionField) {
    for (unsigned seed = 0; seed < 4; ++seed) {
        const NurbsSurface surface = support::rough_bicubic(7, seed);
        const FaceUmbilics found = find_umbilics(surface);
        ASSERT_TRUE(found.certificate.complete);
        EXPECT_NEAR(found.certificate.boundary_winding, followed_winding(surface), 1e-6);
    }
}

TEST(Certificate, UnequalKnotSpansKeepItWhole) {
    std::vector<double> knots = {0, 0, 0, 0, 0.01, 0.7, 0.75, 3, 3, 3, 3};
    const NurbsSurface base = support::rough_bicubic(7, 9);
    const NurbsSurface surface(KnotVector(3, knots), base.v_knots(), base.poles());
    const FaceUmbilics found = find_umbilics(surface);
    ASSERT_TRUE(found.certificate.complete) << found.certificate.why;
    EXPECT_TRUE(*found.certificate.complete);
}

TEST(Certificate, SaysWhyItCannotBeEvaluated) {
    UmbilicOptions options;
    options.boxes_per_patch = 10;
    const FaceUmbilics cut_short = find_umbilics(support::table_3_1_patch(), options);
    EXPECT_FALSE(cut_short.certificate.complete);
    EXPECT_NE(cut_short.certificate.why.find("used up its boxes"), std::string::npos);
    options = {};
    options.certificate = false;
    const FaceUmbilics unasked = find_umbilics(support::table_3_1_patch(), options);
    EXPECT_FALSE(unasked.certificate.complete);
    EXPECT_FALSE(unasked.certificate.why.empty());
}

/// Every umbilic that is taken out of the list, and every one listed twice, is noticed.
void expect_each_is_missed(const FaceUmbilics& found) {
    ASSERT_TRUE(found.certificate.complete) << found.certificate.why;
    ASSERT_TRUE(*found.certificate.complete);
    double undecided = 0.0;
    for (const UndecidedCluster& cluster : found.undecided) undecided += *cluster.index;
    const BorderWinding winding{found.certificate.boundary_winding - undecided, found.certificate.why};
    ASSERT_TRUE(*certify(winding, found).complete);
    for (std::size_t k = 0; k < found.umbilics.size(); ++k) {
        FaceUmbilics lacking = found;
        lacking.umbilics.erase(lacking.umbilics.begin() + k);
        const Certificate certificate = certify(winding, lacking);
        ASSERT_TRUE(certificate.complete);
        EXPECT_FALSE(*certificate.complete);
        EXPECT_NE(certificate.why.find("missing"), std::string::npos);
        FaceUmbilics twice = found;
        twice.umbilics.push_back(found.umbilics[k]);
        EXPECT_FALSE(*certify(winding, twice).complete);
    }
}

/// Graph of a star at (x, y) of the square [-1, 1]^2 and nothing else.
NurbsSurface star_at(double x0, double y0) {
    return support::graph_patch(3, 3, [=](double x, double y) {
        const double s = x - x0, t = y - y0;
        return (s * s + t * t) / 2 + (s * s * s - 3 * s * t * t) / 12;
    });
}

TEST(Certificate, BorderGoesAroundUmbilicsOnIt) {
    for (const auto& [x, y] : {std::pair{-1.0, 0.0},
                               {1.0, 0.25},
                               {0.3, -1.0},
                               {-0.3, 1.0},
                               {-1.0, -1.0},
                               {1.0, -1.0},
                               {1.0, 1.0},
                               {-1.0, 1.0},
                               {-1.0, 1.0 - 1e-6},
                               {1.0 - 1e-11, 0.0}}) {
        const FaceUmbilics found = find_umbilics(star_at(x, y));
        ASSERT_EQ(found.umbilics.size(), 1u);
        EXPECT_NEAR(found.umbilics[0].at.u, (x + 1) / 2, 1e-12);
        ASSERT_TRUE(found.certificate.complete) << found.certificate.why;
        EXPECT_TRUE(*found.certificate.complete);
        EXPECT_EQ(found.certificate.boundary_winding, -0.5);
    }
}

TEST(Certificate, CatchesAMissingUmbilicOfAFace) {
    for (unsigned seed = 0; seed < 3; ++seed) expect_each_is_missed(find_umbilics(support::rough_bicubic(8, seed)));
}

TEST(Certificate, CatchesAMissingUmbilicOfAPatch) {
    const NurbsSurface whole = support::rough_bicubic(8, 0);
    int patches = 0;
    for (const BezierPatch& patch : bezier_patches(whole).patches) {
        std::vector<Vector3> poles;
        for (const Vector4& pole : patch.poles) poles.push_back(pole.head<3>());
        const FaceUmbilics found =
            find_umbilics(NurbsSurface(KnotVector::bezier(3), KnotVector::bezier(3), std::move(poles)));
        expect_each_is_missed(found);
        patches += !found.umbilics.empty();
    }
    EXPECT_GE(patches, 5);
}

TEST(Certificate, GoesAroundLinesInside) {
    // z = r^2 / 2 + (r^2 - 1/4)^3 touches a paraboloid on the circle r = 1/2 to second order.
    const NurbsSurface ring = support::graph_patch(6, 6, [](double x, double y) {
        const double s = x * x + y * y - 0.25;
        return (x * x + y * y) / 2 + s * s * s;
    });
    const FaceUmbilics found = find_umbilics(ring);
    ASSERT_FALSE(found.lines.empty());
    ASSERT_TRUE(found.certificate.complete) << found.certificate.why;
    EXPECT_TRUE(*found.certificate.complete);
    EXPECT_NE(found.certificate.why.find("lines of umbilics"), std::string::npos);
}

TEST(Certificate, GoesAroundRegionsOnTheBorder) {
    // A planar part of 6 x 20 control points beside heights that have umbilics.
    const NurbsSurface base = support::rough_bicubic(14, 3);
    std::vector<Vector3> poles = base.poles();
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 14; ++j) poles[i * 14 + j].z() = 0.0;
    const FaceUmbilics found = find_umbilics(NurbsSurface(base.u_knots(), base.v_knots(), std::move(poles)));
    ASSERT_FALSE(found.regions.empty());
    ASSERT_GE(found.umbilics.size(), 5u);
    EXPECT_NE(found.certificate.why.find("umbilic regions"), std::string::npos);
    expect_each_is_missed(found);
}

TEST(Certificate, NarrowPatchesAreFollowed) {
    // In a patch a millionth as long as its neighbours B is lost in rounding and A alone tells the half plane.
    const NurbsSurface base = support::rough_bicubic(8, 2);
    for (const double width : {1e-3, 1e-6}) {
        const KnotVector knots(3, {0, 0, 0, 0, 0.2, 0.4, 0.6, 0.6 + width, 1, 1, 1, 1});
        const FaceUmbilics found = find_umbilics(NurbsSurface(knots, base.v_knots(), base.poles()));
        expect_each_is_missed(found);
    }
}

TEST(Search, ResultDoesNotDependOnTheNumberOfThreads) {
    const NurbsSurface surface = support::rough_bicubic(12, 5);
    const auto run = [&](std::size_t threads) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        return find_umbilics(surface);
    };
    const FaceUmbilics one = run(1), two = run(2);
    ASSERT_EQ(one.umbilics.size(), two.umbilics.size());
    EXPECT_EQ(one.statistics.boxes, two.statistics.boxes);
    EXPECT_EQ(one.statistics.formed, two.statistics.formed);
    for (std::size_t k = 0; k < one.umbilics.size(); ++k) {
        EXPECT_EQ(one.umbilics[k].at.u, two.umbilics[k].at.u);
        EXPECT_EQ(one.umbilics[k].at.v, two.umbilics[k].at.v);
        EXPECT_EQ(one.umbilics[k].radius, two.umbilics[k].radius);
    }
}

TEST(Search, CanBeCancelled) {
    const Progress progress([](double, std::string_view) { return false; });
    EXPECT_THROW(find_umbilics(support::rough_bicubic(12, 5), {}, progress), Cancelled);
    const Progress stopped;
    stopped.cancel();
    EXPECT_THROW(find_umbilics(support::table_3_1_patch(), {}, stopped), Cancelled);
}

TEST(Search, RefusesSenselessOptions) {
    UmbilicOptions options;
    options.resolution = 0.0;
    EXPECT_THROW(find_umbilics(support::table_3_1_patch(), options), InvalidInput);
    options = {};
    options.boxes_per_patch = 0;
    EXPECT_THROW(find_umbilics(support::table_3_1_patch(), options), InvalidInput);
}

TEST(Search, BudgetHoldsAndNothingIsDropped) {
    UmbilicOptions options;
    options.boxes_per_patch = 10;
    const FaceUmbilics found = find_umbilics(support::table_3_1_patch(), options);
    EXPECT_TRUE(found.statistics.budget_exhausted);
    EXPECT_LE(found.statistics.boxes, 10);
    const FaceUmbilics full = find_umbilics(support::table_3_1_patch());
    for (const Umbilic& umbilic : full.umbilics) {
        bool covered = false;
        for (const Umbilic& other : found.umbilics) covered = covered || (other.point - umbilic.point).norm() < 1e-8;
        const auto holds = [&](const std::vector<ParameterBox>& boxes) {
            for (const ParameterBox& box : boxes) covered = covered || box.contains(umbilic.at.u, umbilic.at.v);
        };
        for (const UndecidedCluster& cluster : found.undecided) holds(cluster.boxes);
        for (const UmbilicLine& line : found.lines) holds(line.boxes);
        EXPECT_TRUE(covered);
    }
    EXPECT_FALSE(found.certificate.complete);
}

}  // namespace
}  // namespace umbilic
