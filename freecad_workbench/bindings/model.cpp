// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bind.h"

#include <pybind11/stl.h>

#include <array>
#include <memory>
#include <vector>

#include <report/json.h>

#include "arrays.h"
#include "interruptible.h"
#include "loaded_model.h"

namespace umbilic::python {

namespace py = pybind11;

namespace {

std::shared_ptr<LoadedModel> read(const std::string& path, const std::string& label, double seconds,
                                  const py::object& progress) {
    return run_interruptible(progress, [&](const Progress& handle) {
        ReadOptions options;
        options.display_meshes = true;
        options.seconds = seconds;
        auto loaded = std::make_shared<LoadedModel>(LoadedModel{read_file(path, options, handle), path});
        if (!label.empty()) {  // a shape handed over in memory: its label means more than the memory file's name
            loaded->file.model.source.path = label;
            loaded->file.model.source.format = "shape";
        }
        return loaded;
    });
}

py::tuple mesh(const LoadedModel& loaded) {
    std::vector<Vector3> points;
    std::vector<std::array<int, 3>> triangles;
    for (const DisplayMesh& face : loaded.file.meshes) {
        const int first = static_cast<int>(points.size());
        points.insert(points.end(), face.points.begin(), face.points.end());
        for (const auto& [a, b, c] : face.triangles) triangles.push_back({first + a, first + b, first + c});
    }
    return py::make_tuple(point_rows(points), triangle_rows(triangles));
}

}  // namespace

void bind_model(py::module_& module) {
    py::class_<LoadedModel, std::shared_ptr<LoadedModel>>(module, "Model")
        .def("info_json",
             [](const LoadedModel& loaded) { return text(info_json(loaded.file.model, recognise(loaded.file.model))); })
        .def("mesh", &mesh, "Points (n, 3) in mm and triangles (m, 3).");
    module.def("read", &read, py::arg("path"), py::arg("label"), py::arg("seconds"), py::arg("progress"));
    module.def("opencascade_version", &opencascade_version);
}

}  // namespace umbilic::python
