// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <umbilic/curves/surface_curve.h>
#include <umbilic/differential/curvature.h>
#include <umbilic/model/model.h>

namespace umbilic {

/// Two orthogonal families of lines on a face: the lines of curvature, or, where a surface has none (plane, sphere),
/// the lines that climb along a given axis (maximum) and those that run level (minimum).
struct LineField {
    std::optional<Vector3> axis;
};

/// A line field's value at a point.
struct FieldValue {
    Vector3 point = Vector3::Zero();
    Vector3 normal = Vector3::UnitZ();  ///< of the surface, r_u x r_v
    Vector3 r_u, r_v;
    Vector3 tangent = Vector3::UnitX();  ///< unit, of the family asked for; its sign is arbitrary
    double spread = 0.0;                 ///< kappa_max - kappa_min, or of an axis the length of its tangential part
    double kappa = 0.0;                  ///< greater of the two |kappa|, or 1 for an axis
    bool regular = false;

    /// Rates (du/ds, dv/ds) of a tangent vector.
    Vector2 rates(const Vector3& vector) const;
};

/// The lines of one face. Within a polynomial piece of the surface their direction is a smooth function. Pieces so
/// narrow that rounding of the control points leaves no second derivative are passed over: the piece before them
/// carries the field on to their far side. References the face.
class FaceLineField {
public:
    FaceLineField(const Face& face, LineField field = {});

    const Face& face() const { return face_; }
    bool along_axis() const { return field_.axis.has_value(); }
    /// Length the face's thresholds are relative to: sqrt(area), mm.
    double size() const { return size_; }
    bool closed(int k) const { return closed_[k]; }
    /// Parameters moved into the domain where the surface is closed.
    Vector2 wrapped(Vector2 parameters) const;

    /// The field on the piece of the surface that holds (u, v).
    FieldValue value(const Vector2& parameters, CurvatureFamily family) const;
    /// The field of one piece, also beside it.
    FieldValue piece_value(const std::array<int, 2>& piece, const Vector2& parameters, CurvatureFamily family) const;
    /// What spreads are relative to: the greater of kappa and 1 / size, or 1 for an axis.
    double spread_scale(const FieldValue& value) const;
    /// True if the families cannot be told apart there: spread <= collapse * spread_scale(), or singular.
    bool indeterminate(const FieldValue& value) const;

    /// Number of the piece that carries the field at (u, v): not one that is passed over.
    std::array<int, 2> piece_at(const Vector2& parameters) const;
    /// Number of the piece that carries the field on piece number i in parameter k.
    int carrier(int k, int i) const { return carrier_[k][i]; }
    /// Numbers of the breaks between which lies the part that piece number i in parameter k carries.
    std::array<int, 2> carried(int k, int i) const;
    /// Breaks of parameter k.
    const std::vector<double>& breaks(int k) const;

    /// Relative difference of the principal curvatures below which directions are lost.
    static constexpr double collapse = 1e-6;

private:
    const Face& face_;
    LineField field_;
    double size_ = 1.0;
    std::array<bool, 2> closed_ = {false, false};
    /// For every piece in u and in v the piece whose polynomial is taken on it: itself, or a neighbour if it is too
    /// narrow.
    std::array<std::vector<int>, 2> carrier_;
};

}  // namespace umbilic
