// SPDX-License-Identifier: LGPL-2.1-or-later
#include <memory>
#include <optional>
#include <string>

#include <occ_adapter/read_file.h>
#include <point_files/read_points.h>
#include <umbilic/core/errors.h>
#include <umbilic/curves/geodesic.h>
#include <umbilic/curves/line_of_curvature.h>
#include <umbilic/curves/projection.h>

#include <cli/commands.h>
#include <cli/console.h>
#include <cli/curve_words.h>
#include <cli/exit_status.h>
#include <cli/finite_numbers.h>
#include <cli/loading.h>
#include <report/json_curves.h>
#include <report/readable.h>

namespace umbilic {

namespace {

/// Words that every kind of curve understands.
struct CurveOptions {
    std::string path, output;
    int face = 0;
    std::optional<double> length;
    double spacing = 0.0;
    std::optional<double> tolerance;
    bool one_face = false;
};

void add_curve_options(CLI::App& subcommand, CurveOptions& options) {
    subcommand.add_option("--length", options.length, "Arc length at which the curve ends, mm")
        ->check(finite_number(false));
    subcommand
        .add_option("--spacing", options.spacing,
                    "Distance between the points of the result, mm; as the integration needs them by default")
        ->check(finite_number(true));
    subcommand
        .add_option("--tolerance", options.tolerance, "Error of a step of the integration, relative to √area of a face")
        ->check(finite_number(false));
    subcommand.add_option("-o,--output", options.output, "STEP file for the curves");
}

std::string face_list(const SurfaceCurve& curve) {
    std::string text;
    int last = 0;
    for (const SurfaceCurvePoint& p : curve.points) {
        if (p.at.face == last) continue;
        last = p.at.face;
        text += (text.empty() ? "" : ", ") + std::to_string(last);
    }
    return text;
}

std::string end_words(const CurveResult& result, const NamedCurve& named) {
    const CurveEnd end = named.curve.ended;
    if (named.left_target) return "the border of the target";
    if (result.kind == "project" && (end == CurveEnd::length || end == CurveEnd::point)) return "the end of the curve";
    return end_text(end);
}

std::string curve_table(const CurveResult& result) {
    if (result.curves.empty()) return "No curve: " + result.why + "\n";
    std::vector<std::vector<std::string>> rows;
    for (const NamedCurve& named : result.curves) {
        const SurfaceCurve& curve = named.curve;
        rows.push_back({named.family.empty() ? "curve" : named.family, readable(curve.length, 8),
                        readable(curve.error, 2), std::to_string(curve.points.size()), face_list(curve),
                        end_words(result, named)});
    }
    return table({result.kind == "project" ? "projection of" : "curve", "length mm", "error mm", "points", "faces",
                  "it ends at"},
                 rows, {1, 2, 3});
}

int finish(const Session& session, const CurveOptions& options, const CurveResult& result) {
    clear_progress_bar();
    if (!options.output.empty() && !result.curves.empty()) {
        std::vector<std::vector<Vector3>> curves;
        for (const NamedCurve& named : result.curves) {
            curves.emplace_back();
            for (const SurfaceCurvePoint& p : named.curve.points) curves.back().push_back(p.point);
        }
        write_curves_step(curves, options.output);
    }
    std::string text = bold(printable(options.path)) + "\n" + curve_table(result);
    if (result.kind == "geodesic" && result.curves.size() > 1)
        text += "The first one is the shortest of " + readable_count(result.curves.size()) + " found.\n";
    print(session, text);
    write_json(session, curves_json(result));
    return exit_done;
}

void add_lines_of_curvature(CLI::App& curve, Session& session, Command& command) {
    struct Options : CurveOptions {
        std::string start, family = "both";
    };
    auto* const subcommand = curve.add_subcommand("lines-of-curvature", "The lines of curvature through a point");
    const auto options = std::make_shared<Options>();
    subcommand->add_option("FILE", options->path, "STEP, IGES or BREP file")->required();
    subcommand->add_option("--face", options->face, "Face of the start, from 1")->check(finite_number(false));
    subcommand->add_option("--start", options->start, "Start U,V, parameters of the face's surface")->required();
    subcommand->add_option("--family", options->family, "maximum, minimum or both (default)")
        ->check(CLI::IsMember({"maximum", "minimum", "both"}));
    add_curve_options(*subcommand, *options);
    add_common_options(*subcommand, session);
    subcommand->callback([&session, &command, options] {
        command = [&session, options] {
            const ReadResult read = load(session, options->path, {}, session.progress.part(0.0, 0.8));
            const Face& face = chosen_face(read.model, options->face, "--face");
            const Vector2 start = chosen_point(read.model, face, "--start", options->start);
            LineOfCurvatureOptions line{.length = options->length, .spacing = options->spacing};
            if (options->tolerance) line.tolerance = *options->tolerance;
            CurveResult result{.kind = "lines-of-curvature", .model = &read.model};
            for (const CurvatureFamily family : {CurvatureFamily::maximum, CurvatureFamily::minimum})
                if (options->family == "both" || options->family == name(family))
                    result.curves.push_back({name(family), as_asked(options->path, [&] {
                                                 return line_of_curvature(face, start, family, line,
                                                                          session.progress.part(0.8, 1.0));
                                             })});
            return finish(session, *options, result);
        };
    });
}

void add_geodesic(CLI::App& curve, Session& session, Command& command) {
    struct Options : CurveOptions {
        std::string from, to, direction;
        int to_face = 0, most = 16;
        double longest = 0.0;
    };
    auto* const subcommand =
        curve.add_subcommand("geodesic", "The geodesics between two points, or the one that leaves a point");
    const auto options = std::make_shared<Options>();
    subcommand->add_option("FILE", options->path, "STEP, IGES or BREP file")->required();
    subcommand->add_option("--face", options->face, "Face of the first point, from 1")->check(finite_number(false));
    subcommand->add_option("--from", options->from, "First point U,V, parameters of the face's surface")->required();
    auto* const to = subcommand->add_option("--to", options->to, "Last point U,V");
    subcommand->add_option("--to-face", options->to_face, "Face of the last point, if another one")
        ->check(finite_number(false))
        ->needs(to);
    subcommand->add_option("--direction", options->direction, "Instead of --to: direction X,Y,Z; needs --length")
        ->excludes(to);
    subcommand
        ->add_option("--longest", options->longest, "Longest geodesic to look for, mm (twice the model's diagonal)")
        ->check(finite_number(false))
        ->needs(to);
    subcommand->add_option("--most", options->most, "Geodesics to return at most")
        ->check(finite_number(false))
        ->needs(to);
    subcommand->add_flag("--one-face", options->one_face, "Do not go on to other faces over smooth edges");
    add_curve_options(*subcommand, *options);
    add_common_options(*subcommand, session);
    subcommand->callback([&session, &command, options] {
        if (options->to.empty() == options->direction.empty())
            throw CLI::ValidationError("give either --to or --direction with --length");
        if (!options->direction.empty() && !options->length) throw CLI::ValidationError("--direction needs --length");
        if (!options->to.empty() && options->length)
            throw CLI::ValidationError("--length goes with --direction; --longest limits the search for --to");
        command = [&session, options] {
            const ReadResult read = load(session, options->path, {}, session.progress.part(0.0, 0.5));
            const Model& model = read.model;
            const Face& face = chosen_face(model, options->face, "--face");
            const Vector2 from = chosen_point(model, face, "--from", options->from);
            const OptionalJoins joined(model, options->one_face);
            const Progress& progress = session.progress;
            CurveResult result{.kind = "geodesic", .model = &model};
            if (!options->direction.empty()) {
                GeodesicOptions geodesic_options{.spacing = options->spacing, .joins = joined.get()};
                if (options->tolerance) geodesic_options.tolerance = *options->tolerance;
                const Vector3 direction = three_numbers("--direction", options->direction);
                result.curves.push_back({"geodesic", as_asked(options->path, [&] {
                                             return geodesic(face, from, direction, *options->length, geodesic_options,
                                                             progress);
                                         })});
                return finish(session, *options, result);
            }
            const Face& last = options->to_face > 0 ? chosen_face(model, options->to_face, "--to-face") : face;
            const Vector2 end = chosen_point(model, last, "--to", options->to);
            GeodesicSearchOptions search{
                .spacing = options->spacing, .joins = joined.get(), .longest = options->longest, .most = options->most};
            if (options->tolerance) search.tolerance = *options->tolerance;
            GeodesicSearch found = as_asked(options->path, [&] {
                return geodesics_between(model, {face.number, from.x(), from.y()}, {last.number, end.x(), end.y()},
                                         search, progress);
            });
            for (SurfaceCurve& one : found.curves) result.curves.push_back({"geodesic", std::move(one)});
            result.why = found.why;
            return finish(session, *options, result);
        };
    });
}

struct ProjectOptions : CurveOptions {
    std::string onto_path, start, to, direction, foot, family = "geodesic";
    int onto_face = 0;
};

/// The curves whose projections are asked for, from the words: of a file of curves or points, or started on a model.
CurveResult projections(const ProjectOptions& options, const std::optional<Model>& original, const Model& onto,
                        const Progress& progress) {
    const Face& target = chosen_face(onto, options.onto_face, "--onto-face");
    const OptionalJoins target_joined(onto, options.one_face);
    ProjectionOptions projection{.spacing = options.spacing, .joins = target_joined.get()};
    if (options.tolerance) projection.tolerance = *options.tolerance;
    if (!options.foot.empty()) projection.foot = chosen_point(onto, target, "--foot", options.foot);
    CurveResult result{.kind = "project", .model = &onto};
    if (!original) {
        std::vector<std::vector<Vector3>> curves;
        if (holds_json(options.path))
            curves = curves_of_result(options.path);
        else
            curves.push_back(read_points(options.path, progress.part(0.0, 0.2)).points);
        for (std::vector<Vector3>& points : curves) {
            try {
                ProjectedCurve one = project_curve(polyline(std::move(points)), target, projection, progress);
                result.curves.push_back({"", std::move(one.projection), std::nullopt, one.left_target});
            } catch (const InvalidInput& error) {
                throw InvalidInput(options.path + ": " + error.what());
            }
        }
        return result;
    }
    result.original_model = &*original;
    const Face& face = chosen_face(*original, options.face, "--face");
    const Vector2 start = chosen_point(*original, face, "--start", options.start);
    const auto add = [&](const std::string& family, ProjectedCurve one) {
        result.curves.push_back({family, std::move(one.projection), std::move(one.original), one.left_target});
    };
    if (!options.to.empty()) {
        const Vector2 end = chosen_point(*original, face, "--to", options.to);
        RelaxationOptions relaxation{.tolerance = 1e-6 * extent(face)};
        ProjectedGeodesicBetween between = as_asked(options.path, [&] {
            return project_geodesic_between(face, start, end, target, projection, relaxation, progress);
        });
        if (between.relaxation.converged)
            add("geodesic", std::move(between.curve));
        else
            result.why =
                "the relaxation from the straight line in the parameter plane did not converge; project the "
                "geodesics that umbilic curve geodesic finds";
        return result;
    }
    const Vector3 direction = three_numbers("--direction", options.direction);
    const OptionalJoins joined(*original, options.one_face);
    projection.original_joins = joined.get();
    const CurvatureFamily family = options.family == "maximum" ? CurvatureFamily::maximum : CurvatureFamily::minimum;
    add(options.family, as_asked(options.path, [&] {
            return options.family == "geodesic"
                       ? project_geodesic(face, start, direction, *options.length, target, projection, progress)
                       : project_line_of_curvature(face, start, family, direction, *options.length, target, projection,
                                                   progress);
        }));
    return result;
}

void add_project(CLI::App& curve, Session& session, Command& command) {
    auto* const subcommand = curve.add_subcommand("project", "The orthogonal projection of a curve onto a face");
    const auto options = std::make_shared<ProjectOptions>();
    subcommand
        ->add_option("CURVE", options->path,
                     "A JSON result of umbilic curve, a table of points, or a CAD file on which the curve starts")
        ->required();
    subcommand->add_option("ONTO", options->onto_path, "STEP, IGES or BREP file of the face to project onto")
        ->required();
    subcommand->add_option("--onto-face", options->onto_face, "Face of ONTO, from 1")->check(finite_number(false));
    subcommand->add_option("--foot", options->foot,
                           "Foot U,V of the curve's start on that face; the closest point by default");
    subcommand->add_option("--face", options->face, "Face of CURVE on which it starts")->check(finite_number(false));
    auto* const start = subcommand->add_option("--start", options->start, "Start U,V on that face");
    subcommand->add_option("--family", options->family, "geodesic (default), or line of curvature: maximum, minimum")
        ->check(CLI::IsMember({"geodesic", "maximum", "minimum"}))
        ->needs(start);
    auto* const direction =
        subcommand->add_option("--direction", options->direction, "Direction X,Y,Z; needs --length")->needs(start);
    subcommand->add_option("--to", options->to, "Instead of --direction: end U,V of a geodesic on the same face")
        ->needs(start)
        ->excludes(direction);
    subcommand->add_flag("--one-face", options->one_face, "Do not go on to other faces over smooth edges");
    add_curve_options(*subcommand, *options);
    add_common_options(*subcommand, session);
    subcommand->callback([&session, &command, options] {
        const bool started = !options->start.empty();
        if (started && options->to.empty() && (options->direction.empty() || !options->length))
            throw CLI::ValidationError("--start needs --direction with --length, or --to");
        if (!options->to.empty() && (options->family != "geodesic" || options->length))
            throw CLI::ValidationError("--to gives a geodesic and takes neither --family nor --length");
        if (!started && options->length) throw CLI::ValidationError("--length goes with --start");
        command = [&session, options, started] {
            std::optional<Model> original;
            if (started) original = load(session, options->path, {}, session.progress.part(0.0, 0.3)).model;
            const ReadResult onto = load(session, options->onto_path, {}, session.progress.part(0.3, 0.6));
            const CurveResult result = projections(*options, original, onto.model, session.progress.part(0.6, 1.0));
            return finish(session, *options, result);
        };
    });
}

}  // namespace

void add_curve(CLI::App& application, Session& session, Command& command) {
    auto* const curve = application.add_subcommand("curve",
                                                   "Single curves on faces: lines of curvature, geodesics, "
                                                   "projections");
    curve->require_subcommand(1);
    add_lines_of_curvature(*curve, session, command);
    add_geodesic(*curve, session, command);
    add_project(*curve, session, command);
}

}  // namespace umbilic
