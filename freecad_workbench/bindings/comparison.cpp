// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bind.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <report/json.h>
#include <report/output.h>
#include <report/scene.h>
#include <umbilic/similarity/compare.h>

#include "arrays.h"
#include "comparison_options.h"
#include "interruptible.h"
#include "loaded_shape.h"

namespace umbilic::python {

namespace py = pybind11;

namespace {

/// A finished comparison with everything its results refer to.
struct FinishedComparison {
    LoadedShape original;
    LoadedShape suspect;
    CompareOptions options;
    Comparison comparison;
    Timing timing;
};

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

LoadedShape prepare_timed(const ShapePointer& source, const CompareOptions& options, const char* stage, Timing& timing,
                          const Progress& progress) {
    const auto start = std::chrono::steady_clock::now();
    LoadedShape shape(source, options, progress);
    timing.emplace_back(stage, seconds_since(start));
    return shape;
}

std::shared_ptr<FinishedComparison> compare_shapes(const ShapePointer& original, const ShapePointer& suspect,
                                                   const py::dict& keywords, const py::object& progress) {
    const CompareOptions options = comparison_options(keywords);
    return run_interruptible(progress, [&](const Progress& handle) {
        Timing timing;
        LoadedShape first = prepare_timed(original, options, "features of the original", timing, handle.part(0.0, 0.2));
        LoadedShape second = prepare_timed(suspect, options, "features of the suspect", timing, handle.part(0.2, 0.4));
        Comparison comparison = compare(first.prepared(), second.prepared(), options, handle.part(0.4, 1.0));
        return std::make_shared<FinishedComparison>(
            FinishedComparison{std::move(first), std::move(second), options, std::move(comparison), std::move(timing)});
    });
}

std::string match_shapes(const ShapePointer& original, const ShapePointer& suspect, const py::dict& keywords,
                         const py::object& progress) {
    const CompareOptions options = comparison_options(keywords);
    return run_interruptible(progress, [&](const Progress& handle) {
        Timing timing;
        const LoadedShape first =
            prepare_timed(original, options, "features of the original", timing, handle.part(0.0, 0.25));
        const LoadedShape second =
            prepare_timed(suspect, options, "features of the suspect", timing, handle.part(0.25, 0.5));
        const auto start = std::chrono::steady_clock::now();
        const Alignment alignment = match(first.prepared(), second.prepared(), options.match, handle.part(0.5, 1.0));
        timing.emplace_back("match", seconds_since(start));
        return text(match_json(first.prepared(), second.prepared(), options, alignment, timing));
    });
}

Json comparison_result(const FinishedComparison& finished) {
    return compare_json(finished.original.prepared(), finished.suspect.prepared(), finished.options,
                        finished.comparison, finished.timing);
}

std::string comparison_json(const FinishedComparison& finished) {
    return text(comparison_result(finished));
}

py::dict mesh_columns(const SceneMesh& mesh) {
    py::dict columns;
    columns["points"] = point_rows(mesh.points);
    columns["normals"] = point_rows(mesh.normals);
    columns["triangles"] = triangle_rows(mesh.triangles);
    columns["edges"] = rows<int>(mesh.edges, 2, [](const auto& edge, int* out) { std::copy_n(edge.data(), 2, out); });
    columns["deviation"] = column<double>(mesh.deviation, [](double value) { return value; });
    return columns;
}

/// What the pictures show, as the report does, in the frame and unit of the original.
py::dict scene(const FinishedComparison& finished, const py::object& progress) {
    const Scene scene = run_interruptible(progress, [&](const Progress& handle) {
        return make_scene(finished.original.prepared(), finished.original.meshes(), finished.suspect.prepared(),
                          finished.suspect.meshes(), finished.comparison, handle);
    });
    py::list umbilics;
    for (const SceneUmbilic& umbilic : scene.umbilics) {
        py::dict entry;
        entry["of_suspect"] = umbilic.of_suspect;
        entry["type"] = name(umbilic.type);
        entry["label"] = umbilic.label;
        entry["point"] = std::array<double, 3>{umbilic.point.x(), umbilic.point.y(), umbilic.point.z()};
        umbilics.append(std::move(entry));
    }
    py::dict result;
    result["original"] = mesh_columns(scene.original);
    result["suspect"] = mesh_columns(scene.suspect);
    result["posed"] = scene.posed;
    result["range"] = scene.scale.range;
    result["largest"] = scene.scale.largest;
    result["tolerance"] = scene.scale.tolerance;
    result["umbilics"] = std::move(umbilics);
    return result;
}

/// Writes the folder of the report and returns the path of its page.
std::string write_report_folder(const FinishedComparison& finished, const std::string& folder, const std::string& call,
                                const py::object& progress) {
    run_interruptible(progress, [&](const Progress& handle) {
        const ReportInput input{.original = finished.original.prepared(),
                                .suspect = finished.suspect.prepared(),
                                .original_meshes = finished.original.meshes(),
                                .suspect_meshes = finished.suspect.meshes(),
                                .options = finished.options,
                                .comparison = finished.comparison,
                                .timing = finished.timing,
                                .command_line = call,
                                .suspect_file = finished.suspect.path()};
        write_report(folder, input, comparison_result(finished), handle);
        return true;
    });
    return (std::filesystem::path(folder) / "report.html").string();
}

/// The nodes of the three tests as columns; NaN where a quantity is not defined at a node.
py::dict nodes(const FinishedComparison& finished, bool suspect) {
    const Assessment& assessment = finished.comparison.assessment;
    const auto& nodes = (suspect ? assessment.suspect_on_original : assessment.original_on_suspect).nodes;
    static constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
    using Node = NodeComparison;
    py::dict columns;
    columns["points"] = rows<double>(nodes, 3, [](const Node& n, double* out) { std::copy_n(n.point.data(), 3, out); });
    columns["face"] = column<int>(nodes, [](const Node& n) { return n.at.face; });
    columns["weight"] = column<double>(nodes, [](const Node& n) { return n.weight; });
    columns["distance"] = column<double>(nodes, [](const Node& n) { return n.distance; });
    columns["signed_distance"] = column<double>(nodes, [](const Node& n) { return n.signed_distance; });
    columns["kappa_max"] = column<double>(nodes, [](const Node& n) { return n.kappa_max.value_or(undefined); });
    columns["kappa_min"] = column<double>(nodes, [](const Node& n) { return n.kappa_min.value_or(undefined); });
    columns["direction"] = column<double>(nodes, [](const Node& n) { return n.direction.value_or(undefined); });
    columns["covered"] = column<bool>(nodes, [](const Node& n) { return n.covered; });
    return columns;
}

}  // namespace

void bind_comparison(py::module_& module) {
    py::class_<FinishedComparison, std::shared_ptr<FinishedComparison>>(module, "Comparison")
        .def("json", &comparison_json)
        .def("scene", &scene, py::arg("progress"))
        .def("nodes", &nodes, py::arg("suspect"));
    module.def("compare", &compare_shapes, py::arg("original"), py::arg("suspect"), py::arg("options"),
               py::arg("progress"));
    module.def("write_report", &write_report_folder, py::arg("comparison"), py::arg("folder"), py::arg("call"),
               py::arg("progress"));
    module.def("match_json", &match_shapes, py::arg("original"), py::arg("suspect"), py::arg("options"),
               py::arg("progress"));
}

}  // namespace umbilic::python
