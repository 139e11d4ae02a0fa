// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <umbilic/core/progress.h>
#include <umbilic/matching/match.h>
#include <umbilic/matching/prepared_points.h>

namespace umbilic {

/// Rules of the decision on measured points.
struct PointDecision {
    /// Tolerance in the suspect's unit: noise_tolerance * noise + FitTolerance::reapproximated * length.
    static constexpr double noise_tolerance = 4.0;
    /// Share of the suspect that must lie within the tolerance.
    static constexpr double share = 0.95;
    /// The rms may exceed the noise by this factor (the jets' noise is itself an estimate).
    static constexpr double greatest_rms = 1.25;
    /// A different pose must fit worse by this factor.
    static constexpr double runner_up = 1.15;
    /// No motion by this part of the length may keep all points within the tolerance.
    static constexpr double sliding = 0.1;
    /// A suspect that departs from a quadric by less than this many times its noise fits many shapes.
    static constexpr double departure = 3.0;
};

/// Whether a method says something of a suspect. `points` needs measured ones. Of these umbilics, moments, analytic
/// faces and points of equal curvature (kh) do not: a surface has to be fitted first; `curvature` and `points` are one
/// there, principal frames of local jets. Throws Unsupported.
void check_method(MethodChoice method, bool measured_suspect);

/// Finds how a cloud or mesh, the whole or a piece, lies on the original when nothing is known of pose, scale or
/// handedness (thesis 4.6.2 and 4.8, without fitting a surface first): jets of the cloud with their
/// principal frames are looked up among the original's samples, the best poses are refined by least squares in the
/// suspect's unit, and PointDecision tells found from ambiguous and compatible. Deterministic.
/// Throws InvalidInput for options as match() does, Unsupported as check_method() does; Cancelled.
Alignment match(const PreparedModel& original, const PreparedPoints& suspect, const MatchOptions& options = {},
                const Progress& progress = {});

/// The same with measured points as the original: distances are those from the jets of its samples.
Alignment match(const PreparedPoints& original, const PreparedPoints& suspect, const MatchOptions& options = {},
                const Progress& progress = {});

}  // namespace umbilic
