// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <umbilic/matching/pose_search.h>

namespace umbilic {

/// Where the surfaces leave the best pose a turn or a slide, looks for amounts of it at which borders of the two models
/// lie on each other, and adds the poses that come of it to the search. Slides first, then turns, because ends of
/// surfaces of revolution need no turn to meet. A surface with such a motion is its own mirror image, so both hands are
/// tried where both are allowed. Borders count if together they are longer than a tenth of the smaller
/// model. Without free motion, or where no border is shared, nothing happens. Throws Cancelled.
void fix_by_borders(PoseSearch& search, const Progress& progress = {});

}  // namespace umbilic
