// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <umbilic/core/progress.h>
#include <umbilic/matching/match.h>
#include <umbilic/matching/prepared_points.h>

namespace umbilic {

/// A model or measured points: what is compared where only the files say which. Refers to what it was made from.
class PreparedShape {
public:
    PreparedShape(const PreparedModel& model) : model_(&model) {}
    PreparedShape(const PreparedPoints& points) : points_(&points) {}

    /// One of the two is null.
    const PreparedModel* model() const { return model_; }
    const PreparedPoints* points() const { return points_; }

    const Source& source() const { return model_ ? model_->model.source : points_->cloud.source; }
    BoundingBox box() const { return model_ ? model_->model.box : points_->cloud.box(); }
    /// Square root of the area, mm.
    double size() const;

private:
    const PreparedModel* model_ = nullptr;
    const PreparedPoints* points_ = nullptr;
};

/// match() for what the shapes are. Throws Unsupported for a model as the suspect of measured points: nothing lies on
/// points, so the model has to be the original.
Alignment match(const PreparedShape& original, const PreparedShape& suspect, const MatchOptions& options = {},
                const Progress& progress = {});

/// The sentence of that error.
[[noreturn]] void refuse_points_as_original(const PreparedShape& original);

}  // namespace umbilic
