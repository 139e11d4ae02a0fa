// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/similarity/nodes.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include <Eigen/Geometry>

#include <umbilic/similarity/foot_curvature.h>
#include <umbilic/similarity/statistics.h>
#include <umbilic/similarity/thresholds.h>

namespace umbilic {

namespace {

/// Angle in [0, pi/2] between two lines.
double angle_between_lines(const Vector3& a, const Vector3& b) {
    return std::atan2(a.cross(b).norm(), std::abs(a.dot(b)));
}

/// Every curvature a model may be said to have at a place known within `radius` (mm of the original), in the original's
/// frame.
std::vector<Curvature> placed_curvatures(const PlacedModel& model, const SurfacePoint& at, double radius) {
    std::vector<Curvature> result =
        curvatures_within(model.prepared.model.face(at.face), at.u, at.v, radius / model.original_model.scale);
    for (Curvature& curvature : result) curvature = placed(curvature, model);
    return result;
}

struct CurvaturePair {
    Curvature node, foot;
};

/// The curvatures of node and foot that agree best: next to a knot line of reduced continuity either of the two may
/// have come to lie on the other side.
std::optional<CurvaturePair> best_pair(const Curvature& node, const std::vector<Curvature>& nodes,
                                       const std::vector<Curvature>& feet) {
    if (feet.empty()) return {};
    const auto difference = [](const Curvature& a, const Curvature& b) {
        return std::abs(a.kappa_max - b.kappa_max) + std::abs(a.kappa_min - b.kappa_min);
    };
    CurvaturePair best{node, feet.front()};
    for (const Curvature& foot : feet) {
        if (difference(node, foot) < difference(best.node, best.foot)) best = {node, foot};
        for (const Curvature& other : nodes)
            if (difference(other, foot) < difference(best.node, best.foot)) best = {other, foot};
    }
    return best;
}

/// False where the surface bends more tightly than places are told apart: a copy within delta_0 need not bend alike.
bool resolved(const Curvature& curvature, const NodeTolerances& tolerances) {
    return std::max(std::abs(curvature.kappa_max), std::abs(curvature.kappa_min)) * tolerances.distance <= 1.0;
}

void compare_curvatures(NodeComparison& comparison, const Curvature& node, const Curvature& foot, double significant) {
    comparison.kappa_max = std::abs(node.kappa_max - foot.kappa_max);
    comparison.kappa_min = std::abs(node.kappa_min - foot.kappa_min);
    if (std::min(node.kappa_max - node.kappa_min, foot.kappa_max - foot.kappa_min) > significant)
        comparison.direction = angle_between_lines(node.direction_max, foot.direction_max);
}

}  // namespace

Curvature placed(const Curvature& curvature, const PlacedModel& model) {
    const SimilarityTransform& t = model.original_model;
    Curvature result = curvature;
    result.point = t.apply(curvature.point);
    // An outward normal stays outward under a mirror image, so curvatures keep their sign.
    result.normal = t.apply_direction(curvature.normal);
    result.kappa_max = curvature.kappa_max / t.scale;
    result.kappa_min = curvature.kappa_min / t.scale;
    result.direction_max = t.apply_direction(curvature.direction_max);
    result.direction_min = result.normal.cross(result.direction_max);
    return model.flipped ? flipped(result) : result;
}

Feet find_feet(const PlacedModel& model, const NodeSet& nodes, const PlacedModel& other, const Progress& progress) {
    // Queried in portions, so that a cancel is heard.
    constexpr std::size_t portion = 500;
    Feet result;
    std::vector<Vector3> queries;
    const SimilarityTransform other_original = other.original_model.inverse();
    for (const AreaSample& sample : nodes.nodes) {
        result.nodes.push_back(model.original_model.apply(sample.curvature.point));
        queries.push_back(other_original.apply(result.nodes.back()));
    }
    for (std::size_t begin = 0; begin < queries.size(); begin += portion) {
        progress.report(static_cast<double>(begin) / queries.size(), "foot points");
        const std::size_t count = std::min(portion, queries.size() - begin);
        for (ClosestPoint foot : other.prepared.tree.closest(std::span(queries).subspan(begin, count))) {
            assert(std::isfinite(foot.distance));
            foot.point = other.original_model.apply(foot.point);
            foot.distance *= other.original_model.scale;
            result.feet.push_back(foot);
        }
    }
    return result;
}

double normal_agreement(const PlacedModel& model, const NodeSet& nodes, const PlacedModel& other, const Feet& feet,
                        double limit) {
    double sum = 0.0;
    for (std::size_t i = 0; i < feet.nodes.size(); ++i) {
        const AreaSample& sample = nodes.nodes[i];
        const ClosestPoint& foot = feet.feet[i];
        if (!(foot.distance <= limit)) continue;
        const std::vector<Curvature> there =
            curvatures_within(other.prepared.model.face(foot.at.face), foot.at.u, foot.at.v, 0.0);
        if (there.empty()) continue;
        sum += sample.weight * placed(sample.curvature, model).normal.dot(placed(there.front(), other).normal);
    }
    return sum;
}

DirectedComparison compare_nodes(const PlacedModel& model, const NodeSet& nodes, const PlacedModel& other,
                                 const Feet& feet, const NodeTolerances& tolerances) {
    DirectedComparison result;
    result.of_wireframe = nodes.of_wireframe;
    const double area_scale = model.original_model.scale * model.original_model.scale;
    const double overlap_limit = spread_factor * tolerances.distance;
    double area = 0.0, covered = 0.0, overlap = 0.0;
    for (std::size_t i = 0; i < feet.nodes.size(); ++i) {
        const AreaSample& sample = nodes.nodes[i];
        const ClosestPoint& foot = feet.feet[i];
        const Curvature node = placed(sample.curvature, model);
        NodeComparison comparison{.at = sample.at, .foot = foot.at, .point = feet.nodes[i]};
        comparison.weight = sample.weight * area_scale;
        comparison.distance = foot.distance;
        comparison.covered = foot.distance <= tolerances.distance;
        const auto pair = best_pair(node, placed_curvatures(model, sample.at, tolerances.distance),
                                    placed_curvatures(other, foot.at, tolerances.distance));
        if (pair) {
            const Vector3& outward = model.is_original ? node.normal : pair->foot.normal;
            const Vector3 suspect_from_original =
                model.is_original ? Vector3(foot.point - feet.nodes[i]) : Vector3(feet.nodes[i] - foot.point);
            comparison.signed_distance = std::copysign(foot.distance, suspect_from_original.dot(outward));
            if (foot.kind == FootKind::interior && resolved(pair->node, tolerances) && resolved(pair->foot, tolerances))
                compare_curvatures(comparison, pair->node, pair->foot, tolerances.kappa);
        } else {
            comparison.signed_distance = foot.distance;
        }
        area += comparison.weight;
        if (comparison.covered) covered += comparison.weight;
        if (comparison.distance <= overlap_limit) overlap += comparison.weight;
        result.nodes.push_back(std::move(comparison));
    }
    result.coverage = area > 0.0 ? covered / area : 0.0;
    result.overlap = area > 0.0 ? overlap / area : 0.0;
    const double limit =
        tolerances.scope == MatchScope::partial ? overlap_limit : std::numeric_limits<double>::infinity();
    result.distance = statistics(result.nodes, Quantity::distance, limit);
    result.kappa_max = statistics(result.nodes, Quantity::kappa_max, limit);
    result.kappa_min = statistics(result.nodes, Quantity::kappa_min, limit);
    result.direction = statistics(result.nodes, Quantity::direction, limit);
    return result;
}

}  // namespace umbilic
