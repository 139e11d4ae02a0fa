// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <complex>
#include <vector>

#include <umbilic/matching/prepared_shape.h>

#include <report/json.h>

namespace umbilic {

Json vector_json(const Vector3& vector);
Json complex_json(std::complex<double> value);

/// (u, v) of the face's own surface in the file, from the parameters of its NURBS form.
Vector2 native_parameters(const Face& face, double u, double v);

/// The inverse: parameters of the NURBS form.
Vector2 surface_parameters(const Face& face, double native_u, double native_v);

/// An isolated umbilic and the face it lies on.
struct LocatedUmbilic {
    const Face* face = nullptr;
    const Umbilic* umbilic = nullptr;
};

/// The isolated umbilics of a model inside its faces, in the order that UmbilicPair and StrongTest count them. The
/// pointers live as long as the prepared model. Measured points have none.
std::vector<LocatedUmbilic> isolated_umbilics(const PreparedShape& shape);

/// Parameters of a surface of this kind: "location", "axis", "x_axis", and those of "radius", "minor_radius" and
/// "semi_angle" it has.
Json elementary_json(SurfaceKind kind, const ElementarySurface& surface);
/// Kind, parameters and deviation.
Json recognised_json(const RecognisedSurface& recognised);

/// What a result was computed with; seconds by stage.
Json tool_json();
Json timing_json(const Timing& timing);

/// One isolated umbilic of a face.
Json umbilic_json(const Face& face, const Umbilic& umbilic);

}  // namespace umbilic
