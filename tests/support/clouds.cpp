// SPDX-License-Identifier: LGPL-2.1-or-later
#include "clouds.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <umbilic/differential/area_samples.h>

namespace umbilic::support {

namespace {

void add_noise(PointCloud& cloud, double noise, std::mt19937& random) {
    std::normal_distribution<double> normal(0.0, 1.0);
    for (Vector3& p : cloud.points) p += noise * Vector3(normal(random), normal(random), normal(random));
}

}  // namespace

PointCloud graph_cloud(int count, const std::function<double(double, double)>& f, double noise, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    PointCloud cloud;
    for (int i = 0; i < count; ++i) {
        const double x = uniform(random), y = uniform(random);
        cloud.points.emplace_back(x, y, f(x, y));
    }
    add_noise(cloud, noise, random);
    return cloud;
}

PointCloud sphere_cloud(int count, double radius, double noise, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0.0, 1.0);
    PointCloud cloud;
    for (int i = 0; i < count; ++i)
        cloud.points.push_back(radius * Vector3(normal(random), normal(random), normal(random)).normalized());
    add_noise(cloud, noise, random);
    return cloud;
}

PointCloud torus_cloud(int count, double major, double minor, double noise, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    PointCloud cloud;
    while (static_cast<int>(cloud.points.size()) < count) {
        const double u = 2.0 * std::numbers::pi * uniform(random), v = 2.0 * std::numbers::pi * uniform(random);
        const double around = major + minor * std::cos(v);
        if (uniform(random) * (major + minor) > around) continue;
        cloud.points.emplace_back(around * std::cos(u), around * std::sin(u), minor * std::sin(v));
    }
    add_noise(cloud, noise, random);
    return cloud;
}

PointCloud scan_of(const Model& model, const ScanKind& kind, const SimilarityTransform& model_scan, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<Vector3> points;
    for (const AreaSample& sample : area_samples(model, {.count = 6 * kind.points, .seed = seed}))
        points.push_back(sample.curvature.point);
    std::shuffle(points.begin(), points.end(), random);
    points.resize(std::min<std::size_t>(points.size(), kind.points));
    const Vector3 centre = points.front();
    std::sort(points.begin(), points.end(), [&](const Vector3& a, const Vector3& b) {
        return (a - centre).squaredNorm() < (b - centre).squaredNorm();
    });
    points.resize(static_cast<std::size_t>(kind.coverage * static_cast<double>(points.size())));
    PointCloud cloud;
    cloud.points = std::move(points);
    add_noise(cloud, kind.noise, random);
    const SimilarityTransform scan_model = model_scan.inverse();
    for (Vector3& p : cloud.points) p = scan_model.apply(p);
    return cloud;
}

PointCloud mesh_of(const NurbsSurface& surface, int n) {
    PointCloud cloud;
    const ParameterBox domain = surface.domain();
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            cloud.points.push_back(surface.value(domain.u.low + domain.u.length() * i / (n - 1),
                                                 domain.v.low + domain.v.length() * j / (n - 1)));
    for (int i = 0; i + 1 < n; ++i)
        for (int j = 0; j + 1 < n; ++j) {
            const int a = i * n + j, b = a + n;
            cloud.triangles.push_back({a, b, b + 1});
            cloud.triangles.push_back({a, b + 1, a + 1});
        }
    return cloud;
}

}  // namespace umbilic::support
