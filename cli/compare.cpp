// SPDX-License-Identifier: LGPL-2.1-or-later
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>

#include <cli/alignment_text.h>
#include <cli/commands.h>
#include <cli/console.h>
#include <cli/exit_status.h>
#include <cli/finite_numbers.h>
#include <cli/loading.h>
#include <cli/match_options.h>
#include <report/output.h>
#include <report/readable.h>

namespace umbilic {

namespace {

struct CompareWords {
    MatchWords match;
    std::string report;
    std::optional<Level> fail_on;
};

std::string summary(const Comparison& comparison) {
    const Assessment& assessment = comparison.assessment;
    const Verdict& verdict = comparison.verdict;
    std::string text = bold(comparison.answer.text) + "\n\n";
    std::vector<std::pair<std::string, std::string>> lines;
    lines.emplace_back("Verdict", std::string(name(verdict.level)) +
                                      " (algorithm 1: " + name(verdict.algorithm_1.level) +
                                      ", algorithm 2: " + name(verdict.algorithm_2.level) + ")");
    lines.emplace_back(" ", verdict.explanation);
    for (auto& line : alignment_facts(comparison.alignment)) lines.push_back(std::move(line));
    const DirectedComparison& forward = assessment.suspect_on_original;
    if (!forward.nodes.empty()) {
        const char* const where = assessment.scope == MatchScope::partial ? "in the overlap: max " : "max ";
        lines.emplace_back("Deviation", where + readable(forward.distance.max, "mm", 3) + ", mean " +
                                            readable(forward.distance.mean, "mm", 3) + ", tolerance " +
                                            readable(assessment.distance.tolerance, "mm", 3));
        lines.emplace_back("Coverage", readable_percent(forward.coverage) + " of the suspect lies on the original; " +
                                           readable_percent(assessment.original_on_suspect.coverage) +
                                           " of the original is covered");
        const std::size_t pairs = assessment.strong.pairs.size();
        if (assessment.measured)
            lines.emplace_back("Noise", readable(find_tolerance(assessment.tolerances, "noise").value, "mm", 3) +
                                            " (estimated standard deviation of the points)");
        else
            lines.emplace_back("Umbilics", readable_count(pairs) + (pairs == 1 ? " pair" : " pairs"));
        lines.emplace_back("Curvature", assessment.intermediate_why);
    }
    return text + facts(lines);
}

int run_compare(const Session& session, CompareWords& words) {
    read_given_poses(words.match);
    set_seed(words.match, session.seed);
    const CompareOptions& options = words.match.options;
    const bool with_report = !words.report.empty();
    if (with_report) check_report_folder(words.report);
    const Progress& progress = session.progress;
    ReadOptions read;
    read.display_meshes = with_report;
    const auto pair = load_pair(session, words.match, read, progress.part(0.0, 0.4));
    const PreparedShape original = pair->original.prepared(), suspect = pair->suspect.prepared();
    const Comparison comparison = compare(original, suspect, options, progress.part(0.4, with_report ? 0.7 : 1.0));
    const Json result = compare_json(original, suspect, options, comparison, pair->timing);
    Timing timing = pair->timing;
    timing.insert(timing.end(), comparison.timing.begin(), comparison.timing.end());
    if (with_report) {
        const auto start = std::chrono::steady_clock::now();
        const ReportInput input{
            original,   suspect,      pair->original.file.meshes, pair->suspect.file.meshes, options,
            comparison, pair->timing, session.command_line};
        write_report(words.report, input, result, progress.part(0.7, 1.0));
        timing.emplace_back("report", std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    clear_progress_bar();
    std::string text = summary(comparison);
    if (with_report) text += "\nReport: " + (std::filesystem::path(words.report) / "report.html").string() + "\n";
    print(session, text);
    print_timing(session, timing);
    write_json(session, result);
    const bool reached = words.fail_on && comparison.verdict.level >= *words.fail_on;
    return reached ? exit_level_reached : exit_done;
}

}  // namespace

void add_compare(CLI::App& application, Session& session, Command& command) {
    auto* const subcommand = application.add_subcommand(
        "compare", "Alignment, weak, intermediate and strong tests, local similarity, verdict, report");
    const auto words = std::make_shared<CompareWords>();
    add_match_options(*subcommand, words->match);
    const auto tolerance = [&](const char* names, std::optional<double>& value, const char* meaning) {
        subcommand->add_option(names, value, meaning)->check(finite_number(false))->group("Tolerances");
    };
    tolerance("--distance", words->match.options.tolerances.distance, "Weak test, mm of the original");
    tolerance("--kappa", words->match.options.tolerances.kappa, "Intermediate test, curvatures, 1/mm of the original");
    tolerance("--direction", words->match.options.tolerances.direction,
              "Intermediate test, principal directions, radians");
    tolerance("--umbilic-distance,--umbilic_distance", words->match.options.tolerances.umbilic_distance,
              "Strong test, mm of the original");
    subcommand
        ->add_option("--cell", words->match.options.tolerances.cell,
                     "Cell of the local similarity, relative to a face's domain")
        ->check(CLI::Range(1e-3, 1.0))
        ->group("Tolerances");
    subcommand
        ->add_option("--nodes", words->match.options.nodes,
                     "Where the models are compared: at nodes of the wireframe (default) or of samples uniform by area")
        ->transform(CLI::CheckedTransformer(std::map<std::string, NodeChoice>{{"wireframe", NodeChoice::wireframe},
                                                                              {"area", NodeChoice::area}})
                        .description(""))
        ->type_name("wireframe|area");
    subcommand
        ->add_option("--algorithm", words->match.options.algorithm, "Decision algorithm that gives the level: 1 or 2")
        ->check(CLI::IsMember({1, 2}))
        ->type_name("1|2");
    subcommand
        ->add_option("--report", words->report,
                     "Folder for report.html, result.json, deviation.csv, aligned.step (or .ply)")
        ->type_name("DIR");
    subcommand
        ->add_option("--fail-on", words->fail_on,
                     "Exit with 10 if the verdict reaches this level: none, weak, intermediate or strong")
        ->transform(CLI::CheckedTransformer(std::map<std::string, Level>{{"none", Level::none},
                                                                         {"weak", Level::weak},
                                                                         {"intermediate", Level::intermediate},
                                                                         {"strong", Level::strong}})
                        .description(""))
        ->type_name("LEVEL");
    add_common_options(*subcommand, session);
    subcommand->callback(
        [&session, &command, words] { command = [&session, words] { return run_compare(session, *words); }; });
}

}  // namespace umbilic
