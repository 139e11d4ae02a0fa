// SPDX-License-Identifier: LGPL-2.1-or-later
// All points with the Gaussian and mean curvature of three points of a 20 x 20 bicubic surface, both signs of H: six
// queries in one pass, on one thread. Peers of the same run: the surface's own evaluation, 1000 points with second
// derivatives, as a measure of the machine; a dense search, Newton's method from a grid, which proves nothing; and the
// thesis's own equations in the general solver.
#include <cmath>

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <support/surfaces.h>
#include <umbilic/curvature_points/by_projected_polyhedron.h>
#include <umbilic/curvature_points/curvature_gradient.h>
#include <umbilic/curvature_points/curvature_points.h>
#include <umbilic/differential/fundamental_forms.h>

namespace umbilic {
namespace {

constexpr unsigned seed = 7;
constexpr double places[][2] = {{0.23, 0.41}, {0.52, 0.68}, {0.79, 0.33}};

NurbsSurface with_weights(const NurbsSurface& base) {
    std::vector<double> weights;
    for (const Vector3& pole : base.poles()) weights.push_back(1.5 + 0.5 * pole.x() * (1 - 2 * pole.y()));
    return NurbsSurface(base.u_knots(), base.v_knots(), base.poles(), weights);
}

std::vector<CurvatureQuery> queries_of(const NurbsSurface& surface, double share) {
    // The range of K and H over the surface.
    double k_low = 1e300, k_high = -1e300, h_low = 1e300, h_high = -1e300;
    for (int i = 0; i < 1600; ++i) {
        const Curvature c = curvature(surface, (i % 40 + 0.5) / 40, (i / 40 + 0.5) / 40);
        k_low = std::min(k_low, c.gaussian());
        k_high = std::max(k_high, c.gaussian());
        h_low = std::min(h_low, c.mean());
        h_high = std::max(h_high, c.mean());
    }
    std::vector<CurvatureQuery> result;
    for (const auto& [u, v] : places) {
        const Curvature c = curvature(surface, u, v);
        result.push_back({c.gaussian(), c.mean(), share * (k_high - k_low), share * (h_high - h_low)});
    }
    return result;
}

void search(benchmark::State& state, const NurbsSurface& surface, double share) {
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    const std::vector<CurvatureQuery> queries = queries_of(surface, share);
    CurvaturePoints found;
    for (auto _ : state) {
        found = find_curvature_points(surface, queries);
        benchmark::DoNotOptimize(found);
    }
    int certified = 0, solutions = 0;
    for (const CurvaturePoint& point : found.points) {
        certified += point.certified;
        solutions += point.solutions;
    }
    state.counters["boxes"] = static_cast<double>(found.boxes);
    state.counters["candidates"] = static_cast<double>(found.points.size());
    state.counters["certified"] = certified;
    state.counters["solutions"] = solutions;
}

double tolerance(const benchmark::State& state) {
    return static_cast<double>(state.range(0)) / 1000.0;
}

void smooth(benchmark::State& state) {
    search(state, support::smooth_bicubic(20, seed), tolerance(state));
}
void rough(benchmark::State& state) {
    search(state, support::rough_bicubic(20, seed), tolerance(state));
}
void rational_smooth(benchmark::State& state) {
    search(state, with_weights(support::smooth_bicubic(20, seed)), tolerance(state));
}
void rational_rough(benchmark::State& state) {
    search(state, with_weights(support::rough_bicubic(20, seed)), tolerance(state));
}

/// Newton's method on (K, H) from 80 x 80 starts for each of the six queries.
void dense_search_rough(benchmark::State& state) {
    const NurbsSurface surface = support::rough_bicubic(20, seed);
    const std::vector<CurvatureQuery> queries = queries_of(surface, 0.0);
    long converged = 0;
    for (auto _ : state) {
        converged = 0;
        for (const CurvatureQuery& query : queries)
            for (const double sign : {1.0, -1.0})
                for (int i = 0; i < 6400; ++i) {
                    Vector2 at((i % 80 + 0.5) / 80, (i / 80 + 0.5) / 80);
                    for (int step = 0; step < 12; ++step) {
                        const SurfaceDerivatives d = surface.derivatives(at.x(), at.y(), 3);
                        const CurvatureGradient c = curvature_gradient(d);
                        const Vector3 x = d.r_u().normalized(), y = unit_normal(d).cross(x);
                        Matrix2 tangents, slopes;
                        tangents << d.r_u().dot(x), d.r_v().dot(x), d.r_u().dot(y), d.r_v().dot(y);
                        slopes << c.gaussian_slope.transpose(), c.mean_slope.transpose();
                        const Vector2 change = (slopes * tangents).inverse() *
                                               Vector2(c.gaussian - query.gaussian, c.mean - sign * query.mean);
                        at -= change;
                        if (!(at.minCoeff() >= 0.0 && at.maxCoeff() <= 1.0)) break;
                        if (change.norm() < 1e-12) {
                            ++converged;
                            break;
                        }
                    }
                }
    }
    state.counters["converged"] = static_cast<double>(converged);
}

/// The thesis's equations, with an auxiliary unknown (0) and squared (1), by the general solver.
void projected_polyhedron_rough(benchmark::State& state) {
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    const NurbsSurface surface = support::rough_bicubic(static_cast<int>(state.range(0)), seed);
    const std::vector<CurvatureQuery> queries = queries_of(surface, 0.0);
    const ProjectedPolyhedronCurvatureOptions options{.system = state.range(1) == 0 ? CurvatureSystem::auxiliary
                                                                                    : CurvatureSystem::squared};
    long boxes = 0;
    std::size_t points = 0, undecided = 0;
    for (auto _ : state) {
        boxes = 0;
        points = undecided = 0;
        for (const CurvatureQuery& query : queries) {
            const auto found = find_curvature_points_by_projected_polyhedron(surface, query, options);
            boxes += found.boxes;
            points += found.points.size();
            undecided += found.undecided.size();
        }
    }
    state.counters["boxes"] = static_cast<double>(boxes);
    state.counters["points"] = static_cast<double>(points);
    state.counters["undecided"] = static_cast<double>(undecided);
}

/// The search on the surfaces of the line above.
void search_rough(benchmark::State& state) {
    search(state, support::rough_bicubic(static_cast<int>(state.range(0)), seed), 0.0);
}

void evaluation(benchmark::State& state) {
    const NurbsSurface surface = support::smooth_bicubic(20, seed);
    for (auto _ : state)
        for (int k = 0; k < 1000; ++k)
            benchmark::DoNotOptimize(surface.derivatives((k % 40 + 0.5) / 40, (k / 40 + 0.5) / 25, 2));
}

// Tolerances in thousandths of the ranges of K and H.
BENCHMARK(evaluation)->Unit(benchmark::kMillisecond);
BENCHMARK(smooth)->ArgName("tolerance")->Arg(0)->Arg(1)->Arg(10)->Arg(50)->Unit(benchmark::kMillisecond);
BENCHMARK(rough)->ArgName("tolerance")->Arg(0)->Arg(1)->Arg(10)->Arg(50)->Unit(benchmark::kMillisecond);
BENCHMARK(rational_smooth)->ArgName("tolerance")->Arg(0)->Arg(50)->Unit(benchmark::kMillisecond);
BENCHMARK(rational_rough)->ArgName("tolerance")->Arg(0)->Arg(50)->Unit(benchmark::kMillisecond);
BENCHMARK(search_rough)->ArgName("poles")->Arg(6)->Unit(benchmark::kMillisecond);
BENCHMARK(projected_polyhedron_rough)
    ->ArgNames({"poles", "squared"})
    ->Args({6, 0})
    ->Args({6, 1})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);
BENCHMARK(dense_search_rough)->Unit(benchmark::kMillisecond)->Iterations(1);

}  // namespace
}  // namespace umbilic
