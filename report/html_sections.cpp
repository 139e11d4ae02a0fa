// SPDX-License-Identifier: LGPL-2.1-or-later
#include <report/html_sections.h>

#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <report/given_pairs_text.h>
#include <report/parameters.h>
#include <report/readable.h>

namespace umbilic {

namespace {

/// Rows of the table of faces that are printed; all are in result.json.
constexpr std::size_t most_face_rows = 200;

/// Bytes of an answer from which on its letters are smaller.
constexpr std::size_t long_answer = 90;

std::string degrees(double radians) {
    return readable(radians * 180.0 / std::numbers::pi) + "°";
}

std::string joined(const Vector3& vector, int digits = 6) {
    return "(" + readable(vector.x(), digits) + ", " + readable(vector.y(), digits) + ", " +
           readable(vector.z(), digits) + ")";
}

/// Entry of a rotation matrix; rounding is no negative zero.
std::string nine_decimals(double value) {
    return fmt::format("{:.9f}", std::round(1e9 * value) / 1e9 + 0.0);
}

std::string yes_no(bool value) {
    return value ? "yes" : "no";
}

std::string plural(std::size_t count, const std::string& noun) {
    return readable_count(count) + " " + noun + (count == 1 ? "" : "s");
}

/// Where the nodes of models come from.
std::string nodes_words(const DirectedComparison& suspect) {
    const std::size_t of_wireframe = static_cast<std::size_t>(suspect.of_wireframe), all = suspect.nodes.size();
    if (of_wireframe == 0) return "Nodes are spread evenly over each model's area.";
    if (of_wireframe == all) return "Nodes are those of each model's wireframe, without those on borders of faces.";
    return "Of the suspect's nodes " + readable_count(of_wireframe) +
           " belong to its wireframe (without those on borders of faces); the other " +
           readable_count(all - of_wireframe) +
           ", on faces that are narrow against the wireframe's step, are spread evenly by area.";
}

}  // namespace

void set_summary(const ReportInput& input, PageData& page) {
    const Comparison& comparison = input.comparison;
    const Assessment& assessment = comparison.assessment;
    const Alignment& alignment = comparison.alignment;
    const Verdict& verdict = comparison.verdict;
    page.set("original_name", base_name(input.original.source().path));
    page.set("suspect_name", base_name(input.suspect.source().path));
    page.set("answer", comparison.answer.text);
    page.set("level", name(verdict.level));
    page.set("long_answer", comparison.answer.text.size() > long_answer);
    page.set("explanation", verdict.explanation);
    page.set("algorithm", std::to_string(verdict.chosen_algorithm));
    PageData steps{PageData::type::list};
    for (const Level level : {Level::none, Level::weak, Level::intermediate, Level::strong}) {
        PageData step = entry({{"name", name(level)}});
        step.set("reached", level <= verdict.level && (level != Level::none || verdict.level == Level::none));
        step.set("here", level == verdict.level);
        steps.push_back(step);
    }
    page.set("levels", steps);

    PageData figures{PageData::type::list};
    const auto figure = [&](std::string value, std::string what) {
        figures.push_back(entry({{"value", std::move(value)}, {"what", std::move(what)}}));
    };
    const DirectedComparison& forward = assessment.suspect_on_original;
    if (!forward.nodes.empty()) {
        figure(readable_percent(forward.coverage), "of the suspect lies on the original");
        figure(readable_percent(assessment.original_on_suspect.coverage), "of the original is covered");
        figure(readable(forward.distance.max, "mm", 3),
               assessment.scope == MatchScope::partial ? "largest deviation in the overlap" : "largest deviation");
        figure(readable(alignment.original_suspect.scale, 6), "scale, suspect to original");
        const std::size_t pairs = assessment.strong.pairs.size();
        if (assessment.measured)
            figure(readable(find_tolerance(assessment.tolerances, "noise").value, "mm", 3), "noise of the points");
        else
            figure(readable_count(pairs), pairs == 1 ? "pair of umbilics" : "pairs of umbilics");
    }
    page.set("figures", figures);
    page.set("has_figures", !forward.nodes.empty());
}

void set_decisions(const Verdict& verdict, PageData& page) {
    PageData decisions{PageData::type::list};
    const std::array<std::pair<const char*, const Decision*>, 2> both = {
        {{"Algorithm 1: maxima against tolerances", &verdict.algorithm_1},
         {"Algorithm 2: statistics against thresholds", &verdict.algorithm_2}}};
    for (int i = 0; i < 2; ++i) {
        PageData decision = entry({{"name", both[i].first}, {"level", name(both[i].second->level)}});
        decision.set("chosen", verdict.chosen_algorithm == i + 1);
        PageData path{PageData::type::list};
        for (const DecisionStep& step : both[i].second->path) {
            path.push_back(entry({{"question", step.question}, {"answer", yes_no(step.answer)}}));
        }
        decision.set("path", path);
        decisions.push_back(decision);
    }
    page.set("decisions", decisions);
}

void set_exhibits(const PreparedShape& original, const PreparedShape& suspect, PageData& page) {
    PageData rows{PageData::type::list};
    const auto row = [&](const char* what, const auto& text_of) {
        rows.push_back(entry({{"what", what}, {"original", text_of(original)}, {"suspect", text_of(suspect)}}));
    };
    /// A row that models, or points, have nothing to say to.
    const auto row_of_models = [&](const char* what, const auto& text_of) {
        row(what, [&](const PreparedShape& s) { return s.model() ? text_of(s.model()->model) : std::string("–"); });
    };
    const auto row_of_points = [&](const char* what, const auto& text_of) {
        if (!original.points() && !suspect.points()) return;
        row(what, [&](const PreparedShape& s) { return s.points() ? text_of(*s.points()) : std::string("–"); });
    };
    row("File", [](const PreparedShape& s) { return base_name(s.source().path); });
    row("Path", [](const PreparedShape& s) { return s.source().path; });
    row("SHA-256", [](const PreparedShape& s) { return s.source().sha256; });
    row("Bytes", [](const PreparedShape& s) { return readable_count(s.source().bytes); });
    row("Format", [](const PreparedShape& s) {
        return s.points() ? s.source().format + " (" + s.points()->cloud.layout + ")" : s.source().format;
    });
    row("Unit", [](const PreparedShape& s) {
        const std::string& unit = s.source().unit;
        return unit == "mm" || s.points() ? unit : unit + " (1 = " + readable(s.source().unit_in_mm, 8) + " mm)";
    });
    row_of_models("Solids", [](const Model& model) { return readable_count(model.solids.size()); });
    row_of_models("Faces", [](const Model& model) {
        const std::string read = readable_count(model.faces.size());
        return model.declared_faces < 0 ? read
                                        : read + " of " + readable_count(model.declared_faces) + " that it declares";
    });
    row_of_points("Points", [](const PreparedPoints& points) { return readable_count(points.cloud.points.size()); });
    row_of_points("Triangles",
                  [](const PreparedPoints& points) { return readable_count(points.cloud.triangles.size()); });
    row_of_points("Noise (estimated)", [](const PreparedPoints& points) { return readable(points.noise, "mm", 3); });
    row("Size", [](const PreparedShape& s) {
        const BoundingBox box = s.box();
        if (box.empty()) return std::string("–");
        const Vector3 size = box.high - box.low;
        return readable(size.x()) + " × " + readable(size.y()) + " × " + readable(size.z()) + " mm";
    });
    row("Area", [](const PreparedShape& s) {
        return s.model() ? readable(s.model()->model.area, "mm²", 8) : "about " + readable(s.points()->area, "mm²", 3);
    });
    row_of_models("Volume", [](const Model& model) {
        return model.solids.empty() ? std::string("–") : readable(model.volume, "mm³", 8);
    });
    row_of_models("Topology valid", [](const Model& model) { return yes_no(model.valid); });
    page.set("exhibits", rows);

    PageData notes{PageData::type::list};
    for (const PreparedShape* shape : {&original, &suspect}) {
        std::vector<std::string> words;
        if (const PreparedModel* prepared = shape->model()) {
            for (const Skipped& skipped : prepared->model.skipped) {
                words.push_back("Skipped " +
                                (skipped.face > 0 ? "face " + std::to_string(skipped.face) : skipped.entity) + ": " +
                                skipped.why);
            }
            for (const std::string& repair : prepared->model.repaired) words.push_back("Repaired: " + repair);
        }
        for (const std::string& warning :
             shape->model() ? shape->model()->model.warnings : shape->points()->cloud.warnings)
            words.push_back("Warning: " + warning);
        if (words.empty()) continue;
        PageData note = entry({{"model", shape == &original ? "Original" : "Suspect"}});
        note.set("lines", lines(words));
        notes.push_back(note);
    }
    page.set("notes", notes);
}

void set_alignment(const Alignment& alignment, PageData& page) {
    const SimilarityTransform& pose = alignment.original_suspect;
    const Eigen::AngleAxisd turn(pose.rotation);
    PageData rows{PageData::type::list};
    const auto row = [&](const char* what, std::string value) {
        rows.push_back(entry({{"what", what}, {"value", std::move(value)}}));
    };
    row("Status", name(alignment.status));
    row("How", alignment.why);
    if (!alignment.given_pairs.empty()) row("Pairs of points", given_pairs_text(alignment.given_pairs));
    PageData matrix{PageData::type::list};
    if (alignment.status != AlignmentStatus::not_found) {
        row("Method", name(alignment.method));
        row("Scope", name(alignment.scope));
        row("Scale σ", readable(pose.scale, 10));
        row("Mirrored", pose.mirrored ? "yes, in x before the rotation" : "no");
        row("Rotation", degrees(turn.angle()) + " about " + joined(turn.axis()));
        row("Translation", joined(pose.translation, 8) + " mm");
        row("RMS distance", readable(alignment.rms, "mm"));
        row("Largest distance", readable(alignment.max, "mm"));
        row("Relative largest distance", readable(alignment.relative_max) + " (over √area of the original)");
        row("Counts as covered", "distance ≤ " + readable(alignment.tolerance, "mm"));
        row("Poses that fit equally well", readable_count(alignment.symmetries.size()));
        if (alignment.copies.size() > 1) row("Places at which it fits", readable_count(alignment.copies.size()));
        for (const FreeMotion& motion : alignment.free_motions) row("The suspect still", in_words(motion));
        for (int i = 0; i < 3; ++i) {
            matrix.push_back(entry({{"x", nine_decimals(pose.rotation(i, 0))},
                                    {"y", nine_decimals(pose.rotation(i, 1))},
                                    {"z", nine_decimals(pose.rotation(i, 2))}}));
        }
    }
    page.set("alignment", rows);
    page.set("rotation", matrix);
    PageData candidates{PageData::type::list};
    for (const PoseCandidate& candidate : alignment.runners_up) {
        const SimilarityTransform& other = candidate.original_suspect;
        candidates.push_back(entry({{"method", name(candidate.method)},
                                    {"score", readable_percent(candidate.score)},
                                    {"original_score", readable_percent(candidate.original_score)},
                                    {"rms", readable(candidate.rms, "mm")},
                                    {"scale", readable(other.scale, 6)},
                                    {"mirrored", yes_no(other.mirrored)},
                                    {"angle", degrees(rotation_angle_between(other.rotation, pose.rotation))}}));
    }
    page.set("has_candidates", !alignment.runners_up.empty());
    page.set("candidates", candidates);
}

void set_statistics(const Assessment& assessment, PageData& page) {
    page.set("nodes_words", nodes_words(assessment.suspect_on_original));
    page.set("nodes_of_wireframe", !assessment.measured && assessment.suspect_on_original.of_wireframe > 0);
    PageData rows{PageData::type::list};
    const auto row = [&](const char* what, Statistics DirectedComparison::*quantity) {
        PageData data = entry({{"what", what}});
        PageData cells{PageData::type::list};
        for (const DirectedComparison* directed : {&assessment.suspect_on_original, &assessment.original_on_suspect}) {
            const Statistics& statistics = directed->*quantity;
            const bool known = statistics.count > 0;
            for (const double value : {statistics.max, statistics.mean, statistics.standard_deviation}) {
                cells.push_back(entry({{"text", known ? readable(value, 3) : "–"}}));
            }
            cells.push_back(entry({{"text", readable_count(statistics.count)}}));
        }
        data.set("cells", cells);
        rows.push_back(data);
    };
    row("Distance (mm)", &DirectedComparison::distance);
    row("Maximum principal curvature (1/mm)", &DirectedComparison::kappa_max);
    row("Minimum principal curvature (1/mm)", &DirectedComparison::kappa_min);
    row("Principal direction (rad)", &DirectedComparison::direction);
    page.set("statistics", rows);
    const bool assessed = !assessment.suspect_on_original.nodes.empty();
    page.set("assessed", assessed);
    page.set("partial", assessment.scope == MatchScope::partial || assessment.measured);
    page.set("intermediate_why", assessment.intermediate_why);
    page.set("has_intermediate_why", !assessment.intermediate_why.empty());

    PageData local{PageData::type::list};
    const auto similarity = [&](const char* what, const LocalSimilarity& value, const char* unit) {
        local.push_back(entry({{"what", what},
                               {"tolerance", readable(value.tolerance, unit)},
                               {"percent", readable_percent(value.percent / 100.0)},
                               {"cell_percent", value.cells > 0 ? readable_percent(value.cell_percent / 100.0) : "–"},
                               {"cells", readable_count(value.cells)},
                               {"marked", readable_count(value.marked)}}));
    };
    similarity("Distance", assessment.distance, "mm");
    similarity("Maximum principal curvature", assessment.kappa_max, "1/mm");
    similarity("Minimum principal curvature", assessment.kappa_min, "1/mm");
    similarity("Principal direction", assessment.direction, "rad");
    page.set("similarity", local);
    page.set("cell", readable(assessment.cell));

    PageData faces{PageData::type::list};
    for (std::size_t i = 0; i < std::min(most_face_rows, assessment.faces.size()); ++i) {
        const FaceCoverage& face = assessment.faces[i];
        faces.push_back(entry({{"suspect", std::to_string(face.suspect_face)},
                               {"original", face.original_face > 0 ? std::to_string(face.original_face) : "–"},
                               {"fraction", readable_percent(face.fraction)},
                               {"level", face.level}}));
    }
    page.set("faces", faces);
    page.set("has_faces", !assessment.faces.empty());
    if (assessment.faces.size() > most_face_rows) {
        page.set("more_faces", plural(assessment.faces.size() - most_face_rows, "more face"));
    }
}

void set_provenance(const ReportInput& input, PageData& page) {
    set_parameters(compare_parameters(input.options, input.comparison), page);
    set_repetition(input.command_line, page);
    PageData stages{PageData::type::list};
    double total = 0.0;
    for (const Timing* timing : {&input.timing, &input.comparison.timing}) {
        for (const auto& [stage, seconds] : *timing) {
            stages.push_back(entry({{"stage", stage}, {"seconds", fmt::format("{:.2f}", seconds)}}));
            total += seconds;
        }
    }
    page.set("timing", stages);
    page.set("total_seconds", fmt::format("{:.2f}", total));
}

}  // namespace umbilic
