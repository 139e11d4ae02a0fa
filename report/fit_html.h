// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include <umbilic/points/fit_points.h>

#include <report/json.h>

namespace umbilic {

/// Everything the report on a fit tells. References must outlive the call they are given to.
struct FitReportInput {
    const PointCloud& cloud;
    const FitOptions& options;
    std::size_t most_points = 0;
    const FitResult& fit;
    const Timing& timing;
    std::string command_line;  ///< that computes the same again
};

/// "80×40 points fitted by 12×9 poles; rms 0.01 mm", and whether that is the noise of the points, for people.
std::string fit_headline(const FitResult& fit);
std::string fit_explanation(const FitOptions& options, const FitResult& fit);

/// The report as one HTML page that needs no other file and no network: the points on the surface coloured by their
/// residuals, the histogram, the nets that were tried, all choices. Strings that come from files are escaped. Throws
/// Cancelled.
std::string fit_html(const FitReportInput& input, const Progress& progress = {});

}  // namespace umbilic
