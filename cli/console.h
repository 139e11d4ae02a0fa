// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include <umbilic/core/progress.h>

namespace umbilic {

/// A progress bar on standard error: redrawn in place, at most twenty times a second, never backwards. Nothing is
/// drawn if standard error is not a terminal or `quiet`.
ProgressCallback progress_bar(bool quiet);
/// Takes the bar off the screen, before anything else is printed there.
void clear_progress_bar();

/// The text in bold, if standard output is a terminal and NO_COLOR is not set.
std::string bold(const std::string& text);

/// A table of left-aligned columns with a heading and a rule; columns named in `right` (from 0) are right-aligned.
std::string table(const std::vector<std::string>& heading, const std::vector<std::vector<std::string>>& rows,
                  const std::vector<int>& right = {});

/// "name   value" lines, names padded to one width; lines with an empty value are left out.
std::string facts(const std::vector<std::pair<std::string, std::string>>& lines);

/// Text from a file without control characters, so that a name cannot steer the terminal.
std::string printable(const std::string& text);

}  // namespace umbilic
