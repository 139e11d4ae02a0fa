// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/prepared_shape.h>

#include <cmath>

#include <umbilic/core/errors.h>
#include <umbilic/matching/match_points.h>

namespace umbilic {

double PreparedShape::size() const {
    return model_ ? model_->model.size() : std::sqrt(points_->area);
}

void refuse_points_as_original(const PreparedShape& original) {
    throw Unsupported(original.source().path +
                      ": measured points can only be the original of other points; exchange the two files, or fit a "
                      "surface first (umbilic fit)");
}

Alignment match(const PreparedShape& original, const PreparedShape& suspect, const MatchOptions& options,
                const Progress& progress) {
    if (original.model() && suspect.model()) return match(*original.model(), *suspect.model(), options, progress);
    if (original.model()) return match(*original.model(), *suspect.points(), options, progress);
    if (suspect.points()) return match(*original.points(), *suspect.points(), options, progress);
    refuse_points_as_original(original);
}

}  // namespace umbilic
