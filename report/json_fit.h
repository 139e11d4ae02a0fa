// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include <umbilic/points/fit_points.h>

#include <report/json.h>
#include <report/parameters.h>

namespace umbilic {

/// Bins of the histogram of residuals.
inline constexpr int residual_bins = 41;

/// Schema "umbilic.fit/1": the points, the surface with knots and control points, residuals with their histogram, every
/// net that was tried. `output`: the file the surface was written to, empty if none.
Json fit_json(const PointCloud& cloud, const FitOptions& options, std::size_t most_points, const FitResult& fit,
              const std::string& output, const Timing& timing);

/// Every choice of a fit.
std::vector<Parameter> fit_parameters(const FitOptions& options, std::size_t most_points);

}  // namespace umbilic
