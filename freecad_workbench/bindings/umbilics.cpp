// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bind.h"

#include <pybind11/stl.h>

#include <memory>
#include <optional>

#include <report/json.h>
#include <umbilic/umbilics/find.h>
#include <umbilic/umbilics/shell_certificate.h>

#include "interruptible.h"
#include "loaded_model.h"

namespace umbilic::python {

namespace py = pybind11;

namespace {

std::string find_umbilics_json(const LoadedModel& loaded, std::optional<int> face, std::optional<double> resolution,
                               double accuracy, const py::object& progress) {
    return run_interruptible(progress, [&](const Progress& handle) {
        const Model& model = loaded.file.model;
        UmbilicOptions options;
        if (resolution) options.resolution = *resolution;
        options.accuracy = accuracy;
        std::vector<FaceUmbilics> faces;
        std::vector<ShellCertificate> shells;
        if (face) {
            faces.push_back(find_umbilics(model.face(*face), options, handle));
        } else {
            faces = find_umbilics(model, options, handle.part(0.0, 0.9));
            shells = shell_certificates(model, faces, handle.part(0.9, 1.0));
        }
        return text(umbilics_json(model, faces, shells));
    });
}

}  // namespace

void bind_umbilics(py::module_& module) {
    module.def("umbilics_json", &find_umbilics_json, py::arg("model"), py::arg("face"), py::arg("resolution"),
               py::arg("accuracy"), py::arg("progress"));
}

}  // namespace umbilic::python
