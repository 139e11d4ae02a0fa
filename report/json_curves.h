// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <umbilic/curves/surface_curve.h>
#include <umbilic/model/model.h>

#include <report/json.h>

namespace umbilic {

/// A curve as a result names it.
struct NamedCurve {
    std::string family;  ///< "maximum", "minimum" or "geodesic"; empty for the projection of a curve from a file
    SurfaceCurve curve;
    /// The curve whose projection this is, on the faces of `original_model`, if it was computed.
    std::optional<SurfaceCurve> original;
    /// A projection ended at the target's border.
    bool left_target = false;
};

/// Curves and what they lie on.
struct CurveResult {
    std::string kind;  ///< "lines-of-curvature", "geodesic" or "project"
    const Model* model = nullptr;
    const Model* original_model = nullptr;  ///< of projections
    std::vector<NamedCurve> curves;
    std::string why;  ///< if there are none
};

/// Schema "umbilic.curve/1". Parameters u and v are those of the file's own surfaces.
Json curves_json(const CurveResult& result);

/// Why a curve ends, in words for a person.
std::string end_text(CurveEnd end);

}  // namespace umbilic
