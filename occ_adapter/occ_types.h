// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gp_Dir.hxx>
#include <gp_Pnt.hxx>
#include <gp_Pnt2d.hxx>
#include <gp_Vec.hxx>

#include <umbilic/core/types.h>

namespace umbilic {

inline Vector3 to_vector(const gp_XYZ& p) {
    return {p.X(), p.Y(), p.Z()};
}
inline Vector3 to_vector(const gp_Pnt& p) {
    return to_vector(p.XYZ());
}
inline Vector3 to_vector(const gp_Vec& v) {
    return to_vector(v.XYZ());
}
inline Vector3 to_vector(const gp_Dir& d) {
    return to_vector(d.XYZ());
}
inline Vector2 to_vector(const gp_Pnt2d& p) {
    return {p.X(), p.Y()};
}
inline gp_Pnt to_point(const Vector3& p) {
    return {p.x(), p.y(), p.z()};
}

}  // namespace umbilic
