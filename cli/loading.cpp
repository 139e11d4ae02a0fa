// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cli/loading.h>

#include <chrono>
#include <future>

#include <fmt/format.h>
#include <tbb/parallel_invoke.h>

#include <cli/console.h>

namespace umbilic {

namespace {

/// Skipped parts that are named one by one; all are in the JSON result.
constexpr std::size_t most_skipped_lines = 5;

void print_warnings(const Session& session, const Model& model) {
    if (session.quiet) return;
    clear_progress_bar();
    const auto line = [&](const std::string& text) {
        fmt::print(stderr, "umbilic: {}: warning: {}\n", printable(model.source.path), printable(text));
    };
    for (const std::string& warning : model.warnings) line(warning);
    for (std::size_t i = 0; i < std::min(most_skipped_lines, model.skipped.size()); ++i) {
        const Skipped& skipped = model.skipped[i];
        line("skipped " + (skipped.face > 0 ? "face " + std::to_string(skipped.face) : skipped.entity) + ": " +
             skipped.why);
    }
    if (model.skipped.size() > most_skipped_lines) {
        line(std::to_string(model.skipped.size() - most_skipped_lines) + " more parts were skipped");
    }
}

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

ReadResult load(const Session& session, const std::string& path, const ReadOptions& options, const Progress& progress) {
    ReadResult result = read_file(path, options, progress);
    print_warnings(session, result.model);
    return result;
}

std::unique_ptr<LoadedPair> load_pair(const Session& session, const std::string& original, const std::string& suspect,
                                      const ReadOptions& read, const FeatureOptions& features,
                                      const Progress& progress) {
    auto pair = std::make_unique<LoadedPair>();
    const auto start = std::chrono::steady_clock::now();
    const Progress reading = progress.part(0.0, 0.4);
    // Reading waits for a child process, so it gets a thread of its own whatever --threads says.
    std::future<ReadResult> second = std::async(std::launch::async, [&] { return read_file(suspect, read, reading); });
    pair->original_read = read_file(original, read, reading);
    pair->suspect_read = second.get();
    pair->timing.emplace_back("read", seconds_since(start));
    print_warnings(session, pair->original_read.model);
    print_warnings(session, pair->suspect_read.model);

    const auto read_end = std::chrono::steady_clock::now();
    const Progress preparing = progress.part(0.4, 1.0);
    const auto prepared = [&](const Model& model) {
        return std::unique_ptr<PreparedModel>(new PreparedModel(prepare(model, features, preparing)));
    };
    tbb::parallel_invoke([&] { pair->original = prepared(pair->original_read.model); },
                         [&] { pair->suspect = prepared(pair->suspect_read.model); });
    pair->timing.emplace_back("features", seconds_since(read_end));
    return pair;
}

void print_timing(const Session& session, const Timing& timing) {
    if (!session.verbose) return;
    clear_progress_bar();
    for (const auto& [stage, seconds] : timing) fmt::print(stderr, "umbilic: {}: {:.3f} s\n", stage, seconds);
}

}  // namespace umbilic
