// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/umbilics/equations.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <string>

#include <umbilic/bernstein/binomials.h>
#include <umbilic/bernstein/rounding.h>
#include <umbilic/umbilics/common_zeros.h>
#include <umbilic/core/errors.h>

namespace umbilic {

namespace {

constexpr std::array<PatchEdge, 4> all_edges = {PatchEdge::u_low, PatchEdge::u_high, PatchEdge::v_low,
                                                PatchEdge::v_high};
constexpr double ulp_of_one = std::numeric_limits<double>::epsilon();

void sum(std::initializer_list<ProductTerm> terms, TensorPolynomial& result) {
    sum_of_products({terms.begin(), terms.size()}, result);
}

/// result = a b - c d, of the smallest bidegree that holds both products.
void difference_of_products(const TensorPolynomial& a, const TensorPolynomial& b, const TensorPolynomial& c,
                            const TensorPolynomial& d, TensorPolynomial& result) {
    const ProductTerm terms[] = {{&a, &b}, {&c, &d, -1.0}};
    sum_of_unequal_products(terms, result);
}

void raise_to_common_degree(TensorPolynomial& a, TensorPolynomial& b) {
    TensorPolynomial* const both[] = {&a, &b};
    umbilic::raise_to_common_degree(both);
}

/// Univariate polynomial on an edge, as a tensor polynomial of degree 0 across it.
TensorPolynomial restriction(const TensorPolynomial& polynomial, PatchEdge edge) {
    const bool across_u = edge == PatchEdge::u_low || edge == PatchEdge::u_high;
    TensorPolynomial result;
    result.set_zero(across_u ? 0 : polynomial.u_degree, across_u ? polynomial.v_degree : 0);
    for (int k = 0; k < static_cast<int>(result.scaled.size()); ++k) {
        const int i = across_u ? (edge == PatchEdge::u_low ? 0 : polynomial.u_degree) : k;
        const int j = across_u ? k : (edge == PatchEdge::v_low ? 0 : polynomial.v_degree);
        result.scaled[k] = polynomial.scaled[i * polynomial.row_length() + j];
    }
    result.bound = polynomial.bound;
    result.measure();
    return result;
}

}  // namespace

InputRounding input_rounding(const NurbsSurface& surface) {
    InputRounding result;
    for (const Vector3& pole : surface.poles())
        result.position = std::max(result.position, ulp_of_one * pole.cwiseAbs().maxCoeff());
    for (const double weight : surface.weights()) result.weight = std::max(result.weight, ulp_of_one * weight);
    return result;
}

EquationScale equation_scale(const BezierPatch& patch) {
    double position = 0.0, weight = 0.0;
    for (const Vector4& pole : patch.poles) {
        position = std::max(position, pole.head<3>().cwiseAbs().maxCoeff());
        weight = std::max(weight, pole[3]);
    }
    return {position > 0.0 ? std::ldexp(1.0, -std::ilogb(position)) : 1.0, std::ldexp(1.0, -std::ilogb(weight))};
}

void UmbilicEquations::load(const BezierPatch& patch, const InputRounding& input) {
    p_ = patch.u_degree;
    q_ = patch.v_degree;
    rational_ = patch.rational;
    const int count = (p_ + 1) * (q_ + 1);
    double position = 0.0, weight = 0.0, lightest = std::numeric_limits<double>::infinity();
    for (const Vector4& pole : patch.poles) {
        position = std::max(position, pole.head<3>().cwiseAbs().maxCoeff());
        weight = std::max(weight, pole[3]);
        lightest = std::min(lightest, pole[3]);
    }
    // Powers of two: exact, and nothing over- or underflows whatever the unit of length.
    const EquationScale scales = equation_scale(patch);
    const double position_input = patch.position_error + weight * input.position + position / lightest * input.weight;
    for (int k = 0; k < 4; ++k) {
        const double scale = k < 3 ? scales.position : scales.weight;
        net_[k].resize(count);
        net_errors_[k].clear();
        net_magnitude_[k] = 0.0;
        for (int at = 0; at < count; ++at) {
            net_[k][at] = patch.poles[at][k] * scale;
            net_magnitude_[k] = std::max(net_magnitude_[k], std::abs(net_[k][at]));
        }
        if (k < 3)
            net_bound_[k] = {patch.position_error * scale, position_input * scale * bound_slack};
        else
            net_bound_[k] = {patch.weight_error * scale, (patch.weight_error + input.weight) * scale * bound_slack};
    }
}

void UmbilicEquations::find_singular_edges() {
    for (const PatchEdge edge : {PatchEdge::u_low, PatchEdge::u_high, PatchEdge::v_low, PatchEdge::v_high}) {
        const auto vanishes_there = [&](const Vector3Polynomial& tangent) {
            return std::all_of(tangent.begin(), tangent.end(), [&](const TensorPolynomial& component) {
                return edge_magnitude(component, edge) <= zero_factor * component.bound.input;
            });
        };
        singular_[static_cast<int>(edge)] = vanishes_there(u_) || vanishes_there(v_);
    }
}

void UmbilicEquations::difference(int k, int u_order, int v_order, double factor, TensorPolynomial& result) const {
    if (p_ < u_order || q_ < v_order) return result.set_zero(0, 0);
    result.set_zero(p_ - u_order, q_ - v_order);
    const double* bu = binomials(result.u_degree);
    const double* bv = binomials(result.v_degree);
    const int row = q_ + 1;
    // Weights of the differences of order 0, 1, 2.
    static constexpr double stencil[3][3] = {{1, 0, 0}, {-1, 1, 0}, {1, -2, 1}};
    for (int i = 0; i <= result.u_degree; ++i)
        for (int j = 0; j <= result.v_degree; ++j) {
            double value = 0.0;
            for (int s = 0; s <= u_order; ++s)
                for (int t = 0; t <= v_order; ++t)
                    value += stencil[u_order][s] * stencil[v_order][t] * net_[k][(i + s) * row + j + t];
            result.scaled[i * result.row_length() + j] = value * factor * (bu[i] * bv[j]);
        }
    // At most four terms (weights 1 or 2), then two products and a product of binomials.
    const double growth = std::ldexp(factor, u_order + v_order);
    const double arithmetic = gamma_bound(6) * net_magnitude_[k];
    result.bound = {growth * (net_bound_[k].rounding + arithmetic) * bound_slack,
                    growth * (net_bound_[k].input + arithmetic) * bound_slack};
    result.measure();
    if (net_errors_[k].empty()) return;
    result.errors.resize(result.scaled.size());
    for (int i = 0; i <= result.u_degree; ++i)
        for (int j = 0; j <= result.v_degree; ++j) {
            double error = 0.0;
            for (int s = 0; s <= u_order; ++s)
                for (int t = 0; t <= v_order; ++t) {
                    const int at = (i + s) * row + j + t;
                    error += std::abs(stencil[u_order][s] * stencil[v_order][t]) *
                             (net_errors_[k][at] + gamma_bound(6) * std::abs(net_[k][at]));
                }
            result.errors[i * result.row_length() + j] = error * factor * (bu[i] * bv[j]) * bound_slack;
        }
}

void UmbilicEquations::sub_net(int k, int u_start, int u_drop, int v_start, int v_drop, double factor,
                               TensorPolynomial& result) const {
    if (p_ < u_drop || q_ < v_drop) return result.set_zero(0, 0);
    result.set_zero(p_ - u_drop, q_ - v_drop);
    const double* bu = binomials(result.u_degree);
    const double* bv = binomials(result.v_degree);
    for (int i = 0; i <= result.u_degree; ++i)
        for (int j = 0; j <= result.v_degree; ++j)
            result.scaled[i * result.row_length() + j] =
                net_[k][(i + u_start) * (q_ + 1) + j + v_start] * factor * (bu[i] * bv[j]);
    const double arithmetic = gamma_bound(3) * net_magnitude_[k];
    result.bound = {factor * (net_bound_[k].rounding + arithmetic) * bound_slack,
                    factor * (net_bound_[k].input + arithmetic) * bound_slack};
    result.measure();
    if (net_errors_[k].empty()) return;
    result.errors.resize(result.scaled.size());
    for (int i = 0; i <= result.u_degree; ++i)
        for (int j = 0; j <= result.v_degree; ++j) {
            const int at = (i + u_start) * (q_ + 1) + j + v_start;
            result.errors[i * result.row_length() + j] =
                (net_errors_[k][at] + gamma_bound(3) * std::abs(net_[k][at])) * factor * (bu[i] * bv[j]) * bound_slack;
        }
}

void UmbilicEquations::form_fundamental(const BezierPatch& patch, const InputRounding& input) {
    load(patch, input);
    form_loaded();
}

void UmbilicEquations::form_fundamental_with_errors(const NurbsSurface& surface, const BezierPatch& patch,
                                                    const InputRounding& input) {
    load(patch, input);
    const EquationScale scales = equation_scale(patch);
    const std::vector<PoleMagnitude> magnitudes = pole_magnitudes(surface, patch);
    const double extraction = extraction_units(p_, q_) * unit_roundoff;
    for (std::vector<double>& errors : net_errors_) errors.resize(magnitudes.size());
    for (std::size_t at = 0; at < magnitudes.size(); ++at) {
        const PoleMagnitude& m = magnitudes[at];
        // A control point moved by input.position, or a weight changed by input.weight, moves the pole by at most:
        const double position = extraction * m.position + m.weight * input.position + m.distance * input.weight;
        for (int k = 0; k < 3; ++k) net_errors_[k][at] = position * scales.position * bound_slack;
        net_errors_[3][at] = rational_ ? (extraction * m.weight + input.weight) * scales.weight * bound_slack : 0.0;
    }
    form_loaded();
}

void UmbilicEquations::form_loaded() {
    if (rational_)
        form_rational();
    else
        form_integral();
    find_singular_edges();
}

void UmbilicEquations::form_integral() {
    const double p = p_, q = q_;
    for (int k = 0; k < 3; ++k) {
        difference(k, 1, 0, p, u_[k]);
        difference(k, 0, 1, q, v_[k]);
        difference(k, 2, 0, p * (p - 1), uu_[k]);
        difference(k, 1, 1, p * q, uv_[k]);
        difference(k, 0, 2, q * (q - 1), vv_[k]);
    }
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        sum({{&u_[i], &v_[j]}, {&u_[j], &v_[i], -1.0}}, normal_[k]);
    }
    const auto dot = [](const Vector3Polynomial& x, const Vector3Polynomial& y, TensorPolynomial& result) {
        sum({{&x[0], &y[0]}, {&x[1], &y[1]}, {&x[2], &y[2]}}, result);
    };
    dot(u_, u_, e_);
    dot(u_, v_, f_);
    dot(v_, v_, g_);
    const auto normal_dot = [&](const Vector3Polynomial& x, bool exists, TensorPolynomial& result) {
        if (exists)
            dot(normal_, x, result);
        else
            result.set_zero(0, 0);
    };
    normal_dot(uu_, p_ > 1, l_);
    normal_dot(uv_, true, m_);
    normal_dot(vv_, q_ > 1, n_);
}

void UmbilicEquations::form_rational() {
    const double p = p_, q = q_;
    // w^2 r_u = w P_u - P w_u = p (w0 X1 - X0 w1) with the halves of the net, likewise for v.
    for (int k = 0; k < 4; ++k) {
        sub_net(k, 0, 1, 0, 0, k == 3 ? p : 1.0, part_[0][k]);
        sub_net(k, 1, 1, 0, 0, k == 3 ? p : 1.0, part_[1][k]);
        sub_net(k, 0, 0, 0, 1, k == 3 ? q : 1.0, part_[2][k]);
        sub_net(k, 0, 0, 1, 1, k == 3 ? q : 1.0, part_[3][k]);
    }
    for (int k = 0; k < 3; ++k) {
        sum({{&part_[0][3], &part_[1][k]}, {&part_[0][k], &part_[1][3], -1.0}}, u_[k]);
        sum({{&part_[2][3], &part_[3][k]}, {&part_[2][k], &part_[3][3], -1.0}}, v_[k]);
    }
    sum({{&u_[0], &u_[0]}, {&u_[1], &u_[1]}, {&u_[2], &u_[2]}}, e_);
    sum({{&u_[0], &v_[0]}, {&u_[1], &v_[1]}, {&u_[2], &v_[2]}}, f_);
    sum({{&v_[0], &v_[0]}, {&v_[1], &v_[1]}, {&v_[2], &v_[2]}}, g_);

    // det(P, P_u, P_v, P_uv) = p^2 q^2 det(P00, P10, P01, P11).
    for (int k = 0; k < 4; ++k) {
        sub_net(k, 0, 1, 0, 1, 1.0, part_[0][k]);
        sub_net(k, 1, 1, 0, 1, p * q, part_[1][k]);
        sub_net(k, 0, 1, 1, 1, 1.0, part_[2][k]);
        sub_net(k, 1, 1, 1, 1, p * q, part_[3][k]);
    }
    determinant(part_[0], part_[1], part_[2], part_[3], m_);

    // det(P, P_u, P_v, P_uu) = -p^2 (p - 1) det(Q0, Q1, Q2, P_v) = p^2 (p - 1) det(Q1, Q0, Q2, P_v).
    if (p_ > 1) {
        for (int k = 0; k < 4; ++k) {
            sub_net(k, 1, 2, 0, 0, p, part_[0][k]);
            sub_net(k, 0, 2, 0, 0, 1.0, part_[1][k]);
            sub_net(k, 2, 2, 0, 0, p * (p - 1), part_[2][k]);
            difference(k, 0, 1, q, part_[3][k]);
        }
        determinant(part_[0], part_[1], part_[2], part_[3], l_);
    } else {
        l_.set_zero(0, 0);
    }
    // det(P, P_u, P_v, P_vv) = q^2 (q - 1) det(R0, R1, R2, P_u).
    if (q_ > 1) {
        for (int k = 0; k < 4; ++k) {
            sub_net(k, 0, 0, 0, 2, q, part_[0][k]);
            sub_net(k, 0, 0, 1, 2, 1.0, part_[1][k]);
            sub_net(k, 0, 0, 2, 2, q * (q - 1), part_[2][k]);
            difference(k, 1, 0, p, part_[3][k]);
        }
        determinant(part_[0], part_[1], part_[2], part_[3], n_);
    } else {
        n_.set_zero(0, 0);
    }
}

void UmbilicEquations::determinant(const Vector4Polynomial& a, const Vector4Polynomial& b, const Vector4Polynomial& c,
                                   const Vector4Polynomial& d, TensorPolynomial& result) {
    // Laplace's expansion by the first two columns.
    static constexpr int pair[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
    for (int k = 0; k < 6; ++k) {
        const auto [i, j] = pair[k];
        sum({{&a[i], &b[j]}, {&a[j], &b[i], -1.0}}, minor_[k]);
        sum({{&c[i], &d[j]}, {&c[j], &d[i], -1.0}}, other_minor_[k]);
    }
    sum({{&minor_[0], &other_minor_[5]},
         {&minor_[1], &other_minor_[4], -1.0},
         {&minor_[2], &other_minor_[3]},
         {&minor_[3], &other_minor_[2]},
         {&minor_[4], &other_minor_[1], -1.0},
         {&minor_[5], &other_minor_[0]}},
        result);
}

bool UmbilicEquations::excluded_by_hulls() const {
    const Interval e = e_.coefficient_hull(), f = f_.coefficient_hull(), g = g_.coefficient_hull();
    const Interval l = l_.coefficient_hull(), m = m_.coefficient_hull(), n = n_.coefficient_hull();
    return !(e * m - f * l).contains(0.0) || !(e * n - g * l).contains(0.0) || !(f * n - g * m).contains(0.0);
}

void UmbilicEquations::form_umbilic() {
    difference_of_products(e_, m_, f_, l_, a_);
    difference_of_products(e_, n_, g_, l_, b_);
    raise_to_common_degree(a_, b_);
}

TensorPolynomial UmbilicEquations::discriminant() const {
    TensorPolynomial a, b, c, result;
    difference_of_products(e_, m_, f_, l_, a);
    difference_of_products(e_, n_, g_, l_, b);
    difference_of_products(f_, n_, g_, m_, c);
    const int degree = std::max({2 * b.u_degree, 2 * b.v_degree, a.u_degree + c.u_degree, a.v_degree + c.v_degree});
    if (degree > maximum_product_degree)
        throw Unsupported("P_N of degree " + std::to_string(degree) + " is above " +
                          std::to_string(maximum_product_degree) + ": search for umbilics by the certified method");
    // Times 4: exact.
    for (double& value : a.scaled) value *= 4.0;
    a.magnitude *= 4.0;
    a.bound = {4.0 * a.bound.rounding, 4.0 * a.bound.input};
    difference_of_products(b, b, a, c, result);
    return result;
}

EdgeEquations UmbilicEquations::edge_equations(PatchEdge edge) const {
    const TensorPolynomial e = restriction(e_, edge), f = restriction(f_, edge), g = restriction(g_, edge);
    const TensorPolynomial l = restriction(l_, edge), m = restriction(m_, edge), n = restriction(n_, edge);
    TensorPolynomial a, b;
    difference_of_products(e, m, f, l, a);
    difference_of_products(e, n, g, l, b);
    raise_to_common_degree(a, b);
    EdgeEquations result;
    result.a.resize(a.scaled.size());
    result.b.resize(b.scaled.size());
    result.a_error = a.bernstein_coefficients(result.a).rounding;
    result.b_error = b.bernstein_coefficients(result.b).rounding;
    return result;
}

bool UmbilicEquations::umbilic(PatchEdge edge) const {
    const bool zero = a_.magnitude <= zero_factor * a_.bound.input && b_.magnitude <= zero_factor * b_.bound.input;
    return !zero && !singular(edge) && edge_magnitude(a_, edge) <= a_.bound.input &&
           edge_magnitude(b_, edge) <= b_.bound.input;
}

void UmbilicEquations::divide_by_edges(const std::array<bool, 4>& edges) {
    for (const PatchEdge edge : {PatchEdge::u_low, PatchEdge::u_high, PatchEdge::v_low, PatchEdge::v_high}) {
        if (!edges[static_cast<int>(edge)]) continue;
        const bool across_u = edge == PatchEdge::u_low || edge == PatchEdge::u_high;
        for (TensorPolynomial* polynomial : {&a_, &b_})
            while ((across_u ? polynomial->u_degree : polynomial->v_degree) > 0 &&
                   polynomial->magnitude > polynomial->bound.input &&
                   edge_magnitude(*polynomial, edge) <= polynomial->bound.input)
                divide_by_edge(*polynomial, edge);
    }
    raise_to_common_degree(a_, b_);
}

void UmbilicEquations::divide_by_poles(const std::array<bool, 4>& edges) {
    for (const PatchEdge edge : all_edges) {
        if (!edges[static_cast<int>(edge)]) continue;
        const PolePowers powers = pole_powers(edge);
        for (int k = 0; k < powers.a; ++k) divide_by_edge(a_, edge);
        for (int k = 0; k < powers.b; ++k) divide_by_edge(b_, edge);
    }
    raise_to_common_degree(a_, b_);
}

bool collapsed(const NurbsSurface& surface, const BezierPatch& patch, PatchEdge edge) {
    const bool across_u = edge == PatchEdge::u_low || edge == PatchEdge::u_high;
    const bool low = edge == PatchEdge::u_low || edge == PatchEdge::v_low;
    const KnotVector& knots = across_u ? surface.u_knots() : surface.v_knots();
    const ParameterInterval &side = across_u ? patch.domain.u : patch.domain.v, domain = knots.domain();
    if (low ? side.low != domain.low : side.high != domain.high) return false;
    const std::vector<double>& k = knots.knots();
    if (low ? k.front() != domain.low : k.back() != domain.high) return false;
    const int rows = surface.u_pole_count(), columns = surface.v_pole_count();
    const auto pole = [&](int at) -> const Vector3& {
        const int i = across_u ? (low ? 0 : rows - 1) : at, j = across_u ? at : (low ? 0 : columns - 1);
        return surface.poles()[static_cast<std::size_t>(i) * columns + j];
    };
    for (int at = 1; at < (across_u ? columns : rows); ++at)
        if (pole(at) != pole(0)) return false;
    return true;
}

PolePowers pole_powers(PatchEdge edge) {
    // With r = p + t c(s) + ... , t the distance: N is of order 1 in t; of E, F, G the one of r_s r_s is of order 2 and
    // F of order 1; of l, m, n that of r_ss is of order 2, m of order 2 since N r_st = t (c' x c) c' + ..., that of
    // r_tt of order 1.
    return edge == PatchEdge::u_low || edge == PatchEdge::u_high ? PolePowers{2, 2} : PolePowers{3, 2};
}

}  // namespace umbilic
