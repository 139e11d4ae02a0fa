// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/umbilics/duplicates.h>

#include <algorithm>
#include <cmath>

namespace umbilic {

namespace {

/// Zeros that two neighbours see at one place differ by their radii times the ratio of their Jacobians, which is
/// moderate unless one is nearly singular.
constexpr double jacobian_ratio = 64.0;

/// The zero's ball is not wholly inside its patch.
bool on_edge(const IsolatedZero& zero) {
    const Vector2 low = zero.at - zero.input_radius, high = zero.at + zero.input_radius;
    return low.minCoeff() <= 0.0 || high.maxCoeff() >= 1.0;
}

struct Placed {
    Vector2 at;
    Vector2 reach;
};

Placed placed(const Candidate& candidate, const BezierPatch& patch) {
    const Vector2 side(patch.domain.u.length(), patch.domain.v.length());
    const Vector2 rounding = Vector2(std::abs(patch.domain.u.low) + std::abs(patch.domain.u.high),
                                     std::abs(patch.domain.v.low) + std::abs(patch.domain.v.high)) *
                             std::numeric_limits<double>::epsilon();
    return {Vector2(candidate.umbilic.at.u, candidate.umbilic.at.v),
            jacobian_ratio * (candidate.zero.input_radius.cwiseProduct(side) + rounding)};
}

/// True if the parameters agree, directly or across a side on which the surface closes on itself.
bool same_place(const NurbsSurface& surface, const InputRounding& input, const Candidate& first,
                const Candidate& second, const BezierPatch& first_patch, const BezierPatch& second_patch) {
    const Placed a = placed(first, first_patch), b = placed(second, second_patch);
    const Vector2 reach = a.reach + b.reach;
    Vector2 gap = (a.at - b.at).cwiseAbs();
    if ((gap.array() <= reach.array()).all()) return true;
    const ParameterBox domain = surface.domain();
    const Vector2 period(domain.u.length(), domain.v.length());
    gap = gap.cwiseMin((period - gap).cwiseAbs());
    if ((gap.array() > reach.array()).any()) return false;
    const SurfaceDerivatives d = surface.derivatives(first.umbilic.at.u, first.umbilic.at.v, 1);
    const double distance = reach.x() * d.r_u().norm() + reach.y() * d.r_v().norm() + jacobian_ratio * input.position;
    return (first.umbilic.point - second.umbilic.point).norm() <= distance;
}

}  // namespace

std::vector<SightedUmbilic> merge_duplicates(const NurbsSurface& surface, const BezierPatches& patches,
                                             const InputRounding& input, std::vector<Candidate> candidates,
                                             std::vector<OpenPart>& open) {
    const auto sighting = [&](const Candidate& candidate) {
        const ParameterBox& domain = patches.patches[candidate.patch].domain;
        return Sighting{candidate.patch, Vector2(domain.u.low + candidate.zero.at.x() * domain.u.length(),
                                                 domain.v.low + candidate.zero.at.y() * domain.v.length())};
    };
    std::vector<std::vector<Sighting>> sightings(candidates.size());
    std::vector<std::size_t> edge;
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        sightings[k].push_back(sighting(candidates[k]));
        if (on_edge(candidates[k].zero)) edge.push_back(k);
    }
    std::vector<bool> dropped(candidates.size(), false);
    for (const std::size_t k : edge) {
        if (dropped[k]) continue;
        bool contradicted = false;
        for (std::size_t other = 0; other < candidates.size(); ++other) {
            const Candidate &a = candidates[k], &b = candidates[other];
            if (other == k || dropped[other] || a.patch == b.patch) continue;
            if (!same_place(surface, input, a, b, patches.patches[a.patch], patches.patches[b.patch])) continue;
            dropped[other] = true;
            sightings[k].insert(sightings[k].end(), sightings[other].begin(), sightings[other].end());
            contradicted = contradicted || a.zero.sign != b.zero.sign;
        }
        if (contradicted) {
            dropped[k] = true;
            open.push_back({candidates[k].umbilic.box, false});
        }
    }
    std::vector<SightedUmbilic> result;
    for (std::size_t k = 0; k < candidates.size(); ++k)
        if (!dropped[k]) result.push_back({std::move(candidates[k].umbilic), std::move(sightings[k])});
    return result;
}

}  // namespace umbilic
