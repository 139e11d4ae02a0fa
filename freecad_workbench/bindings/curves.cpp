// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bind.h"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <report/json_curves.h>
#include <report/json_geometry.h>
#include <umbilic/core/errors.h>
#include <umbilic/curves/geodesic.h>
#include <umbilic/curves/line_of_curvature.h>
#include <umbilic/curves/projection.h>

#include "interruptible.h"
#include "loaded_model.h"

namespace umbilic::python {

namespace py = pybind11;

namespace {

/// The face of that number; the only one if there is none.
const Face& chosen_face(const Model& model, std::optional<int> number) {
    if (number) return model.face(*number);
    if (model.faces.size() != 1)
        throw InvalidInput(model.source.path + ": has " + std::to_string(model.faces.size()) +
                           " faces; choose one with face=N");
    return model.faces.front();
}

Vector2 on_surface(const Face& face, const Vector2& native) {
    return surface_parameters(face, native.x(), native.y());
}

SurfacePoint point_of(const Face& face, const Vector2& native) {
    const Vector2 at = on_surface(face, native);
    return {face.number, at.x(), at.y()};
}

std::string lines_of_curvature(const LoadedModel& loaded, std::optional<int> face_number, const Vector2& start,
                               const std::string& family, std::optional<double> length, double spacing,
                               std::optional<double> tolerance, const py::object& progress) {
    return run_interruptible(progress, [&](const Progress& handle) {
        const Model& model = loaded.file.model;
        const Face& face = chosen_face(model, face_number);
        LineOfCurvatureOptions options{.length = length, .spacing = spacing};
        if (tolerance) options.tolerance = *tolerance;
        CurveResult result{.kind = "lines-of-curvature", .model = &model};
        for (const CurvatureFamily each : {CurvatureFamily::maximum, CurvatureFamily::minimum})
            if (family == "both" || family == name(each))
                result.curves.push_back(
                    {name(each), line_of_curvature(face, on_surface(face, start), each, options, handle)});
        return text(curves_json(result));
    });
}

std::string geodesics(const LoadedModel& loaded, std::optional<int> face_number, const Vector2& start,
                      const std::optional<Vector2>& to, std::optional<int> to_face,
                      const std::optional<Vector3>& direction, std::optional<double> length, double longest, int most,
                      bool one_face, double spacing, std::optional<double> tolerance, const py::object& progress) {
    return run_interruptible(progress, [&](const Progress& handle) {
        const Model& model = loaded.file.model;
        const Face& face = chosen_face(model, face_number);
        const OptionalJoins joined(model, one_face);
        CurveResult result{.kind = "geodesic", .model = &model};
        if (direction) {
            GeodesicOptions options{.spacing = spacing, .joins = joined.get()};
            if (tolerance) options.tolerance = *tolerance;
            result.curves.push_back({"geodesic", geodesic(face, on_surface(face, start), *direction,
                                                          length.value_or(0.0), options, handle)});
            return text(curves_json(result));
        }
        const Face& last = to_face ? model.face(*to_face) : face;
        GeodesicSearchOptions options{.spacing = spacing, .joins = joined.get(), .longest = longest, .most = most};
        if (tolerance) options.tolerance = *tolerance;
        GeodesicSearch found =
            geodesics_between(model, point_of(face, start), point_of(last, to.value()), options, handle);
        for (SurfaceCurve& curve : found.curves) result.curves.push_back({"geodesic", std::move(curve)});
        result.why = found.why;
        return text(curves_json(result));
    });
}

ProjectionOptions projection_options(const Face& target, const std::optional<Vector2>& foot, double spacing,
                                     std::optional<double> tolerance) {
    ProjectionOptions options{.spacing = spacing};
    if (tolerance) options.tolerance = *tolerance;
    if (foot) options.foot = on_surface(target, *foot);
    return options;
}

std::string project_points(const std::vector<std::vector<Vector3>>& curves, const LoadedModel& onto,
                           std::optional<int> onto_face, const std::optional<Vector2>& foot, bool one_face,
                           double spacing, std::optional<double> tolerance, const py::object& progress) {
    return run_interruptible(progress, [&](const Progress& handle) {
        const Model& model = onto.file.model;
        const Face& target = chosen_face(model, onto_face);
        const OptionalJoins joined(model, one_face);
        ProjectionOptions options = projection_options(target, foot, spacing, tolerance);
        options.joins = joined.get();
        CurveResult result{.kind = "project", .model = &model};
        for (const std::vector<Vector3>& points : curves) {
            ProjectedCurve one = project_curve(polyline(points), target, options, handle);
            result.curves.push_back({"", std::move(one.projection), std::nullopt, one.left_target});
        }
        return text(curves_json(result));
    });
}

std::string project_started(const LoadedModel& from, std::optional<int> face_number, const Vector2& start,
                            const std::string& family, const std::optional<Vector3>& direction,
                            std::optional<double> length, const std::optional<Vector2>& to, const LoadedModel& onto,
                            std::optional<int> onto_face, const std::optional<Vector2>& foot, bool one_face,
                            double spacing, std::optional<double> tolerance, const py::object& progress) {
    return run_interruptible(progress, [&](const Progress& handle) {
        const Face& face = chosen_face(from.file.model, face_number);
        const Face& target = chosen_face(onto.file.model, onto_face);
        const OptionalJoins joined(onto.file.model, one_face), own(from.file.model, one_face);
        ProjectionOptions options = projection_options(target, foot, spacing, tolerance);
        options.joins = joined.get();
        options.original_joins = own.get();
        CurveResult result{.kind = "project", .model = &onto.file.model, .original_model = &from.file.model};
        const auto add = [&](ProjectedCurve one) {
            result.curves.push_back({family, std::move(one.projection), std::move(one.original), one.left_target});
        };
        const Vector2 at = on_surface(face, start);
        if (to) {
            ProjectedGeodesicBetween between = project_geodesic_between(
                face, at, on_surface(face, *to), target, options, {.tolerance = 1e-6 * extent(face)}, handle);
            if (between.relaxation.converged)
                add(std::move(between.curve));
            else
                result.why =
                    "the relaxation from the straight line in the parameter plane did not converge; project "
                    "the curves that geodesic() finds";
        } else if (family == "geodesic") {
            add(project_geodesic(face, at, direction.value(), length.value_or(0.0), target, options, handle));
        } else {
            const CurvatureFamily lines = family == "maximum" ? CurvatureFamily::maximum : CurvatureFamily::minimum;
            add(project_line_of_curvature(face, at, lines, direction.value(), length.value_or(0.0), target, options,
                                          handle));
        }
        return text(curves_json(result));
    });
}

}  // namespace

void bind_curves(py::module_& module) {
    module.def("lines_of_curvature_json", &lines_of_curvature, py::arg("model"), py::arg("face"), py::arg("start"),
               py::arg("family"), py::arg("length"), py::arg("spacing"), py::arg("tolerance"), py::arg("progress"));
    module.def("geodesics_json", &geodesics, py::arg("model"), py::arg("face"), py::arg("start"), py::arg("to"),
               py::arg("to_face"), py::arg("direction"), py::arg("length"), py::arg("longest"), py::arg("most"),
               py::arg("one_face"), py::arg("spacing"), py::arg("tolerance"), py::arg("progress"));
    module.def("project_points_json", &project_points, py::arg("curves"), py::arg("onto"), py::arg("onto_face"),
               py::arg("foot"), py::arg("one_face"), py::arg("spacing"), py::arg("tolerance"), py::arg("progress"));
    module.def("project_started_json", &project_started, py::arg("model"), py::arg("face"), py::arg("start"),
               py::arg("family"), py::arg("direction"), py::arg("length"), py::arg("to"), py::arg("onto"),
               py::arg("onto_face"), py::arg("foot"), py::arg("one_face"), py::arg("spacing"), py::arg("tolerance"),
               py::arg("progress"));
}

}  // namespace umbilic::python
