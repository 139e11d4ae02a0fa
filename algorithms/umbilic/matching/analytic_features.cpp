// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/analytic_features.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include <Eigen/Geometry>

#include <umbilic/differential/recognise.h>

namespace umbilic {

namespace {

/// Faces lie on one surface if their parameters agree within this part of the model's size, beyond what they may be off
/// by: designs repeat a surface to rounding, files to some 1e-7.
constexpr double same_surface = 1e-6;

/// Samples of one face, gathered.
struct FaceSamples {
    double area = 0.0;
    Vector3 moment = Vector3::Zero();
    double square = 0.0;  ///< of the distances from the origin
    Vector3 point = Vector3::Zero(), normal = Vector3::UnitZ();

    void add(const AreaSample& sample) {
        const Vector3& p = sample.curvature.point;
        if (area == 0.0) point = p, normal = sample.curvature.normal;
        area += sample.weight;
        moment += sample.weight * p;
        square += sample.weight * p.squaredNorm();
    }
    Vector3 middle() const { return moment / area; }
    double extent() const { return std::sqrt(std::max(0.0, square / area - middle().squaredNorm())); }
};

Vector3 foot_on_axis(const Vector3& p, const AnalyticFeature& axis) {
    return axis.point + (p - axis.point).dot(axis.direction) * axis.direction;
}

/// Moves `point` along its surface of many points to the one nearest to the middle.
void place(AnalyticFeature& feature) {
    if (feature.has_centre()) return;
    const Vector3 along = feature.middle - feature.point;
    if (feature.kind == SurfaceKind::plane)
        feature.point = feature.middle - along.dot(feature.direction) * feature.direction;
    else if (feature.has_axis())
        feature.point = foot_on_axis(feature.middle, feature);
    else
        feature.point = feature.middle;
}

AnalyticFeature feature_of(const Face& face, SurfaceKind kind, const ElementarySurface& surface, double error,
                           const FaceSamples& samples) {
    AnalyticFeature feature{.kind = kind, .direction = surface.axis, .point = surface.location};
    feature.error = error + face.conversion_error;
    feature.middle = samples.middle();
    feature.extent = samples.extent();
    feature.area = samples.area;
    feature.faces = {face.number};
    switch (kind) {
        case SurfaceKind::plane:
            if (surface.axis.dot(samples.normal) < 0.0) feature.direction = -surface.axis;
            break;
        case SurfaceKind::cone:
            feature.semi_angle = std::abs(surface.semi_angle);
            if (surface.semi_angle < 0.0) feature.direction = -surface.axis;
            feature.point = surface.location - surface.radius / std::tan(feature.semi_angle) * feature.direction;
            break;
        case SurfaceKind::sphere:
            feature.direction = Vector3::Zero();
            feature.radius = surface.radius;
            break;
        case SurfaceKind::torus:
            feature.minor_radius = surface.minor_radius;
            [[fallthrough]];
        case SurfaceKind::cylinder:
            feature.radius = surface.radius;
            break;
        default:
            break;
    }
    if (kind != SurfaceKind::plane && kind != SurfaceKind::extrusion && kind != SurfaceKind::revolution) {
        Vector3 from = samples.point - feature.point;
        if (kind == SurfaceKind::torus) {
            const Vector3 across = from - from.dot(feature.direction) * feature.direction;
            from -= feature.radius * across.normalized();
        } else if (kind != SurfaceKind::sphere) {
            from = samples.point - foot_on_axis(samples.point, feature);
        }
        feature.side = from.dot(samples.normal) > 0.0 ? 1 : -1;
    }
    place(feature);
    return feature;
}

/// True if two features are the same surface within a length, as far as the faces reach.
bool same(const AnalyticFeature& a, const AnalyticFeature& b, double length) {
    if (a.kind != b.kind || a.side != b.side) return false;
    if (a.kind == SurfaceKind::extrusion || a.kind == SurfaceKind::revolution) return false;  // profiles may differ
    const double reach = (a.middle - b.middle).norm() + a.extent + b.extent;
    const bool either_sense = a.kind != SurfaceKind::cone && a.kind != SurfaceKind::plane;
    if (a.has_direction()) {
        double turn = (a.direction - b.direction).norm();
        if (either_sense) turn = std::min(turn, (a.direction + b.direction).norm());
        if (turn * reach > length) return false;
    }
    if (std::abs(a.radius - b.radius) > length || std::abs(a.minor_radius - b.minor_radius) > length ||
        std::abs(a.semi_angle - b.semi_angle) * reach > length)
        return false;
    const Vector3 apart = b.point - a.point;
    if (a.has_centre()) return apart.norm() <= length;
    if (a.kind == SurfaceKind::plane) return std::abs(apart.dot(a.direction)) <= length;
    return (apart - apart.dot(a.direction) * a.direction).norm() <= length;
}

void merge(AnalyticFeature& into, const AnalyticFeature& other) {
    const double area = into.area + other.area;
    const Vector3 middle = (into.area * into.middle + other.area * other.middle) / area;
    const auto spread = [&](const AnalyticFeature& f) {
        return f.area * (f.extent * f.extent + (f.middle - middle).squaredNorm());
    };
    const double extent = std::sqrt((spread(into) + spread(other)) / area);
    // The larger piece knows its surface better.
    const bool better = other.error < into.error;
    std::vector<int> faces = into.faces;
    faces.insert(faces.end(), other.faces.begin(), other.faces.end());
    if (better) into = other;
    into.faces = std::move(faces);
    into.area = area;
    into.middle = middle;
    into.extent = extent;
    place(into);
}

}  // namespace

std::vector<AnalyticFeature> analytic_features(const Model& model, const std::vector<AreaSample>& samples,
                                               const Progress& progress) {
    std::map<int, FaceSamples> of_face;
    for (const AreaSample& sample : samples) of_face[sample.at.face].add(sample);
    const std::vector<std::optional<RecognisedSurface>> recognised = recognise(model, {}, progress);

    std::vector<AnalyticFeature> features;
    for (std::size_t k = 0; k < model.faces.size(); ++k) {
        const Face& face = model.faces[k];
        const auto found = of_face.find(face.number);
        if (found == of_face.end() || !(found->second.area > 0.0)) continue;
        std::optional<AnalyticFeature> feature;
        if (elementary(face.kind) && face.elementary) {
            feature = feature_of(face, face.kind, *face.elementary, 0.0, found->second);
        } else {
            const std::optional<RecognisedSurface> surface =
                elementary(face.kind) ? recognise(face.surface) : recognised[k];
            if (surface)
                feature = feature_of(face, surface->kind, surface->surface, surface->parameter_error, found->second);
        }
        if (!feature) continue;
        const double length = same_surface * model.size();
        const auto known = std::find_if(features.begin(), features.end(), [&](const AnalyticFeature& other) {
            return same(*feature, other, length + feature->error + other.error);
        });
        if (known == features.end())
            features.push_back(*feature);
        else
            merge(*known, *feature);
    }
    std::stable_sort(features.begin(), features.end(),
                     [](const AnalyticFeature& a, const AnalyticFeature& b) { return a.area > b.area; });
    return features;
}

}  // namespace umbilic
