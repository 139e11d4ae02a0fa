// SPDX-License-Identifier: LGPL-2.1-or-later
// Matching by points of equal Gaussian and mean curvature (KH, the thesis's method) beside matching by principal
// frames, on the settings of the thesis rebuilt on designs of our own: pieces of free-form faces, moved, of either
// hand. curvature_matching [--cases N] [--only TEXT]
//   --cases N     cases a cell (default 10)
//   --only TEXT   rows whose design contains TEXT
// One thread, processor time of one search after the models' features are computed. The thesis's own times (2003): KH
// 725 s, on low-degree approximations of K and H 225 s (Table 4.3); search of the scale 3449, 1567 and 907 s (Table
// 6.11).
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <random>
#include <string>
#include <vector>

#include <tbb/global_control.h>

#include <occ_adapter/read_file.h>
#include <support/reparametrisation.h>
#include <support/surfaces.h>
#include <umbilic/matching/match.h>

#include "free_form.h"
#include "measurements.h"

using namespace umbilic;
using namespace umbilic::bench;

namespace {

struct Design {
    std::string name;
    NurbsSurface surface;
};

struct Method {
    const char* name;
    MatchOptions options;
    bool free_scale;
};

constexpr double low_scale = 0.3, high_scale = 3.0;

std::vector<Method> methods() {
    const ScaleChoice fixed{ScaleChoice::Kind::fixed}, range{ScaleChoice::Kind::range, low_scale, high_scale};
    return {
        {"kh, known scale", {.method = MethodChoice::kh, .scale = fixed}, false},
        {"curvature, known scale", {.method = MethodChoice::curvature, .scale = fixed}, false},
        {"kh, 0.3:3, golden section",
         {.method = MethodChoice::kh, .scale = range, .scale_search = ScaleSearch::golden_section},
         true},
        {"kh, 0.3:3, Brent", {.method = MethodChoice::kh, .scale = range, .scale_search = ScaleSearch::brent}, true},
        {"curvature, no bracket", {.method = MethodChoice::curvature}, true},
    };
}

Design design_of(const char* name, const char* file) {
    return {name, largest_surface(read_file(std::string(UMBILIC_MODELS_DIR) + "/" + file).model)};
}

struct Cell {
    int cases = 0, success = 0, wrong = 0;
    std::vector<double> seconds, errors;
};

}  // namespace

int main(int count, char** words) {
    int cases = 10;
    std::string only;
    for (int k = 1; k + 1 < count; k += 2) {
        if (std::strcmp(words[k], "--cases") == 0) cases = std::max(1, std::atoi(words[k + 1]));
        if (std::strcmp(words[k], "--only") == 0) only = words[k + 1];
    }
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    const std::vector<Design> designs = {design_of("bottle", "bottle.step"),
                                         design_of("hood", "hood.step"),
                                         design_of("mask", "mask.igs"),
                                         {"20x20 smooth", support::smooth_bicubic(20, 7)},
                                         {"20x20 rough", support::rough_bicubic(20, 7)}};
    std::printf("%-13s %-9s %-14s %-26s %9s %7s %10s %12s\n", "design", "coverage", "copy", "method", "success %",
                "wrong", "median s", "median error");
    for (const Design& design : designs) {
        if (!only.empty() && design.name.find(only) == std::string::npos) continue;
        const Model original_model = support::model_of({design.surface});
        const PreparedModel original = prepare(original_model);
        for (const double coverage : {1.0, 0.3})
            for (const bool exact : {true, false}) {
                std::vector<Cell> cells(methods().size());
                for (int k = 0; k < cases; ++k) {
                    std::mt19937_64 random(1000 + k);
                    std::uniform_real_distribution<double> unit(0.0, 1.0);
                    const double side = std::sqrt(coverage), u = unit(random) * (1 - side),
                                 v = unit(random) * (1 - side);
                    const double log_scale = std::log(low_scale) + unit(random) * std::log(high_scale / low_scale);
                    const ParameterBox domain = design.surface.domain();
                    NurbsSurface piece =
                        coverage == 1.0
                            ? design.surface
                            : support::restricted(design.surface, {{domain.u.low + u * domain.u.length(),
                                                                    domain.u.low + (u + side) * domain.u.length()},
                                                                   {domain.v.low + v * domain.v.length(),
                                                                    domain.v.low + (v + side) * domain.v.length()}});
                    if (!exact) piece = support::reapproximated(piece, 5, 1e-4 * original_model.size()).surface;
                    for (const bool free_scale : {false, true}) {
                        const SimilarityTransform truth = support::random_similarity(
                            2000 + k, free_scale ? std::exp(log_scale) : 1.0, k % 2 == 1, original_model.size());
                        const Model suspect_model = support::model_of({support::transformed(piece, truth.inverse())});
                        const PreparedModel suspect = prepare(suspect_model);
                        for (std::size_t m = 0; m < cells.size(); ++m) {
                            const Method method = methods()[m];
                            if (method.free_scale != free_scale) continue;
                            const std::clock_t start = std::clock();
                            const Alignment alignment = match(original, suspect, method.options);
                            Cell& cell = cells[m];
                            cell.seconds.push_back(seconds_since(start));
                            ++cell.cases;
                            const double error = relative_maximum_error(original, suspect, alignment.original_suspect);
                            const double scale = alignment.original_suspect.scale / truth.scale;
                            const bool success = alignment.found() && error < 0.01 && std::abs(scale - 1) < 0.02;
                            cell.success += success;
                            cell.wrong += alignment.found() && !success;
                            if (success) cell.errors.push_back(error);
                        }
                    }
                }
                for (std::size_t m = 0; m < cells.size(); ++m)
                    std::printf("%-13s %6.0f %%  %-14s %-26s %9.0f %7d %10.3f %12.1e\n", design.name.c_str(),
                                100 * coverage, exact ? "exact" : "reapprox. 1e-4", methods()[m].name,
                                100.0 * cells[m].success / cells[m].cases, cells[m].wrong, median(cells[m].seconds),
                                median(cells[m].errors));
                std::fflush(stdout);
            }
    }
}
