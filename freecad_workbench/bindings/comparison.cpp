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
#include "loaded_model.h"

namespace umbilic::python {

namespace py = pybind11;

namespace {

using ModelPointer = std::shared_ptr<const LoadedModel>;

/// A finished comparison with everything its results refer to.
struct FinishedComparison {
    ModelPointer original;
    ModelPointer suspect;
    CompareOptions options;
    PreparedModel prepared_original;
    PreparedModel prepared_suspect;
    Comparison comparison;
    std::vector<std::pair<std::string, double>> timing;
};

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

PreparedModel prepare_timed(const LoadedModel& loaded, const FeatureOptions& options, const char* stage,
                            std::vector<std::pair<std::string, double>>& timing, const Progress& progress) {
    const auto start = std::chrono::steady_clock::now();
    PreparedModel prepared = prepare(loaded.file.model, options, progress);
    timing.emplace_back(stage, seconds_since(start));
    return prepared;
}

std::shared_ptr<FinishedComparison> compare_models(ModelPointer original, ModelPointer suspect,
                                                   const py::dict& keywords, const py::object& progress) {
    const CompareOptions options = comparison_options(keywords);
    return run_interruptible(progress, [&](const Progress& handle) {
        std::vector<std::pair<std::string, double>> timing;
        PreparedModel of_original =
            prepare_timed(*original, options.features, "features of the original", timing, handle.part(0.0, 0.2));
        PreparedModel of_suspect =
            prepare_timed(*suspect, options.features, "features of the suspect", timing, handle.part(0.2, 0.4));
        Comparison comparison = compare(of_original, of_suspect, options, handle.part(0.4, 1.0));
        return std::make_shared<FinishedComparison>(FinishedComparison{original, suspect, options,
                                                                       std::move(of_original), std::move(of_suspect),
                                                                       std::move(comparison), std::move(timing)});
    });
}

std::string match_models(ModelPointer original, ModelPointer suspect, const py::dict& keywords,
                         const py::object& progress) {
    const CompareOptions options = comparison_options(keywords);
    return run_interruptible(progress, [&](const Progress& handle) {
        std::vector<std::pair<std::string, double>> timing;
        const PreparedModel of_original =
            prepare_timed(*original, options.features, "features of the original", timing, handle.part(0.0, 0.25));
        const PreparedModel of_suspect =
            prepare_timed(*suspect, options.features, "features of the suspect", timing, handle.part(0.25, 0.5));
        const auto start = std::chrono::steady_clock::now();
        const Alignment alignment = match(of_original, of_suspect, options.match, handle.part(0.5, 1.0));
        timing.emplace_back("match", seconds_since(start));
        return text(
            match_json(original->file.model, suspect->file.model, options.features, options.match, alignment, timing));
    });
}

std::string comparison_json(const FinishedComparison& finished) {
    return text(compare_json(finished.prepared_original, finished.prepared_suspect, finished.options,
                             finished.comparison, finished.timing));
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
        return make_scene(finished.prepared_original, finished.original->file.meshes, finished.prepared_suspect,
                          finished.suspect->file.meshes, finished.comparison, handle);
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
        const ReportInput input{.original = finished.prepared_original,
                                .suspect = finished.prepared_suspect,
                                .original_meshes = finished.original->file.meshes,
                                .suspect_meshes = finished.suspect->file.meshes,
                                .options = finished.options,
                                .comparison = finished.comparison,
                                .timing = finished.timing,
                                .command_line = call,
                                .suspect_file = finished.suspect->path};
        write_report(folder, input,
                     compare_json(finished.prepared_original, finished.prepared_suspect, finished.options,
                                  finished.comparison, finished.timing),
                     handle);
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
    module.def("compare", &compare_models, py::arg("original"), py::arg("suspect"), py::arg("options"),
               py::arg("progress"));
    module.def("write_report", &write_report_folder, py::arg("comparison"), py::arg("folder"), py::arg("call"),
               py::arg("progress"));
    module.def("match_json", &match_models, py::arg("original"), py::arg("suspect"), py::arg("options"),
               py::arg("progress"));
}

}  // namespace umbilic::python
