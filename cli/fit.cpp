// SPDX-License-Identifier: LGPL-2.1-or-later
#include <charconv>
#include <chrono>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include <occ_adapter/read_file.h>
#include <umbilic/matching/prepared_points.h>
#include <umbilic/core/errors.h>
#include <umbilic/points/fit_points.h>

#include <cli/commands.h>
#include <cli/console.h>
#include <cli/exit_status.h>
#include <cli/finite_numbers.h>
#include <cli/loading.h>
#include <report/fit_html.h>
#include <report/json_fit.h>
#include <report/output.h>
#include <report/readable.h>

namespace umbilic {

namespace {

struct FitWords {
    std::string points, output, report;
    FitOptions fit;
    std::size_t most_points = PointFeatureOptions().most_points;
};

/// "12x9" or "12,9".
std::pair<int, int> size_from(const char* option, const std::string& text) {
    const auto number = [](std::string_view word, int& value) {
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        return error == std::errc() && end == word.data() + word.size() && value > 0;
    };
    std::pair<int, int> size;
    const auto cross = text.find_first_of("x,");
    const std::string_view view = text;
    if (cross == std::string::npos || !number(view.substr(0, cross), size.first) ||
        !number(view.substr(cross + 1), size.second))
        throw CLI::ValidationError(option, "'" + text + "' is not two whole numbers above 0 such as 12x9");
    return size;
}

std::string summary(const FitWords& words, const FitResult& fit) {
    std::vector<std::vector<std::string>> rows;
    for (const FitStep& step : fit.steps)
        rows.push_back({std::to_string(step.u_poles) + "×" + std::to_string(step.v_poles), readable(step.rms, 3),
                        readable(step.maximum, 3)});
    return bold(fit_headline(fit)) + "\n" + fit_explanation(words.fit, fit) + "\n\n" +
           table({"poles", "rms mm", "largest mm"}, rows, {0, 1, 2}) + "\nSurface: " + words.output + "\n" +
           (words.report.empty() ? ""
                                 : "Report: " + (std::filesystem::path(words.report) / "report.html").string() + "\n");
}

/// The fit; what is wrong with the points is said of their file.
FitResult fitted(const PointCloud& cloud, const FitWords& words, const Progress& progress) {
    try {
        return fit_points(cloud, words.fit, progress);
    } catch (const InvalidInput& error) {
        throw InvalidInput(words.points + ": " + error.what());
    } catch (const Unsupported& error) {
        throw Unsupported(words.points + ": " + error.what());
    }
}

int run_fit(const Session& session, const FitWords& words) {
    using Clock = std::chrono::steady_clock;
    Timing timing;
    auto start = Clock::now();
    const auto lap = [&](const char* stage) {
        timing.emplace_back(stage, std::chrono::duration<double>(Clock::now() - start).count());
        start = Clock::now();
    };
    if (!words.report.empty()) check_report_folder(words.report);
    const Progress& progress = session.progress;
    // A grid has to stay whole.
    const std::size_t most_points = words.fit.grid ? std::numeric_limits<std::size_t>::max() : words.most_points;
    const PointCloud cloud = load_points(session, words.points, most_points, progress.part(0.0, 0.1));
    lap("read");
    const FitResult fit = fitted(cloud, words, progress.part(0.1, 0.8));
    lap("fit");
    write_surface_step(fit.surface, words.output);
    lap("write");
    const Json result = fit_json(cloud, words.fit, words.most_points, fit, words.output, timing);
    if (!words.report.empty()) {
        const FitReportInput input{cloud, words.fit, words.most_points, fit, timing, session.command_line};
        write_fit_report(words.report, input, result, progress.part(0.8, 1.0));
        lap("report");
    }
    clear_progress_bar();
    print(session, summary(words, fit));
    print_timing(session, timing);
    write_json(session, result);
    return exit_done;
}

}  // namespace

void add_fit(CLI::App& application, Session& session, Command& command) {
    auto* const subcommand = application.add_subcommand("fit", "A NURBS surface fitted to points, with its residuals");
    const auto words = std::make_shared<FitWords>();
    subcommand->add_option("POINTS", words->points, "Points or a mesh (xyz, csv, ply, stl, obj)")->required();
    subcommand->add_option("-o,--output", words->output, "STEP file for the surface")->required();
    subcommand
        ->add_option("--method", words->fit.method,
                     "scattered (least squares), multilevel (multilevel B-splines) or grid")
        ->transform(CLI::CheckedTransformer(std::map<std::string, FitMethod>{{"scattered", FitMethod::scattered},
                                                                             {"multilevel", FitMethod::multilevel},
                                                                             {"grid", FitMethod::grid}})
                        .description(""))
        ->type_name("METHOD");
    subcommand
        ->add_option_function<std::string>(
            "--grid",
            [words](const std::string& text) {
                words->fit.grid = size_from("--grid", text);
                words->fit.method = FitMethod::grid;
            },
            "The points stand in so many rows and columns, row by row")
        ->type_name("ROWSxCOLUMNS");
    subcommand
        ->add_option_function<std::string>(
            "--net", [words](const std::string& text) { words->fit.poles = size_from("--net", text); },
            "Control points along u and v; without it the net grows until what it leaves is noise")
        ->type_name("MxN");
    subcommand->add_option("--degree", words->fit.degree, "Degree in u and v")->check(CLI::Range(1, maximum_degree));
    subcommand
        ->add_option("--tolerance", words->fit.tolerance,
                     "The net grows until no point is farther than this, mm, instead of until what it leaves is noise")
        ->check(finite_number(false));
    subcommand->add_option("--smooth", words->fit.smooth, "Width of a Gaussian low-pass filter before the fit, mm")
        ->check(finite_number(false));
    subcommand->add_option("--most_poles", words->fit.most_poles, "Control points along either direction at most")
        ->check(CLI::Range(2, 1000));
    subcommand
        ->add_option("--most_points", words->most_points,
                     "Points of a larger cloud that are used, chosen at random; the result says so")
        ->check(CLI::Range(4, 100'000'000));
    subcommand->add_option("--report", words->report, "Folder for report.html and fit.json")->type_name("DIR");
    add_common_options(*subcommand, session);
    subcommand->callback(
        [&session, &command, words] { command = [&session, words] { return run_fit(session, *words); }; });
}

}  // namespace umbilic
