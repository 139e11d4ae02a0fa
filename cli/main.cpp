// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cstdio>
#include <exception>
#include <new>

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <umbilic/core/errors.h>

#include <cli/commands.h>
#include <cli/console.h>
#include <cli/exit_status.h>
#include <cli/interrupt.h>
#include <report/versions.h>

namespace umbilic {

namespace {

/// The words as a shell would have to be given them.
std::string quoted_command_line(int argc, char** argv) {
    std::string line = "umbilic";
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        const bool plain = !word.empty() && word.find_first_not_of(
                                                "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                                "0123456789_@%+=:,./-") == std::string::npos;
        std::string quoted = "'";
        for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
        line += ' ' + (plain ? word : quoted + "'");
    }
    return line;
}

int failed(const std::string& message, int status) {
    clear_progress_bar();
    fmt::print(stderr, "umbilic: {}\n", printable(message));
    return status;
}

std::string version_text() {
    const Versions used = versions();
    return fmt::format("umbilic {} (commit {}), OpenCASCADE {}", used.umbilic, used.commit, used.opencascade);
}

int run(int argc, char** argv) {
    CLI::App application("Tells whether a CAD model, or a piece of it, is a copy of another one.", "umbilic");
    application.set_version_flag("--version", version_text());
    application.require_subcommand(1);
    application.fallthrough(false);
    Session session;
    session.command_line = quoted_command_line(argc, argv);
    Command command;
    add_compare(application, session, command);
    add_match(application, session, command);
    add_fit(application, session, command);
    add_curve(application, session, command);
    add_umbilics(application, session, command);
    add_wireframe(application, session, command);
    add_info(application, session, command);
    try {
        application.parse(argc, argv);
    } catch (const CLI::Success& success) {
        return application.exit(success);  // --help and --version
    } catch (const CLI::ParseError& error) {
        return failed(std::string(error.what()) + "; see umbilic --help", exit_wrong_use);
    }
    session.progress = Progress(progress_bar(session.quiet));
    cancel_on_signals(session.progress);
    const tbb::global_control threads(
        tbb::global_control::max_allowed_parallelism,
        session.threads > 0 ? static_cast<std::size_t>(session.threads)
                            : tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
    return command();
}

}  // namespace

}  // namespace umbilic

int main(int argc, char** argv) {
    using namespace umbilic;
    try {
        return run(argc, argv);
    } catch (const WrongUse& error) {
        return failed(error.what(), exit_wrong_use);
    } catch (const Cancelled&) {
        return failed("stopped; nothing was written", exit_not_finished);
    } catch (const InvalidInput& error) {
        return failed(error.what(), exit_bad_input);
    } catch (const Unsupported& error) {
        return failed(error.what(), exit_bad_input);
    } catch (const std::bad_alloc&) {
        return failed("out of memory; try fewer threads or a smaller model", exit_not_finished);
    } catch (const std::exception& error) {
        return failed(error.what(), exit_not_finished);
    }
}
