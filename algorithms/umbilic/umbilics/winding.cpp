// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/umbilics/winding.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <umbilic/bernstein/rounding.h>
#include <umbilic/bernstein/subdivision.h>

namespace umbilic {

namespace {

/// Pieces an edge is halved into, one within the other, before it is given up.
constexpr int maximum_depth = 40;

/// An angle farther than this from whole turns (in turns) does not close: rounding errors add up to far less.
constexpr double closure = 1e-3;

struct Curve {
    std::vector<double> a, b;
    double a_error, b_error;
};

std::optional<double> turning(Curve curve, int depth) {
    const int degree = static_cast<int>(curve.a.size()) - 1;
    double a_mean = 0.0, b_mean = 0.0, a_size = 0.0, b_size = 0.0;
    for (int k = 0; k <= degree; ++k) {
        a_mean += curve.a[k];
        b_mean += curve.b[k];
        a_size = std::max(a_size, std::abs(curve.a[k]));
        b_size = std::max(b_size, std::abs(curve.b[k]));
    }
    double least = a_mean * curve.a[0] + b_mean * curve.b[0];
    for (int k = 1; k <= degree; ++k) least = std::min(least, a_mean * curve.a[k] + b_mean * curve.b[k]);
    const double error = (std::abs(a_mean) * (curve.a_error + 3 * unit_roundoff * a_size) +
                          std::abs(b_mean) * (curve.b_error + 3 * unit_roundoff * b_size)) *
                         bound_slack;
    if (least > error) {
        // The whole piece lies in an open half plane: it turns by less than half a turn, told by its ends.
        const double cross = curve.a.front() * curve.b.back() - curve.b.front() * curve.a.back();
        const double dot = curve.a.front() * curve.a.back() + curve.b.front() * curve.b.back();
        return std::atan2(cross, dot);
    }
    if (depth == maximum_depth || (a_size <= curve.a_error && b_size <= curve.b_error)) return std::nullopt;
    Curve first = curve;
    halve_v({0, degree}, curve.a.data(), first.a.data());
    halve_v({0, degree}, curve.b.data(), first.b.data());
    first.a_error = curve.a_error = (curve.a_error + gamma_bound(degree) * a_size) * bound_slack;
    first.b_error = curve.b_error = (curve.b_error + gamma_bound(degree) * b_size) * bound_slack;
    const std::optional<double> low = turning(std::move(first), depth + 1);
    if (!low) return std::nullopt;
    const std::optional<double> high = turning(std::move(curve), depth + 1);
    if (!high) return std::nullopt;
    return *low + *high;
}

}  // namespace

std::optional<double> turning(const EdgeEquations& edge, double u_length, double v_length) {
    Curve curve{edge.a, edge.b, edge.a_error, edge.b_error};
    // One factor for both keeps the ratio; it only avoids extreme sizes.
    const double a_scale = v_length / std::max(u_length, v_length), b_scale = u_length / std::max(u_length, v_length);
    for (double& value : curve.a) value *= a_scale;
    for (double& value : curve.b) value *= b_scale;
    const auto largest = [](const std::vector<double>& c) {
        double result = 0.0;
        for (const double value : c) result = std::max(result, std::abs(value));
        return result;
    };
    curve.a_error = (curve.a_error * a_scale + 2 * unit_roundoff * largest(curve.a)) * bound_slack;
    curve.b_error = (curve.b_error * b_scale + 2 * unit_roundoff * largest(curve.b)) * bound_slack;
    return turning(std::move(curve), 0);
}

namespace {

bool smooth_inside(const KnotVector& knots, const ParameterInterval& interval) {
    for (std::size_t k = 1; k + 1 < knots.breaks().size(); ++k)
        if (interval.low < knots.breaks()[k] && knots.breaks()[k] < interval.high &&
            knots.continuity(static_cast<int>(k)) < 2)
            return false;
    return true;
}

/// The part of `interval` within `piece`, in the piece's own parameter.
ParameterInterval local_part(const ParameterInterval& piece, const ParameterInterval& interval) {
    const auto local = [&](double value) { return std::clamp((value - piece.low) / piece.length(), 0.0, 1.0); };
    return {local(interval.low), local(interval.high)};
}

}  // namespace

std::optional<double> whole_turns(double angle) {
    const double turns = angle / (2 * std::numbers::pi);
    if (std::abs(turns - std::round(turns)) > closure) return std::nullopt;
    return std::round(turns);
}

std::optional<double> rectangle_winding(const NurbsSurface& surface, const BezierPatches& patches,
                                        const InputRounding& input, const ParameterBox& rectangle) {
    if (!smooth_inside(surface.u_knots(), rectangle.u) || !smooth_inside(surface.v_knots(), rectangle.v))
        return std::nullopt;
    UmbilicEquations equations;
    double angle = 0.0;
    for (const BezierPatch& patch : patches.patches) {
        const ParameterBox& domain = patch.domain;
        if (domain.u.low >= rectangle.u.high || domain.u.high <= rectangle.u.low || domain.v.low >= rectangle.v.high ||
            domain.v.high <= rectangle.v.low)
            continue;
        const std::array<bool, 4> on_border = {domain.u.low <= rectangle.u.low, domain.u.high >= rectangle.u.high,
                                               domain.v.low <= rectangle.v.low, domain.v.high >= rectangle.v.high};
        if (!std::any_of(on_border.begin(), on_border.end(), [](bool b) { return b; })) continue;
        equations.form_fundamental(patch, input);
        equations.form_umbilic();
        const ParameterInterval u = local_part(domain.u, rectangle.u), v = local_part(domain.v, rectangle.v);
        const CoefficientShape shape{equations.a().u_degree, equations.a().v_degree};
        std::array<std::vector<double>, 2> c;
        std::array<double, 2> error{};
        for (int k = 0; k < 2; ++k) {
            const TensorPolynomial& polynomial = k == 0 ? equations.a() : equations.b();
            c[k].resize(shape.size());
            error[k] = polynomial.bernstein_coefficients(c[k]).rounding +
                       gamma_bound(6 * (shape.p + shape.q)) * polynomial.magnitude * bound_slack;
            restrict_u(shape, c[k].data(), u.low, u.high);
            restrict_v(shape, c[k].data(), v.low, v.high);
        }
        for (const Edge edge : {Edge::u_low, Edge::u_high, Edge::v_low, Edge::v_high}) {
            if (!on_border[static_cast<int>(edge)]) continue;
            const bool across_u = edge == Edge::u_low || edge == Edge::u_high;
            const int degree = across_u ? shape.q : shape.p;
            EdgeEquations pair;
            pair.a_error = error[0];
            pair.b_error = error[1];
            for (int k = 0; k <= degree; ++k) {
                const int i = across_u ? (edge == Edge::u_low ? 0 : shape.p) : k;
                const int j = across_u ? k : (edge == Edge::v_low ? 0 : shape.q);
                pair.a.push_back(c[0][i * shape.row_length() + j]);
                pair.b.push_back(c[1][i * shape.row_length() + j]);
            }
            const std::optional<double> part = turning(pair, domain.u.length(), domain.v.length());
            if (!part) return std::nullopt;
            angle += edge == Edge::v_low || edge == Edge::u_high ? *part : -*part;
        }
    }
    return whole_turns(angle);
}

}  // namespace umbilic
