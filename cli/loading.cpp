// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cli/loading.h>

#include <chrono>
#include <future>

#include <fmt/format.h>
#include <tbb/parallel_invoke.h>

#include <cli/console.h>
#include <point_files/read_points.h>

namespace umbilic {

namespace {

/// Skipped parts that are named one by one; all are in the JSON result.
constexpr std::size_t most_skipped_lines = 5;

void print_warning(const std::string& path, const std::string& text) {
    fmt::print(stderr, "umbilic: {}: warning: {}\n", printable(path), printable(text));
}

void print_warnings(const Session& session, const PointCloud& cloud) {
    if (session.quiet) return;
    clear_progress_bar();
    for (const std::string& warning : cloud.warnings) print_warning(cloud.source.path, warning);
}

void print_warnings(const Session& session, const Model& model) {
    if (session.quiet) return;
    clear_progress_bar();
    const auto line = [&](const std::string& text) { print_warning(model.source.path, text); };
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

PointCloud load_points(const Session& session, const std::string& path, std::size_t most_points,
                       const Progress& progress) {
    PointCloud cloud = read_points(path, progress);
    thin_out(cloud, most_points, session.seed);
    print_warnings(session, cloud);
    return cloud;
}

std::unique_ptr<LoadedPair> load_pair(const Session& session, const MatchWords& words, const ReadOptions& read,
                                      const Progress& progress) {
    const FeatureOptions& features = words.options.features;
    const PointFeatureOptions& points = words.options.points;
    auto pair = std::make_unique<LoadedPair>();
    const auto start = std::chrono::steady_clock::now();
    const Progress reading = progress.part(0.0, 0.4);
    const auto read_into = [&](LoadedShape& shape, const std::string& path) {
        if (holds_points(path)) {
            shape.cloud = read_points(path, reading);
            thin_out(shape.cloud, points.most_points, points.seed);
        } else {
            shape.file = read_file(path, read, reading);
        }
    };
    // Reading waits for a child process, so it gets a thread of its own whatever --threads says.
    std::future<void> second = std::async(std::launch::async, [&] { read_into(pair->suspect, words.suspect); });
    read_into(pair->original, words.original);
    second.get();
    pair->timing.emplace_back("read", seconds_since(start));
    for (const LoadedShape* shape : {&pair->original, &pair->suspect}) {
        print_warnings(session, shape->file.model);
        print_warnings(session, shape->cloud);
    }
    check_method_of(words, !pair->suspect.cloud.points.empty());

    const auto read_end = std::chrono::steady_clock::now();
    const Progress preparing = progress.part(0.4, 1.0);
    const auto prepare_in = [&](LoadedShape& shape) {
        if (shape.cloud.points.empty())
            shape.model.reset(new PreparedModel(prepare(shape.file.model, features, preparing)));
        else
            shape.points.reset(new PreparedPoints(prepare(shape.cloud, points, preparing)));
    };
    tbb::parallel_invoke([&] { prepare_in(pair->original); }, [&] { prepare_in(pair->suspect); });
    pair->timing.emplace_back("features", seconds_since(read_end));
    return pair;
}

void print_timing(const Session& session, const Timing& timing) {
    if (!session.verbose) return;
    clear_progress_bar();
    for (const auto& [stage, seconds] : timing) fmt::print(stderr, "umbilic: {}: {:.3f} s\n", stage, seconds);
}

}  // namespace umbilic
