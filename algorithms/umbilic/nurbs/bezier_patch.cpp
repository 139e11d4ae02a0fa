// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/nurbs/bezier_patch.h>

#include <algorithm>
#include <limits>

namespace umbilic {

namespace {

/// Half an ulp of 1: the largest relative error of one rounded operation.
constexpr double unit_roundoff = std::numeric_limits<double>::epsilon() / 2;

struct Span {
    int index = 0;
    ParameterInterval interval;
    std::vector<double> matrix;
};

std::vector<Span> spans(const KnotVector& knots) {
    std::vector<Span> result;
    for (int i = knots.degree(); i < knots.pole_count(); ++i)
        if (knots.knots()[i] < knots.knots()[i + 1])
            result.push_back({i, {knots.knots()[i], knots.knots()[i + 1]}, knots.bernstein_matrix(i)});
    return result;
}

BezierPatch extract(const NurbsSurface& surface, const Span& u, const Span& v) {
    const int p = surface.u_degree(), q = surface.v_degree();
    BezierPatch patch;
    patch.u_degree = p;
    patch.v_degree = q;
    patch.rational = surface.rational();
    patch.domain = {u.interval, v.interval};
    patch.origin = surface.pole(u.index - p / 2, v.index - q / 2);

    std::vector<Vector4> local((p + 1) * (q + 1));
    double largest = 0.0, heaviest = 0.0;
    for (int i = 0; i <= p; ++i)
        for (int j = 0; j <= q; ++j) {
            const double w = surface.weight(u.index - p + i, v.index - q + j);
            Vector4& point = local[i * (q + 1) + j];
            point << w * (surface.pole(u.index - p + i, v.index - q + j) - patch.origin), w;
            largest = std::max(largest, point.head<3>().cwiseAbs().maxCoeff());
            heaviest = std::max(heaviest, w);
        }

    std::vector<Vector4> half((p + 1) * (q + 1), Vector4::Zero());
    for (int i = 0; i <= p; ++i)
        for (int j = 0; j <= q; ++j)
            for (int k = 0; k <= q; ++k) half[i * (q + 1) + j] += v.matrix[j * (q + 1) + k] * local[i * (q + 1) + k];
    patch.poles.assign((p + 1) * (q + 1), Vector4::Zero());
    for (int i = 0; i <= p; ++i)
        for (int k = 0; k <= p; ++k)
            for (int j = 0; j <= q; ++j)
                patch.poles[i * (q + 1) + j] += u.matrix[i * (p + 1) + k] * half[k * (q + 1) + j];
    if (!patch.rational)
        for (Vector4& pole : patch.poles) pole[3] = 1.0;

    const double units = extraction_units(p, q);
    patch.position_error = units * unit_roundoff * largest;
    patch.weight_error = patch.rational ? units * unit_roundoff * heaviest : 0.0;
    return patch;
}

}  // namespace

double extraction_units(int u_degree, int v_degree) {
    // Matrix entries 6 (p + q), inner products 2 (p + 1) + 2 (q + 1), translation and weighting 2; one more for the
    // second-order terms of these counts, which stay below one unit for every degree up to maximum_degree.
    return 8.0 * (u_degree + v_degree) + 7.0;
}

std::vector<PoleMagnitude> pole_magnitudes(const NurbsSurface& surface, const BezierPatch& patch) {
    const int p = patch.u_degree, q = patch.v_degree;
    const int u = surface.u_knots().span(patch.domain.u.middle()), v = surface.v_knots().span(patch.domain.v.middle());
    const std::vector<double> u_matrix = surface.u_knots().bernstein_matrix(u);
    const std::vector<double> v_matrix = surface.v_knots().bernstein_matrix(v);
    const auto combine = [](const PoleMagnitude& sum, double factor, const PoleMagnitude& part) {
        if (factor == 0.0) return sum;
        return PoleMagnitude{sum.position + factor * part.position, sum.weight + factor * part.weight,
                             std::max(sum.distance, part.distance)};
    };
    std::vector<PoleMagnitude> local((p + 1) * (q + 1)), half(local.size()), result(local.size());
    for (int i = 0; i <= p; ++i)
        for (int j = 0; j <= q; ++j) {
            const double w = surface.weight(u - p + i, v - q + j);
            const double distance = (surface.pole(u - p + i, v - q + j) - patch.origin).cwiseAbs().maxCoeff();
            local[i * (q + 1) + j] = {w * distance, w, distance};
        }
    for (int i = 0; i <= p; ++i)
        for (int j = 0; j <= q; ++j)
            for (int k = 0; k <= q; ++k)
                half[i * (q + 1) + j] =
                    combine(half[i * (q + 1) + j], v_matrix[j * (q + 1) + k], local[i * (q + 1) + k]);
    for (int i = 0; i <= p; ++i)
        for (int k = 0; k <= p; ++k)
            for (int j = 0; j <= q; ++j)
                result[i * (q + 1) + j] =
                    combine(result[i * (q + 1) + j], u_matrix[i * (p + 1) + k], half[k * (q + 1) + j]);
    return result;
}

BezierPatches bezier_patches(const NurbsSurface& surface) {
    const std::vector<Span> u_spans = spans(surface.u_knots());
    const std::vector<Span> v_spans = spans(surface.v_knots());
    BezierPatches result;
    result.u_count = static_cast<int>(u_spans.size());
    result.v_count = static_cast<int>(v_spans.size());
    result.patches.reserve(u_spans.size() * v_spans.size());
    for (const Span& u : u_spans)
        for (const Span& v : v_spans) result.patches.push_back(extract(surface, u, v));
    return result;
}

}  // namespace umbilic
