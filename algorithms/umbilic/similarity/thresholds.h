// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <umbilic/similarity/assessment.h>

namespace umbilic {

/// A quantity passes by statistics if mean <= delta and mean + 2 standard deviations <= spread_factor * delta. The same
/// factor bounds how far decision algorithm 1 may raise a derived tolerance, and the overlap of a partial match:
/// distance <= spread_factor * delta_0. docs/algorithms/decision.md says why.
inline constexpr double spread_factor = 3.0;
/// A model counts as lying on the other one if this share of its area is in the overlap.
inline constexpr double whole_share = 0.99;
/// The same of measured points: scans have outliers.
inline constexpr double measured_share = 0.95;
/// Smallest share of either model that counts as a part that coincides.
inline constexpr double least_part = 0.1;
/// Where only a part coincides, mean distance in the overlap <= partial_mean * delta_0: where surfaces merely cross or
/// touch, the distances fill the overlap's band evenly.
inline constexpr double partial_mean = 0.5;
/// Curvatures must be comparable on at least this share of the nodes.
inline constexpr double comparable_share = 0.5;

/// mean <= tolerance and mean + 2 standard deviations <= spread_factor * tolerance, over at least one node.
bool within_thresholds(const Statistics& statistics, double tolerance);
/// max <= tolerance, over at least one node.
bool within_maximum(const Statistics& statistics, double tolerance);

/// The directions that decide: both where the scope is global (a suspect that is only a piece must not pass as a
/// whole); the one of which more lies on the other model where it is partial (the thesis limits partial comparisons to
/// the smaller surface). Of measured points the suspect's.
std::vector<const DirectedComparison*> deciding_directions(const Assessment& assessment);

/// Share of the deciding model that must be in the overlap.
double needed_share(const Assessment& assessment);

/// True if curvatures could be compared on enough nodes.
bool comparable(const DirectedComparison& direction);

/// The weak test by statistics; under partial scope the deciding model must also lie on the other one (whole_share).
bool passes_weak(const Assessment& assessment);
/// The intermediate test by statistics, without asking for the weak one. Directions enter only where they are defined.
bool passes_intermediate(const Assessment& assessment);

/// True if a part of either model coincides with the other, whatever the scope: at least least_part of it, distances in
/// the overlap gather at zero (partial_mean), and curvatures agree there.
bool part_coincides(const Assessment& assessment);

}  // namespace umbilic
