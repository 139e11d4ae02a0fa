// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bicubic_solid.h"

#include <boost/math/quadrature/gauss.hpp>

#include <Eigen/Geometry>

#include <support/surfaces.h>
#include <umbilic/core/errors.h>

namespace umbilic::bench {

namespace {

/// Exact for polynomials of degree 19; second moments of a bicubic piece have degree 14.
using Rule = boost::math::quadrature::gauss<double, 10>;

template <typename F>
void for_each_point(const std::vector<double>& breaks, const F& visit) {
    for (std::size_t k = 0; k + 1 < breaks.size(); ++k) {
        const double middle = 0.5 * (breaks[k] + breaks[k + 1]), half = 0.5 * (breaks[k + 1] - breaks[k]);
        for (std::size_t n = 0; n < Rule::abscissa().size(); ++n)
            for (const double side : {-1.0, 1.0})
                visit(middle + side * half * Rule::abscissa()[n], half * Rule::weights()[n]);
    }
}

/// Averages of three successive knots: where on the curve a pole of a cubic has most weight.
double greville(const KnotVector& knots, int k) {
    return (knots.knots()[k + 1] + knots.knots()[k + 2] + knots.knots()[k + 3]) / 3.0;
}

/// From a curve to another on the same knots; the second direction is a straight line of degree 3.
NurbsSurface ruled(const KnotVector& knots, const std::vector<Vector3>& from, const std::vector<Vector3>& to) {
    std::vector<Vector3> poles;
    for (std::size_t k = 0; k < from.size(); ++k)
        for (int step = 0; step <= 3; ++step) poles.push_back(from[k] + step / 3.0 * (to[k] - from[k]));
    return NurbsSurface(knots, KnotVector::bezier(3), poles);
}

}  // namespace

std::vector<SolidFace> thickened(const NurbsSurface& outer, double thickness) {
    const KnotVector &u = outer.u_knots(), &v = outer.v_knots();
    if (outer.rational() || u.degree() != 3 || v.degree() != 3 || !(thickness > 0.0))
        throw InvalidInput("thickened: a bicubic integral surface and a positive thickness are needed");
    const int rows = u.pole_count(), columns = v.pole_count();
    std::vector<Vector3> beside = outer.poles();
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) {
            const SurfaceDerivatives d = outer.derivatives(greville(u, i), greville(v, j), 1);
            beside[i * columns + j] -= thickness * d.r_u().cross(d.r_v()).normalized();
        }
    const auto column = [&](const std::vector<Vector3>& net, int j) {
        std::vector<Vector3> result;
        for (int i = 0; i < rows; ++i) result.push_back(net[i * columns + j]);
        return result;
    };
    const auto row = [&](const std::vector<Vector3>& net, int i) {
        return std::vector<Vector3>(net.begin() + i * columns, net.begin() + (i + 1) * columns);
    };
    // Inwards along the ruling is -n: r_v x (-n) = -r_u and r_u x (-n) = r_v, up to lengths.
    return {{outer, false},
            {NurbsSurface(u, v, beside), true},
            {ruled(v, row(outer.poles(), 0), row(beside, 0)), false},
            {ruled(v, row(outer.poles(), rows - 1), row(beside, rows - 1)), true},
            {ruled(u, column(outer.poles(), 0), column(beside, 0)), true},
            {ruled(u, column(outer.poles(), columns - 1), column(beside, columns - 1)), false}};
}

Model solid_of(const std::vector<SolidFace>& faces) {
    std::vector<NurbsSurface> surfaces;
    for (const SolidFace& face : faces) surfaces.push_back(face.surface);
    Model model = support::model_of(std::move(surfaces));
    // Of x -> x f(x), f homogeneous of degree k, the divergence is (3 + k) f. About the box's middle.
    const Vector3 origin = model.box.center();
    double volume = 0.0;
    Vector3 first = Vector3::Zero();
    Matrix3 second = Matrix3::Zero();
    for (std::size_t k = 0; k < faces.size(); ++k) {
        const NurbsSurface& surface = faces[k].surface;
        model.faces[k].reversed = faces[k].reversed;
        model.faces[k].solid = 0;
        for_each_point(surface.u_knots().breaks(), [&](double u, double u_weight) {
            for_each_point(surface.v_knots().breaks(), [&](double v, double v_weight) {
                const SurfaceDerivatives d = surface.derivatives(u, v, 1);
                const Vector3 x = d.r() - origin;
                const double flux =
                    (faces[k].reversed ? -1.0 : 1.0) * u_weight * v_weight * x.dot(d.r_u().cross(d.r_v()));
                volume += flux / 3.0;
                first += flux / 4.0 * x;
                second += flux / 5.0 * x * x.transpose();
            });
        });
    }
    Solid solid;
    solid.volume = volume;
    solid.area = model.area;
    const Vector3 centre = first / volume;
    solid.centroid = origin + centre;
    const Matrix3 about = second - volume * centre * centre.transpose();
    solid.inertia = about.trace() * Matrix3::Identity() - about;
    model.solids = {solid};
    model.volume = volume;
    return model;
}

std::vector<SolidFace> moved(std::vector<SolidFace> faces, const SimilarityTransform& move) {
    for (SolidFace& face : faces) face.surface = support::transformed(face.surface, move);
    return faces;
}

}  // namespace umbilic::bench
