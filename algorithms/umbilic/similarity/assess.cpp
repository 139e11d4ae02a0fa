// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/similarity/assess.h>

#include <algorithm>
#include <cmath>
#include <map>

#include <umbilic/similarity/local_similarity.h>
#include <umbilic/similarity/nodes.h>
#include <umbilic/similarity/strong_test.h>
#include <umbilic/similarity/thresholds.h>

namespace umbilic {

namespace {

/// Area-weighted mean over the faces of what their file says of their accuracy, mm: a single careless face must not
/// loosen the tolerance for all.
double stated_accuracy(const Model& model) {
    double sum = 0.0, area = 0.0;
    for (const Face& face : model.faces) {
        sum += face.area * (face.conversion_error + face.tolerance);
        area += face.area;
    }
    return area > 0.0 ? sum / area : 0.0;
}

/// Level of one face of the suspect by the statistics of its own nodes.
std::string face_level(const std::vector<NodeComparison>& nodes, const std::vector<Tolerance>& tolerances) {
    const auto passes = [&](Quantity quantity, const char* tolerance) {
        return within_thresholds(statistics(nodes, quantity), find_tolerance(tolerances, tolerance).value);
    };
    if (!passes(Quantity::distance, "distance")) return "none";
    const bool directions = statistics(nodes, Quantity::direction).count > 0;
    const bool agree = passes(Quantity::kappa_max, "kappa") && passes(Quantity::kappa_min, "kappa") &&
                       (!directions || passes(Quantity::direction, "direction"));
    return agree ? "intermediate" : "weak";
}

std::vector<FaceCoverage> face_coverages(const Model& suspect, const DirectedComparison& comparison,
                                         const std::vector<Tolerance>& tolerances) {
    std::map<int, std::vector<NodeComparison>> nodes_of_face;
    for (const NodeComparison& node : comparison.nodes) nodes_of_face[node.at.face].push_back(node);
    std::vector<FaceCoverage> result;
    for (const Face& face : suspect.faces) {
        const std::vector<NodeComparison>& nodes = nodes_of_face[face.number];
        FaceCoverage coverage{.suspect_face = face.number};
        double area = 0.0, covered = 0.0;
        std::map<int, double> covered_by;
        for (const NodeComparison& node : nodes) {
            area += node.weight;
            if (!node.covered) continue;
            covered += node.weight;
            covered_by[node.foot.face] += node.weight;
        }
        if (!covered_by.empty())
            coverage.original_face =
                std::ranges::max_element(covered_by, {}, [](const auto& entry) { return entry.second; })->first;
        coverage.fraction = area > 0.0 ? covered / area : 0.0;
        coverage.level = face_level(nodes, tolerances);
        result.push_back(std::move(coverage));
    }
    return result;
}

}  // namespace

Assessment assess(const PreparedModel& original, const PreparedModel& suspect, const Alignment& alignment,
                  const ToleranceChoices& choices, const Progress& progress) {
    return assess(original, suspect, {area_nodes(original), area_nodes(suspect)}, alignment, choices, progress);
}

Assessment assess(const PreparedModel& original, const PreparedModel& suspect, const AssessedNodes& nodes,
                  const Alignment& alignment, const ToleranceChoices& choices, const Progress& progress) {
    const double scale = alignment.original_suspect.scale;
    const double size = std::min(original.model.size(), scale * suspect.model.size());
    const double accuracy = stated_accuracy(original.model) + scale * stated_accuracy(suspect.model);

    Assessment result;
    result.scope = alignment.scope;
    result.tolerances = derive_tolerances(size, accuracy, choices);
    const double distance = find_tolerance(result.tolerances, "distance").value;
    const double kappa = find_tolerance(result.tolerances, "kappa").value;
    const NodeTolerances tolerances{distance, kappa, alignment.scope};

    const PlacedModel placed_original{.prepared = original, .is_original = true};
    PlacedModel placed_suspect{.prepared = suspect, .original_model = alignment.original_suspect};
    const Feet suspect_feet = find_feet(placed_suspect, nodes.suspect, placed_original, progress.part(0.0, 0.45));
    const Feet original_feet = find_feet(placed_original, nodes.original, placed_suspect, progress.part(0.45, 0.9));

    if (!original.model.oriented() || !suspect.model.oriented()) {
        const double limit = spread_factor * distance;
        const double agreement =
            normal_agreement(placed_suspect, nodes.suspect, placed_original, suspect_feet, limit) * scale * scale +
            normal_agreement(placed_original, nodes.original, placed_suspect, original_feet, limit);
        placed_suspect.flipped = result.flipped = agreement < 0.0;
    }
    progress.report(0.9, "curvatures");
    result.suspect_on_original =
        compare_nodes(placed_suspect, nodes.suspect, placed_original, suspect_feet, tolerances);
    result.original_on_suspect =
        compare_nodes(placed_original, nodes.original, placed_suspect, original_feet, tolerances);
    result.weak_passed = passes_weak(result);
    result.intermediate_passed = result.weak_passed && passes_intermediate(result);

    progress.report(0.95, "umbilics");
    result.strong = strong_test(placed_original, placed_suspect, alignment.scope, distance,
                                find_tolerance(result.tolerances, "umbilic-distance").value);

    result.cell = find_tolerance(result.tolerances, "cell").value;
    const auto local = [&](Quantity quantity, double tolerance) {
        return local_similarity(suspect.model, result.suspect_on_original.nodes, quantity, tolerance, result.cell);
    };
    result.distance = local(Quantity::distance, distance);
    result.kappa_max = local(Quantity::kappa_max, kappa);
    result.kappa_min = local(Quantity::kappa_min, kappa);
    result.direction = local(Quantity::direction, find_tolerance(result.tolerances, "direction").value);
    result.faces = face_coverages(suspect.model, result.suspect_on_original, result.tolerances);
    progress.report(1.0, "assessed");
    return result;
}

}  // namespace umbilic
