// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <umbilic/similarity/assessment.h>

namespace umbilic {

/// Runs the weak, intermediate and strong tests (thesis 4.4.1-4.4.4) for a suspect in a given pose. Throws Cancelled.
Assessment assess(const PreparedModel& original, const PreparedModel& suspect, const Alignment& alignment,
                  const ToleranceChoices& choices = {}, const Progress& progress = {});

}  // namespace umbilic
