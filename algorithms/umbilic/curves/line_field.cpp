// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/curves/line_field.h>

#include <algorithm>
#include <cmath>
#include <string>

#include <Eigen/Geometry>

#include <umbilic/core/errors.h>

namespace umbilic {

namespace {

/// A piece narrower in space than this, relative to the face, is passed over. Second derivatives across it are
/// differences of control points over the square of its width, 1e-14 of the face's: coordinates rounded at 1e-16 leave
/// them a digit or two, and none where the face lies far from the origin. A neighbour continued over it misses the
/// surface by no more than that width, even at a crease.
constexpr double narrowest_piece = 1e-7;
/// Only pieces narrower than this in the parameter, relative to the domain, are measured in space.
constexpr double narrow_parameter = 1e-4;

/// Whether piece number i in parameter k is too narrow in space to carry the field, seen at both ends and in the
/// middle of every piece along it.
bool too_narrow(const NurbsSurface& surface, int k, int i, double size) {
    const std::vector<double>& across = (k == 0 ? surface.u_knots() : surface.v_knots()).breaks();
    const std::vector<double>& along = (k == 0 ? surface.v_knots() : surface.u_knots()).breaks();
    if (across[i + 1] - across[i] > narrow_parameter * (across.back() - across.front())) return false;
    const auto width = [&](double t) {
        const auto at = [&](double s) { return k == 0 ? surface.value(s, t) : surface.value(t, s); };
        const Vector3 middle = at(0.5 * (across[i] + across[i + 1]));
        return (middle - at(across[i])).norm() + (at(across[i + 1]) - middle).norm();
    };
    for (std::size_t j = 0; j + 1 < along.size(); ++j)
        for (const double t : {along[j], 0.5 * (along[j] + along[j + 1]), along[j + 1]})
            if (width(t) > narrowest_piece * size) return false;
    return true;
}

/// The piece whose polynomial is taken on each piece in parameter k: of narrow ones the one before them, or, at the
/// beginning of the domain, after them.
std::vector<int> carriers(const NurbsSurface& surface, int k, double size) {
    const int count = static_cast<int>((k == 0 ? surface.u_knots() : surface.v_knots()).breaks().size()) - 1;
    std::vector<int> result(count);
    std::vector<int> wide;
    for (int i = 0; i < count; ++i)
        if (!too_narrow(surface, k, i, size)) wide.push_back(i);
    for (int i = 0; i < count; ++i) {
        const auto after = std::upper_bound(wide.begin(), wide.end(), i);
        // Where all are narrow none is better than another.
        result[i] = wide.empty() ? i : after == wide.begin() ? wide.front() : *std::prev(after);
    }
    return result;
}

}  // namespace

Vector2 FieldValue::rates(const Vector3& vector) const {
    const double E = r_u.squaredNorm(), F = r_u.dot(r_v), G = r_v.squaredNorm();
    const double a = r_u.dot(vector), b = r_v.dot(vector), determinant = E * G - F * F;
    return {(G * a - F * b) / determinant, (E * b - F * a) / determinant};
}

FaceLineField::FaceLineField(const Face& face, LineField field)
    : face_(face), field_(field), closed_({face.u_closed || face.u_periodic, face.v_closed || face.v_periodic}) {
    size_ = face.area > 0.0 ? std::sqrt(face.area) : face.surface.pole_box().diagonal();
    if (!(size_ > 0.0)) throw InvalidInput("face " + std::to_string(face.number) + " has no extent");
    for (const int k : {0, 1}) carrier_[k] = carriers(face.surface, k, size_);
}

Vector2 FaceLineField::wrapped(Vector2 parameters) const {
    const ParameterBox domain = face_.surface.domain();
    for (int k = 0; k < 2; ++k) {
        const ParameterInterval& range = k == 0 ? domain.u : domain.v;
        if (!closed_[k] || range.contains(parameters[k])) continue;
        parameters[k] -= range.length() * std::floor((parameters[k] - range.low) / range.length());
        parameters[k] = range.clamp(parameters[k]);
    }
    return parameters;
}

FieldValue FaceLineField::piece_value(const std::array<int, 2>& piece, const Vector2& parameters,
                                      CurvatureFamily family) const {
    const SurfaceDerivatives d =
        face_.surface.piece_derivatives(piece[0], piece[1], parameters.x(), parameters.y(), field_.axis ? 1 : 2);
    FieldValue value;
    value.point = d.r();
    value.r_u = d.r_u();
    value.r_v = d.r_v();
    if (field_.axis) {
        value.regular = regular(d);
        if (!value.regular) return value;
        value.normal = unit_normal(d);
        const Vector3 along = *field_.axis - field_.axis->dot(value.normal) * value.normal;
        value.spread = along.norm();
        value.kappa = 1.0;
        if (value.spread > 0.0) value.tangent = along / value.spread;
        if (family == CurvatureFamily::minimum) value.tangent = value.normal.cross(value.tangent).eval();
        return value;
    }
    const Curvature c = curvature(d);
    value.regular = c.regular;
    value.normal = c.normal;
    // The outward side of a reversed face is the other one: there the families change places.
    value.tangent = (family == CurvatureFamily::maximum) != face_.reversed ? c.direction_max : c.direction_min;
    value.spread = c.kappa_max - c.kappa_min;
    value.kappa = std::max(std::abs(c.kappa_max), std::abs(c.kappa_min));
    return value;
}

FieldValue FaceLineField::value(const Vector2& parameters, CurvatureFamily family) const {
    return piece_value(piece_at(parameters), parameters, family);
}

std::array<int, 2> FaceLineField::piece_at(const Vector2& parameters) const {
    const NurbsSurface& surface = face_.surface;
    return {carrier_[0][surface.u_knots().piece(parameters.x())], carrier_[1][surface.v_knots().piece(parameters.y())]};
}

double FaceLineField::spread_scale(const FieldValue& value) const {
    return field_.axis ? 1.0 : std::max(value.kappa, 1.0 / size_);
}

bool FaceLineField::indeterminate(const FieldValue& value) const {
    return !value.regular || !(value.spread > collapse * spread_scale(value));
}

std::array<int, 2> FaceLineField::carried(int k, int i) const {
    const auto [first, last] = std::equal_range(carrier_[k].begin(), carrier_[k].end(), i);
    const auto begin = carrier_[k].begin();
    return {static_cast<int>(first - begin), static_cast<int>(last - begin)};
}

const std::vector<double>& FaceLineField::breaks(int k) const {
    return (k == 0 ? face_.surface.u_knots() : face_.surface.v_knots()).breaks();
}

}  // namespace umbilic
