// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/curvature_seeds.h>

#include <algorithm>
#include <cmath>
#include <map>

#include <Eigen/SVD>

#include <umbilic/curvature_points/curvature_gradient.h>
#include <umbilic/curvature_points/dependence.h>
#include <umbilic/differential/fundamental_forms.h>
#include <umbilic/matching/pose_distance.h>

namespace umbilic {

namespace {

/// Samples among which seeds are chosen.
constexpr std::size_t seed_pool = 1200;
/// Seeds need a principal frame: (kappa_max - kappa_min) / rho at least this.
constexpr double least_anisotropy = 0.2;
/// K and H alike: within this part of rho^2 and rho.
constexpr double alike = 0.1;
/// Commonness below this makes a seed no better: it has few solutions already.
constexpr double rare = 0.01;
/// A seed counts less where the surface is flatter than this, relative to one over the length.
constexpr double curved = 2.0;

double rho(const Curvature& c) {
    return std::hypot(c.kappa_max, c.kappa_min);
}

}  // namespace

std::vector<CurvatureSeed> choose_curvature_seeds(const PreparedModel& model, int count) {
    std::map<int, const Face*> faces;
    for (const Face& face : model.model.faces)
        if (!curvature_dependence(face)) faces[face.number] = &face;
    const std::vector<AreaSample>& samples = model.features.samples;
    const double length = shape_size(model.features).length;
    std::vector<CurvatureSeed> pool;
    const std::size_t stride = samples.size() / seed_pool + 1;
    for (std::size_t k = 0; k < samples.size(); k += stride) {
        const Curvature& c = samples[k].curvature;
        const double size = rho(c);
        const auto face = faces.find(samples[k].at.face);
        if (face == faces.end() || !(size > 0.0) || c.kappa_max - c.kappa_min < least_anisotropy * size) continue;
        const SurfaceDerivatives d = face->second->surface.derivatives(samples[k].at.u, samples[k].at.v, 3);
        if (!regular(d)) continue;
        const CurvatureGradient gradient = curvature_gradient(d);
        Matrix2 slopes;
        slopes << gradient.gaussian_slope.transpose() / (size * size), gradient.mean_slope.transpose() / size;
        const double least = slopes.jacobiSvd().singularValues()[1];
        if (!(least * length > 0.0)) continue;
        pool.push_back({samples[k].at, c, 1.0 / least});
    }
    for (CurvatureSeed& seed : pool) {
        const double size = rho(seed.curvature);
        int like = 0;
        for (const CurvatureSeed& other : pool)
            like += std::abs(other.curvature.gaussian() - seed.curvature.gaussian()) < alike * size * size &&
                    std::abs(std::abs(other.curvature.mean()) - std::abs(seed.curvature.mean())) < alike * size;
        seed.commonness = static_cast<double>(like) / static_cast<double>(pool.size());
    }
    const auto worth = [&](const CurvatureSeed& seed) {
        return std::min(1.0, length / seed.sensitivity) * std::min(1.0, rho(seed.curvature) * length / curved) * rare /
               (rare + seed.commonness);
    };
    // Farthest first, weighted.
    std::vector<CurvatureSeed> result;
    std::vector<double> nearest(pool.size(), length);
    while (static_cast<int>(result.size()) < count) {
        std::size_t best = pool.size();
        double best_value = 0.0;
        for (std::size_t k = 0; k < pool.size(); ++k) {
            const double value = nearest[k] * std::sqrt(worth(pool[k]));
            if (value > best_value) {
                best_value = value;
                best = k;
            }
        }
        if (best == pool.size()) break;
        result.push_back(pool[best]);
        for (std::size_t k = 0; k < pool.size(); ++k)
            nearest[k] = std::min(nearest[k], (pool[k].curvature.point - pool[best].curvature.point).norm());
    }
    return result;
}

}  // namespace umbilic
