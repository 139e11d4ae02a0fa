// SPDX-License-Identifier: LGPL-2.1-or-later
// Success matrix of matching measured points: random pieces of free-form designs, noisy, in unknown places and scales;
// beside it the ICP of Besl and McKay, the thesis's baseline, from centroids (and sizes, where the scale is unknown)
// laid on each other.
//
// points_success [--cases N] [--only TEXT] [--coverage C] [--mirror] [--export DIR]
// "Noise allows": per cent of the cases, shape by shape, whose scale the best unbiased estimate knows within 2 %
// (Cramer-Rao bound).
//   --cases N     cases a cell (default 51, shared among the shapes)
//   --only TEXT   rows whose name contains TEXT
//   --coverage C  only this coverage: 1, 0.6, 0.3 or 0.1
//   --mirror      also try mirror images, as the command does
//   --export DIR  only write every trial as original.ply, suspect.ply, exact.ply and truth.txt, for peers
//                 (points_peers.py)
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <Eigen/LU>
#include <tbb/global_control.h>

#include <occ_adapter/read_file.h>
#include <support/surfaces.h>
#include <umbilic/core/errors.h>
#include <umbilic/matching/match_points.h>
#include <umbilic/matching/pose_distance.h>
#include <umbilic/matching/refine.h>
#include <umbilic/matching/score.h>
#include <umbilic/matching/table_ground.h>

#include "iterative_closest_points.h"
#include "measurements.h"
#include "point_trials.h"

using namespace umbilic;
using namespace umbilic::bench;

namespace {

struct Row {
    const char* name;
    double noise;
    bool unknown_scale;
};

constexpr std::array<Row, 4> rows = {{{"xi = 0.01, known scale", 3e-4, false},
                                      {"xi = 0.01, unknown scale", 3e-4, true},
                                      {"noise 1e-3, unknown scale", 1e-3, true},
                                      {"noise 3e-3, unknown scale", 3e-3, true}}};
constexpr std::array<double, 4> coverages = {1.0, 0.6, 0.3, 0.1};

struct Arguments {
    int cases = 51;
    std::string only, folder;
    double coverage = 0.0;  ///< 0: all
    bool mirror = false;
};

struct Cell {
    int cases = 0, success = 0, found = 0, wrong = 0, negatives = 0, false_found = 0, closest_points = 0;
    std::vector<int> per_shape;
    std::vector<double> limits;  ///< shape by shape: sum of the chances that the noise leaves, see chance_of_scale()
    std::vector<double> errors, prepare_seconds, match_seconds, closest_points_seconds;
};

void write_trial(const std::string& folder, const PointOriginal& original, const PointTrial& trial, const Row& row,
                 double coverage, int number) {
    char name[128];
    std::snprintf(name, sizeof name, "noise%g_%s_%g_%s_%03d", row.noise, row.unknown_scale ? "free" : "fixed", coverage,
                  original.name.c_str(), number);
    const std::filesystem::path place = std::filesystem::path(folder) / name;
    std::filesystem::create_directories(place);
    const std::string dense = (std::filesystem::path(folder) / (original.name + "_dense.ply")).string();
    if (!std::filesystem::exists(dense)) write_ply(dense, original.stock);
    write_ply((place / "original.ply").string(),
              std::vector<Vector3>(original.stock.begin(), original.stock.begin() + 3000));
    write_ply((place / "suspect.ply").string(), trial.suspect.points);
    write_ply((place / "exact.ply").string(), trial.exact);
    std::ofstream truth(place / "truth.txt");
    truth.precision(17);
    truth << trial.truth.scale << '\n'
          << trial.truth.rotation << '\n'
          << trial.truth.translation.transpose() << '\n'
          << original.model.size() << '\n';
}

/// Probability that the best unbiased estimate of the scale is right within 2 %, from the Cramer-Rao bound at the true
/// pose: what noise of this size leaves to be known of these points, whoever looks at them.
double chance_of_scale(const PointOriginal& original, const PointTrial& trial, const Row& row) {
    if (!row.unknown_scale) return 1.0;
    std::vector<WeightedPoint> points;
    for (const Vector3& p : trial.exact) points.push_back({p});
    const Refinement at = refine(Ground(*original.prepared), points, trial.truth, {.maximum_steps = 1});
    const double variance = at.normal_matrix.inverse()(6, 6) / static_cast<double>(points.size());
    const double deviation = row.noise * original.model.size() * std::sqrt(variance) / at.radius;
    return std::erf(greatest_scale_error / (deviation * std::sqrt(2.0)));
}

MatchOptions options_for(const Row& row, const Arguments& arguments) {
    MatchOptions options;
    if (!row.unknown_scale) options.scale.kind = ScaleChoice::Kind::fixed;
    options.mirror = arguments.mirror ? MirrorChoice::automatic : MirrorChoice::never;
    return options;
}

SimilarityTransform by_closest_points(const PointOriginal& original, const PreparedPoints& suspect, bool free_scale) {
    const ShapeSize to = shape_size(original.prepared->features), from = shape_size(suspect.samples);
    SimilarityTransform start;
    if (free_scale) start.scale = to.length / from.length;
    start.translation = to.centroid - start.scale * from.centroid;
    return iterative_closest_points(TableGround(original.prepared->table), suspect.cloud.points, start,
                                    {.free_scale = free_scale});
}

Cell run_cell(const std::vector<std::unique_ptr<PointOriginal>>& originals, const Row& row, double coverage,
              const Arguments& arguments) {
    Cell cell;
    cell.per_shape.assign(originals.size(), 0);
    cell.limits.assign(originals.size(), 0.0);
    const MatchOptions options = options_for(row, arguments);
    for (int k = 0; k < arguments.cases; ++k) {
        const std::size_t shape = k % originals.size();
        const PointOriginal& original = *originals[shape];
        std::mt19937_64 random(1000003ull * k + static_cast<std::uint64_t>(1e6 * row.noise + 10 * coverage));
        const TrialKind kind{.coverage = coverage, .noise = row.noise, .unknown_scale = row.unknown_scale};
        const PointTrial trial = point_trial(original, kind, random);
        if (!arguments.folder.empty()) {
            write_trial(arguments.folder, original, trial, row, coverage, k);
            continue;
        }
        cell.limits[shape] += chance_of_scale(original, trial, row);
        auto start = std::clock();
        const PreparedPoints suspect = prepare(trial.suspect);
        cell.prepare_seconds.push_back(seconds_since(start));
        start = std::clock();
        const Alignment alignment = match(*original.prepared, suspect, options);
        cell.match_seconds.push_back(seconds_since(start));
        // A pose that is called ambiguous or compatible is still an answer; not found gives its best as runner-up.
        const SimilarityTransform pose = alignment.status != AlignmentStatus::not_found ? alignment.original_suspect
                                         : alignment.runners_up.empty()                 ? SimilarityTransform()
                                                                        : alignment.runners_up.front().original_suspect;
        TrialError error = trial_error(original, trial, pose);
        for (const SimilarityTransform& symmetric : alignment.symmetries)
            if (!error.success()) error = trial_error(original, trial, symmetric);
        ++cell.cases;
        cell.success += error.success();
        cell.per_shape[shape] += error.success();
        if (error.success()) cell.errors.push_back(error.distance);
        cell.found += alignment.found();
        cell.wrong += alignment.found() && !error.success();
        start = std::clock();
        const SimilarityTransform closest = by_closest_points(original, suspect, row.unknown_scale);
        cell.closest_points_seconds.push_back(seconds_since(start));
        cell.closest_points += trial_error(original, trial, closest).success();
        const PointOriginal& other =
            *originals[(shape + 1 + k / originals.size() % (originals.size() - 1)) % originals.size()];
        ++cell.negatives;
        cell.false_found += match(*other.prepared, suspect, options).found();
    }
    return cell;
}

Arguments read_arguments(int argc, char** argv) {
    Arguments arguments;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        const bool more = i + 1 < argc;
        if (word == "--mirror")
            arguments.mirror = true;
        else if (word == "--cases" && more)
            arguments.cases = std::max(1, std::atoi(argv[++i]));
        else if (word == "--only" && more)
            arguments.only = argv[++i];
        else if (word == "--coverage" && more)
            arguments.coverage = std::atof(argv[++i]);
        else if (word == "--export" && more)
            arguments.folder = argv[++i];
        else
            throw InvalidInput("points_success: unknown word " + word);
    }
    return arguments;
}

void run(const Arguments& arguments) {
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    std::vector<std::unique_ptr<PointOriginal>> originals;
    const std::string models = UMBILIC_MODELS_DIR;
    originals.push_back(point_original("bottle", read_file(models + "/bottle.step").model));
    originals.push_back(point_original("hood", read_file(models + "/hood.step").model));
    originals.push_back(point_original("bumps20", support::model_of({support::smooth_bicubic(20, 20, 0.2)})));
    std::printf("%d cases a cell, one thread, mirror images %s; shapes:", arguments.cases,
                arguments.mirror ? "tried" : "not tried");
    for (const auto& original : originals) std::printf(" %s", original->name.c_str());
    std::printf("\n%-26s %5s %9s %18s %13s %8s %5s %14s %12s %10s %8s %6s %6s\n", "row", "cover", "success %",
                "by shape", "noise allows", "found %", "wrong", "false found", "error/sqrtA", "prepare s", "match s",
                "ICP %", "ICP s");
    for (const Row& row : rows) {
        if (std::string(row.name).find(arguments.only) == std::string::npos) continue;
        for (const double coverage : coverages) {
            if (arguments.coverage > 0.0 && coverage != arguments.coverage) continue;
            const Cell cell = run_cell(originals, row, coverage, arguments);
            if (!arguments.folder.empty()) continue;
            std::string shapes, limits;
            for (std::size_t i = 0; i < originals.size(); ++i) {
                const int of_shape =
                    (cell.cases + static_cast<int>(originals.size() - 1 - i)) / static_cast<int>(originals.size());
                shapes += std::to_string(cell.per_shape[i]) + "/" + std::to_string(of_shape) + " ";
                limits += " " + std::to_string(std::lround(100.0 * cell.limits[i] / std::max(of_shape, 1)));
            }
            std::printf("%-26s %4.0f%% %9.1f %18s %13s %8.1f %5d %7d of %3d %12.2g %10.3f %8.3f %6.1f %6.2f\n",
                        row.name, 100 * coverage, 100.0 * cell.success / cell.cases, shapes.c_str(), limits.c_str(),
                        100.0 * cell.found / cell.cases, cell.wrong, cell.false_found, cell.negatives,
                        median(cell.errors), median(cell.prepare_seconds), median(cell.match_seconds),
                        100.0 * cell.closest_points / cell.cases, median(cell.closest_points_seconds));
            std::fflush(stdout);
        }
    }
}

}  // namespace

int main(int argc, char** argv) {
    try {
        run(read_arguments(argc, argv));
    } catch (const Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
