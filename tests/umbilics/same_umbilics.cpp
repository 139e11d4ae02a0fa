// SPDX-License-Identifier: LGPL-2.1-or-later
#include "same_umbilics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <Eigen/Geometry>
#include <Eigen/SVD>

namespace umbilic {

using support::ModelCopy;

namespace {

/// Bounds are to first order in the perturbation; what is left out stays below them by far more than this.
constexpr double first_order_slack = 4.0;

/// How far rounding and a stated deviation of the surface move what is found at an umbilic.
struct Accuracy {
    double curvature = 0.0;  ///< error of normal curvatures, 1/mm
    double position = 0.0;   ///< mm
    double cubic = 0.0;      ///< error of the cubic form's coefficients, 1/mm^2

    Accuracy operator+(const Accuracy& other) const {
        return {curvature + other.curvature, position + other.position, cubic + other.cubic};
    }
    Accuracy scaled(double s) const { return {curvature / s, position * s, cubic / (s * s)}; }
};

double local_span(const KnotVector& knots, double t) {
    const int span = knots.span(t);
    return knots.knots()[span + 1] - knots.knots()[span];
}

Accuracy accuracy(const NurbsSurface& surface, const Umbilic& umbilic, double deviation) {
    double coordinate = 0.0, lightest = 1.0, heaviest = 1.0;
    for (const Vector3& pole : surface.poles()) coordinate = std::max(coordinate, pole.cwiseAbs().maxCoeff());
    if (surface.rational()) {
        lightest = *std::min_element(surface.weights().begin(), surface.weights().end());
        heaviest = *std::max_element(surface.weights().begin(), surface.weights().end());
    }
    // Control points and weights are off by an ulp each; the k-th difference of control points adds them up 2^k times.
    const double off = 2 * std::numeric_limits<double>::epsilon() * coordinate * heaviest / lightest + deviation;
    const SurfaceDerivatives d = surface.derivatives(umbilic.at.u, umbilic.at.v, 4);
    const double u_speed = d.r_u().norm(), v_speed = d.r_v().norm();
    const double sine = d.r_u().cross(d.r_v()).norm() / (u_speed * v_speed);
    // Derivatives of Bezier pieces: degree / length of the piece in space, in the worst direction of a skew frame.
    const double per_length = (surface.u_degree() / (local_span(surface.u_knots(), umbilic.at.u) * u_speed) +
                               surface.v_degree() / (local_span(surface.v_knots(), umbilic.at.v) * v_speed)) /
                              sine;
    Accuracy result;
    result.curvature = 4 * off * per_length * per_length;
    // The traceless part of the shape operator grows from the umbilic on at least by this per mm.
    const auto& [a, b, c, cubic_d] = umbilic.cubic;
    Matrix2 slope;
    slope << (a - c) / 2, (b - cubic_d) / 2, b, c;
    const Vector2 singular = slope.jacobiSvd().singularValues();
    const ParameterBox domain = surface.domain();
    const double proved = umbilic.radius * (domain.u.length() * u_speed + domain.v.length() * v_speed);
    result.position = proved + result.curvature / singular[1] + off;
    // On that way the curvature changes with the cubic form, and that with the fourth derivatives.
    double fourth = 0.0;
    for (int k = 0; k <= 4; ++k)
        fourth += d(k, 4 - k).norm() / std::pow(u_speed * sine, k) / std::pow(v_speed * sine, 4 - k);
    const double third = std::sqrt(umbilic.cubic.squared_norm());
    fourth += std::abs(umbilic.kappa) * (third + umbilic.kappa * umbilic.kappa);
    result.curvature += result.position * third;
    result.cubic = 8 * off * std::pow(per_length, 3) + result.position * fourth;
    return result;
}

}  // namespace

namespace {

OpenPlace open_place(const NurbsSurface& surface, const ParameterBox& box) {
    OpenPlace result{surface.value(box.u.middle(), box.v.middle())};
    for (const double u : {box.u.low, box.u.high})
        for (const double v : {box.v.low, box.v.high})
            result.radius = std::max(result.radius, (surface.value(u, v) - result.center).norm());
    return result;
}

}  // namespace

FoundUmbilics search_umbilics(const Model& model, std::size_t faces) {
    FoundUmbilics result;
    const std::vector<FaceUmbilics> all = find_umbilics(model);
    for (std::size_t k = 0; k < faces; ++k) {
        const FaceUmbilics& face = all[k];
        result.undecided += static_cast<int>(face.undecided.size());
        result.lines += static_cast<int>(face.lines.size());
        result.regions += static_cast<int>(face.regions.size());
        if (face.certificate.complete) {
            EXPECT_TRUE(*face.certificate.complete) << "face " << face.face << ": " << face.certificate.why;
        }
        const auto add_open = [&](const auto& parts) {
            for (const auto& part : parts)
                for (const ParameterBox& box : part.boxes)
                    result.open.push_back(open_place(model.faces[k].surface, box));
        };
        add_open(face.undecided);
        add_open(face.lines);
        add_open(face.regions);
        for (const Umbilic& umbilic : face.umbilics)
            if (umbilic.containment == Containment::inside) result.inside.push_back({&model.faces[k], umbilic});
    }
    return result;
}

namespace {

/// Distance to the nearest border of the domain, relative to its sides.
double border_distance(const NurbsSurface& surface, double u, double v) {
    const ParameterBox domain = surface.domain();
    return std::min({u - domain.u.low, domain.u.high - u}) < 0 || std::min(v - domain.v.low, domain.v.high - v) < 0
               ? 0.0
               : std::min(std::min(u - domain.u.low, domain.u.high - u) / domain.u.length(),
                          std::min(v - domain.v.low, domain.v.high - v) / domain.v.length());
}

/// Umbilics of a model and its copy within this of its size are taken for each other before they are compared; one that
/// differs by more counts as missed.
constexpr double same_place = 1e-6;
/// Umbilics nearer to a border than this, relative to the domain, may change sides.
constexpr double border_margin = 1e-9;

void expect_same_form(const Umbilic& base, const Umbilic& other, const ModelCopy& copy, const Accuracy& bound) {
    const double s = copy.space.scale;
    EXPECT_LE((other.point - copy.space.apply(base.point)).norm(), bound.position);
    const double same_side = other.normal.dot(copy.space.apply_direction(base.normal));
    EXPECT_GT(std::abs(same_side), 1 - 1e-6);
    if (copy.parameters) {
        EXPECT_GT(same_side * copy.normal_sign, 0.0);
    }
    const double sign = same_side > 0 ? 1.0 : -1.0;
    EXPECT_NEAR(other.kappa, sign * base.kappa / s, bound.curvature);
    EXPECT_EQ(other.certified, base.certified);
    // An error of the coefficients seen by forms that are quotients of them.
    const double relative = 8 * bound.cubic / (std::sqrt(base.cubic.squared_norm()) / (s * s));
    EXPECT_NEAR(std::sqrt(other.cubic.squared_norm()), std::sqrt(base.cubic.squared_norm()) / (s * s), 8 * bound.cubic);
    EXPECT_NEAR(other.kind.delta, base.kind.delta, relative);
    // Seen from the other side, or in a mirror, zeta becomes its conjugate; both together leave it.
    const bool conjugate = (sign < 0) != copy.space.mirrored;
    EXPECT_LE(std::abs(other.kind.zeta - (conjugate ? std::conj(base.kind.zeta) : base.kind.zeta)), relative);
    if (base.kind.type == UmbilicType::non_generic || other.kind.type == UmbilicType::non_generic) return;
    EXPECT_EQ(other.index, base.index);
    EXPECT_EQ(other.kind.type, base.kind.type);
    EXPECT_EQ(other.kind.star, base.kind.star);
    EXPECT_EQ(other.directions.size(), base.directions.size());
}

/// Whether the search left the neighbourhood of the point open; boxes may be bent, hence twice their size.
bool left_open(const FoundUmbilics& found, const Vector3& point) {
    return std::any_of(found.open.begin(), found.open.end(),
                       [&](const OpenPlace& place) { return (place.center - point).norm() <= 2 * place.radius; });
}

/// True if the image of the umbilic lies well inside one face of the copy.
bool stays(const Umbilic& umbilic, const ModelCopy& copy) {
    if (!copy.parameters) return true;
    const std::vector<SurfacePoint> images = copy.parameters(umbilic.at);
    if (images.size() != 1) return false;  // cut off, or on a cut
    const Face& face = copy.model.face(images[0].face);
    return border_distance(face.surface, images[0].u, images[0].v) >= border_margin &&
           face.region.classify(images[0].u, images[0].v, border_margin) == Containment::inside;
}

std::size_t nearest(const FoundUmbilics& found, const Vector3& point) {
    std::size_t result = 0;
    for (std::size_t k = 1; k < found.inside.size(); ++k)
        if ((found.inside[k].umbilic.point - point).norm() < (found.inside[result].umbilic.point - point).norm())
            result = k;
    return result;
}

double distance(const FoundUmbilics& found, const Vector3& point) {
    if (found.inside.empty()) return std::numeric_limits<double>::infinity();
    return (found.inside[nearest(found, point)].umbilic.point - point).norm();
}

std::string described(const Face& face, const Umbilic& umbilic) {
    return "umbilic of face " + std::to_string(face.number) + " at " + std::to_string(umbilic.at.u) + " " +
           std::to_string(umbilic.at.v) + ", delta " + std::to_string(umbilic.kind.delta);
}

}  // namespace

int expect_same_umbilics(const Model& model, const FoundUmbilics& base, const ModelCopy& copy) {
    const std::size_t own = copy.foreign ? copy.model.faces.size() - 1 : copy.model.faces.size();
    const FoundUmbilics found = search_umbilics(copy.model, own);
    int open = 0;
    std::vector<int> taken(found.inside.size(), 0);
    for (const auto& [face, umbilic] : base.inside) {
        if (border_distance(face->surface, umbilic.at.u, umbilic.at.v) < border_margin || !stays(umbilic, copy))
            continue;
        SCOPED_TRACE(described(*face, umbilic));
        const Vector3 expected = copy.space.apply(umbilic.point);
        if (distance(found, expected) > same_place * copy.model.size()) {
            if (left_open(found, expected))
                ++open;
            else
                ADD_FAILURE() << "missed; the nearest lies " << distance(found, expected) << " mm away";
            continue;
        }
        const PlacedUmbilic& other = found.inside[nearest(found, expected)];
        const Accuracy bound = accuracy(face->surface, umbilic, 0.0).scaled(copy.space.scale) +
                               accuracy(other.face->surface, other.umbilic, copy.deviation);
        expect_same_form(
            umbilic, other.umbilic, copy,
            {first_order_slack * bound.curvature, first_order_slack * bound.position, first_order_slack * bound.cubic});
        ++taken[nearest(found, expected)];
    }
    for (std::size_t k = 0; k < found.inside.size(); ++k) {
        const auto& [face, umbilic] = found.inside[k];
        EXPECT_LE(taken[k], 1) << "two umbilics became one: " << described(*face, umbilic);
        if (taken[k] == 1 || border_distance(face->surface, umbilic.at.u, umbilic.at.v) < border_margin) continue;
        if (face->region.classify(umbilic.at.u, umbilic.at.v, border_margin) != Containment::inside) continue;
        // What is left must have been on a border or a cut of the original.
        const Vector3 before = copy.space.inverse().apply(umbilic.point);
        if (distance(base, before) <= same_place * model.size()) continue;
        if (left_open(base, before))
            ++open;
        else
            ADD_FAILURE() << "new " << described(*face, umbilic) << "; the nearest lay " << distance(base, before)
                          << " mm away";
    }
    return open;
}

}  // namespace umbilic
