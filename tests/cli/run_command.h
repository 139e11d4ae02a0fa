// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <vector>

namespace umbilic {

/// How a run of the command ended.
struct CommandResult {
    int status = -1;  ///< exit status; -1 if a signal ended it
    std::string output;
    std::string error;
};

/// Runs the built `umbilic` with these words, its output taken through files. `meanwhile` is called with the process id
/// while it runs. A run of more than two minutes is ended.
CommandResult run_umbilic(const std::vector<std::string>& words, const std::function<void(int)>& meanwhile = {});

/// Path of a file in models/.
std::string model_path(const std::string& name);

}  // namespace umbilic
