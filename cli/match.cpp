// SPDX-License-Identifier: LGPL-2.1-or-later
#include <chrono>
#include <memory>

#include <cli/alignment_text.h>
#include <cli/commands.h>
#include <cli/console.h>
#include <cli/exit_status.h>
#include <cli/loading.h>
#include <cli/match_options.h>
#include <report/json.h>
#include <report/readable.h>

namespace umbilic {

namespace {

int run_match(const Session& session, MatchWords& words) {
    read_given_poses(words);
    set_seed(words, session.seed);
    const Progress& progress = session.progress;
    const CompareOptions& options = words.options;
    const auto pair = load_pair(session, words, {}, progress.part(0.0, 0.5));
    const PreparedShape original = pair->original.prepared(), suspect = pair->suspect.prepared();
    const auto start = std::chrono::steady_clock::now();
    const Alignment alignment = match(original, suspect, options.match, progress.part(0.5, 1.0));
    pair->timing.emplace_back("match", std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    clear_progress_bar();
    auto lines = alignment_facts(alignment);
    if (alignment.status != AlignmentStatus::not_found) {
        lines.emplace_back("Coverage",
                           readable_percent(alignment.suspect_coverage) + " of the suspect lies on the original; " +
                               readable_percent(alignment.original_coverage) + " of the original is covered");
        lines.emplace_back("Runners-up", readable_count(alignment.runners_up.size()));
    }
    print(session, facts(lines));
    print_timing(session, pair->timing);
    write_json(session, match_json(original, suspect, options, alignment, pair->timing));
    return exit_done;
}

}  // namespace

void add_match(CLI::App& application, Session& session, Command& command) {
    auto* const subcommand = application.add_subcommand("match", "The similarity transform of the suspect alone");
    const auto words = std::make_shared<MatchWords>();
    add_match_options(*subcommand, *words);
    add_common_options(*subcommand, session);
    subcommand->callback(
        [&session, &command, words] { command = [&session, words] { return run_match(session, *words); }; });
}

}  // namespace umbilic
