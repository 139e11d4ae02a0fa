// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cli/match_options.h>

#include <charconv>
#include <cmath>

#include <cli/exit_status.h>
#include <cli/finite_numbers.h>
#include <cli/given_poses.h>
#include <umbilic/core/errors.h>
#include <umbilic/matching/choice_words.h>
#include <umbilic/matching/match_points.h>

namespace umbilic {

namespace {

bool read_number(std::string_view text, double& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
}

/// "auto", "fixed" or "LOW:HIGH".
ScaleChoice scale_from(const std::string& text) {
    ScaleChoice scale;
    if (text == "auto") return scale;
    if (text == "fixed") {
        scale.kind = ScaleChoice::Kind::fixed;
        return scale;
    }
    scale.kind = ScaleChoice::Kind::range;
    const auto colon = text.find(':');
    const std::string_view view = text;
    const bool understood = colon != std::string::npos && read_number(view.substr(0, colon), scale.low) &&
                            read_number(view.substr(colon + 1), scale.high) && 0.0 < scale.low &&
                            scale.low <= scale.high;
    if (!understood) {
        throw CLI::ValidationError("--scale",
                                   "'" + text + "' is neither auto, fixed nor LOW:HIGH with 0 < LOW <= HIGH");
    }
    return scale;
}

}  // namespace

void add_match_options(CLI::App& subcommand, MatchWords& words) {
    subcommand.add_option("ORIGINAL", words.original, "STEP, IGES or BREP file; points or mesh if the suspect is one")
        ->required();
    subcommand
        .add_option("SUSPECT", words.suspect,
                    "The file that may be a copy: STEP, IGES or BREP, or points or a mesh (xyz, ply, stl, obj)")
        ->required();
    const char* const group = "Pose";
    subcommand
        .add_option("--method", words.options.match.method,
                    "How poses are proposed: auto, analytic, umbilics, umbilics-lines, umbilics-kh, moments, "
                    "curvature, kh or points (of measured points: auto, curvature or points)")
        ->transform(CLI::CheckedTransformer(method_words).description(""))
        ->type_name("METHOD")
        ->group(group);
    subcommand
        .add_option_function<std::string>(
            "--scale", [&words](const std::string& text) { words.options.match.scale = scale_from(text); },
            "What is known of the scale, suspect to original: auto, fixed (it is 1) or LOW:HIGH")
        ->type_name("SCALE")
        ->group(group);
    subcommand
        .add_option("--scale-search", words.options.match.scale_search,
                    "How the method kh searches a scale that is not fixed: golden (section) or brent")
        ->transform(CLI::CheckedTransformer(scale_search_words).description(""))
        ->type_name("SEARCH")
        ->group(group);
    subcommand
        .add_option(
            "--kh-solver", words.options.match.curvature_solver,
            "How the methods kh and umbilics-kh find points of given curvatures: direct, or as the thesis does, "
            "auxiliary (slow) or approximated")
        ->transform(CLI::CheckedTransformer(curvature_solver_words).description(""))
        ->type_name("SOLVER")
        ->group(group);
    subcommand.add_option("--mirror", words.options.match.mirror, "Whether mirror images are tried: auto or never")
        ->transform(CLI::CheckedTransformer(mirror_words).description(""))
        ->type_name("MIRROR")
        ->group(group);
    subcommand.add_option("--scope", words.options.match.scope, "Whole models or parts: auto, global or partial")
        ->transform(CLI::CheckedTransformer(scope_words).description(""))
        ->type_name("SCOPE")
        ->group(group);
    subcommand
        .add_option("--initial", words.initial_path,
                    "JSON file with a pose to start from (scale, rotation, translation)")
        ->type_name("FILE")
        ->group(group);
    subcommand
        .add_option("--pairs", words.pairs_path,
                    "CSV file with corresponding points: x, y, z on the original, x, y, z on the suspect")
        ->type_name("FILE")
        ->group(group);
    subcommand
        .add_option("--match_seconds", words.options.match.seconds,
                    "Time after which the best pose so far is judged (results then depend on the machine)")
        ->check(finite_number(false))
        ->type_name("SECONDS")
        ->group(group);
    const char* const tolerances = "Tolerances";
    const auto add = [&](const char* names, auto& value, const char* meaning, const CLI::Validator& check) {
        subcommand.add_option(names, value, meaning)->check(check)->group(tolerances);
    };
    add("--match_tolerance", words.options.match.tolerance,
        "Distance within which a sample lies on the other model, mm", finite_number(false));
    add("--umbilic_invariant_tolerance", words.options.match.umbilic_invariant_tolerance,
        "Difference of the invariants of two umbilics that may correspond", finite_number(false));
    add("--samples", words.options.features.samples.count, "Points spread over each model", CLI::Range(1, 10'000'000));
    add("--point_samples", words.options.points.samples, "Points of a cloud at which it is measured",
        CLI::Range(40, 10'000'000));
    add("--most_points", words.options.points.most_points,
        "Points of a larger cloud that are used, chosen at random; the result says so", CLI::Range(40, 100'000'000));
    add("--umbilic_resolution", words.options.features.umbilics.resolution,
        "Side of the smallest box of the umbilic search, relative to the domain", finite_number(false));
    add("--umbilic_boxes", words.options.features.umbilics.boxes_per_patch,
        "Boxes the umbilic search may use on a patch", finite_number(false));
    add("--umbilic_margin", words.options.features.umbilics.generic_margin,
        "Relative error of the cubic forms that is assumed on top of rounding", finite_number(true));
    add("--umbilic_accuracy", words.options.features.umbilics.accuracy,
        "How far (mm) control points may be from where they should be: types that this changes are non-generic",
        finite_number(true));
    add("--umbilic_recognition", words.options.features.umbilics.recognition,
        "Deviation from a plane or sphere, relative to a face's size, within which it is umbilic everywhere",
        finite_number(true));
}

void check_method_of(const MatchWords& words, bool measured_suspect) {
    try {
        check_method(words.options.match.method, measured_suspect);
    } catch (const Unsupported& error) {
        throw WrongUse(words.suspect + ": " + error.what());
    }
}

void set_seed(MatchWords& words, std::uint64_t seed) {
    words.options.features.samples.seed = seed;
    words.options.points.seed = seed;
}

void read_given_poses(MatchWords& words) {
    if (!words.initial_path.empty()) words.options.match.initial = read_transform(words.initial_path);
    if (!words.pairs_path.empty()) words.options.match.pairs = read_point_pairs(words.pairs_path);
}

}  // namespace umbilic
