// SPDX-License-Identifier: LGPL-2.1-or-later
// Wireframes on one thread. Argument: how often the step is halved. `per_node` shall stay flat when it is: every
// halving has about four times as many nodes. `quads` is the share of cells that are quadrilaterals.
#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <cmath>
#include <filesystem>
#include <string>

#include <occ_adapter/read_file.h>
#include <umbilic/wireframe/wireframe.h>

namespace umbilic {
namespace {

void mesh(benchmark::State& state, const std::string& path) {
    if (!std::filesystem::exists(path)) {
        state.SkipWithError((path + " is not there").c_str());
        return;
    }
    const Model model = read_file(path).model;
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    const double step = std::ldexp(WireframeOptions{}.relative_step, -static_cast<int>(state.range(0)));
    Wireframe result;
    for (auto _ : state) {
        result = wireframe(model, {.relative_step = step});
        benchmark::DoNotOptimize(result);
    }
    double nodes = 0.0, cells = 0.0, quadrilaterals = 0.0;
    for (const FaceWireframe& face : result.faces) {
        nodes += static_cast<double>(face.nodes.size());
        cells += static_cast<double>(face.cells.size());
        quadrilaterals += face.quadrilaterals;
    }
    state.counters["nodes"] = nodes;
    state.counters["quads"] = quadrilaterals / cells;
    state.counters["per_node"] =
        benchmark::Counter(nodes, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

BENCHMARK_CAPTURE(mesh, bottle, UMBILIC_MODELS_DIR "/bottle.step")->DenseRange(0, 3)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(mesh, blade, UMBILIC_MODELS_DIR "/blade.step")->DenseRange(0, 2)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(mesh, hull, UMBILIC_SHARED_CAD_DIR "/pairs/dtmb5415_hull.iges")
    ->DenseRange(0, 2)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace umbilic
