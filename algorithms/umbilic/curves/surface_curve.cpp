// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/curves/surface_curve.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include <umbilic/core/errors.h>

namespace umbilic {

int parts_of(double length, double spacing) {
    const double parts = std::max(1.0, std::round(length / spacing));
    if (parts <= most_curve_points) return static_cast<int>(parts);
    std::ostringstream text;
    text << "a spacing of " << spacing << " mm asks for more than a million points on a curve of " << length
         << " mm; choose at least " << length / most_curve_points << " mm";
    throw InvalidInput(text.str());
}

const char* name(CurvatureFamily family) {
    return family == CurvatureFamily::maximum ? "maximum" : "minimum";
}

const char* name(CurveEnd end) {
    switch (end) {
        case CurveEnd::length:
            return "length";
        case CurveEnd::boundary:
            return "boundary";
        case CurveEnd::trim:
            return "trim";
        case CurveEnd::umbilic:
            return "umbilic";
        case CurveEnd::closed:
            return "closed";
        case CurveEnd::evolute:
            return "evolute";
        case CurveEnd::point:
            return "point";
    }
    return "";
}

}  // namespace umbilic
