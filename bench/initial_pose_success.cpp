// SPDX-License-Identifier: LGPL-2.1-or-later
// Convergence basin of refinement from initial information (IPWOS, IPWS of the thesis's Table 4.1): how far a given
// pose may be off. Noisy pieces of free-form designs, the true pose turned about a random axis by the angle of the row
// and shifted in a random direction by the part of the suspect's length of the column, with the scale known or off by
// the factor of the block; beside it the ICP of Besl and McKay from the same starts.
// initial_pose_success [--cases N] (default 30 a cell, shared among the shapes)
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <vector>

#include <Eigen/Geometry>
#include <tbb/global_control.h>

#include <occ_adapter/read_file.h>
#include <support/surfaces.h>
#include <umbilic/core/errors.h>
#include <umbilic/matching/pose_distance.h>
#include <umbilic/matching/refine.h>
#include <umbilic/matching/score.h>
#include <umbilic/matching/table_ground.h>

#include "iterative_closest_points.h"
#include "point_trials.h"

using namespace umbilic;
using namespace umbilic::bench;

namespace {

constexpr std::array<double, 7> turns = {0, 10, 20, 30, 45, 60, 90};  // degrees
constexpr std::array<double, 4> shifts = {0.0, 0.1, 0.2, 0.4};        // of the suspect's length
constexpr std::array<double, 2> factors = {1.0, 1.2};                 // of the scale; 1: known
constexpr std::array<double, 2> coverages = {1.0, 0.3};
constexpr double noise = 3e-4;
/// Points that take part, and the cut-off that lets in what is as far off as the farthest starts.
constexpr int points_used = 400;
constexpr double start_cutoff = 0.25;

/// The true pose, turned about the suspect's centroid, shifted and scaled about it.
SimilarityTransform disturbed(const SimilarityTransform& truth, const ShapeSize& suspect, double degrees, double shift,
                              double factor, std::mt19937_64& random) {
    std::normal_distribution<double> normal(0.0, 1.0);
    const auto direction = [&] { return Vector3(normal(random), normal(random), normal(random)).normalized(); };
    const Vector3 centre = truth.apply(suspect.centroid);
    SimilarityTransform pose = truth;
    pose.scale *= factor;
    pose.rotation = Eigen::AngleAxisd(degrees * M_PI / 180.0, direction()).toRotationMatrix() * truth.rotation;
    const Vector3 wanted = centre + shift * suspect.length * truth.scale * direction();
    pose.translation += wanted - pose.apply(suspect.centroid);
    return pose;
}

struct Cell {
    int refined = 0, closest_points = 0;
};

Cell run_cell(const std::vector<std::unique_ptr<PointOriginal>>& originals, double coverage, double factor,
              double degrees, double shift, int cases) {
    Cell cell;
    for (int k = 0; k < cases; ++k) {
        const PointOriginal& original = *originals[k % originals.size()];
        std::mt19937_64 random(1000003ull * k + static_cast<std::uint64_t>(10 * coverage + 100 * factor));
        const bool free_scale = factor != 1.0;
        const PointTrial trial =
            point_trial(original, {.coverage = coverage, .noise = noise, .unknown_scale = free_scale}, random);
        const std::vector<Vector3>& points = trial.suspect.points;
        std::vector<AreaSample> samples(points.size());
        for (std::size_t i = 0; i < points.size(); ++i) samples[i].curvature.point = points[i], samples[i].weight = 1.0;
        const SimilarityTransform start =
            disturbed(trial.truth, shape_size(samples), degrees, shift, k % 2 == 0 ? factor : 1.0 / factor, random);
        std::vector<WeightedPoint> some;
        std::vector<Vector3> same;
        for (const int i : spread_samples(samples, points_used)) {
            some.push_back({points[i]});
            same.push_back(points[i]);
        }
        const ScaleChoice scale{free_scale ? ScaleChoice::Kind::automatic : ScaleChoice::Kind::fixed};
        const Refinement refined = refine(Ground(*original.prepared), some, start,
                                          {.scale = scale, .start_cutoff = start_cutoff, .hold_borders = true});
        cell.refined += trial_error(original, trial, refined.original_suspect).success();
        const SimilarityTransform closest =
            iterative_closest_points(TableGround(original.prepared->table), same, start, {.free_scale = free_scale});
        cell.closest_points += trial_error(original, trial, closest).success();
    }
    return cell;
}

void run(int cases) {
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    std::vector<std::unique_ptr<PointOriginal>> originals;
    const std::string models = UMBILIC_MODELS_DIR;
    originals.push_back(point_original("bottle", read_file(models + "/bottle.step").model));
    originals.push_back(point_original("hood", read_file(models + "/hood.step").model));
    originals.push_back(point_original("bumps20", support::model_of({support::smooth_bicubic(20, 20, 0.2)})));
    std::printf("%d cases a cell, noise %g sqrt(area); success %% of refinement / of ICP (Besl, McKay)\n", cases,
                noise);
    for (const double coverage : coverages)
        for (const double factor : factors) {
            std::printf("\ncoverage %.0f %%, %s", 100 * coverage,
                        factor == 1.0 ? "scale known" : "scale off by a factor");
            if (factor != 1.0) std::printf(" %g", factor);
            std::printf("\n%12s", "turn \\ shift");
            for (const double shift : shifts) std::printf(" %10.1f L", shift);
            std::printf("\n");
            for (const double degrees : turns) {
                std::printf("%11.0f°", degrees);
                for (const double shift : shifts) {
                    const Cell cell = run_cell(originals, coverage, factor, degrees, shift, cases);
                    std::printf("   %4.0f /%4.0f", 100.0 * cell.refined / cases, 100.0 * cell.closest_points / cases);
                    std::fflush(stdout);
                }
                std::printf("\n");
            }
        }
}

}  // namespace

int main(int count, char** words) {
    try {
        run(count == 3 && std::strcmp(words[1], "--cases") == 0 ? std::max(1, std::atoi(words[2])) : 30);
    } catch (const Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
