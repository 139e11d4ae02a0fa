// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cli/session.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include <umbilic/core/errors.h>

#include <report/output.h>

namespace umbilic {

namespace {

constexpr int most_threads = 1024;

}  // namespace

void add_common_options(CLI::App& subcommand, Session& session) {
    const char* const group = "Everywhere";
    subcommand.add_option("--json", session.json, "Write the result as JSON to FILE, - for standard output")
        ->type_name("FILE")
        ->group(group);
    subcommand.add_option("--threads", session.threads, "Threads to use; 0: one for each processor")
        ->check(CLI::Range(0, most_threads))
        ->group(group);
    subcommand.add_option("--seed", session.seed, "Shifts the points at which models are sampled")->group(group);
    auto* const quiet = subcommand.add_flag("--quiet,-q", session.quiet, "Print errors only")->group(group);
    subcommand.add_flag("--verbose,-v", session.verbose, "Print stages and their times on standard error")
        ->excludes(quiet)
        ->group(group);
}

void write_output(const std::string& text) {
    const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
    if (!written) {
        throw NumericFailure(std::string("standard output: cannot be written (") + std::strerror(errno) +
                             "); use --json FILE or another place");
    }
}

void write_json(const Session& session, const Json& json) {
    if (session.json.empty()) return;
    const std::string contents = text(json) + "\n";
    if (session.json_on_output()) {
        write_output(contents);
    } else {
        write_file(session.json, contents);
    }
}

void print(const Session& session, const std::string& text) {
    if (!session.quiet && !session.json_on_output()) write_output(text);
}

}  // namespace umbilic
