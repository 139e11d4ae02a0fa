// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/by_principal_frame.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>

#include <Eigen/Geometry>

#include <tbb/parallel_for.h>

namespace umbilic {

namespace {

using Entry = PrincipalFrameTable::Entry;

/// Seeds need a well-defined frame: (kappa_max - kappa_min) / magnitude at least this.
constexpr double least_anisotropy = 0.2;
/// Random points of the suspect among which seeds are chosen.
constexpr int seed_pool = 90;
/// Error of a transformed probe: share of its distance from the seed (errors of frame and scale grow with it), of the
/// suspect's extent, and of the original's sample step. Measured values of the literature on this formulation.
constexpr double tolerance_by_distance = 0.08, tolerance_by_extent = 0.001, tolerance_by_step = 0.3;
/// A pose is given up after 2 + 0.3 k outliers among the first k probes.
constexpr double outliers_at_once = 2.0, outlier_share = 0.3;
/// The first probes judge all poses of a seed; as many of the best as this are tested on every probe.
constexpr std::size_t first_probes = 24, poses_of_seed = 100;
/// The suspect as a part of the original: its moved extent relative to the original's.
constexpr double smallest_part = 0.04, largest_part = 1.3;
/// Poses closer than this are one: offset relative to the moved extent, rotation in radians, logarithm of the scale.
constexpr double same_offset = 0.02, same_rotation = 0.04, same_log_scale = 0.03;
/// With a known scale the curvatures may differ by this share of their magnitude.
constexpr double known_scale_window = 0.15;

double cubic_distance(const Cubic& x, const Cubic& y) {
    return std::sqrt(Cubic{x.a - y.a, x.b - y.b, x.c - y.c, x.d - y.d}.squared_norm());
}

/// Seeds: strongly curved relative to the model, anisotropic, far from each other.
std::vector<int> choose_seeds(const PrincipalFrameTable& table, int wanted) {
    const std::vector<Entry>& entries = table.entries();
    std::vector<int> pool(entries.size());
    for (std::size_t i = 0; i < pool.size(); ++i) pool[i] = static_cast<int>(i);
    std::mt19937 random(1);
    std::shuffle(pool.begin(), pool.end(), random);
    std::erase_if(pool, [&](int i) {
        const ShapeSignature& s = entries[i].signature;
        return s.anisotropy < least_anisotropy || !(s.magnitude > 0.0);
    });
    if (static_cast<int>(pool.size()) > seed_pool) pool.resize(seed_pool);
    const auto rank = [&](int i) {
        const ShapeSignature& s = entries[i].signature;
        return s.magnitude * std::min(1.0, s.anisotropy);
    };
    std::stable_sort(pool.begin(), pool.end(), [&](int i, int j) { return rank(i) > rank(j); });

    std::vector<int> seeds;
    std::vector<double> nearest(pool.size(), table.extent());
    while (static_cast<int>(seeds.size()) < std::min<int>(wanted, static_cast<int>(pool.size()))) {
        // Farthest first, weighted by rank so that flat far corners do not win.
        int best = -1;
        double best_value = 0.0;
        for (std::size_t i = 0; i < pool.size(); ++i) {
            const double value = nearest[i] * std::sqrt(rank(pool[i]));
            if (value > best_value) best_value = value, best = static_cast<int>(i);
        }
        if (best < 0) break;
        seeds.push_back(pool[best]);
        for (std::size_t i = 0; i < pool.size(); ++i)
            nearest[i] = std::min(nearest[i], (entries[pool[i]].frame.point - entries[pool[best]].frame.point).norm());
    }
    return seeds;
}

std::vector<Vector3> choose_probes(const PrincipalFrameTable& table, int wanted) {
    std::vector<int> order(table.entries().size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
    std::mt19937 random(2);
    std::shuffle(order.begin(), order.end(), random);
    std::vector<Vector3> probes;
    for (int i = 0; i < wanted && i < static_cast<int>(order.size()); ++i)
        probes.push_back(table.entries()[order[i]].frame.point);
    return probes;
}

/// One way of looking at a seed: its frame as columns (e1, e2, n) and its signature there.
struct View {
    Matrix3 frame;
    ShapeSignature signature;
    bool mirror = false;
};

Matrix3 frame_of(const Curvature& c) {
    Matrix3 result;
    result << c.direction_max, c.direction_min, c.normal;
    return result;
}

std::vector<View> views_of(const Entry& entry, const PrincipalFrameOptions& options) {
    std::vector<View> views;
    const auto add = [&](const Matrix3& frame, const ShapeSignature& signature) {
        const Matrix3 turned = frame * Vector3(-1, -1, 1).asDiagonal();
        views.push_back({frame, signature, false});
        views.push_back({turned, half_turned(signature), false});
        if (options.mirror == MirrorChoice::never) return;
        views.push_back({frame, mirrored(signature), true});
        views.push_back({turned, mirrored(half_turned(signature)), true});
    };
    add(frame_of(entry.frame), entry.signature);
    if (options.flip_normals) add(frame_of(flipped(entry.frame)), seen_from_behind(entry.signature));
    return views;
}

/// Scale the pair of magnitudes asks for, or nothing if it is not allowed.
std::optional<double> scale_of(const ShapeSignature& suspect, const ShapeSignature& original,
                               const ScaleChoice& choice) {
    const double scale = suspect.magnitude / original.magnitude;
    if (choice.kind == ScaleChoice::Kind::fixed)
        return std::abs(std::log(scale)) <= known_scale_window ? std::optional(1.0) : std::nullopt;
    if (choice.kind == ScaleChoice::Kind::range &&
        (scale < choice.low * (1 - known_scale_window) || scale > choice.high * (1 + known_scale_window)))
        return std::nullopt;
    return scale;
}

struct Search {
    const PrincipalFrameTable& original;
    const PrincipalFrameTable& suspect;
    const PrincipalFrameOptions& options;
    std::vector<Vector3> probes;

    /// Score on the first `count` probes of a pose that maps the seed's point exactly; negative if rejected or if it
    /// cannot reach `least`.
    double score(const SimilarityTransform& pose, const Vector3& seed, std::size_t count, double least) const {
        double sum = 0.0;
        int outliers = 0;
        const double fixed = tolerance_by_extent * pose.scale * suspect.extent() + tolerance_by_step * original.step();
        for (std::size_t k = 0; k < count; ++k) {
            if (sum + static_cast<double>(count - k) < least * static_cast<double>(count)) return -1.0;
            const double tolerance = tolerance_by_distance * pose.scale * (probes[k] - seed).norm() + fixed;
            const std::optional<double> distance = original.approximate_distance(pose.apply(probes[k]), tolerance);
            if (distance)
                sum += 1.0 - *distance * *distance / (tolerance * tolerance);
            else if (++outliers > outliers_at_once + outlier_share * static_cast<double>(k + 1))
                return -1.0;
        }
        return sum / static_cast<double>(count);
    }

    std::vector<PoseCandidate> poses_of(const Entry& seed, const Progress& progress) const {
        std::vector<PoseCandidate> found;
        std::vector<double> best;  // scores of the best so far, a heap with the least on top
        const std::size_t first_count = std::min(first_probes, probes.size());
        for (const View& view : views_of(seed, options)) {
            const auto [first, last] = original.angle_range(view.signature.angle - options.angle_window,
                                                            view.signature.angle + options.angle_window);
            const double own = std::sqrt(view.signature.cubic.squared_norm());
            const double allowed = options.third_order_factor * (own + options.third_order_offset);
            int compared = 0;
            for (int i = first; i < last; i += options.stride) {
                if (++compared % 256 == 0) progress.check();
                const Entry& target = original.entries()[i];
                if (target.signature.anisotropy < least_anisotropy / 2) continue;
                if (options.third_order && cubic_distance(view.signature.cubic, target.signature.cubic) > allowed)
                    continue;
                const std::optional<double> scale = scale_of(view.signature, target.signature, options.scale);
                if (!scale) continue;
                const double part = *scale * suspect.extent() / original.extent();
                if (part < smallest_part || part > largest_part) continue;
                const Matrix3 hand = Vector3(1, view.mirror ? -1 : 1, 1).asDiagonal();
                const Matrix3 orthogonal = frame_of(target.frame) * hand * view.frame.transpose();
                PoseCandidate pose;
                pose.original_suspect = similarity_from_orthogonal(
                    *scale, orthogonal, target.frame.point - *scale * (orthogonal * seed.frame.point));
                pose.score = score(pose.original_suspect, seed.frame.point, first_count,
                                   best.size() < poses_of_seed ? 0.0 : best.front());
                pose.method = MatchMethod::curvature;
                if (!(pose.score > 0.0)) continue;
                found.push_back(pose);
                best.push_back(pose.score);
                std::push_heap(best.begin(), best.end(), std::greater<>());
                if (best.size() <= poses_of_seed) continue;
                std::pop_heap(best.begin(), best.end(), std::greater<>());
                best.pop_back();
            }
        }
        std::erase_if(found, [&](const PoseCandidate& pose) { return pose.score < best.front(); });
        for (PoseCandidate& pose : found)
            pose.score = score(pose.original_suspect, seed.frame.point, probes.size(), 0.0);
        std::erase_if(found, [](const PoseCandidate& pose) { return !(pose.score > 0.0); });
        return found;
    }

    bool same(const SimilarityTransform& a, const SimilarityTransform& b) const {
        if (a.mirrored != b.mirrored) return false;
        if (std::abs(std::log(a.scale / b.scale)) > same_log_scale) return false;
        if (rotation_angle_between(a.rotation, b.rotation) > same_rotation) return false;
        const Vector3& somewhere = probes.front();
        return (a.apply(somewhere) - b.apply(somewhere)).norm() <= same_offset * a.scale * suspect.extent();
    }
};

}  // namespace

std::vector<PoseCandidate> propose_by_principal_frame(const PrincipalFrameTable& original,
                                                      const PrincipalFrameTable& suspect,
                                                      const PrincipalFrameOptions& options, const Progress& progress) {
    if (original.entries().empty() || suspect.entries().empty()) return {};
    const Search search{original, suspect, options, choose_probes(suspect, options.probes)};
    std::vector<int> seeds = choose_seeds(suspect, options.seeds);
    seeds.erase(seeds.begin(), seeds.begin() + std::min<std::size_t>(options.first_seed, seeds.size()));
    std::vector<std::vector<PoseCandidate>> found(seeds.size());
    tbb::parallel_for(std::size_t(0), seeds.size(),
                      [&](std::size_t i) { found[i] = search.poses_of(suspect.entries()[seeds[i]], progress); });

    std::vector<PoseCandidate> all;
    for (const std::vector<PoseCandidate>& poses : found) all.insert(all.end(), poses.begin(), poses.end());
    std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.score > b.score; });
    std::vector<PoseCandidate> best;
    for (const PoseCandidate& pose : all) {
        if (static_cast<int>(best.size()) >= options.keep) break;
        const bool known = std::any_of(best.begin(), best.end(), [&](const PoseCandidate& other) {
            return search.same(pose.original_suspect, other.original_suspect);
        });
        if (!known) best.push_back(pose);
    }
    return best;
}

}  // namespace umbilic
