// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/umbilics/by_projected_polyhedron.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <support/surfaces.h>
#include <umbilic/core/errors.h>
#include <umbilic/umbilics/find.h>

namespace umbilic {
namespace {

TEST(UmbilicsByProjectedPolyhedron, AgreeWithTheCertifiedSearchOnRandomSurfaces) {
    int umbilics = 0;
    for (unsigned seed = 0; seed < 30; ++seed) {
        SCOPED_TRACE(seed);
        const int p = 2 + seed % 3, q = 2 + seed / 3 % 2;
        const NurbsSurface surface = support::random_surface(p, q, p + 3, q + 3, seed, 0.2, seed % 3 == 0 ? 2.0 : 1.0);
        const FaceUmbilics certified = find_umbilics(surface);
        const ProjectedPolyhedronUmbilics found = find_umbilics_by_projected_polyhedron(surface);
        EXPECT_FALSE(found.exhausted);
        EXPECT_EQ(found.umbilics.size(), certified.umbilics.size());
        if (certified.undecided.empty()) {
            EXPECT_TRUE(found.undecided.empty());
        }
        for (const Umbilic& umbilic : certified.umbilics) {
            ++umbilics;
            const auto same = [&](const UmbilicPosition& other) {
                return std::abs(other.u - umbilic.at.u) <= other.radius.x() + umbilic.radius &&
                       std::abs(other.v - umbilic.at.v) <= other.radius.y() + umbilic.radius;
            };
            const auto it = std::find_if(found.umbilics.begin(), found.umbilics.end(), same);
            ASSERT_NE(it, found.umbilics.end()) << umbilic.at.u << ' ' << umbilic.at.v;
            EXPECT_TRUE(it->certified);
            EXPECT_EQ(it->index, umbilic.index);
            EXPECT_LE(it->radius.maxCoeff(), 1e-7);
        }
    }
    EXPECT_GT(umbilics, 60);
}

TEST(UmbilicsByProjectedPolyhedron, TheThesisSystemHasTheSamePlaces) {
    ProjectedPolyhedronUmbilicOptions thesis;
    thesis.system = UmbilicSystem::thesis;
    for (unsigned seed = 0; seed < 6; ++seed) {
        SCOPED_TRACE(seed);
        const NurbsSurface surface = support::random_surface(3, 3, 5, 5, seed, 0.2);
        const FaceUmbilics certified = find_umbilics(surface);
        const ProjectedPolyhedronUmbilics found = find_umbilics_by_projected_polyhedron(surface, thesis);
        for (const UmbilicPosition& umbilic : found.umbilics) {
            EXPECT_FALSE(umbilic.certified);
            EXPECT_EQ(umbilic.index, 0.0);
        }
        for (const Umbilic& umbilic : certified.umbilics) {
            const bool met =
                std::any_of(found.umbilics.begin(), found.umbilics.end(), [&](const UmbilicPosition& other) {
                    return std::abs(other.u - umbilic.at.u) <= other.radius.x() + umbilic.radius &&
                           std::abs(other.v - umbilic.at.v) <= other.radius.y() + umbilic.radius;
                });
            const bool open = std::any_of(found.undecided.begin(), found.undecided.end(), [&](const ParameterBox& box) {
                return umbilic.at.u >= box.u.low - umbilic.radius && umbilic.at.u <= box.u.high + umbilic.radius &&
                       umbilic.at.v >= box.v.low - umbilic.radius && umbilic.at.v <= box.v.high + umbilic.radius;
            });
            EXPECT_TRUE(met || open);
        }
    }
}

TEST(UmbilicsByProjectedPolyhedron, LineAndPlaneStayBounded) {
    const ProjectedPolyhedronUmbilics plane = find_umbilics_by_projected_polyhedron(support::smooth_bicubic(6, 1, 0.0));
    EXPECT_TRUE(plane.umbilics.empty());
    EXPECT_EQ(plane.undecided.size(), 9u);
    EXPECT_EQ(plane.boxes, 9);
    // A cylinder over a curve with an inflection: a line of umbilics.
    ProjectedPolyhedronUmbilicOptions options;
    options.boxes_per_patch = 3000;
    const ProjectedPolyhedronUmbilics line = find_umbilics_by_projected_polyhedron(
        support::graph_patch(3, 1, [](double x, double) { return x * x * x - 0.2 * x * x; }), options);
    EXPECT_TRUE(line.umbilics.empty());
    EXPECT_FALSE(line.undecided.empty());
    EXPECT_LE(line.boxes, 3000);
}

TEST(UmbilicsByProjectedPolyhedron, BadOptionsAndCancelling) {
    const NurbsSurface surface = support::table_3_1_patch();
    ProjectedPolyhedronUmbilicOptions options;
    options.tolerance = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(find_umbilics_by_projected_polyhedron(surface, options), InvalidInput);
    options = {};
    options.boxes_per_patch = 0;
    EXPECT_THROW(find_umbilics_by_projected_polyhedron(surface, options), InvalidInput);
    const Progress progress([](double, std::string_view) { return false; });
    EXPECT_THROW(find_umbilics_by_projected_polyhedron(surface, {}, progress), Cancelled);
}

}  // namespace
}  // namespace umbilic
