// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include <umbilic/matching/alignment.h>
#include <umbilic/matching/pose_search.h>

namespace umbilic {

/// How much of a refined pose is believed.
enum class FitLevel { none, compatible, found };

/// A pose judged at the tolerance that suits it.
struct Fit {
    FitLevel level = FitLevel::none;
    bool exact = false;      ///< the tolerance is the one of exact copies
    double tolerance = 0.0;  ///< mm of the original
    Coverage suspect;        ///< of the suspect on the original
    Coverage original;       ///< of the original on the suspect
    std::string why;         ///< what kept the level down; a clause without full stop, empty if found
    /// What the pose leaves open; of models that agree as wholes only what their outlines leave open too.
    std::vector<FreeMotion> free_motions;
};

/// Judges one pose. Tolerance: the user's, or the finest of the FitTolerance steps beyond which coverage grows by less
/// than a tenth. Enough must coincide for that tolerance, the larger of the two shares counting: 0.2 exactly, 0.6
/// re-approximated; at the next step 0.95 of the suspect on at least 0.3 of the original, because smaller pieces of
/// smooth surfaces agree so far by accident; beyond, 0.95 of both is a resemblance and never more than compatible.
/// What coincides must over-determine the pose: satisfied equations (see satisfied_equations) beyond the four unknowns
/// of scale and translation, four of them, two if one model lies on the other completely; if both do (the outlines
/// agree too) one, and a scale that is 1 within the tolerance counts as it. And no motion may slide it along itself by
/// a tenth of the length within the tolerance, unless the models agree as wholes, which then turn about their own axis,
/// or shared borders fix it (see fix_by_borders), each of which counts as one condition more.
Fit judge(const ScoredPose& pose, const PoseSearch& search);

/// True if a search need not go on: the best pose is found, and one model lies on the other completely, or the pose is
/// exact and does not come from analytic faces alone.
bool settled(const PoseSearch& search);

/// True if the best pose finds the whole original in the suspect, and what is left of the suspect is enough for another
/// copy of it.
bool has_room_for_copies(const PoseSearch& search);

/// Best pose, the others, the symmetries among them and the status. Poses that fit equally well as the best one are
/// listed as symmetries: the shape's own (the motion between the two poses lays the original or the suspect on itself),
/// or, of exact fits, places where the original repeats. If the fit is not exact, a different pose that is no symmetry
/// and fits within 1.15 times the rms makes the result ambiguous; but a pose that leaves a motion free is compatible.
/// Among equals the unmirrored pose that turns least wins, and symmetries follow from symmetries until none is missing.
/// `tried`: what the methods said, for the case that nothing fits.
Alignment decide_alignment(PoseSearch& search, const std::string& tried, const Progress& progress);

}  // namespace umbilic
