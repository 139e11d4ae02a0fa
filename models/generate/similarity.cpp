// SPDX-License-Identifier: LGPL-2.1-or-later
#include "similarity.h"

#include <BRepBuilderAPI_Transform.hxx>
#include <gp_Ax1.hxx>
#include <gp_Mat.hxx>

namespace umbilic::models {
namespace {

gp_Mat matrix(const std::array<double, 9>& m) {
    return {m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8]};
}

std::array<double, 9> values(const gp_Mat& m) {
    return {m(1, 1), m(1, 2), m(1, 3), m(2, 1), m(2, 2), m(2, 3), m(3, 1), m(3, 2), m(3, 3)};
}

const gp_Mat kMirror{-1, 0, 0, 0, 1, 0, 0, 0, 1};

}  // namespace

Similarity pose(double scale, std::array<double, 3> axis, double angle, std::array<double, 3> translation,
                bool mirrored) {
    gp_Trsf turn;
    turn.SetRotation(gp_Ax1{gp_Pnt{0, 0, 0}, gp_Dir{axis[0], axis[1], axis[2]}}, angle);
    return {scale, values(turn.VectorialPart()), translation, mirrored};
}

Similarity inverse(const Similarity& similarity) {
    // q = s R M p + t  gives  p = (1/s) M R' (q - t), and M R' = (M R' M) M.
    gp_Mat back = matrix(similarity.rotation).Transposed();
    if (similarity.mirrored) back = kMirror * back * kMirror;
    gp_Mat linear = similarity.mirrored ? back * kMirror : back;
    gp_XYZ t{similarity.translation[0], similarity.translation[1], similarity.translation[2]};
    t.Multiply(linear);
    t *= -1 / similarity.scale;
    return {1 / similarity.scale, values(back), {t.X(), t.Y(), t.Z()}, similarity.mirrored};
}

gp_Trsf to_trsf(const Similarity& similarity) {
    gp_Mat m = matrix(similarity.rotation);
    if (similarity.mirrored) m = m * kMirror;
    m *= similarity.scale;
    gp_Trsf result;
    result.SetValues(m(1, 1), m(1, 2), m(1, 3), similarity.translation[0], m(2, 1), m(2, 2), m(2, 3),
                     similarity.translation[1], m(3, 1), m(3, 2), m(3, 3), similarity.translation[2]);
    return result;
}

TopoDS_Shape transformed(const TopoDS_Shape& shape, const Similarity& similarity) {
    const bool copy_geometry = true;
    return BRepBuilderAPI_Transform{shape, to_trsf(similarity), copy_geometry}.Shape();
}

}  // namespace umbilic::models
