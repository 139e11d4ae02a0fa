// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <complex>
#include <vector>

#include <umbilic/matching/prepared_model.h>

#include <report/json.h>

namespace umbilic {

Json vector_json(const Vector3& vector);
Json complex_json(std::complex<double> value);

/// (u, v) of the face's own surface in the file, from the parameters of its NURBS form.
Vector2 native_parameters(const Face& face, double u, double v);

/// An isolated umbilic and the face it lies on.
struct LocatedUmbilic {
    const Face* face = nullptr;
    const Umbilic* umbilic = nullptr;
};

/// The isolated umbilics of a model inside its faces, in the order that UmbilicPair and StrongTest count them. The
/// pointers live as long as the prepared model.
std::vector<LocatedUmbilic> isolated_umbilics(const PreparedModel& prepared);

/// One isolated umbilic of a face.
Json umbilic_json(const Face& face, const Umbilic& umbilic);

}  // namespace umbilic
