// SPDX-License-Identifier: LGPL-2.1-or-later
// Search for umbilics on one thread. Peers of the same run: the surface's own evaluation, 1000 points with second
// derivatives, as a measure of the machine; and the thesis's own quadtree on P_N at its tolerance of 0.005 (81 s for an
// 8 x 8 and 524 s for a 16 x 16 surface on the machine of 2003), which proves absence only, and the general solver.
#include <algorithm>
#include <cmath>

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <support/surfaces.h>
#include <support/swept_surfaces.h>
#include <umbilic/differential/recognise.h>
#include <umbilic/umbilics/by_projected_polyhedron.h>
#include <umbilic/umbilics/find.h>
#include <umbilic/umbilics/quadtree.h>

namespace umbilic {
namespace {

constexpr unsigned seed = 7;

void search(benchmark::State& state, const NurbsSurface& surface) {
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    FaceUmbilics found;
    for (auto _ : state) {
        found = find_umbilics(surface);
        benchmark::DoNotOptimize(found);
    }
    double radius = 0.0;
    int certified = 0;
    for (const Umbilic& umbilic : found.umbilics) {
        certified += umbilic.certified;
        radius = std::max(radius, umbilic.radius);
    }
    std::size_t open = found.lines.size() + found.regions.size() + found.undecided.size();
    const auto found_count = static_cast<double>(found.umbilics.size() + open);
    state.counters["patches"] = found.statistics.patches;
    state.counters["boxes/patch"] = static_cast<double>(found.statistics.boxes) / found.statistics.patches;
    state.counters["umbilics"] = static_cast<double>(found.umbilics.size());
    state.counters["certified"] = found_count > 0 ? certified / found_count : 1.0;
    state.counters["radius"] = radius;
}

void smooth(benchmark::State& state) {
    search(state, support::smooth_bicubic(static_cast<int>(state.range(0)), seed));
}

void rough(benchmark::State& state) {
    search(state, support::rough_bicubic(static_cast<int>(state.range(0)), seed));
}

/// The smooth surface with weights that vary smoothly between 1 and 2.
void rational_smooth(benchmark::State& state) {
    const NurbsSurface base = support::smooth_bicubic(static_cast<int>(state.range(0)), seed);
    std::vector<double> weights;
    for (const Vector3& pole : base.poles()) weights.push_back(1.5 + 0.5 * pole.x() * (1 - 2 * pole.y()));
    search(state, NurbsSurface(base.u_knots(), base.v_knots(), base.poles(), weights));
}

void rational_rough(benchmark::State& state) {
    const int n = static_cast<int>(state.range(0));
    search(state, support::random_surface(3, 3, n, n, seed, 0.05, 3.0));
}

/// Inflection line across 17 patches of a 20 x 20 developable.
void line(benchmark::State& state) {
    const NurbsSurface base = support::smooth_bicubic(20, seed);
    std::vector<Vector3> poles = base.poles();
    for (Vector3& pole : poles) pole.z() = std::pow(pole.x() - 0.5754, 3) + 0.1 * pole.x();
    search(state, NurbsSurface(base.u_knots(), base.v_knots(), poles));
}

/// Rough surface with a planar block of 5 x 5 spans, or a rough block on a plate.
void planar_part(benchmark::State& state) {
    const bool inside = state.range(0) != 0;
    const NurbsSurface base = support::rough_bicubic(20, seed);
    std::vector<Vector3> poles = base.poles();
    for (int i = 0; i < 20; ++i)
        for (int j = 0; j < 20; ++j)
            if ((i >= 6 && i < 14 && j >= 6 && j < 14) == inside) poles[i * 20 + j].z() = 0.0;
    search(state, NurbsSurface(base.u_knots(), base.v_knots(), poles));
}

void plane(benchmark::State& state) {
    search(state,
           support::transformed(support::smooth_bicubic(20, seed, 0.0), support::random_similarity(3, 1.0, false)));
}

void sphere(benchmark::State& state) {
    search(state, support::revolved(support::arc({0, 0}, 1.0, -1.5, 1.5), 6.0));
}

/// What recognition costs on a surface that is nothing of the kind, and on a sphere.
void recognition(benchmark::State& state) {
    const NurbsSurface surface = state.range(0) == 0 ? support::smooth_bicubic(20, seed)
                                                     : support::revolved(support::arc({0, 0}, 1.0, -1.5, 1.5), 6.0);
    for (auto _ : state) benchmark::DoNotOptimize(recognise(surface));
}

void quadtree(benchmark::State& state, const NurbsSurface& surface) {
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    QuadtreeUmbilics found;
    for (auto _ : state) {
        found = find_umbilics_by_quadtree(surface);
        benchmark::DoNotOptimize(found);
    }
    state.counters["patches"] = found.patches;
    state.counters["boxes/patch"] = static_cast<double>(found.boxes) / found.patches;
    state.counters["clusters"] = found.clusters;
    state.counters["leaves"] = static_cast<double>(found.leaves.size());
}

void thesis_quadtree_smooth(benchmark::State& state) {
    quadtree(state, support::smooth_bicubic(static_cast<int>(state.range(0)), seed));
}

void thesis_quadtree_rough(benchmark::State& state) {
    quadtree(state, support::rough_bicubic(static_cast<int>(state.range(0)), seed));
}

void projected_polyhedron_rough(benchmark::State& state) {
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    const NurbsSurface surface = support::rough_bicubic(static_cast<int>(state.range(0)), seed);
    ProjectedPolyhedronUmbilics found;
    for (auto _ : state) {
        found = find_umbilics_by_projected_polyhedron(surface);
        benchmark::DoNotOptimize(found);
    }
    state.counters["boxes"] = static_cast<double>(found.boxes);
    state.counters["umbilics"] = static_cast<double>(found.umbilics.size());
    state.counters["undecided"] = static_cast<double>(found.undecided.size());
}

void evaluation(benchmark::State& state) {
    const NurbsSurface surface = support::smooth_bicubic(20, seed);
    for (auto _ : state)
        for (int k = 0; k < 1000; ++k)
            benchmark::DoNotOptimize(surface.derivatives((k % 40 + 0.5) / 40, (k / 40 + 0.5) / 25, 2));
}

BENCHMARK(evaluation)->Unit(benchmark::kMillisecond);
BENCHMARK(smooth)->Arg(8)->Arg(16)->Arg(20)->Arg(64)->Unit(benchmark::kMillisecond);
BENCHMARK(rough)->Arg(8)->Arg(16)->Arg(20)->Arg(64)->Unit(benchmark::kMillisecond);
BENCHMARK(thesis_quadtree_smooth)->Arg(8)->Arg(16)->Unit(benchmark::kMillisecond);
BENCHMARK(thesis_quadtree_rough)->Arg(8)->Arg(16)->Unit(benchmark::kMillisecond);
BENCHMARK(projected_polyhedron_rough)->Arg(8)->Arg(16)->Unit(benchmark::kMillisecond);
BENCHMARK(rational_smooth)->Arg(20)->Unit(benchmark::kMillisecond);
BENCHMARK(rational_rough)->Arg(20)->Unit(benchmark::kMillisecond);
BENCHMARK(line)->Unit(benchmark::kMillisecond);
BENCHMARK(planar_part)->ArgName("inside")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);
BENCHMARK(plane)->Unit(benchmark::kMillisecond);
BENCHMARK(sphere)->Unit(benchmark::kMillisecond);
BENCHMARK(recognition)->ArgName("sphere")->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace umbilic
