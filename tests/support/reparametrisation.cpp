// SPDX-License-Identifier: LGPL-2.1-or-later
#include <support/reparametrisation.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/LU>

#include <umbilic/core/errors.h>

namespace umbilic::support {

namespace {

using Real = long double;
using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

/// Weights with which the control points span - degree ... span make the polar form of that span at the arguments.
std::vector<Real> polar_weights(const KnotVector& knots, int span, const std::vector<Real>& arguments) {
    const int p = knots.degree();
    const std::vector<double>& t = knots.knots();
    Matrix d = Matrix::Identity(p + 1, p + 1);
    for (int level = 1; level <= p; ++level)
        for (int i = p; i >= level; --i) {
            const Real low = t[span - p + i], high = t[span + 1 + i - level];
            const Real share = (arguments[level - 1] - low) / (high - low);
            d.row(i) = (1 - share) * d.row(i - 1) + share * d.row(i);
        }
    std::vector<Real> result(p + 1);
    for (int k = 0; k <= p; ++k) result[k] = d(p, k);
    return result;
}

/// The end points' values of a linear function over the domain.
struct Linear {
    Real low = 1, high = 1;
};

/// Takes control points over `from` to those of the same function over `to`. If `to` is one degree higher, the function
/// is also multiplied by `factor` (1: degree elevation). `to` must hold the knots of `from` within its own domain.
Matrix control_point_map(const KnotVector& from, const KnotVector& to, const Linear& factor = {}) {
    const std::vector<double>& t = to.knots();
    const ParameterInterval domain = from.domain();
    Matrix result = Matrix::Zero(to.pole_count(), from.pole_count());
    for (int i = 0; i < to.pole_count(); ++i) {
        std::vector<int> spans;
        for (int k = std::max(i, to.degree()); k <= std::min(i + to.degree(), to.pole_count() - 1); ++k)
            if (t[k] < t[k + 1]) spans.push_back(k);
        const int k = spans[spans.size() / 2];
        const int span = from.span(0.5 * (t[k] + t[k + 1]));
        const auto add = [&](const std::vector<Real>& arguments, Real share) {
            const std::vector<Real> weights = polar_weights(from, span, arguments);
            for (int j = 0; j <= from.degree(); ++j) result(i, span - from.degree() + j) += share * weights[j];
        };
        const std::vector<Real> arguments(t.begin() + i + 1, t.begin() + i + 1 + to.degree());
        if (to.degree() == from.degree()) {
            add(arguments, 1);
            continue;
        }
        // Polar form of a product with a linear function: the mean over the argument that the latter takes.
        for (int j = 0; j < to.degree(); ++j) {
            std::vector<Real> rest = arguments;
            rest.erase(rest.begin() + j);
            const Real x = (arguments[j] - Real(domain.low)) / (Real(domain.high) - Real(domain.low));
            add(rest, ((1 - x) * factor.low + x * factor.high) / to.degree());
        }
    }
    return result;
}

/// Homogeneous control points under a map along u and one along v.
NurbsSurface mapped(const NurbsSurface& surface, KnotVector u_knots, KnotVector v_knots, const Matrix& u_map,
                    const Matrix& v_map) {
    std::array<Matrix, 4> net;
    for (int k = 0; k < 4; ++k) {
        Matrix old(surface.u_pole_count(), surface.v_pole_count());
        for (int i = 0; i < old.rows(); ++i)
            for (int j = 0; j < old.cols(); ++j)
                old(i, j) = Real(surface.weight(i, j)) * (k == 3 ? Real(1) : Real(surface.pole(i, j)[k]));
        net[k] = u_map * old * v_map.transpose();
    }
    // The rows of both maps sum to 1 unless a factor came in: then the surface is rational.
    bool rational = surface.rational();
    std::vector<Vector3> poles;
    std::vector<double> weights;
    for (int i = 0; i < net[3].rows(); ++i)
        for (int j = 0; j < net[3].cols(); ++j) {
            const Real w = net[3](i, j);
            poles.emplace_back(static_cast<double>(net[0](i, j) / w), static_cast<double>(net[1](i, j) / w),
                               static_cast<double>(net[2](i, j) / w));
            weights.push_back(static_cast<double>(w));
            rational = rational || weights.back() != 1.0;
        }
    if (!rational) weights.clear();
    return NurbsSurface(std::move(u_knots), std::move(v_knots), std::move(poles), std::move(weights));
}

/// Clamped knots over `range` with the interior knots of the given ones.
KnotVector clamped(const KnotVector& knots, const ParameterInterval& range) {
    std::vector<double> result(knots.degree() + 1, range.low);
    for (const double t : knots.knots())
        if (range.low < t && t < range.high) result.push_back(t);
    result.insert(result.end(), knots.degree() + 1, range.high);
    return KnotVector(knots.degree(), std::move(result));
}

NurbsSurface clamped(const NurbsSurface& surface) {
    return restricted(surface, surface.domain());
}

int multiplicity(const std::vector<double>& knots, double t) {
    return static_cast<int>(std::count(knots.begin(), knots.end(), t));
}

KnotVector inserted(const KnotVector& knots, std::span<const double> parameters) {
    std::vector<double> result = knots.knots();
    for (const double t : parameters)
        if (multiplicity(result, t) < knots.degree())
            result.insert(std::upper_bound(result.begin(), result.end(), t), t);
    return KnotVector(knots.degree(), std::move(result));
}

NurbsSurface on_knots(const NurbsSurface& surface, const KnotVector& u, const KnotVector& v,
                      const Linear& u_factor = {}, const Linear& v_factor = {}) {
    return mapped(surface, u, v, control_point_map(surface.u_knots(), u, u_factor),
                  control_point_map(surface.v_knots(), v, v_factor));
}

KnotVector raised(const KnotVector& knots) {
    std::vector<double> result;
    for (std::size_t i = 0; i < knots.knots().size(); ++i) {
        result.push_back(knots.knots()[i]);
        if (i + 1 == knots.knots().size() || knots.knots()[i + 1] != knots.knots()[i])
            result.push_back(knots.knots()[i]);
    }
    return KnotVector(knots.degree() + 1, std::move(result));
}

Vector2 kept(const Vector2& at) {
    return at;
}

double backwards(const ParameterInterval& domain, double t) {
    return domain.low + domain.high - t;
}

/// New parameter of the old one, and the factors of the control points' weights.
struct MoebiusMap {
    ParameterInterval domain;
    double ratio;

    double operator()(double t) const {
        const double x = (t - domain.low) / domain.length();
        return domain.low + domain.length() * (ratio * x / (1 + (ratio - 1) * x));
    }
    KnotVector knots(const KnotVector& old) const {
        std::vector<double> result;
        for (const double t : old.knots()) result.push_back(t == domain.low || t == domain.high ? t : (*this)(t));
        return KnotVector(old.degree(), std::move(result));
    }
    /// Product of the denominators s + ratio (1 - s) over the knots of a control point's polar form.
    double weight(const KnotVector& old, int pole) const {
        Real result = 1;
        for (int j = 1; j <= old.degree(); ++j) {
            const Real x = (Real(old.knots()[pole + j]) - domain.low) / (Real(domain.high) - domain.low);
            result *= ratio / (1 + (Real(ratio) - 1) * x);
        }
        return static_cast<double>(result);
    }
};

std::vector<double> greville(const KnotVector& knots) {
    std::vector<double> result;
    for (int i = 0; i < knots.pole_count(); ++i) {
        double sum = 0.0;
        for (int j = 1; j <= knots.degree(); ++j) sum += knots.knots()[i + j];
        result.push_back(knots.domain().clamp(sum / knots.degree()));
    }
    return result;
}

KnotVector uniform(const ParameterInterval& domain, int degree, int poles) {
    std::vector<double> knots(degree + 1, domain.low);
    for (int i = 1; i < poles - degree; ++i) knots.push_back(domain.low + domain.length() * i / (poles - degree));
    knots.insert(knots.end(), degree + 1, domain.high);
    return KnotVector(degree, std::move(knots));
}

/// Inverse of the values of all basis functions at the Greville abscissae.
Eigen::MatrixXd interpolation(const KnotVector& knots) {
    const std::vector<double> at = greville(knots);
    Eigen::MatrixXd values = Eigen::MatrixXd::Zero(knots.pole_count(), knots.pole_count());
    std::vector<double> basis(knots.degree() + 1);
    for (std::size_t i = 0; i < at.size(); ++i) {
        const int span = knots.span(at[i]);
        knots.basis(span, at[i], 0, basis.data());
        for (int k = 0; k <= knots.degree(); ++k) values(static_cast<int>(i), span - knots.degree() + k) = basis[k];
    }
    return values.partialPivLu().inverse();
}

}  // namespace

Reparametrised exchanged(const NurbsSurface& surface) {
    return {surface.swapped(), [](const Vector2& at) { return Vector2(at.y(), at.x()); }};
}

Reparametrised u_backwards(const NurbsSurface& surface) {
    const ParameterInterval u = surface.domain().u;
    return {surface.u_reversed(), [u](const Vector2& at) { return Vector2(backwards(u, at.x()), at.y()); }};
}

Reparametrised v_backwards(const NurbsSurface& surface) {
    const ParameterInterval v = surface.domain().v;
    return {surface.swapped().u_reversed().swapped(),
            [v](const Vector2& at) { return Vector2(at.x(), backwards(v, at.y())); }};
}

Reparametrised elevated(const NurbsSurface& surface, int u_raise, int v_raise) {
    NurbsSurface result = clamped(surface);
    for (; u_raise > 0; --u_raise) result = on_knots(result, raised(result.u_knots()), result.v_knots());
    for (; v_raise > 0; --v_raise) result = on_knots(result, result.u_knots(), raised(result.v_knots()));
    return {std::move(result), kept};
}

Reparametrised with_knots(const NurbsSurface& surface, std::span<const double> u, std::span<const double> v) {
    const NurbsSurface old = clamped(surface);
    return {on_knots(old, inserted(old.u_knots(), u), inserted(old.v_knots(), v)), kept};
}

Reparametrised in_bezier_form(const NurbsSurface& surface) {
    const auto everywhere = [](const KnotVector& knots) {
        std::vector<double> interior(knots.breaks().begin() + 1, knots.breaks().end() - 1);
        interior.push_back(knots.domain().middle());
        std::vector<double> result;
        for (int k = 0; k < knots.degree(); ++k) result.insert(result.end(), interior.begin(), interior.end());
        return result;
    };
    return with_knots(surface, everywhere(surface.u_knots()), everywhere(surface.v_knots()));
}

Reparametrised with_common_factor(const NurbsSurface& surface, double u_ratio, double v_ratio) {
    const NurbsSurface old = clamped(surface);
    return {on_knots(old, raised(old.u_knots()), raised(old.v_knots()), {1, u_ratio}, {1, v_ratio}), kept};
}

Reparametrised moebius(const NurbsSurface& surface, double u_ratio, double v_ratio) {
    const NurbsSurface old = clamped(surface);
    const MoebiusMap u{old.domain().u, u_ratio}, v{old.domain().v, v_ratio};
    std::vector<double> weights;
    for (int i = 0; i < old.u_pole_count(); ++i)
        for (int j = 0; j < old.v_pole_count(); ++j)
            weights.push_back(old.weight(i, j) * u.weight(old.u_knots(), i) * v.weight(old.v_knots(), j));
    return {NurbsSurface(u.knots(old.u_knots()), v.knots(old.v_knots()), old.poles(), std::move(weights)),
            [u, v](const Vector2& at) { return Vector2(u(at.x()), v(at.y())); }, false};
}

Reparametrised rejoined(const NurbsSurface& surface) {
    const ParameterInterval domain = surface.domain().u;
    const double cut = domain.low + 0.4 * domain.length();
    const auto stretched = [cut](double u) { return u <= cut ? u : cut + 2 * (u - cut); };
    const NurbsSurface joint = with_knots(surface, std::vector<double>(surface.u_degree(), cut), {}).surface;
    std::vector<double> knots;
    for (const double t : joint.u_knots().knots()) knots.push_back(stretched(t));
    return {
        NurbsSurface(KnotVector(joint.u_degree(), std::move(knots)), joint.v_knots(), joint.poles(), joint.weights()),
        [stretched](const Vector2& at) { return Vector2(stretched(at.x()), at.y()); }, false, cut};
}

NurbsSurface restricted(const NurbsSurface& surface, const ParameterBox& box) {
    return on_knots(surface, clamped(surface.u_knots(), box.u), clamped(surface.v_knots(), box.v));
}

Reapproximated reapproximated(const NurbsSurface& surface, int degree, double deviation) {
    for (int poles = 2 * degree; poles <= 256; poles *= 2) {
        const KnotVector u = uniform(surface.domain().u, degree, poles), v = uniform(surface.domain().v, degree, poles);
        const std::vector<double> u_at = greville(u), v_at = greville(v);
        const Eigen::MatrixXd u_inverse = interpolation(u), v_inverse = interpolation(v);
        std::array<Eigen::MatrixXd, 3> net;
        for (Eigen::MatrixXd& values : net) values.resize(poles, poles);
        for (int i = 0; i < poles; ++i)
            for (int j = 0; j < poles; ++j) {
                const Vector3 point = surface.value(u_at[i], v_at[j]);
                for (int k = 0; k < 3; ++k) net[k](i, j) = point[k];
            }
        for (Eigen::MatrixXd& values : net) values = u_inverse * values * v_inverse.transpose();
        std::vector<Vector3> control;
        for (int i = 0; i < poles; ++i)
            for (int j = 0; j < poles; ++j) control.emplace_back(net[0](i, j), net[1](i, j), net[2](i, j));
        Reapproximated result{NurbsSurface(u, v, std::move(control))};
        const int grid = 5 * poles;
        const ParameterBox domain = surface.domain();
        for (int i = 0; i <= grid; ++i)
            for (int j = 0; j <= grid; ++j) {
                const double s = domain.u.low + domain.u.length() * i / grid,
                             t = domain.v.low + domain.v.length() * j / grid;
                result.deviation =
                    std::max(result.deviation, (result.surface.value(s, t) - surface.value(s, t)).norm());
            }
        if (result.deviation <= deviation) return result;
    }
    throw NumericFailure("256 x 256 poles of degree " + std::to_string(degree) + " do not come within " +
                         std::to_string(deviation) + " mm of the surface; allow more");
}

}  // namespace umbilic::support
