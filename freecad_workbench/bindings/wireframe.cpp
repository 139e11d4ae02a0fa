// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bind.h"

#include <pybind11/stl.h>

#include <optional>

#include <report/json_wireframe.h>
#include <umbilic/wireframe/wireframe.h>

#include "interruptible.h"
#include "loaded_model.h"

namespace umbilic::python {

namespace py = pybind11;

namespace {

std::string find_wireframe_json(const LoadedModel& loaded, std::optional<int> face, std::optional<double> step,
                                std::optional<double> relative_step, const py::object& progress) {
    return run_interruptible(progress, [&](const Progress& handle) {
        WireframeOptions options;
        options.step = step;
        if (relative_step) options.relative_step = *relative_step;
        if (face) {
            loaded.file.model.face(*face);
            options.face = *face;
        }
        return text(wireframe_json(loaded.file.model, wireframe(loaded.file.model, options, handle)));
    });
}

}  // namespace

void bind_wireframe(py::module_& module) {
    module.def("wireframe_json", &find_wireframe_json, py::arg("model"), py::arg("face"), py::arg("step"),
               py::arg("relative_step"), py::arg("progress"));
}

}  // namespace umbilic::python
