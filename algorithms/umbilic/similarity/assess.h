// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <umbilic/similarity/assessment.h>
#include <umbilic/similarity/wireframe_nodes.h>

namespace umbilic {

/// The nodes at which two models are compared.
struct AssessedNodes {
    NodeSet original, suspect;
};

/// Runs the weak, intermediate and strong tests (thesis 4.4.1-4.4.4) for a suspect in a given pose. Throws Cancelled.
Assessment assess(const PreparedModel& original, const PreparedModel& suspect, const AssessedNodes& nodes,
                  const Alignment& alignment, const ToleranceChoices& choices = {}, const Progress& progress = {});

/// The same at the area samples of both.
Assessment assess(const PreparedModel& original, const PreparedModel& suspect, const Alignment& alignment,
                  const ToleranceChoices& choices = {}, const Progress& progress = {});

}  // namespace umbilic
