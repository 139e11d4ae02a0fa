// SPDX-License-Identifier: LGPL-2.1-or-later
#include "made_comparison.h"

#include "../support/surfaces.h"

namespace umbilic {

namespace {

using support::model_of;
using support::random_similarity;
using support::table_3_1_patch;
using support::transformed;

DisplayMesh grid_mesh(const Face& face, int n) {
    DisplayMesh mesh;
    mesh.face = face.number;
    const ParameterBox domain = face.surface.domain();
    for (int i = 0; i <= n; ++i) {
        for (int j = 0; j <= n; ++j) {
            const Vector2 at(domain.u.low + domain.u.length() * i / n, domain.v.low + domain.v.length() * j / n);
            mesh.parameters.push_back(at);
            mesh.points.push_back(face.surface.value(at.x(), at.y()));
        }
    }
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const int a = i * (n + 1) + j, b = a + n + 1;
            mesh.triangles.push_back({a, b, b + 1});
            mesh.triangles.push_back({a, b + 1, a + 1});
        }
    }
    return mesh;
}

void name_everything(Model& model, const std::string& name, const std::string& path) {
    model.source.path = path;
    model.source.sha256 = std::string(64, 'a');
    model.source.bytes = 1234567;
    model.source.format = "STEP";
    model.source.unit = name;
    model.source.unit_in_mm = 25.4;
    model.skipped.push_back({0, name, name});
    model.skipped.push_back({7, "", "why " + name});
    model.repaired.push_back(name);
    model.warnings.push_back(name);
    for (Face& face : model.faces) face.name = name;
}

DirectedComparison directed(const PreparedModel& from, const PreparedModel& onto, const SimilarityTransform& pose) {
    DirectedComparison result;
    int i = 0;
    for (const AreaSample& sample : from.features.samples) {
        NodeComparison node;
        node.at = sample.at;
        node.foot = {onto.model.faces.front().number, sample.at.u, sample.at.v};
        node.point = pose.apply(sample.curvature.point);
        node.weight = sample.weight;
        node.distance = 1e-4 * (i % 7);
        node.signed_distance = i % 2 == 0 ? node.distance : -node.distance;
        if (i % 3 != 0) {
            node.kappa_max = 0.01 * (i % 5);
            node.kappa_min = 0.02;
        }
        if (i % 4 != 0) node.direction = 0.1;
        node.covered = true;
        result.nodes.push_back(node);
        ++i;
    }
    result.distance = {6e-4, 3e-4, 2e-4, i};
    result.kappa_max = {0.04, 0.02, 0.01, i - i / 3};
    result.kappa_min = {0.02, 0.02, 0.0, i - i / 3};
    result.direction = {0.1, 0.1, 0.0, i - i / 4};
    result.coverage = 0.875;
    return result;
}

}  // namespace

std::unique_ptr<MadeComparison> made_comparison(const std::string& name) {
    auto made = std::make_unique<MadeComparison>();
    const SimilarityTransform suspect_original = random_similarity(5, 0.37, true);
    made->original_model = model_of({table_3_1_patch()});
    made->suspect_model = model_of({transformed(table_3_1_patch(), suspect_original)});
    name_everything(made->original_model, name, "/files/" + name + "_original.step");
    name_everything(made->suspect_model, name, "/files/" + name + "_suspect.step");
    made->options.features.samples.count = 120;
    made->original = std::make_unique<PreparedModel>(prepare(made->original_model, made->options.features));
    made->suspect = std::make_unique<PreparedModel>(prepare(made->suspect_model, made->options.features));
    made->original_meshes = {grid_mesh(made->original_model.faces.front(), 12)};
    made->suspect_meshes = {grid_mesh(made->suspect_model.faces.front(), 12)};

    Comparison& comparison = made->comparison;
    Alignment& alignment = comparison.alignment;
    alignment.status = AlignmentStatus::found;
    alignment.why = "five umbilics of " + name;
    alignment.method = MatchMethod::umbilics;
    alignment.original_suspect = suspect_original.inverse();
    alignment.tolerance = 0.01;
    alignment.rms = 1e-4;
    alignment.max = 6e-4;
    alignment.relative_max = 5e-4;
    alignment.suspect_coverage = 0.875;
    alignment.original_coverage = 0.875;
    PoseCandidate candidate;
    candidate.method = MatchMethod::moments;
    candidate.score = 0.5;
    alignment.runners_up = {candidate};
    alignment.symmetries = {alignment.original_suspect};
    alignment.free_motions = {{FreeMotionKind::turn, Vector3(0, 0, 5), Vector3::UnitZ()}};

    Assessment& assessment = comparison.assessment;
    assessment.suspect_on_original = directed(*made->suspect, *made->original, alignment.original_suspect);
    assessment.original_on_suspect = directed(*made->original, *made->suspect, SimilarityTransform());
    assessment.weak_passed = true;
    assessment.strong.passed = true;
    assessment.strong.why = name;
    assessment.strong.pairs = {{0, 1, UmbilicType::star, 1e-5}};
    assessment.strong.unmatched_suspect = {0};
    assessment.cell = 0.05;
    assessment.distance = {0.01, 99.5, 98.75, 400, 5};
    assessment.kappa_max = {0.03, 91.25, 92.25, 400, 31};
    assessment.kappa_min = {0.03, 96.0, 96.0, 400, 16};
    assessment.direction = {0.06, 95.5, 95.5, 400, 18};
    assessment.faces = {{1, 1, 0.875, "intermediate"}, {2, 0, 0.0, "none"}};
    assessment.tolerances = {{"distance", 0.01, "mm", ToleranceOrigin::derived, "distance <= distance of " + name},
                             {"kappa", 0.03, "1/mm", ToleranceOrigin::user, "difference <= kappa"}};

    Verdict& verdict = comparison.verdict;
    verdict.algorithm_1 = {Level::intermediate, {{"Is " + name + " near?", true}, {"Are umbilics alike?", false}}};
    verdict.algorithm_2 = {Level::strong, {{"Do the means of " + name + " agree?", true}}};
    verdict.level = Level::strong;
    verdict.derived = true;
    verdict.explanation = "Explanation of " + name;
    comparison.answer = {AnswerClass::mirrored, "answer " + name};
    comparison.timing = {{"match", 0.125}};
    return made;
}

std::unique_ptr<MadeComparison> made_comparison_without_pose() {
    auto made = made_comparison();
    const auto tolerances = made->comparison.assessment.tolerances;
    made->comparison = {};
    made->comparison.alignment.why = "nothing fits";
    made->comparison.assessment.tolerances = tolerances;
    made->comparison.answer.text = "different";
    return made;
}

}  // namespace umbilic
