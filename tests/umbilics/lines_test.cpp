// SPDX-License-Identifier: LGPL-2.1-or-later
// Lines of umbilics whose place is known in closed form or by a search in one
// dimension.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <boost/math/tools/roots.hpp>

#include <support/reparametrisation.h>
#include <support/surfaces.h>
#include <support/swept_surfaces.h>
#include <umbilic/differential/curvature.h>
#include <umbilic/umbilics/find.h>

namespace umbilic {
namespace {

constexpr double pi = std::numbers::pi;

/// Greatest |kappa_max - kappa_min| on a line.
double largest_difference(const NurbsSurface& surface, const UmbilicLine& line) {
    double largest = 0.0;
    for (const Vector2& at : line.parameters) {
        const Curvature c = curvature(surface, at.x(), at.y());
        largest = std::max(largest, c.kappa_max - c.kappa_min);
    }
    return largest;
}

void expect_sound(const NurbsSurface& surface, const UmbilicLine& line) {
    EXPECT_LE(line.accuracy, 1e-8);
    ASSERT_EQ(line.points.size(), line.parameters.size());
    double chords = 0.0;
    const double size = surface.pole_box().diagonal();
    for (std::size_t k = 0; k < line.points.size(); ++k) {
        const Vector2& at = line.parameters[k];
        EXPECT_LE((surface.value(at.x(), at.y()) - line.points[k]).norm(), 1e-7 * size);
        if (k == 0) continue;
        const double chord = (line.points[k] - line.points[k - 1]).norm();
        EXPECT_LE(chord, 0.1 * size);
        chords += chord;
    }
    EXPECT_GE(line.length, chords * (1 - 1e-12));
    EXPECT_LE(line.length, chords * 1.01);
    EXPECT_EQ(line.closed, line.ends[0] == LineEnd::closed);
    EXPECT_EQ(line.closed, line.ends[1] == LineEnd::closed);
    if (line.closed) {
        EXPECT_LE((line.points.front() - line.points.back()).norm(), 1e-7 * size);
    }
}

/// A developable (u, v, z(u)) of degree 3 x 1 with `spans` spans across, which
/// is flat along one ruling.
NurbsSurface developable(std::vector<double> heights) {
    std::vector<Vector2> poles;
    for (std::size_t i = 0; i < heights.size(); ++i) poles.emplace_back(i / (heights.size() - 1.0), heights[i]);
    return support::extruded(support::spline(3, poles), 1.0);
}

TEST(UmbilicLines, InflectionOfADevelopable) {
    const double z[4] = {0.0, 1.0, -0.3770311209, 0.0};
    const double first = z[0] - 2 * z[1] + z[2], second = z[1] - 2 * z[2] + z[3];
    const double inflection = first / (first - second);
    for (const bool knots : {false, true})
        for (const bool swapped : {false, true}) {
            NurbsSurface surface = developable({z[0], z[1], z[2], z[3]});
            if (knots) {
                const double inserted[] = {0.2, 0.55, inflection, 0.8};
                surface = support::with_knots(surface, inserted, std::vector<double>{0.3, 0.6}).surface;
            }
            if (swapped) surface = support::exchanged(surface).surface;
            const SimilarityTransform placed = support::random_similarity(4, 3.0, false);
            const NurbsSurface moved = support::transformed(surface, placed);
            const FaceUmbilics found = find_umbilics(moved);
            EXPECT_TRUE(found.umbilics.empty());
            EXPECT_TRUE(found.undecided.empty());
            EXPECT_TRUE(found.regions.empty());
            ASSERT_EQ(found.lines.size(), 1u) << knots << swapped;
            const UmbilicLine& line = found.lines[0];
            expect_sound(moved, line);
            EXPECT_FALSE(line.closed);
            EXPECT_EQ(line.ends[0], LineEnd::border);
            EXPECT_EQ(line.ends[1], LineEnd::border);
            EXPECT_NEAR(line.length, 3.0, 1e-12);
            for (const Vector2& at : line.parameters) EXPECT_NEAR(swapped ? at.y() : at.x(), inflection, 1e-12);
            const auto [low, high] =
                std::minmax(line.parameters.front()[swapped ? 0 : 1], line.parameters.back()[swapped ? 0 : 1]);
            EXPECT_EQ(low, 0.0);
            EXPECT_EQ(high, 1.0);
        }
}

TEST(UmbilicLines, CirclesOfAGraphOfDegreeSix) {
    // z = d^3, d = x^2 + y^2 - 1/4: flat points on d = 0, and umbilics of
    // positive curvature where d^5 = 1/9.
    const NurbsSurface surface = support::graph_patch(6, 6, [](double x, double y) {
        const double d = x * x + y * y - 0.25;
        return d * d * d;
    });
    const FaceUmbilics found = find_umbilics(surface);
    EXPECT_TRUE(found.regions.empty());
    ASSERT_EQ(found.lines.size(), 2u);
    std::vector<double> radius = {0.5, std::sqrt(0.25 + std::pow(9.0, -0.2))};
    for (const UmbilicLine& line : found.lines) {
        expect_sound(surface, line);
        EXPECT_TRUE(line.closed);
        const double at = std::hypot(line.points[0].x(), line.points[0].y());
        const double expected = std::abs(at - radius[0]) < 0.1 ? radius[0] : radius[1];
        for (const Vector3& point : line.points) EXPECT_NEAR(std::hypot(point.x(), point.y()), expected, 2e-8);
        EXPECT_NEAR(line.length, 2 * pi * expected, 1e-6);
    }
    EXPECT_GT(std::abs(found.lines[0].length - found.lines[1].length), 1.0);
    // The middle is an umbilic of index 1.
    ASSERT_EQ(found.undecided.size() + found.umbilics.size(), 1u);
    if (!found.undecided.empty()) {
        EXPECT_EQ(found.undecided[0].index.value_or(0.0), 1.0);
    }
    EXPECT_LE(found.statistics.boxes, 100000);
}

/// z = 6 h y^2 + q y^3, q = (x - 1/8)^2 + y - y0, x in [-1, 1], y in [0, 1], all numbers exact in double precision.
NurbsSurface bent_plate(double y0, double h) {
    // Powers of u = (x + 1) / 2 and y; then Bernstein coefficients.
    const double x0 = 1.0 / 8;
    double power[3][5] = {};
    power[0][2] = 6 * h;
    power[0][3] = (1 + x0) * (1 + x0) - y0;
    power[1][3] = -4 * (1 + x0);
    power[2][3] = 4;
    power[0][4] = 1;
    constexpr double u_share[3][3] = {{1, 0, 0}, {1, 0.5, 0}, {1, 1, 1}};
    std::vector<Vector3> poles;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 5; ++j) {
            const double y_share[5] = {1.0, j / 4.0, j * (j - 1) / 12.0, j * (j - 1) * (j - 2) / 24.0,
                                       j == 4 ? 1.0 : 0.0};
            double z = 0.0;
            for (int a = 0; a < 3; ++a)
                for (int b = 0; b < 5; ++b)
                    z += u_share[i][a] * (b == 2 ? power[a][b] / 6 * (j * (j - 1) / 2) : power[a][b] * y_share[b]);
            poles.emplace_back(i - 1.0, j / 4.0, z);
        }
    return NurbsSurface(KnotVector::bezier(2), KnotVector::bezier(4), std::move(poles));
}

TEST(UmbilicLines, AnUmbilicBesideAnEdgeThatIsUmbilicWithinRounding) {
    // Flat points along y = 0 if h = 0. The equations are divided by y near that edge; for h within their rounding what
    // that leaves out moves the umbilic by up to 4e-9.
    for (const double y0 : {0x1p-6, 0x1p-8, 0x1p-10})
        for (const double h : {0.0, 0x1p-39, -0x1p-39, 0x1p-44, 0x1p-30}) {
            SCOPED_TRACE(std::to_string(y0) + ' ' + std::to_string(h));
            const NurbsSurface surface = bent_plate(y0, h);
            const FaceUmbilics found = find_umbilics(surface);
            // On x = 1/8 the plane x = const is one of symmetry up to second order: A = 0, and B = z_yy - (1 + z_y^2)
            // z_xx.
            using Real = long double;
            const auto b = [&](Real y) {
                const Real z_y = 12 * h * y + 4 * y * y * y - 3 * y0 * y * y;
                const Real z_yy = 12 * h + 12 * y * y - 6 * y0 * y;
                return z_yy - (1 + z_y * z_y) * 2 * y * y * y;
            };
            std::uintmax_t most = 200;
            const auto root = boost::math::tools::toms748_solve(b, Real(0.4 * y0), Real(0.7 * y0),
                                                                boost::math::tools::eps_tolerance<Real>(60), most);
            const auto near = std::find_if(found.umbilics.begin(), found.umbilics.end(),
                                           [&](const Umbilic& umbilic) { return umbilic.at.v < y0; });
            ASSERT_NE(near, found.umbilics.end());
            EXPECT_EQ(near->index, 0.5);
            EXPECT_LE(near->radius, 1e-14);
            EXPECT_LE(std::abs(near->at.u - 0.5625), near->radius);
            EXPECT_LE(std::abs(near->at.v - root.first), near->radius);
        }
}

TEST(UmbilicLines, ParallelsOfAVase) {
    const support::Profile profile =
        support::spline(3, {{1.0, 0.0}, {1.6, 0.5}, {1.3, 1.2}, {0.5, 1.9}, {0.6, 2.5}, {1.0, 3.0}});
    const NurbsSurface whole = support::revolved(profile, 2 * pi);
    // Where the curvatures along and across the profile agree: a search in one
    // dimension.
    const auto difference = [&](double v) {
        const SurfaceDerivatives d = whole.derivatives(0.3, v, 2);
        return normal_curvature(d, 1.0, 0.0) - normal_curvature(d, 0.0, 1.0);
    };
    std::vector<double> expected;
    constexpr int steps = 2000;
    for (int k = 0; k < steps; ++k) {
        const double low = static_cast<double>(k) / steps, high = static_cast<double>(k + 1) / steps;
        if (difference(low) * difference(high) >= 0.0) continue;
        std::uintmax_t most = 100;
        const auto root = boost::math::tools::toms748_solve(difference, low, high,
                                                            boost::math::tools::eps_tolerance<double>(50), most);
        expected.push_back(0.5 * (root.first + root.second));
    }
    ASSERT_GE(expected.size(), 2u);
    for (const double angle : {2 * pi, pi / 2, 4.0}) {
        const SimilarityTransform placed = support::random_similarity(6, 10.0, false, 50.0);
        const NurbsSurface surface = support::transformed(support::revolved(profile, angle), placed);
        const FaceUmbilics found = find_umbilics(surface);
        EXPECT_TRUE(found.umbilics.empty());
        EXPECT_TRUE(found.undecided.empty());
        EXPECT_TRUE(found.regions.empty());
        ASSERT_EQ(found.lines.size(), expected.size()) << angle;
        for (const UmbilicLine& line : found.lines) {
            expect_sound(surface, line);
            EXPECT_EQ(line.closed, angle == 2 * pi);
            const double v = line.parameters[0].y();
            const double nearest = *std::min_element(expected.begin(), expected.end(), [&](double a, double b) {
                return std::abs(a - v) < std::abs(b - v);
            });
            for (const Vector2& at : line.parameters) EXPECT_NEAR(at.y(), nearest, 1e-8);
            const Vector3 on_profile = whole.value(0.0, nearest);
            EXPECT_NEAR(line.length, 10.0 * angle * std::hypot(on_profile.x(), on_profile.y()), 1e-5);
            EXPECT_LE(largest_difference(surface, line), 1e-9);
        }
        EXPECT_LE(found.statistics.boxes, 200000);
    }
}

TEST(UmbilicLines, LoopsCutThem) {
    const NurbsSurface surface = developable({0.0, 1.0, -0.4, 0.0});
    const auto face = [&](double v_low, double v_high, double u_low) {
        Face result = support::model_of({surface}).faces[0];
        const Vector2 corner[4] = {{u_low, v_low}, {0.9, v_low}, {0.9, v_high}, {u_low, v_high}};
        TrimmingLoop loop;
        for (int k = 0; k < 4; ++k)
            loop.push_back({NurbsCurve2(KnotVector::bezier(1), {corner[k], corner[(k + 1) % 4]})});
        result.region = TrimmingRegion(surface.domain(), {loop}, {}, {});
        return result;
    };
    const auto place = [&](const Face& trimmed) {
        const FaceUmbilics found = find_umbilics(trimmed);
        EXPECT_EQ(found.lines.size(), 1u);
        return found.lines.empty() ? Containment::outside : found.lines[0].containment;
    };
    EXPECT_EQ(place(face(0.0, 1.0, 0.1)), Containment::inside);
    EXPECT_EQ(place(face(0.2, 0.7, 0.1)), Containment::boundary);
}

}  // namespace
}  // namespace umbilic
