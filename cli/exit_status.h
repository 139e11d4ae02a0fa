// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <stdexcept>
#include <string>

#include <umbilic/core/errors.h>

namespace umbilic {

// Exit statuses of the command.
inline constexpr int exit_done = 0;            ///< whatever the verdict
inline constexpr int exit_wrong_use = 2;       ///< words of the command line
inline constexpr int exit_bad_input = 3;       ///< an input could not be read or holds nothing to compare
inline constexpr int exit_not_finished = 4;    ///< the work could not be finished
inline constexpr int exit_level_reached = 10;  ///< --fail-on, and the verdict reached that level

/// The command line asks for what cannot be.
class WrongUse : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// The result of work on a file that has been read: what that finds invalid is what the command line asked for. Throws
/// WrongUse, which names the file, in place of InvalidInput.
template <class Work>
auto as_asked(const std::string& path, const Work& work) {
    try {
        return work();
    } catch (const InvalidInput& error) {
        throw WrongUse(path + ": " + error.what());
    }
}

}  // namespace umbilic
