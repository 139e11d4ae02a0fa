// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <umbilic/core/progress.h>

namespace umbilic {

/// From now on SIGINT, SIGTERM and SIGHUP cancel `progress`, which must outlive the program's work. A closed pipe
/// becomes an error of writing instead of a signal.
void cancel_on_signals(const Progress& progress);

}  // namespace umbilic
