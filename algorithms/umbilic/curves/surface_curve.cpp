// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/curves/surface_curve.h>

namespace umbilic {

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
