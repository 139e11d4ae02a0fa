// SPDX-License-Identifier: LGPL-2.1-or-later
#include "read_file.h"

#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <system_error>

#include <unistd.h>

#include <Standard_Version.hxx>
#include <fmt/format.h>

#include <umbilic/core/errors.h>
#include <umbilic/model/serialization.h>

#include "file_format.h"
#include "reader_process.h"

namespace umbilic {

namespace {

namespace fs = std::filesystem;

/// The path under which another process finds the same file; /proc/self is another place there.
std::string path_for_reader(const std::string& path) {
    constexpr std::string_view self = "/proc/self/";
    if (path.starts_with(self)) return fmt::format("/proc/{}/{}", ::getpid(), path.substr(self.size()));
    return path;
}

/// Removes a file that was not finished.
class Unfinished {
public:
    explicit Unfinished(fs::path path) : path_(std::move(path)) {}
    ~Unfinished() {
        std::error_code ignored;
        fs::remove(path_, ignored);
    }
    const fs::path& path() const { return path_; }

private:
    fs::path path_;
};

void check(const ReadOptions& options) {
    if (!(options.seconds > 0.0)) throw InvalidInput("time limit for reading: must be positive");
    if (!(options.display_deflection > 0.0)) throw InvalidInput("display deflection: must be positive");
}

/// Hands what `write` writes to the child process, which makes a STEP file of it; the file appears whole or not at all.
void write_step(const std::string& step_path, const char* command, const ReadOptions& options,
                const std::function<void(std::ostream&)>& write) {
    check(options);
    const fs::path target(step_path);
    const auto part = [&](const char* ending) {
        return target.parent_path() / fmt::format(".{}.{}.{}", target.filename().string(), ::getpid(), ending);
    };
    const Unfinished source(part("source")), beside(part("part"));
    {
        std::ofstream out(source.path(), std::ios::binary);
        write(out);
        if (!out.flush()) throw InvalidInput(step_path + ": cannot be written; choose another place");
    }
    run_reader(step_path, {command, source.path().string(), beside.path().string()}, {options.seconds, options.memory},
               {});
    std::error_code error;
    fs::rename(beside.path(), target, error);
    if (error) throw InvalidInput(step_path + ": cannot be written (" + error.message() + "); choose another place");
}

}  // namespace

ReadResult read_file(const std::string& path, const ReadOptions& options, const Progress& progress) {
    check(options);
    describe_file(path);
    const std::vector<std::string> arguments = {
        "read", path_for_reader(path), options.display_meshes ? fmt::format("{:a}", options.display_deflection) : "0"};
    std::istringstream bytes(run_reader(path, arguments, {options.seconds, options.memory}, progress));
    ReadResult result{read_model(bytes), read_display_meshes(bytes)};
    result.model.source.path = path;
    return result;
}

void write_transformed_step(const std::string& path, const SimilarityTransform& transform, const std::string& step_path,
                            const ReadOptions& options) {
    check(options);
    describe_file(path);
    const fs::path target(step_path);
    const Unfinished beside(target.parent_path() / fmt::format(".{}.{}.part", target.filename().string(), ::getpid()));
    std::vector<std::string> arguments = {"transform", path_for_reader(path), beside.path().string()};
    const Matrix3 linear = transform.scale * transform.orthogonal();
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column)
            arguments.push_back(fmt::format("{:a}", column < 3 ? linear(row, column) : transform.translation(row)));
    run_reader(path, arguments, {options.seconds, options.memory}, {});
    std::error_code error;
    fs::rename(beside.path(), target, error);
    if (error) throw InvalidInput(step_path + ": cannot be written (" + error.message() + "); choose another place");
}

void write_surfaces_step(const Model& model, const std::string& step_path, const ReadOptions& options) {
    write_step(step_path, "write", options, [&](std::ostream& out) { write_model(model, out); });
}

void write_surface_step(const NurbsSurface& surface, const std::string& step_path, const ReadOptions& options) {
    Model model;
    model.source = {.path = step_path, .format = "shape", .unit = "mm"};
    model.shells = model.declared_faces = 1;
    model.box = surface.pole_box();
    model.faces.push_back({.number = 1, .surface = surface, .region = TrimmingRegion(surface.domain())});
    write_surfaces_step(model, step_path, options);
}

void write_curves_step(const std::vector<std::vector<Vector3>>& curves, const std::string& step_path,
                       const ReadOptions& options) {
    write_step(step_path, "curves", options, [&](std::ostream& out) {
        for (const std::vector<Vector3>& curve : curves) {
            const auto count = static_cast<double>(curve.size());
            out.write(reinterpret_cast<const char*>(&count), sizeof count);
            for (const Vector3& p : curve) out.write(reinterpret_cast<const char*>(p.data()), 3 * sizeof(double));
        }
    });
}

std::string opencascade_version() {
    return OCC_VERSION_COMPLETE;
}

}  // namespace umbilic
