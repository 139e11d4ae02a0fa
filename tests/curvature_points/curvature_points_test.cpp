// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <support/reparametrisation.h>
#include <support/surfaces.h>
#include <umbilic/core/disjoint_sets.h>
#include <umbilic/core/errors.h>
#include <umbilic/curvature_points/curvature_gradient.h>
#include <umbilic/curvature_points/curvature_points.h>

namespace umbilic {
namespace {

std::vector<Vector3> places(const NurbsSurface& surface, const CurvaturePoints& found, bool opposite) {
    std::vector<Vector3> result;
    for (const CurvaturePoint& point : found.points)
        if (point.opposite == opposite) {
            EXPECT_TRUE(point.certified);
            result.push_back(surface.value(point.at.u, point.at.v));
        }
    return result;
}

/// Both sets hold the same points within `tolerance`.
void expect_same(const std::vector<Vector3>& a, const std::vector<Vector3>& b, double tolerance, const char* what) {
    EXPECT_EQ(a.size(), b.size()) << what;
    for (const Vector3& x : a) {
        double nearest = 1e300;
        for (const Vector3& y : b) nearest = std::min(nearest, (x - y).norm());
        EXPECT_LE(nearest, tolerance) << what;
    }
}

CurvatureQuery query_at(const NurbsSurface& surface, double u, double v) {
    const Curvature c = curvature(surface, u, v);
    return {c.gaussian(), c.mean()};
}

TEST(CurvaturePoints, EllipsoidInClosedForm) {
    // With p the distance of the tangent plane from the centre, K = p^4 / (a b c)^2 and
    // H = p^3 (a^2 + b^2 + c^2 - |r|^2) / (2 (a b c)^2): K and H give p and |r|, and those x^2, y^2, z^2.
    const double a = 1.0, b = 1.7, c = 2.4, abc = a * b * c;
    const NurbsSurface octant = support::ellipsoid_octant(a, b, c);
    const Vector3 point = Vector3(a, b, c).cwiseProduct(Vector3(0.5, 0.6, std::sqrt(1 - 0.25 - 0.36)));
    const double p = 1 / std::sqrt(std::pow(point.x() / (a * a), 2) + std::pow(point.y() / (b * b), 2) +
                                   std::pow(point.z() / (c * c), 2));
    const double gaussian = std::pow(p, 4) / (abc * abc);
    const double mean = std::pow(p, 3) * (a * a + b * b + c * c - point.squaredNorm()) / (2 * abc * abc);
    const CurvatureQuery query{gaussian, mean};
    const CurvaturePoints found = find_curvature_points(octant, {&query, 1});
    expect_same(places(octant, found, false), {point}, 1e-12, "ellipsoid");
    EXPECT_TRUE(places(octant, found, true).empty());
}

TEST(CurvaturePoints, SignOfTheMeanCurvatureFollowsTheNormal) {
    const NurbsSurface surface = support::smooth_bicubic(8, 3);
    const CurvatureQuery query = query_at(surface, 0.37, 0.61);
    const NurbsSurface other = support::exchanged(surface).surface;
    const CurvaturePoints found = find_curvature_points(surface, {&query, 1});
    const CurvaturePoints on_other = find_curvature_points(other, {&query, 1});
    ASSERT_FALSE(places(surface, found, false).empty());
    expect_same(places(surface, found, false), places(other, on_other, true), 1e-11, "same");
    expect_same(places(surface, found, true), places(other, on_other, false), 1e-11, "opposite");
}

TEST(CurvaturePoints, FollowSimilaritiesAndMirrors) {
    const NurbsSurface surface = support::rough_bicubic(9, 4, 0.1);
    const CurvatureQuery query = query_at(surface, 0.42, 0.55);
    const std::vector<Vector3> expected = places(surface, find_curvature_points(surface, {&query, 1}), false);
    for (const bool mirrored : {false, true})
        for (const double scale : {0.01, 1.0, 250.0}) {
            const SimilarityTransform move = support::random_similarity(6, scale, mirrored, 10.0 * scale);
            const NurbsSurface copy = support::transformed(surface, move);
            // The mirrored copy's r_u x r_v is the image of the original's, reversed.
            const CurvatureQuery scaled{query.gaussian / (scale * scale), query.mean / scale};
            const CurvaturePoints found = find_curvature_points(copy, {&scaled, 1});
            std::vector<Vector3> moved;
            for (const Vector3& p : expected) moved.push_back(move.apply(p));
            expect_same(places(copy, found, mirrored), moved, 1e-9 * scale, mirrored ? "mirrored" : "moved");
        }
}

TEST(CurvaturePoints, DoNotDependOnTheRepresentation) {
    const NurbsSurface surface = support::rough_bicubic(7, 5, 0.1);
    const CurvatureQuery query = query_at(surface, 0.33, 0.71);
    const CurvaturePoints found = find_curvature_points(surface, {&query, 1});
    for (const bool opposite : {false, true}) {
        const std::vector<Vector3> expected = places(surface, found, opposite);
        const auto holds = [&](const support::Reparametrised& copy, const char* what) {
            expect_same(places(copy.surface, find_curvature_points(copy.surface, {&query, 1}), opposite), expected,
                        1e-9, what);
        };
        const double knots[] = {0.13, 0.5, 0.77};
        holds(support::with_common_factor(surface, 2.0, 0.7), "rational");
        holds(support::moebius(surface, 1.5, 0.6), "moebius");
        holds(support::elevated(surface, 1, 2), "elevated");
        holds(support::with_knots(surface, knots, knots), "knots");
        holds(support::in_bezier_form(surface), "bezier");
        holds(support::rejoined(surface), "rejoined");
    }
}

TEST(CurvaturePoints, ManyQueriesGiveWhatEachGives) {
    const NurbsSurface surface = support::rough_bicubic(8, 7);
    std::vector<CurvatureQuery> queries;
    for (int k = 0; k < 9; ++k) queries.push_back(query_at(surface, 0.1 + 0.09 * k, 0.93 - 0.1 * k));
    const CurvaturePoints together = find_curvature_points(surface, queries);
    for (int k = 0; k < 9; ++k) {
        const CurvaturePoints alone = find_curvature_points(surface, {&queries[k], 1});
        CurvaturePoints part;
        for (const CurvaturePoint& point : together.points)
            if (point.query == k) part.points.push_back(point);
        for (const bool opposite : {false, true})
            expect_same(places(surface, part, opposite), places(surface, alone, opposite), 1e-11, "query");
    }
}

/// Second method: neighbours on a fine grid, both within the tolerances, lie in one part, and grid points that not even
/// four times the tolerances join lie in different ones.
void expect_parts_told_apart(const NurbsSurface& surface, const CurvatureQuery& query, const CurvaturePoints& found) {
    const int n = 250, count = (n + 1) * (n + 1);
    for (const bool opposite : {false, true}) {
        const double mean = opposite ? -query.mean : query.mean;
        std::vector<double> misfit(count);
        for (int k = 0; k < count; ++k) {
            const Curvature c = curvature(surface, double(k / (n + 1)) / n, double(k % (n + 1)) / n);
            misfit[k] = std::max(std::abs(c.gaussian() - query.gaussian) / query.gaussian_tolerance,
                                 std::abs(c.mean() - mean) / query.mean_tolerance);
        }
        DisjointSets near(count), wide(count);
        for (int i = 0; i <= n; ++i)
            for (int j = 0; j <= n; ++j)
                for (const auto& [di, dj] : {std::pair(1, 0), std::pair(0, 1), std::pair(1, 1), std::pair(1, -1)}) {
                    if (i + di > n || j + dj > n || j + dj < 0) continue;
                    const int a = i * (n + 1) + j, b = a + di * (n + 1) + dj;
                    if (di * dj == 0 && std::max(misfit[a], misfit[b]) <= 1.0) near.unite(a, b);
                    if (std::max(misfit[a], misfit[b]) <= 4.0) wide.unite(a, b);
                }
        std::map<std::size_t, ParameterBox> together;
        std::set<std::size_t> apart;
        for (int k = 0; k < count; ++k) {
            if (misfit[k] > 1.0) continue;
            apart.insert(wide.find(k));
            const double u = double(k / (n + 1)) / n, v = double(k % (n + 1)) / n;
            ParameterBox& box = together.try_emplace(near.find(k), ParameterBox{{u, u}, {v, v}}).first->second;
            box.u = {std::min(box.u.low, u), std::max(box.u.high, u)};
            box.v = {std::min(box.v.low, v), std::max(box.v.high, v)};
        }
        for (const auto& [set, box] : together)
            EXPECT_TRUE(std::any_of(found.points.begin(), found.points.end(), [&](const CurvaturePoint& point) {
                return point.opposite == opposite && point.extent.contains(box.u.low, box.v.low) &&
                       point.extent.contains(box.u.high, box.v.high);
            }));
        EXPECT_GE(std::count_if(found.points.begin(), found.points.end(),
                                [&](const CurvaturePoint& point) { return point.opposite == opposite; }),
                  static_cast<long>(apart.size()));
    }
}

/// Second method: points of a fine grid within the tolerances lie in a part.
void expect_all_within_tolerances(const NurbsSurface& surface) {
    const double u = 0.37, v = 0.61;
    CurvatureQuery query = query_at(surface, u, v);
    const CurvaturePoints exact = find_curvature_points(surface, {&query, 1});
    const int n = 250;
    for (const double share : {0.002, 0.01, 0.04}) {
        query.gaussian_tolerance = share * std::abs(query.gaussian);
        query.mean_tolerance = share * std::abs(query.mean);
        const CurvaturePoints found = find_curvature_points(surface, {&query, 1});
        int solutions = 0;
        for (const CurvaturePoint& point : found.points) solutions += point.solutions;
        EXPECT_EQ(solutions, static_cast<int>(exact.points.size())) << share;
        for (int i = 0; i <= n; ++i)
            for (int j = 0; j <= n; ++j) {
                const Curvature c = curvature(surface, double(i) / n, double(j) / n);
                for (const bool opposite : {false, true}) {
                    const double mean = opposite ? -query.mean : query.mean;
                    if (std::abs(c.gaussian() - query.gaussian) > query.gaussian_tolerance ||
                        std::abs(c.mean() - mean) > query.mean_tolerance)
                        continue;
                    EXPECT_TRUE(std::any_of(found.points.begin(), found.points.end(), [&](const CurvaturePoint& p) {
                        return p.opposite == opposite && p.extent.contains(double(i) / n, double(j) / n);
                    })) << share;
                }
            }
        expect_parts_told_apart(surface, query, found);
        for (const CurvaturePoint& point : found.points) {
            const double mean = point.opposite ? -query.mean : query.mean;
            // Boxes are accepted whose ranges are below twice the tolerances.
            EXPECT_LE(std::abs(point.curvature.gaussian() - query.gaussian), 3 * query.gaussian_tolerance);
            EXPECT_LE(std::abs(point.curvature.mean() - mean), 3 * query.mean_tolerance);
        }
    }
}

TEST(CurvaturePoints, TolerancesGiveOneCandidateForEachConnectedPart) {
    expect_all_within_tolerances(support::smooth_bicubic(8, 3));
    expect_all_within_tolerances(support::rough_bicubic(9, 5, 0.1));
    expect_all_within_tolerances(support::random_surface(3, 4, 8, 7, 5, 0.1, 2.0));
}

TEST(CurvaturePoints, PolesAreNoObstacle) {
    // The octant's side v = 1 is one point. Next to it the divided equations have wide bounds: found, but not proved.
    const NurbsSurface octant = support::ellipsoid_octant(1.0, 1.3, 2.0);
    for (const double v : {0.5, 0.9, 0.99, 0.999}) {
        const CurvatureQuery query = query_at(octant, 0.4, v);
        const CurvaturePoints found = find_curvature_points(octant, {&query, 1});
        EXPECT_FALSE(found.exhausted) << v;
        EXPECT_TRUE(std::any_of(found.points.begin(), found.points.end(), [&](const CurvaturePoint& point) {
            const double miss = (octant.value(point.at.u, point.at.v) - octant.value(0.4, v)).norm();
            return point.certified ? miss <= 1e-9 : point.extent.contains(0.4, v) && miss <= 1e-6;
        })) << v;
        if (v <= 0.9) {
            ASSERT_EQ(found.points.size(), 1u) << v;
            EXPECT_TRUE(found.points[0].certified) << v;
        }
    }
}

TEST(CurvaturePoints, FacesApplyTheirOutwardSide) {
    Model model = support::model_of({support::smooth_bicubic(8, 3), support::smooth_bicubic(8, 3)});
    model.faces[1].reversed = true;
    const CurvatureQuery query = query_at(model.faces[0].surface, 0.37, 0.61);
    const std::vector<CurvaturePoints> found = find_curvature_points(model, {&query, 1});
    ASSERT_EQ(found.size(), 2u);
    const NurbsSurface& surface = model.faces[0].surface;
    expect_same(places(surface, found[0], false), places(surface, found[1], true), 1e-12, "reversed");
    for (const CurvaturePoints& face : found)
        for (const CurvaturePoint& point : face.points)
            EXPECT_NEAR(point.curvature.mean(), point.opposite ? -query.mean : query.mean, 1e-9);
}

TEST(CurvaturePoints, BadInputIsRefusedAndWorkCanBeCancelled) {
    const NurbsSurface surface = support::rough_bicubic(20, 1);
    CurvatureQuery query{0.0, std::nan("")};
    EXPECT_THROW(find_curvature_points(surface, {&query, 1}), InvalidInput);
    query = {0.0, 1.0, 0.1, 0.0};
    EXPECT_THROW(find_curvature_points(surface, {&query, 1}), InvalidInput);
    query = query_at(surface, 0.5, 0.5);
    EXPECT_THROW(find_curvature_points(surface, {&query, 1}, {.resolution = 0.0}), InvalidInput);
    EXPECT_THROW(find_curvature_points(surface, {&query, 1}, {.boxes_per_patch = 0}), InvalidInput);
    EXPECT_THROW(
        find_curvature_points(surface, {&query, 1}, {}, Progress([](double, std::string_view) { return false; })),
        Cancelled);
    EXPECT_TRUE(find_curvature_points(surface, {}).points.empty());
    const CurvaturePoints cut = find_curvature_points(surface, {&query, 1}, {.boxes_per_patch = 1});
    EXPECT_TRUE(cut.exhausted);
}

}  // namespace
}  // namespace umbilic
