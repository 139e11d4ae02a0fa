// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <memory>
#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/differential/area_samples.h>
#include <umbilic/differential/monge_form.h>
#include <umbilic/model/model.h>

namespace umbilic {

/// Shape of a surface around a point, free of scale: what two points must agree in to correspond. Computed in the
/// principal frame (direction_max, direction_min, normal), whose half turn about the normal is arbitrary.
struct ShapeSignature {
    double angle = 0.0;       ///< atan2(kappa_min, kappa_max), in [-3 pi / 4, pi / 4]
    double magnitude = 0.0;   ///< sqrt(kappa_max^2 + kappa_min^2), 1/mm: its ratio is the scale
    double anisotropy = 0.0;  ///< (kappa_max - kappa_min) / magnitude, in [0, sqrt(2)]: the frame is undefined at 0
    Cubic cubic;              ///< derivative of the second fundamental form in the principal frame / magnitude^2
};

/// Signature from derivatives of order 3 at a regular point; `outward` is false where the face's outward side is
/// against r_u x r_v.
ShapeSignature shape_signature(const SurfaceDerivatives& d, bool outward);

/// The signature of the same point with the half turn of the frame, seen from the other side, and in a mirror.
ShapeSignature half_turned(const ShapeSignature& signature);
ShapeSignature seen_from_behind(const ShapeSignature& signature);
ShapeSignature mirrored(const ShapeSignature& signature);

/// Dense samples of a model with their signatures, sorted by angle, and their positions for nearest-sample look-ups.
/// Built once per model.
class PrincipalFrameTable {
public:
    /// Beyond this many steps of tangential offset from the nearest sample a point lies past the border of the surface.
    static constexpr double border_steps = 2.0;

    struct Entry {
        Curvature frame;
        ShapeSignature signature;
        int face = 0;  ///< number of the model's face; 0 of measured points
    };

    /// `count`: samples over the whole model. Throws Cancelled.
    PrincipalFrameTable(const Model& model, int count, const Progress& progress = {});
    /// Entries found otherwise, `step` mm apart. Those whose magnitude is 0 take part in look-ups of positions only.
    /// `extent` (mm) stands for that of the samples.
    PrincipalFrameTable(std::vector<Entry> entries, double step, std::optional<double> extent = {});
    ~PrincipalFrameTable();
    PrincipalFrameTable(PrincipalFrameTable&&) noexcept;

    /// The entries of one face by themselves.
    PrincipalFrameTable of_face(int face) const;

    /// All regular samples, flat and umbilic ones included, by increasing angle.
    const std::vector<Entry>& entries() const { return entries_; }
    /// Range of entries whose angle lies in [low, high].
    std::pair<int, int> angle_range(double low, double high) const;
    /// Typical distance of neighbouring samples, mm.
    double step() const { return step_; }
    /// Twice the root mean square distance of the samples from their centroid, or what it was said to be, mm.
    double extent() const { return extent_; }

    /// The sample nearest to a point of space, or null if none is within `limit` (mm): a small limit ends the search of
    /// far points at once.
    const Entry* nearest(const Vector3& point, double limit) const;

    /// Distance of a point from the surface, from its nearest sample: to that sample's tangent plane, or in full where
    /// the point lies beyond the border (tangential offset above border_steps). Accurate to the sagitta over one step;
    /// nothing if it exceeds `limit`.
    std::optional<double> approximate_distance(const Vector3& point, double limit) const;

private:
    void arrange();

    struct Index;
    std::vector<Entry> entries_;
    std::unique_ptr<const Index> index_;
    double step_ = 0.0;
    double extent_ = 0.0;
};

}  // namespace umbilic
