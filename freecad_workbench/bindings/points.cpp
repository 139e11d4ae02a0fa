// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bind.h"

#include <pybind11/stl.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <occ_adapter/read_file.h>
#include <point_files/read_points.h>
#include <report/json_fit.h>
#include <report/output.h>
#include <umbilic/core/errors.h>
#include <umbilic/points/fit_points.h>

#include "arrays.h"
#include "interruptible.h"

namespace umbilic::python {

namespace py = pybind11;

namespace {

using CloudPointer = std::shared_ptr<const PointCloud>;
using Rows = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Triples = py::array_t<int, py::array::c_style | py::array::forcecast>;

void check_shape(const py::array& array, const std::string& label, const char* what) {
    if (array.ndim() != 2 || array.shape(1) != 3)
        throw InvalidInput(label + ": " + what + " must be an array of shape (n, 3)");
}

/// Points in memory, cleaned as those of a file are.
std::shared_ptr<PointCloud> points_from(const Rows& points, const std::optional<Triples>& triangles,
                                        const std::string& label) {
    check_shape(points, label, "points");
    auto cloud = std::make_shared<PointCloud>();
    cloud->source = {.path = label, .format = "points", .unit = "mm (assumed)"};
    cloud->source.bytes = static_cast<std::uint64_t>(points.nbytes());
    cloud->layout = "array";
    for (py::ssize_t i = 0; i < points.shape(0); ++i)
        cloud->points.emplace_back(points.at(i, 0), points.at(i, 1), points.at(i, 2));
    if (triangles) {
        check_shape(*triangles, label, "triangles");
        for (py::ssize_t i = 0; i < triangles->shape(0); ++i)
            cloud->triangles.push_back({triangles->at(i, 0), triangles->at(i, 1), triangles->at(i, 2)});
    }
    clean(*cloud);
    if (cloud->points.empty()) throw InvalidInput(label + ": holds no finite point");
    return cloud;
}

std::shared_ptr<PointCloud> read_cloud(const std::string& path, const py::object& progress) {
    return run_interruptible(
        progress, [&](const Progress& handle) { return std::make_shared<PointCloud>(read_points(path, handle)); });
}

/// A fit with everything its results refer to.
struct FinishedFit {
    PointCloud cloud;
    FitOptions options;
    std::size_t most_points = 0;
    FitResult fit;
    Timing timing;

    std::string json(const std::string& output) const {
        return text(fit_json(cloud, options, most_points, fit, output, timing));
    }
};

std::shared_ptr<FinishedFit> fit_cloud(const CloudPointer& cloud, const std::string& method, int degree,
                                       std::optional<std::pair<int, int>> net, std::optional<std::pair<int, int>> grid,
                                       std::optional<double> tolerance, std::optional<double> smooth, int most_poles,
                                       std::size_t most_points, std::uint64_t seed, const py::object& progress) {
    FitOptions options{.degree = degree, .poles = net, .tolerance = tolerance, .grid = grid, .smooth = smooth};
    options.most_poles = most_poles;
    if (method == "grid" || grid)
        options.method = FitMethod::grid;
    else if (method == "multilevel")
        options.method = FitMethod::multilevel;
    else if (method != "scattered")
        throw InvalidInput("method = '" + method + "': expected scattered, multilevel or grid");
    return run_interruptible(progress, [&](const Progress& handle) {
        const auto start = std::chrono::steady_clock::now();
        PointCloud used = *cloud;
        if (!grid) thin_out(used, most_points, seed);
        FitResult fit = fit_points(used, options, handle);
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        return std::make_shared<FinishedFit>(
            FinishedFit{std::move(used), options, most_points, std::move(fit), {{"fit", seconds}}});
    });
}

py::dict fitted_points(const FinishedFit& finished) {
    const FitResult& fit = finished.fit;
    py::dict columns;
    columns["points"] =
        rows<double>(fit.points, 3, [](const auto& p, double* out) { std::copy_n(p.point.data(), 3, out); });
    columns["parameters"] = rows<double>(fit.points, 2, [](const auto& p, double* out) { out[0] = p.u, out[1] = p.v; });
    columns["distance"] = column<double>(fit.distances, [](double value) { return value; });
    return columns;
}

std::string write_fit_folder(const FinishedFit& finished, const std::string& folder, const std::string& call,
                             const py::object& progress) {
    run_interruptible(progress, [&](const Progress& handle) {
        const FitReportInput input{finished.cloud, finished.options, finished.most_points,
                                   finished.fit,   finished.timing,  call};
        write_fit_report(
            folder, input,
            fit_json(finished.cloud, finished.options, finished.most_points, finished.fit, "", finished.timing),
            handle);
        return true;
    });
    return (std::filesystem::path(folder) / "report.html").string();
}

}  // namespace

void bind_points(py::module_& module) {
    py::class_<PointCloud, std::shared_ptr<PointCloud>>(module, "Points")
        .def("info_json", [](const PointCloud& cloud) { return text(input_json(cloud)); })
        .def("points", [](const PointCloud& cloud) { return point_rows(cloud.points); })
        .def("triangles", [](const PointCloud& cloud) { return triangle_rows(cloud.triangles); });
    module.def("holds_points", &holds_points, py::arg("path"));
    module.def("read_points", &read_cloud, py::arg("path"), py::arg("progress"));
    module.def("points_from", &points_from, py::arg("points"), py::arg("triangles"), py::arg("label"));
    py::class_<FinishedFit, std::shared_ptr<FinishedFit>>(module, "Fit")
        .def("json", &FinishedFit::json, py::arg("output"))
        .def("points", &fitted_points)
        .def("write_step", [](const FinishedFit& finished, const std::string& path) {
            const py::gil_scoped_release without_gil;
            write_surface_step(finished.fit.surface, path);
        });
    module.def("fit", &fit_cloud, py::arg("points"), py::arg("method"), py::arg("degree"), py::arg("net"),
               py::arg("grid"), py::arg("tolerance"), py::arg("smooth"), py::arg("most_poles"), py::arg("most_points"),
               py::arg("seed"), py::arg("progress"));
    module.def("write_fit_report", &write_fit_folder, py::arg("fit"), py::arg("folder"), py::arg("call"),
               py::arg("progress"));
}

}  // namespace umbilic::python
