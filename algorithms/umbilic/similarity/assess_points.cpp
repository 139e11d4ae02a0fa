// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/similarity/assess_points.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include <Eigen/Geometry>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <umbilic/matching/passed_samples.h>
#include <umbilic/matching/score.h>
#include <umbilic/matching/table_ground.h>
#include <umbilic/similarity/local_similarity.h>
#include <umbilic/similarity/nodes.h>
#include <umbilic/similarity/statistics.h>
#include <umbilic/similarity/thresholds.h>
#include <umbilic/similarity/wording.h>

namespace umbilic {

namespace {

constexpr double anywhere = std::numeric_limits<double>::infinity();

/// The original as the shape that points lie on.
struct OriginalGround {
    std::unique_ptr<GroundSurface> surface;
    const std::vector<AreaSample>& samples;
    double noise = 0.0;            ///< mm; 0 for models
    double curvature_error = 0.0;  ///< standard deviation of its curvatures, 1/mm; 0 for models
    bool oriented = false;
};

OriginalGround ground_of(const PreparedShape& original) {
    if (const PreparedModel* model = original.model())
        return {std::make_unique<Ground>(*model), model->features.samples, 0.0, 0.0, model->model.oriented()};
    const PreparedPoints& points = *original.points();
    return {std::make_unique<TableGround>(points.table), points.samples, points.noise, typical_curvature_error(points),
            points.oriented};
}

/// Foot points of all points of the suspect, in the frame of the original.
std::vector<GroundFoot> feet_of(const PointCloud& suspect, const SimilarityTransform& original_suspect,
                                const GroundSurface& original, const Progress& progress) {
    std::vector<GroundFoot> feet(suspect.points.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, feet.size(), 256), [&](const auto& range) {
        progress.check();
        for (std::size_t i = range.begin(); i < range.end(); ++i)
            feet[i] = *original.foot(original_suspect.apply(suspect.points[i]), anywhere);
    });
    return feet;
}

/// Jets of the original where the suspect's jets are, on the same stencils: fitted to the foot points.
std::vector<PointJet> jets_of_feet(const std::vector<GroundFoot>& feet, const PreparedPoints& suspect, double scale,
                                   const Progress& progress) {
    PointCloud cloud;
    for (const GroundFoot& foot : feet) {
        cloud.points.push_back(foot.point);
        cloud.normals.push_back(foot.normal.value_or(Vector3::Zero()));
    }
    std::vector<int> indices;
    for (const PointJet& jet : suspect.jets) indices.push_back(jet.index);
    return point_jets(cloud, Neighbours(cloud.points), indices, {.radius = scale * suspect.jet_radius}, progress);
}

/// The suspect's jets in the frame and unit of the original, with normals to the side of the original's.
class PlacedJets {
public:
    PlacedJets(const PreparedPoints& suspect, const SimilarityTransform& original_suspect, bool original_oriented,
               const std::vector<PointJet>& there, const std::vector<GroundFoot>& feet, double limit)
        : suspect_(suspect), pose_(original_suspect) {
        // Solids and scans with normals both know their outward side; a scan without, or an open surface, does not.
        each_ = !suspect.oriented;
        if (each_ || original_oriented) return;
        double agreement = 0.0;
        for (std::size_t k = 0; k < there.size(); ++k)
            if (suspect.jets[k].valid && there[k].valid && feet[suspect.jets[k].index].distance <= limit)
                agreement += suspect.samples[k].weight * placed(k).normal.dot(there[k].frame.normal);
        flipped_ = agreement < 0.0;
    }

    bool all_flipped() const { return flipped_; }

    Curvature at(std::size_t k, const Vector3& normal_there) const {
        const Curvature frame = placed(k);
        const bool turn = each_ ? frame.normal.dot(normal_there) < 0.0 : flipped_;
        return turn ? flipped(frame) : frame;
    }

private:
    Curvature placed(std::size_t k) const {
        Curvature frame = suspect_.jets[k].frame;
        frame.normal = pose_.apply_direction(frame.normal);
        frame.direction_max = pose_.apply_direction(frame.direction_max);
        frame.direction_min = pose_.apply_direction(frame.direction_min);
        frame.kappa_max /= pose_.scale;
        frame.kappa_min /= pose_.scale;
        return frame;
    }

    const PreparedPoints& suspect_;
    const SimilarityTransform& pose_;
    bool each_ = false, flipped_ = false;
};

void finish(DirectedComparison& comparison, const std::vector<Tolerance>& tolerances) {
    const double overlap_limit = spread_factor * find_tolerance(tolerances, "distance").value;
    double area = 0.0, covered = 0.0, overlap = 0.0;
    for (const NodeComparison& node : comparison.nodes) {
        area += node.weight;
        if (node.covered) covered += node.weight;
        if (node.distance <= overlap_limit) overlap += node.weight;
    }
    comparison.coverage = area > 0.0 ? covered / area : 0.0;
    comparison.overlap = area > 0.0 ? overlap / area : 0.0;
    comparison.distance = statistics(comparison.nodes, Quantity::distance, overlap_limit);
    comparison.kappa_max = statistics(comparison.nodes, Quantity::kappa_max, overlap_limit);
    comparison.kappa_min = statistics(comparison.nodes, Quantity::kappa_min, overlap_limit);
    comparison.direction = statistics(comparison.nodes, Quantity::direction, overlap_limit);
}

/// Nodes of the original and whether the points' surface passes them; `chord` becomes the deepest chord of a mesh
/// there.
DirectedComparison original_nodes(const OriginalGround& original, const PreparedPoints& suspect,
                                  const SimilarityTransform& original_suspect, double tolerance, double& chord) {
    DirectedComparison result;
    chord = 0.0;
    for (const PassedSample& passed : passed_samples(original.samples, suspect, original_suspect)) {
        const AreaSample& sample = original.samples[result.nodes.size()];
        NodeComparison node{.at = sample.at, .point = sample.curvature.point, .weight = sample.weight};
        node.distance = passed.distance;
        node.signed_distance = passed.signed_distance;
        node.covered = !passed.past_border && node.distance <= tolerance;
        if (node.covered) chord = std::max(chord, passed.chord);
        result.nodes.push_back(std::move(node));
    }
    return result;
}

std::string uncertain_curvatures(double error, double noise, double tolerance) {
    return "the noise of the points, " + in_mm(noise) + ", leaves their curvatures uncertain by " +
           in_digits(error, 2) + " 1/mm (median), too much for a tolerance of " + in_digits(tolerance, 2) + " 1/mm";
}

}  // namespace

std::vector<Tolerance> derive_point_tolerances(double size, double noise, const ToleranceChoices& choices) {
    std::vector<Tolerance> result = derive_tolerances(size, 0.0, choices);
    std::erase_if(result,
                  [](const Tolerance& t) { return t.name == "umbilic-distance" || t.name == "exact-distance"; });
    for (Tolerance& tolerance : result) {
        if (tolerance.name == "distance") {
            if (tolerance.origin != ToleranceOrigin::user)
                tolerance.value = std::max(tolerance.value, measured_noise_tolerance * noise);
            tolerance.inequality = "weak test: distance of a point from the original <= delta_0, at least 3 noise";
        }
        if (tolerance.name == "cell")
            tolerance.inequality = "local similarity: side of a cube in space, relative to the size";
    }
    result.push_back({"noise", noise, "mm", ToleranceOrigin::derived,
                      "standard deviation of the points along the normal, estimated from the residuals of their jets"});
    return result;
}

Assessment assess(const PreparedShape& original, const PreparedPoints& suspect, const Alignment& alignment,
                  const ToleranceChoices& choices, const Progress& progress) {
    const SimilarityTransform& pose = alignment.original_suspect;
    const OriginalGround ground = ground_of(original);
    const double size = std::min(original.size(), pose.scale * std::sqrt(suspect.area));
    const double noise = std::hypot(ground.noise, pose.scale * suspect.noise);

    Assessment result;
    result.measured = true;
    result.scope = alignment.scope;
    result.tolerances = derive_point_tolerances(size, noise, choices);
    const double distance = find_tolerance(result.tolerances, "distance").value;
    const double kappa = find_tolerance(result.tolerances, "kappa").value;
    const double direction = find_tolerance(result.tolerances, "direction").value;

    progress.report(0.0, "foot points");
    const std::vector<GroundFoot> feet = feet_of(suspect.cloud, pose, *ground.surface, progress.part(0.0, 0.6));
    progress.report(0.6, "curvatures");
    const std::vector<PointJet> there = jets_of_feet(feet, suspect, pose.scale, progress.part(0.6, 0.9));
    const PlacedJets jets(suspect, pose, ground.oriented, there, feet, spread_factor * distance);
    result.flipped = jets.all_flipped();

    DirectedComparison& forward = result.suspect_on_original;
    std::vector<double> errors;
    for (std::size_t k = 0; k < suspect.samples.size(); ++k) {
        const PointJet& jet = suspect.jets[k];
        const GroundFoot& foot = feet[jet.index];
        NodeComparison node{.foot = foot.at, .point = pose.apply(suspect.cloud.points[jet.index])};
        node.weight = suspect.samples[k].weight * pose.scale * pose.scale;
        node.distance = foot.distance;
        node.covered = foot.distance <= distance;
        const Vector3 outward = foot.normal.value_or(Vector3(node.point - foot.point));
        node.signed_distance = std::copysign(foot.distance, (node.point - foot.point).dot(outward));
        if (jet.valid && there[k].valid) {
            const Curvature measured = jets.at(k, there[k].frame.normal);
            const Curvature& exact = there[k].frame;
            const double error =
                std::hypot(std::max(jet.kappa_max_error, jet.kappa_min_error) / pose.scale, ground.curvature_error);
            errors.push_back(error);
            if (curvature_certainty * error <= kappa) {
                node.kappa_max = std::abs(measured.kappa_max - exact.kappa_max);
                node.kappa_min = std::abs(measured.kappa_min - exact.kappa_min);
                const double spread =
                    std::min(measured.kappa_max - measured.kappa_min, exact.kappa_max - exact.kappa_min);
                if (spread > kappa && curvature_certainty * jet.direction_error <= direction)
                    node.direction = std::atan2(measured.direction_max.cross(exact.direction_max).norm(),
                                                std::abs(measured.direction_max.dot(exact.direction_max)));
            }
        }
        forward.nodes.push_back(std::move(node));
    }
    finish(forward, result.tolerances);
    double chord = 0.0;
    result.original_on_suspect = original_nodes(ground, suspect, pose, distance, chord);
    if (suspect.triangles)
        result.tolerances.push_back(
            {"chord", chord, "mm", ToleranceOrigin::derived,
             "greatest depth of a triangle below the original that its corners lie on; no difference of the shapes"});
    finish(result.original_on_suspect, result.tolerances);

    result.weak_passed = passes_weak(result);
    result.intermediate_passed = result.weak_passed && passes_intermediate(result);
    if (!comparable(forward)) {
        const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
        std::nth_element(errors.begin(), middle, errors.end());
        result.intermediate_why = errors.empty() ? "the points are too few around each other for curvatures"
                                                 : uncertain_curvatures(*middle, noise, kappa);
    }
    result.strong.why = "measured points have no umbilics that could be proved; fit a surface to look for them";

    result.cell = find_tolerance(result.tolerances, "cell").value;
    const auto local = [&](Quantity quantity, double tolerance) {
        return local_similarity(forward.nodes, quantity, tolerance, result.cell * size);
    };
    result.distance = local(Quantity::distance, distance);
    result.kappa_max = local(Quantity::kappa_max, kappa);
    result.kappa_min = local(Quantity::kappa_min, kappa);
    result.direction = local(Quantity::direction, direction);
    progress.report(1.0, "assessed");
    return result;
}

}  // namespace umbilic
