// SPDX-License-Identifier: LGPL-2.1-or-later
// Time, boxes and memory of the search, one thread, on surfaces where subdivision explodes; and one large surface on
// one and two threads. Peer of the same run: the rough 20 x 20 bicubic, an ordinary hard case.
#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>

#include <benchmark/benchmark.h>
#include <malloc.h>
#include <tbb/global_control.h>

#include <support/surfaces.h>
#include <support/worst_cases.h>
#include <umbilic/umbilics/find.h>

namespace {

std::atomic<long> allocated{0}, most_allocated{0};

void* counted(void* memory) {
    if (!memory) throw std::bad_alloc();
    const long now = allocated += static_cast<long>(malloc_usable_size(memory));
    long most = most_allocated;
    while (now > most && !most_allocated.compare_exchange_weak(most, now)) {
    }
    return memory;
}

void released(void* memory) {
    if (memory) allocated -= static_cast<long>(malloc_usable_size(memory));
    std::free(memory);
}

}  // namespace

void* operator new(std::size_t size) {
    return counted(std::malloc(size));
}
void operator delete(void* memory) noexcept {
    released(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    released(memory);
}

namespace umbilic {
namespace {

void search(benchmark::State& state, const NurbsSurface& surface, int threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    FaceUmbilics found;
    long memory = 0;
    for (auto _ : state) {
        found = {};
        const long before = allocated;
        most_allocated = before;
        found = find_umbilics(surface);
        memory = std::max(memory, most_allocated - before);
        benchmark::DoNotOptimize(found);
    }
    state.counters["boxes"] = static_cast<double>(found.statistics.boxes);
    state.counters["KiB"] = static_cast<double>(memory) / 1024;
    state.counters["umbilics"] = static_cast<double>(found.umbilics.size());
    state.counters["undecided"] = static_cast<double>(found.undecided.size());
    state.counters["lines"] = static_cast<double>(found.lines.size());
    state.counters["regions"] = static_cast<double>(found.regions.size());
}

void threads(benchmark::State& state) {
    search(state, state.range(0) == 0 ? support::smooth_bicubic(64, 7) : support::rough_bicubic(64, 7),
           static_cast<int>(state.range(1)));
    state.SetLabel(state.range(0) == 0 ? "smooth 64x64" : "rough 64x64");
}

void register_worst_cases() {
    benchmark::RegisterBenchmark("rough_20x20", [](benchmark::State& state) {
        search(state, support::rough_bicubic(20, 7), 1);
    })->Unit(benchmark::kMillisecond);
    for (const support::WorstCase& one : support::worst_cases())
        benchmark::RegisterBenchmark(one.name.c_str(), [one](benchmark::State& state) {
            search(state, one.surface, 1);
        })->Unit(benchmark::kMillisecond);
}

BENCHMARK(threads)
    ->ArgsProduct({{0, 1}, {1, 2}})
    ->UseRealTime()
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace umbilic

int main(int count, char** arguments) {
    benchmark::Initialize(&count, arguments);
    umbilic::register_worst_cases();
    benchmark::RunSpecifiedBenchmarks();
}
