// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/differential/area_samples.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include <support/surfaces.h>
#include <tbb/global_control.h>
#include <umbilic/core/errors.h>

namespace umbilic {
namespace {

std::map<int, double> weight_by_face(const std::vector<AreaSample>& samples) {
    std::map<int, double> result;
    for (const AreaSample& sample : samples) result[sample.at.face] += sample.weight;
    return result;
}

TEST(AreaSamples, CountsAndWeightsFollowTheFaces) {
    const Model model = support::model_of({support::smooth_bicubic(8, 1), support::ellipsoid_octant(1, 2, 3),
                                           support::torus_quarter(3, 1),
                                           support::transformed(support::smooth_bicubic(5, 2), {.scale = 1e-3})});
    const std::vector<AreaSample> samples = area_samples(model, {.count = 2000});
    std::map<int, int> counts;
    for (const AreaSample& sample : samples) ++counts[sample.at.face];
    const std::map<int, double> weights = weight_by_face(samples);
    for (const Face& face : model.faces) {
        EXPECT_NEAR(weights.at(face.number), face.area, 1e-12 * face.area);
        const double share = 2000 * face.area / model.area;
        EXPECT_NEAR(counts[face.number], std::max(share, 1.0), 0.5);
    }
}

/// On a sphere areas between parallels are equal for equal heights (Archimedes), whatever the parametrisation.
TEST(AreaSamples, UniformOnASphere) {
    const Model model = support::model_of({support::ellipsoid_octant(1, 1, 1)});
    const int count = 4000, bands = 10;
    std::array<int, bands> zones{}, sectors{};
    double mean_height = 0.0;
    for (const AreaSample& sample : area_samples(model, {.count = count})) {
        const Vector3& p = sample.curvature.point;
        ++zones[std::min(bands - 1, static_cast<int>(bands * p.z()))];
        ++sectors[std::min(bands - 1, static_cast<int>(bands * std::atan2(p.y(), p.x()) / (std::numbers::pi / 2)))];
        mean_height += sample.weight * p.z() / model.area;
        EXPECT_NEAR(sample.curvature.kappa_max, 1.0, 1e-6);
        EXPECT_GT(sample.curvature.normal.dot(p), 0.99);
    }
    // A random sample would stray by 20 (one standard deviation); the low-discrepancy sequence stays well below.
    for (int k = 0; k < bands; ++k) {
        EXPECT_NEAR(zones[k], count / bands, 20);
        EXPECT_NEAR(sectors[k], count / bands, 20);
    }
    EXPECT_NEAR(mean_height, 0.5, 1e-3);
}

TEST(AreaSamples, IntegralsConvergeOnAnUnevenParametrisation) {
    // x = s^3 concentrates parameters near x = 0.
    std::vector<Vector3> poles;
    for (int i = 0; i <= 3; ++i)
        for (int j = 0; j <= 1; ++j) poles.emplace_back(i == 3 ? 1.0 : 0.0, j, 0.0);
    const Model model =
        support::model_of({NurbsSurface(KnotVector::bezier(3), KnotVector::bezier(1), std::move(poles))});
    double x = 0.0, xx = 0.0;
    int low = 0;
    const std::vector<AreaSample> samples = area_samples(model, {.count = 4000});
    for (const AreaSample& sample : samples) {
        const double value = sample.curvature.point.x();
        x += sample.weight * value;
        xx += sample.weight * value * value;
        low += value < 0.1;
    }
    EXPECT_NEAR(x, 0.5, 2e-3);
    EXPECT_NEAR(xx, 1.0 / 3, 2e-3);
    EXPECT_NEAR(low, 400, 20);
}

TEST(AreaSamples, ReversedFacesPointOutward) {
    Model model = support::model_of({support::ellipsoid_octant(1, 1, 1)});
    model.faces[0].reversed = true;
    for (const AreaSample& sample : area_samples(model, {.count = 50})) {
        EXPECT_LT(sample.curvature.normal.dot(sample.curvature.point), -0.99);
        EXPECT_NEAR(sample.curvature.kappa_min, -1.0, 1e-6);
    }
}

/// Square in the plane z = 0, cut to the triangle or sliver below a line from the origin to (1, top).
Model wedge(double top) {
    Model model =
        support::model_of({NurbsSurface(KnotVector::bezier(1), KnotVector::bezier(1),
                                        {Vector3(0, 0, 0), Vector3(0, 1, 0), Vector3(1, 0, 0), Vector3(1, 1, 0)})});
    const auto line = [](Vector2 a, Vector2 b) {
        return TrimmingCurve{.curve = NurbsCurve2(KnotVector::bezier(1), {a, b})};
    };
    model.faces[0].region =
        TrimmingRegion(model.faces[0].surface.domain(),
                       {{line({0, 0}, {1, 0}), line({1, 0}, {1, top}), line({1, top}, {0, 0})}}, {}, {});
    model.area = model.faces[0].area = 0.5 * top;
    return model;
}

TEST(AreaSamples, StayInsideTheLoops) {
    const std::vector<AreaSample> samples = area_samples(wedge(1.0), {.count = 1000});
    EXPECT_EQ(samples.size(), 1000u);
    Vector3 mean = Vector3::Zero();
    double sum = 0.0;
    for (const AreaSample& sample : samples) {
        EXPECT_LE(sample.at.v, sample.at.u + 2e-6);
        mean += sample.weight * sample.curvature.point;
        sum += sample.weight;
    }
    EXPECT_NEAR(sum, 0.5, 1e-14);
    EXPECT_NEAR(mean.x() / sum, 2.0 / 3, 5e-3);
    EXPECT_NEAR(mean.y() / sum, 1.0 / 3, 5e-3);
}

TEST(AreaSamples, EverySliverGetsASample) {
    for (const double top : {1e-2, 1e-4, 1e-5}) {
        const std::vector<AreaSample> samples = area_samples(wedge(top), {.count = 1});
        ASSERT_EQ(samples.size(), 1u) << top;
        EXPECT_LE(samples[0].at.v, top * samples[0].at.u + 2e-6);
    }
}

TEST(AreaSamples, SameForAnyNumberOfThreads) {
    const Model model = support::model_of({support::smooth_bicubic(8, 1), support::torus_quarter(3, 1),
                                           support::smooth_bicubic(6, 3), support::ellipsoid_octant(2, 2, 1)});
    const auto run = [&](std::size_t threads, std::uint64_t seed) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        return area_samples(model, {.count = 500, .seed = seed});
    };
    const std::vector<AreaSample> one = run(1, 0), many = run(4, 0), other = run(4, 1);
    ASSERT_EQ(one.size(), many.size());
    bool differs = false;
    for (std::size_t i = 0; i < one.size(); ++i) {
        EXPECT_EQ(one[i].at.face, many[i].at.face);
        EXPECT_EQ(one[i].at.u, many[i].at.u);
        EXPECT_EQ(one[i].at.v, many[i].at.v);
        EXPECT_EQ(one[i].weight, many[i].weight);
        differs = differs || one[i].at.u != other[i].at.u;
    }
    EXPECT_TRUE(differs);
}

TEST(AreaSamples, RefusesAndStops) {
    const Model model = support::model_of({support::smooth_bicubic(5, 1)});
    EXPECT_THROW(area_samples(model, {.count = 0}), InvalidInput);
    EXPECT_TRUE(area_samples(Model{}).empty());
    EXPECT_THROW(area_samples(model, {}, Progress([](double, std::string_view) { return false; })), Cancelled);
}

}  // namespace
}  // namespace umbilic
