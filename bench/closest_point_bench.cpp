// SPDX-License-Identifier: LGPL-2.1-or-later
// Global closest points on bicubic B-splines. Arguments: poles along each side; 0 for points within 0.1 of the
// surface's size, 1 for points up to four sizes away. Every figure is the time of one point on one thread; `misses`
// counts, among the first `checked` points, answers that are farther than the truth by more than 1e-6 of the size
// (1e-10 for Umbilic), and none at all. The truth is the least over a dense grid, refined from its local minima, and
// over all contestants.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <vector>

#include <support/surfaces.h>
#include <umbilic/curves/closest_point.h>

#include "peer_surfaces.h"

#ifdef UMBILIC_WITH_OPENCASCADE
#include <GeomAPI_ProjectPointOnSurf.hxx>
#include <ShapeAnalysis_Surface.hxx>
#endif

namespace umbilic::bench {
namespace {

constexpr int point_count = 100000;
constexpr int checked_count = 500;
constexpr double peer_tolerance = 1e-6;
constexpr double own_tolerance = 1e-10;

struct Problem {
    NurbsSurface surface;
    std::vector<Vector3> points;
    std::vector<double> truth;  ///< distances of the first points
};

double refined(const NurbsSurface& surface, const Vector3& point, double u, double v, double step) {
    double here = (surface.value(u, v) - point).norm();
    while (step > 1e-8) {
        double next = here, u_next = u, v_next = v;
        for (int a = -1; a <= 1; ++a)
            for (int b = -1; b <= 1; ++b) {
                const double x = std::clamp(u + a * step, 0.0, 1.0), y = std::clamp(v + b * step, 0.0, 1.0);
                const double d = (surface.value(x, y) - point).norm();
                if (d < next) next = d, u_next = x, v_next = y;
            }
        if (next < here) {
            here = next, u = u_next, v = v_next;
        } else {
            step *= 0.5;
        }
    }
    return here;
}

Problem make(int n, bool far) {
    Problem problem{support::smooth_bicubic(n, 1), {}, {}};
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(0.0, 1.0), both(-1.0, 1.0);
    for (int i = 0; i < point_count; ++i) {
        const Vector3 base = problem.surface.value(uniform(random), uniform(random));
        const Vector3 offset(both(random), both(random), both(random));
        problem.points.push_back(base + (far ? 4.0 : 0.1) * offset);
    }
    constexpr int cells = 250;
    std::vector<Vector3> grid;
    for (int i = 0; i <= cells; ++i)
        for (int j = 0; j <= cells; ++j) grid.push_back(problem.surface.value(double(i) / cells, double(j) / cells));
    std::vector<double> squared(grid.size());
    for (int k = 0; k < checked_count; ++k) {
        const Vector3& point = problem.points[k];
        for (std::size_t i = 0; i < grid.size(); ++i) squared[i] = (grid[i] - point).squaredNorm();
        double best = std::numeric_limits<double>::infinity();
        for (int i = 0; i <= cells; ++i)
            for (int j = 0; j <= cells; ++j) {
                const double here = squared[i * (cells + 1) + j];
                bool least = true;
                for (int a = std::max(i - 1, 0); a <= std::min(i + 1, cells) && least; ++a)
                    for (int b = std::max(j - 1, 0); b <= std::min(j + 1, cells); ++b)
                        least = least && here <= squared[a * (cells + 1) + b];
                if (least)
                    best = std::min(best,
                                    refined(problem.surface, point, double(i) / cells, double(j) / cells, 0.5 / cells));
            }
        problem.truth.push_back(best);
    }
    return problem;
}

const Problem& problem_of(const benchmark::State& state) {
    static std::map<std::pair<int, int>, Problem> problems;
    const std::pair<int, int> key(state.range(0), state.range(1));
    auto found = problems.find(key);
    if (found == problems.end()) found = problems.emplace(key, make(key.first, key.second == 1)).first;
    return found->second;
}

/// Times `distance(point)` over the points in turn; then counts the misses among those with a known truth.
template <typename Distance>
void run(benchmark::State& state, double tolerance, const Distance& distance) {
    const Problem& problem = problem_of(state);
    std::size_t next = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(distance(problem.points[next]));
        if (++next == problem.points.size()) next = 0;
    }
    int misses = 0;
    for (int k = 0; k < checked_count; ++k) {
        const double found = distance(problem.points[k]);
        misses += !(found <= problem.truth[k] + tolerance);
    }
    state.counters["misses"] = misses;
    state.counters["checked"] = checked_count;
}

void arguments(benchmark::internal::Benchmark* benchmark) {
    for (const int n : {8, 32})
        for (const int far : {0, 1}) benchmark->Args({n, far});
}

#ifdef UMBILIC_WITH_OPENCASCADE
void BM_closest_opencascade_value_of_uv(benchmark::State& state) {
    ShapeAnalysis_Surface surface(opencascade_surface(problem_of(state).surface));
    run(state, peer_tolerance, [&](const Vector3& p) {
        const gp_Pnt point(p.x(), p.y(), p.z());
        const gp_Pnt2d uv = surface.ValueOfUV(point, 1e-7);
        return surface.Value(uv).Distance(point);
    });
}
BENCHMARK(BM_closest_opencascade_value_of_uv)->Apply(arguments);

void BM_closest_opencascade_project(benchmark::State& state) {
    const Handle(Geom_BSplineSurface) surface = opencascade_surface(problem_of(state).surface);
    GeomAPI_ProjectPointOnSurf project;
    project.Init(surface, 0.0, 1.0, 0.0, 1.0, 1e-7);
    run(state, peer_tolerance, [&](const Vector3& p) {
        project.Perform(gp_Pnt(p.x(), p.y(), p.z()));
        return project.NbPoints() > 0 ? project.LowerDistance() : std::numeric_limits<double>::infinity();
    });
}
BENCHMARK(BM_closest_opencascade_project)->Apply(arguments);
#endif

#ifdef UMBILIC_WITH_SISL
void BM_closest_sisl(benchmark::State& state) {
    const SislSurface surface = sisl_surface(problem_of(state).surface);
    run(state, peer_tolerance, [&](const Vector3& p) {
        double point[3] = {p.x(), p.y(), p.z()}, at[2], distance = 0.0;
        int status = 0;
        s1958(surface.get(), point, 3, 0.0, 1e-7, at, &distance, &status);
        return status < 0 ? std::numeric_limits<double>::infinity() : distance;
    });
}
BENCHMARK(BM_closest_sisl)->Apply(arguments);
#endif

void BM_closest_umbilic(benchmark::State& state) {
    const ClosestPointTree tree(problem_of(state).surface);
    int unproved = 0;
    run(state, own_tolerance, [&](const Vector3& p) {
        const auto found = tree.closest(p);
        unproved += !found->certified;
        return found->distance;
    });
    state.counters["unproved"] = unproved;
}
BENCHMARK(BM_closest_umbilic)->Apply(arguments);

void BM_closest_tree_build(benchmark::State& state) {
    const NurbsSurface surface = support::smooth_bicubic(static_cast<int>(state.range(0)), 1);
    for (auto _ : state) {
        const ClosestPointTree tree(surface);
        benchmark::DoNotOptimize(&tree);
    }
}
BENCHMARK(BM_closest_tree_build)->Arg(8)->Arg(32)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace umbilic::bench
