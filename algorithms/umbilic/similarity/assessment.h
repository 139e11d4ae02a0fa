// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/core/tolerances.h>
#include <umbilic/matching/alignment.h>
#include <umbilic/matching/prepared_model.h>

namespace umbilic {

/// Statistics of one quantity over the nodes (thesis 4.4.4).
struct Statistics {
    double max = 0.0;
    double mean = 0.0;
    double standard_deviation = 0.0;
    int count = 0;
};

/// One node of a model and its foot point on the other one, both in the frame and unit of the original.
struct NodeComparison {
    SurfacePoint at;                  ///< on the model the node belongs to
    SurfacePoint foot;                ///< on the other model
    Vector3 point = Vector3::Zero();  ///< the node, moved into the original's frame
    double weight = 0.0;              ///< area, mm^2 of the original
    double distance = 0.0;            ///< mm, unsigned
    double signed_distance = 0.0;     ///< along the original's outward normal
    std::optional<double> kappa_max;  ///< |difference| of the greater principal curvatures, 1/mm
    std::optional<double> kappa_min;
    std::optional<double>
        direction;         ///< angle between the lines of kappa_max in [0, pi/2]; none where they are not defined
    bool covered = false;  ///< distance within the weak test's tolerance
};

/// The nodes of one model against the other.
struct DirectedComparison {
    std::vector<NodeComparison> nodes;
    int of_wireframe = 0;  ///< so many of them are nodes of the wireframe; the others are spread uniformly by area
    /// Over all nodes where the scope is global; over the overlap (distance within spread_factor times the weak test's
    /// tolerance, see thresholds.h) where it is partial.
    Statistics distance, kappa_max, kappa_min, direction;
    double coverage = 0.0;  ///< share of area whose nodes are covered
    double overlap = 0.0;   ///< share of area whose nodes lie in the overlap; 1 only if all do
};

/// Two umbilics of the same type that come to lie on each other.
struct UmbilicPair {
    int original = 0;  ///< index into the original's isolated umbilics inside its faces, from 0
    int suspect = 0;
    UmbilicType type = UmbilicType::non_generic;
    double distance = 0.0;  ///< mm of the original
};

struct StrongTest {
    std::optional<bool> passed;  ///< none: there is no isolated generic umbilic to compare
    std::string why;
    std::vector<UmbilicPair> pairs;
    std::vector<int> unmatched_original;  ///< that should have a partner and have none
    std::vector<int> unmatched_suspect;
};

/// Local similarity of one quantity (thesis 4.4.4): share of the area, in percent, on which it stays within its
/// tolerance.
struct LocalSimilarity {
    double tolerance = 0.0;
    double percent = 0.0;       ///< weighted by area
    double cell_percent = 0.0;  ///< the thesis's (1 - D_eps / D_T) 100 over cells that hold nodes
    int cells = 0;              ///< D_T, cells that hold nodes
    int marked = 0;             ///< D_eps
};

/// How much of one face of the suspect lies on which face of the original.
struct FaceCoverage {
    int suspect_face = 0;
    int original_face = 0;  ///< the one most of it lies on; 0 if none
    double fraction = 0.0;
    std::string level;  ///< "none", "weak" or "intermediate"
};

/// The three tests of the thesis (4.4) in both directions.
struct Assessment {
    MatchScope scope = MatchScope::global;   ///< which nodes the statistics are over, and which direction decides
    DirectedComparison suspect_on_original;  ///< the statistics a report shows first
    DirectedComparison original_on_suspect;
    bool flipped = false;      ///< the suspect's normals were reversed to agree with the original's (open surfaces)
    bool weak_passed = false;  ///< by the thresholds of decision algorithm 2
    bool intermediate_passed = false;  ///< the same; never without weak_passed
    /// Why curvatures could not be compared, so that the intermediate test says nothing; empty if they could.
    std::string intermediate_why;
    /// The suspect is measured points: its direction alone decides, as nothing is known of what was not measured.
    bool measured = false;
    StrongTest strong;
    double cell = 0.0;  ///< delta_s, relative to a face's domain
    LocalSimilarity distance, kappa_max, kappa_min, direction;
    std::vector<FaceCoverage> faces;
    std::vector<Tolerance> tolerances;  ///< every tolerance used, by the name it bears in the report
};

}  // namespace umbilic
