// SPDX-License-Identifier: LGPL-2.1-or-later
// Points with derivatives up to order 2, and principal curvatures, of bicubic B-splines (argument: poles along each
// side), at random parameters and along rows of a grid. Every figure is the time of one point.
#include <benchmark/benchmark.h>

#include <random>
#include <vector>

#include <support/surfaces.h>
#include <umbilic/differential/curvature.h>

#include "peer_surfaces.h"

#ifdef UMBILIC_WITH_OPENCASCADE
#include <GeomAdaptor_Surface.hxx>
#include <gp_Pnt.hxx>
#include <gp_Vec.hxx>
#endif

namespace umbilic::bench {
namespace {

constexpr int point_count = 4096;
constexpr int row_length = 64;

std::vector<Vector2> random_parameters() {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    std::vector<Vector2> result;
    for (int i = 0; i < point_count; ++i) result.emplace_back(uniform(random), uniform(random));
    return result;
}

/// Rows u = const, v increasing.
std::vector<Vector2> row_parameters() {
    std::vector<Vector2> result;
    for (int i = 0; i < point_count; ++i)
        result.emplace_back((i / row_length + 0.5) / (point_count / row_length), (i % row_length + 0.5) / row_length);
    return result;
}

NurbsSurface surface_of(const benchmark::State& state) {
    return support::smooth_bicubic(static_cast<int>(state.range(0)), 1);
}

/// Runs `visit` over all parameters again and again, and reports the time of one of them.
template <typename Visit>
void per_point(benchmark::State& state, const std::vector<Vector2>& parameters, const Visit& visit) {
    while (state.KeepRunningBatch(static_cast<benchmark::IterationCount>(parameters.size())))
        for (const Vector2& p : parameters) visit(p);
}

void BM_derivatives_umbilic(benchmark::State& state) {
    const NurbsSurface surface = surface_of(state);
    per_point(state, random_parameters(), [&](const Vector2& p) {
        const SurfaceDerivatives d = surface.derivatives(p.x(), p.y(), 2);
        benchmark::DoNotOptimize(&d);
    });
}
BENCHMARK(BM_derivatives_umbilic)->Arg(8)->Arg(32);

void BM_derivatives_batch_umbilic(benchmark::State& state) {
    const NurbsSurface surface = surface_of(state);
    const std::vector<Vector2> parameters = random_parameters();
    std::vector<SurfaceDerivatives> result(parameters.size());
    while (state.KeepRunningBatch(point_count)) {
        surface.derivatives(parameters, 2, result);
        benchmark::DoNotOptimize(result.data());
        benchmark::ClobberMemory();
    }
}
BENCHMARK(BM_derivatives_batch_umbilic)->Arg(8)->Arg(32);

void BM_rows_batch_umbilic(benchmark::State& state) {
    const NurbsSurface surface = surface_of(state);
    const std::vector<Vector2> parameters = row_parameters();
    std::vector<SurfaceDerivatives> result(parameters.size());
    while (state.KeepRunningBatch(point_count)) {
        surface.derivatives(parameters, 2, result);
        benchmark::DoNotOptimize(result.data());
        benchmark::ClobberMemory();
    }
}
BENCHMARK(BM_rows_batch_umbilic)->Arg(8)->Arg(32);

void BM_curvature_umbilic(benchmark::State& state) {
    const NurbsSurface surface = surface_of(state);
    per_point(state, random_parameters(), [&](const Vector2& p) {
        const Curvature k = curvature(surface, p.x(), p.y());
        benchmark::DoNotOptimize(&k);
    });
}
BENCHMARK(BM_curvature_umbilic)->Arg(8)->Arg(32);

#ifdef UMBILIC_WITH_OPENCASCADE
template <typename Surface>
void second_derivatives(benchmark::State& state, const Surface& surface, const std::vector<Vector2>& parameters) {
    gp_Pnt point;
    gp_Vec u, v, uu, vv, uv;
    per_point(state, parameters, [&](const Vector2& p) {
        surface.D2(p.x(), p.y(), point, u, v, uu, vv, uv);
        benchmark::DoNotOptimize(point);
        benchmark::DoNotOptimize(uv);
    });
}

void BM_derivatives_opencascade(benchmark::State& state) {
    second_derivatives(state, *opencascade_surface(surface_of(state)), random_parameters());
}
BENCHMARK(BM_derivatives_opencascade)->Arg(8)->Arg(32);

void BM_derivatives_opencascade_adaptor(benchmark::State& state) {
    second_derivatives(state, GeomAdaptor_Surface(opencascade_surface(surface_of(state))), random_parameters());
}
BENCHMARK(BM_derivatives_opencascade_adaptor)->Arg(8)->Arg(32);

void BM_rows_opencascade_adaptor(benchmark::State& state) {
    second_derivatives(state, GeomAdaptor_Surface(opencascade_surface(surface_of(state))), row_parameters());
}
BENCHMARK(BM_rows_opencascade_adaptor)->Arg(8)->Arg(32);
#endif

#ifdef UMBILIC_WITH_SISL
void derivatives_sisl(benchmark::State& state, const std::vector<Vector2>& parameters) {
    const SislSurface surface = sisl_surface(surface_of(state));
    int u_span = 0, v_span = 0, status = 0;
    double derivatives[18], normal[3];
    per_point(state, parameters, [&](const Vector2& p) {
        double at[2] = {p.x(), p.y()};
        s1421(surface.get(), 2, at, &u_span, &v_span, derivatives, normal, &status);
        benchmark::DoNotOptimize(derivatives);
    });
}

void BM_derivatives_sisl(benchmark::State& state) {
    derivatives_sisl(state, random_parameters());
}
BENCHMARK(BM_derivatives_sisl)->Arg(8)->Arg(32);

void BM_rows_sisl(benchmark::State& state) {
    derivatives_sisl(state, row_parameters());
}
BENCHMARK(BM_rows_sisl)->Arg(8)->Arg(32);

void BM_curvature_sisl(benchmark::State& state) {
    const SislSurface surface = sisl_surface(surface_of(state));
    int u_span = 0, v_span = 0, status = 0;
    double k1 = 0.0, k2 = 0.0, d1[2], d2[2];
    per_point(state, random_parameters(), [&](const Vector2& p) {
        double at[2] = {p.x(), p.y()};
        s2542(surface.get(), 0, 0, 0, at, &u_span, &v_span, &k1, &k2, d1, d2, &status);
        benchmark::DoNotOptimize(k1);
        benchmark::DoNotOptimize(d1);
    });
}
BENCHMARK(BM_curvature_sisl)->Arg(8)->Arg(32);
#endif

}  // namespace
}  // namespace umbilic::bench
