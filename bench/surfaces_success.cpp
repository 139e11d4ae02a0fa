// SPDX-License-Identifier: LGPL-2.1-or-later
// Success matrix of matching free-form surfaces: pieces of designs, exact, re-approximated, mirrored or among foreign
// material, in unknown places, sizes (1/20 ... 20) and hands.
// surfaces_success [--cases N] [--only TEXT] [--method METHOD]
//   --cases N     cases a cell (default 51, shared among the shapes)
//   --only TEXT   rows whose name contains TEXT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <tbb/global_control.h>

#include <occ_adapter/read_file.h>
#include <support/reparametrisation.h>
#include <support/surfaces.h>
#include <umbilic/core/errors.h>
#include <umbilic/matching/choice_words.h>
#include <umbilic/matching/match.h>

#include "free_form.h"
#include "measurements.h"

using namespace umbilic;
using namespace umbilic::bench;

namespace {

struct Row {
    const char* name;
    double reapproximation;  ///< deviation over the square root of the area; 0: exact
    bool mirrored;
    bool foreign;  ///< the suspect is half the piece, half a surface of another design
};

constexpr std::array<Row, 4> rows = {{{"exact", 0.0, false, false},
                                      {"re-approximated 1e-4", 1e-4, false, false},
                                      {"exact, mirrored", 0.0, true, false},
                                      {"half foreign", 0.0, false, true}}};
constexpr std::array<double, 4> coverages = {1.0, 0.6, 0.3, 0.1};
/// Success: largest distance of a sample from where it belongs, over the square root of the original's area, and
/// relative error of the scale.
constexpr double greatest_error = 0.01, greatest_scale_error = 0.02;

struct Original {
    std::string name;
    Model model;
    std::unique_ptr<PreparedModel> prepared;
};

struct Trial {
    Model suspect;
    Model piece;  ///< of the suspect, what is not foreign
    SimilarityTransform truth;
};

struct Cell {
    int cases = 0, success = 0, found = 0, wrong = 0, false_found = 0;
    std::vector<double> errors, prepare_seconds, match_seconds;
};

std::unique_ptr<Original> original_of(const std::string& name, Model model) {
    auto original = std::make_unique<Original>(Original{name, std::move(model), nullptr});
    original->prepared = std::make_unique<PreparedModel>(prepare(original->model));
    return original;
}

/// A rectangle of the domain that is `share` of it, somewhere.
ParameterBox part_of(const ParameterBox& domain, double share, std::mt19937_64& random) {
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    // Between square and 1 : 2, as far as the share leaves room.
    const double ratio = std::exp2(uniform(random) - 0.5);
    const double u_share = std::clamp(std::sqrt(share * ratio), share, 1.0), v_share = share / u_share;
    const auto part = [&](const ParameterInterval& whole, double side) {
        const double low = whole.low + uniform(random) * (1.0 - side) * whole.length();
        return ParameterInterval{low, low + side * whole.length()};
    };
    return {part(domain.u, u_share), part(domain.v, v_share)};
}

Trial make_trial(const Original& original, const Original& other, const Row& row, double coverage, unsigned seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const auto cut = [&](const Original& from) {
        const NurbsSurface& surface = largest_surface(from.model);
        NurbsSurface piece =
            coverage < 1.0 ? support::restricted(surface, part_of(surface.domain(), coverage, random)) : surface;
        if (row.reapproximation > 0.0)
            piece = support::reapproximated(piece, 4, row.reapproximation * from.model.size()).surface;
        return piece;
    };
    const double scale = std::exp(uniform(random) * std::log(20.0));
    Trial trial;
    trial.truth = support::random_similarity(seed, scale, row.mirrored, original.model.size());
    const SimilarityTransform placed = trial.truth.inverse();
    const NurbsSurface piece = support::transformed(cut(original), placed);
    trial.piece = support::model_of({piece});
    std::vector<NurbsSurface> surfaces = {piece};
    if (row.foreign) {
        // Beside the piece, of its size.
        const NurbsSurface foreign = cut(other);
        const double ratio = trial.piece.size() / support::model_of({foreign}).size();
        SimilarityTransform beside = support::random_similarity(seed + 1, ratio, false, 0.0);
        const Vector3 from = beside.apply(support::model_of({foreign}).box.center());
        beside.translation = trial.piece.box.center() + Vector3(2.0 * trial.piece.box.diagonal(), 0, 0) - from;
        surfaces.push_back(support::transformed(foreign, beside));
    }
    trial.suspect = support::model_of(surfaces);
    return trial;
}

struct PoseError {
    double distance = 0.0, scale = 0.0;

    bool success() const { return distance < greatest_error && scale < greatest_scale_error; }
};

PoseError error_of(const Original& original, const Trial& trial, const SimilarityTransform& found) {
    PoseError error;
    for (const AreaSample& sample : area_samples(trial.piece, {.count = 200}))
        error.distance = std::max(
            error.distance, (found.apply(sample.curvature.point) - trial.truth.apply(sample.curvature.point)).norm() /
                                original.model.size());
    error.scale = std::abs(found.scale / trial.truth.scale - 1.0);
    return error;
}

SimilarityTransform best_pose(const Alignment& alignment) {
    if (alignment.status != AlignmentStatus::not_found) return alignment.original_suspect;
    return alignment.runners_up.empty() ? SimilarityTransform() : alignment.runners_up.front().original_suspect;
}

Cell run_cell(const std::vector<std::unique_ptr<Original>>& originals, const Row& row, double coverage, int cases,
              const MatchOptions& options) {
    Cell cell;
    for (int k = 0; k < cases; ++k) {
        const std::size_t shape = k % originals.size();
        const Original& original = *originals[shape];
        const Original& other = *originals[(shape + 1) % originals.size()];
        const unsigned seed = 7919u * k + static_cast<unsigned>(1000 * coverage) + (row.mirrored ? 1u : 0u);
        const Trial trial = make_trial(original, other, row, coverage, seed);
        auto start = std::clock();
        const PreparedModel suspect = prepare(trial.suspect);
        cell.prepare_seconds.push_back(seconds_since(start));
        start = std::clock();
        const Alignment alignment = match(*original.prepared, suspect, options);
        cell.match_seconds.push_back(seconds_since(start));
        PoseError error = error_of(original, trial, best_pose(alignment));
        for (const SimilarityTransform& symmetric : alignment.symmetries)
            if (!error.success()) error = error_of(original, trial, symmetric);
        ++cell.cases;
        cell.success += error.success();
        if (error.success()) cell.errors.push_back(error.distance);
        cell.found += alignment.found();
        cell.wrong += alignment.found() && !error.success();
        // A negative: against a third design, of which nothing is in the suspect.
        const Original& stranger = *originals[(shape + 2) % originals.size()];
        cell.false_found += match(*stranger.prepared, suspect, options).found();
    }
    return cell;
}

void run(int cases, const std::string& only, const MatchOptions& options) {
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    std::vector<std::unique_ptr<Original>> originals;
    const std::string models = UMBILIC_MODELS_DIR;
    originals.push_back(original_of("bottle", read_file(models + "/bottle.step").model));
    originals.push_back(original_of("hood", read_file(models + "/hood.step").model));
    originals.push_back(original_of("bumps20", support::model_of({support::smooth_bicubic(20, 20, 0.2)})));
    originals.push_back(original_of("blade", read_file(models + "/blade.step").model));
    std::printf("%d cases a cell, one thread; shapes:", cases);
    for (const auto& original : originals) std::printf(" %s", original->name.c_str());
    std::printf("\n%-22s %5s %9s %8s %6s %12s %11s %10s %9s\n", "row", "cover", "success %", "found %", "wrong",
                "false found", "error/sqrtA", "prepare s", "match s");
    for (const Row& row : rows) {
        if (std::string(row.name).find(only) == std::string::npos) continue;
        for (const double coverage : coverages) {
            const Cell cell = run_cell(originals, row, coverage, cases, options);
            std::printf("%-22s %4.0f%% %9.1f %8.1f %6d %12d %11.2g %10.3f %9.3f\n", row.name, 100 * coverage,
                        100.0 * cell.success / cell.cases, 100.0 * cell.found / cell.cases, cell.wrong,
                        cell.false_found, median(cell.errors), median(cell.prepare_seconds),
                        median(cell.match_seconds));
            std::fflush(stdout);
        }
    }
}

}  // namespace

int main(int argc, char** argv) {
    int cases = 51;
    std::string only;
    MatchOptions options;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i], value = i + 1 < argc ? argv[i + 1] : "";
        if (word == "--cases" && std::atoi(value.c_str()) > 0) {
            cases = std::atoi(value.c_str());
        } else if (word == "--only" && !value.empty()) {
            only = value;
        } else if (word == "--method" && method_words.count(value)) {
            options.method = method_words.at(value);
        } else {
            std::fprintf(stderr, "surfaces_success: '%s %s' is not understood\n", word.c_str(), value.c_str());
            return 2;
        }
        ++i;
    }
    try {
        run(cases, only, options);
    } catch (const umbilic::Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
