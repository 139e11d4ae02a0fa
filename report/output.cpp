// SPDX-License-Identifier: LGPL-2.1-or-later
#include <report/output.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <functional>
#include <future>
#include <memory>

#include <unistd.h>

#include <occ_adapter/read_file.h>
#include <point_files/write_ply.h>
#include <umbilic/core/errors.h>

#include <report/deviation_csv.h>

namespace umbilic {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, int error) {
    const char* const advice = error == ENOSPC   ? "free some space or choose another place"
                               : error == EACCES ? "choose a place that you may write to"
                               : error == EPERM  ? "choose a place that you may write to"
                               : error == EROFS  ? "choose a place that you may write to"
                               : error == ENOENT ? "make its folder first"
                                                 : "choose another place";
    throw NumericFailure(path + ": cannot be written (" + std::strerror(error) + "); " + advice);
}

void write_through(const std::string& path, const std::string& shown_path, const std::string& contents) {
    std::FILE* const file = std::fopen(path.c_str(), "wb");
    if (file == nullptr) fail(shown_path, errno);
    int error = 0;
    if (std::fwrite(contents.data(), 1, contents.size(), file) != contents.size()) error = errno;
    if (std::fclose(file) != 0 && error == 0) error = errno;
    if (error != 0) fail(shown_path, error);
}

/// A path that is removed, with what it holds, unless it was moved away.
class Temporary {
public:
    explicit Temporary(fs::path path) : path_(std::move(path)) {}
    ~Temporary() {
        std::error_code ignored;  // already gone if it was moved
        fs::remove_all(path_, ignored);
    }
    Temporary(const Temporary&) = delete;
    Temporary& operator=(const Temporary&) = delete;
    const fs::path& path() const { return path_; }

private:
    fs::path path_;
};

/// Where something is put together before it takes its place: in the same folder, so that renaming it is one step.
fs::path beside(const fs::path& target) {
    return target.parent_path() / ("." + target.filename().string() + "." + std::to_string(getpid()) + ".part");
}

fs::path resolved(const std::string& path, const std::string& shown_path) {
    std::error_code error;
    const fs::path absolute = fs::absolute(path, error);
    const fs::path target = error ? fs::path() : fs::weakly_canonical(absolute, error);
    if (error) fail(shown_path, error.value());
    // "DIR/" has no file name of its own.
    return target.has_filename() ? target : target.parent_path();
}

/// Makes a folder appear with all of its files at the end. `fill` puts them into a folder beside it: write(name,
/// contents) for one, or by itself under the given path. Files named in `stale` are of an older report and leave if
/// nothing new takes their place.
void write_folder(
    const std::string& folder, const std::vector<std::string>& stale,
    const std::function<void(const std::function<void(const char*, const std::string&)>&, const fs::path&)>& fill) {
    check_report_folder(folder);
    const fs::path target = resolved(folder, folder);
    std::error_code error;
    const bool exists = fs::exists(target, error);
    fs::create_directories(target.parent_path(), error);
    if (error) fail(folder, error.value());

    const Temporary assembled(beside(target));
    fs::create_directory(assembled.path(), error);
    if (error) fail(folder, error.value());
    fill(
        [&](const char* name, const std::string& contents) {
            write_through(assembled.path() / name, (fs::path(folder) / name).string(), contents);
        },
        assembled.path());
    if (!exists) {
        fs::rename(assembled.path(), target, error);
        if (error) fail(folder, error.value());
        return;
    }
    for (const std::string& name : stale) fs::remove(target / name, error);
    for (const auto& entry : fs::directory_iterator(assembled.path())) {
        fs::rename(entry.path(), target / entry.path().filename(), error);
        if (error) fail((fs::path(folder) / entry.path().filename()).string(), error.value());
    }
}

}  // namespace

void write_file(const std::string& path, const std::string& contents) {
    const fs::path target = resolved(path, path);
    std::error_code error;
    const fs::file_status status = fs::status(target, error);
    if (fs::is_directory(status)) fail(path, EISDIR);
    if (fs::exists(status) && !fs::is_regular_file(status)) {
        write_through(path, path, contents);
        return;
    }
    const Temporary temporary(beside(target));
    write_through(temporary.path(), path, contents);
    fs::rename(temporary.path(), target, error);
    if (error) fail(path, error.value());
}

void check_report_folder(const std::string& folder) {
    const fs::path target = resolved(folder, folder);
    std::error_code error;
    if (fs::exists(target, error) && !fs::is_directory(target, error)) fail(folder, ENOTDIR);
}

void write_report(const std::string& folder, const ReportInput& input, const Json& result, const Progress& progress) {
    // An older report's aligned suspect must not stand beside a result that has no pose.
    write_folder(folder, {"aligned.step", "aligned.ply"}, [&](const auto& write, const fs::path& assembled) {
        // Written in a child process, so it costs nothing beside the page.
        std::future<void> aligned;
        const bool posed = input.comparison.alignment.status != AlignmentStatus::not_found;
        const SimilarityTransform& pose = input.comparison.alignment.original_suspect;
        if (posed && input.suspect.points()) write("aligned.ply", ply_text(input.suspect.points()->cloud, pose));
        if (posed && input.suspect.model()) {
            aligned = std::async(std::launch::async, [&] {
                const std::string& suspect_file =
                    input.suspect_file.empty() ? input.suspect.source().path : input.suspect_file;
                write_transformed_step(suspect_file, pose, assembled / "aligned.step");
            });
        }
        write("report.html", report_html(input, progress.part(0.0, 0.7)));
        write("result.json", text(result) + "\n");
        write("deviation.csv", deviation_csv(input.original, input.suspect, input.comparison.assessment));
        if (aligned.valid()) {
            progress.report(0.75, "writing the aligned suspect");
            aligned.get();
        }
        progress.report(1.0, "report written");
    });
}

void write_umbilics_report(const std::string& folder, const UmbilicsReportInput& input, const Json& result,
                           const Progress& progress) {
    write_folder(folder, {}, [&](const auto& write, const fs::path&) {
        write("report.html", umbilics_html(input, progress));
        write("umbilics.json", text(result) + "\n");
        progress.report(1.0, "report written");
    });
}

void write_fit_report(const std::string& folder, const FitReportInput& input, const Json& result,
                      const Progress& progress) {
    write_folder(folder, {}, [&](const auto& write, const fs::path&) {
        write("report.html", fit_html(input, progress));
        write("fit.json", text(result) + "\n");
        progress.report(1.0, "report written");
    });
}

}  // namespace umbilic
