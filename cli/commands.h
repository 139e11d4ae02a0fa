// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>

#include <CLI/CLI.hpp>

#include <cli/session.h>

namespace umbilic {

/// What runs once the words of the command line were understood; returns the exit status.
using Command = std::function<int()>;

// Each adds its subcommand to the application and sets `command` when its words are found. The session outlives both.
void add_info(CLI::App& application, Session& session, Command& command);
void add_umbilics(CLI::App& application, Session& session, Command& command);
void add_wireframe(CLI::App& application, Session& session, Command& command);
void add_curve(CLI::App& application, Session& session, Command& command);
void add_fit(CLI::App& application, Session& session, Command& command);
void add_match(CLI::App& application, Session& session, Command& command);
void add_compare(CLI::App& application, Session& session, Command& command);

}  // namespace umbilic
