// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/differential/curvature.h>
#include <umbilic/model/model.h>

namespace umbilic {

/// A point of a model with its principal frame. `curvature.normal` points to the face's outward side (Face::reversed
/// applied).
struct AreaSample {
    SurfacePoint at;
    Curvature curvature;
    double weight = 0.0;  ///< area it stands for, mm^2
};

struct AreaSampleOptions {
    int count = 4000;        ///< samples wanted over the whole model; every face gets at least one
    std::uint64_t seed = 0;  ///< shifts the low-discrepancy sequence
};

/// Points spread uniformly by area over the trimmed faces of a model (not by parameters): they depend on the shape and
/// not on its parametrisation, up to the choice of the low-discrepancy sequence. Singular points are left out. The
/// weights of a face sum to its area.
std::vector<AreaSample> area_samples(const Model& model, const AreaSampleOptions& options = {},
                                     const Progress& progress = {});

}  // namespace umbilic
