// SPDX-License-Identifier: LGPL-2.1-or-later
// Cost against size: models of 10 to 3,000 faces, surfaces of one to some thousand umbilics, each compared with a
// moved, scaled and mirrored copy of itself. cost_by_size [--threads N] [--largest N]
//   --threads N  default 2
//   --largest N  no model with more faces or umbilics than about N (default 5000)
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

#include <tbb/global_control.h>

#include <occ_adapter/shape_to_model.h>
#include <support/surfaces.h>
#include <umbilic/core/errors.h>
#include <umbilic/similarity/compare.h>

#include "mechanical_parts.h"

using namespace umbilic;
using namespace umbilic::bench;

namespace {

/// Bosses that give about 10, 30, ... 3,000 faces, and poles a side that give one to some thousand umbilics.
constexpr std::array<int, 6> bosses = {2, 14, 56, 177, 594, 1780};
constexpr std::array<int, 6> poles = {5, 10, 20, 40, 80, 130};
constexpr double scale = 1.7, reach = 50.0;

double wall_seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

struct Costs {
    double prepare = 0.0, match = 0.0, compare = 0.0;
    std::string status, level;
};

/// The suspect's features, the search for its pose and the whole comparison, which holds such a search.
Costs costs_of(const Model& original, const Model& suspect, const MatchOptions& options) {
    Costs costs;
    const PreparedModel prepared_original = prepare(original);
    auto start = std::chrono::steady_clock::now();
    const PreparedModel prepared_suspect = prepare(suspect);
    costs.prepare = wall_seconds_since(start);
    start = std::chrono::steady_clock::now();
    costs.status = name(match(prepared_original, prepared_suspect, options).status);
    costs.match = wall_seconds_since(start);
    start = std::chrono::steady_clock::now();
    costs.level = name(compare(prepared_original, prepared_suspect, {.match = options}).verdict.level);
    costs.compare = wall_seconds_since(start);
    return costs;
}

void print(std::size_t size, const Costs& costs) {
    std::printf("%8zu %11.3f %9.3f %11.3f %14.3f  %-11s %s\n", size, costs.prepare, costs.match, costs.compare,
                1e3 * (2.0 * costs.prepare + costs.compare) / size, costs.status.c_str(), costs.level.c_str());
    std::fflush(stdout);
}

void print_head(const char* size) {
    std::printf("%8s %11s %9s %11s %14s  %-11s %s\n", size, "features s", "match s", "compare s", "ms each, all",
                "alignment", "level");
}

void run(int threads, int largest) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    std::printf("wall time, %d threads; features: of one model; compare: the match, the nodes and the tests\n",
                threads);
    print_head("faces");
    for (const int count : bosses) {
        if (1.7 * count > largest) break;
        const TopoDS_Shape plate = plate_with_bosses(count, 7);
        const Model original = shape_to_model(plate);
        const Model suspect = shape_to_model(moved(plate, support::random_similarity(3, scale, true, reach)));
        print(original.faces.size(), costs_of(original, suspect, {}));
    }
    print_head("umbilics");
    for (const int count : poles) {
        if (0.35 * count * count > largest) break;
        const NurbsSurface surface = support::rough_bicubic(count, 11, 0.2 / count);
        const Model original = support::model_of({surface});
        const Model suspect =
            support::model_of({support::transformed(surface, support::random_similarity(5, scale, true, reach))});
        MatchOptions options;
        options.method = MethodChoice::umbilics;
        std::size_t umbilics = 0;
        for (const FaceUmbilics& face : prepare(original).features.umbilics) umbilics += face.umbilics.size();
        print(umbilics, costs_of(original, suspect, options));
    }
}

}  // namespace

int main(int argc, char** argv) {
    int threads = 2, largest = 5000;
    for (int i = 1; i + 1 < argc; i += 2) {
        const std::string option = argv[i];
        if (option == "--threads")
            threads = std::atoi(argv[i + 1]);
        else if (option == "--largest")
            largest = std::atoi(argv[i + 1]);
        else
            return std::fprintf(stderr, "unknown option %s\n", argv[i]), 2;
    }
    if (argc % 2 == 0 || threads < 1 || largest < 1)
        return std::fprintf(stderr, "cost_by_size [--threads N] [--largest N]\n"), 2;
    try {
        run(threads, largest);
    } catch (const Error& error) {
        return std::fprintf(stderr, "%s\n", error.what()), 1;
    }
}
