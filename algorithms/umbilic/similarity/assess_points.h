// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <umbilic/matching/prepared_shape.h>
#include <umbilic/similarity/assessment.h>

namespace umbilic {

/// delta_0 of measured points is at least this many standard deviations of their noise: of the points of an exact copy
/// one in 370 exceeds it.
inline constexpr double measured_noise_tolerance = 3.0;
/// A curvature is compared where this many standard deviations of its error stay below the tolerance.
inline constexpr double curvature_certainty = 2.0;

/// Tolerances for measured points: those of derive_tolerances() that concern them, delta_0 raised by the noise (mm of
/// the original), and `noise` itself.
std::vector<Tolerance> derive_point_tolerances(double size, double noise, const ToleranceChoices& choices);

/// Assessment of measured points in a given pose on a model or on other measured points (thesis 4.4, with the
/// statistics of 4.4.4). Nodes of the suspect are its samples: distance from the original, and curvatures by jets. The
/// jet of a node is compared with the jet fitted in the same way to the foot points of the same neighbours, so that
/// what a polynomial misses of the shape is missed on both sides; nodes whose curvatures are too uncertain
/// (curvature_certainty) are left out. Nodes of the original are its samples, for the share of it that the points
/// cover; no curvature is compared there. Statistics are over the overlap. The strong test says nothing: points have no
/// umbilics that could be proved. The alignment must have a pose. Throws InvalidInput for tolerances as
/// derive_tolerances() does; Cancelled.
Assessment assess(const PreparedShape& original, const PreparedPoints& suspect, const Alignment& alignment,
                  const ToleranceChoices& choices = {}, const Progress& progress = {});

}  // namespace umbilic
