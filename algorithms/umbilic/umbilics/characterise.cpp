// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/umbilics/characterise.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include <umbilic/bernstein/rounding.h>
#include <umbilic/differential/fundamental_forms.h>
#include <umbilic/umbilics/sensitivity.h>

namespace umbilic {

namespace {

double place(const ParameterInterval& interval, double local) {
    return interval.low + local * interval.length();
}

/// Rounding of a parameter formed from a local one, absolute.
double parameter_rounding(const ParameterInterval& interval) {
    return 4 * unit_roundoff * (std::abs(interval.low) + std::abs(interval.high));
}

/// Distance from a knot line, relative to the domain's side, below which an umbilic is taken to lie on it: surfaces
/// that are meant to be the same differ by this much after an exchange of files.
constexpr double knot_reach = 1e-6;
/// Factor that covers what is of second order in the displacement, for as long as the metric changes by less than
/// `greatest_metric_change`.
constexpr double second_order = 2.0;
constexpr double greatest_metric_change = 0.1;

double diagonal(const BezierPatch& patch) {
    BoundingBox box;
    for (const Vector4& pole : patch.poles) box.add(Vector3(pole.head<3>() / pole[3]));
    return box.diagonal();
}

/// Displacement (mm) of the control points that stands for all rounding: of the input, of the weights, and of an
/// evaluation, which sums (p + 1)(q + 1) products of rounded numbers.
double rounding_displacement(const BezierPatch& patch, const InputRounding& input) {
    double result = (2 * (patch.u_degree + patch.v_degree) + 5) * input.position;
    if (patch.rational) {
        double lightest = patch.poles[0][3];
        for (const Vector4& pole : patch.poles) lightest = std::min(lightest, pole[3]);
        // A change of one weight moves the surface as a displacement of its control point towards the surface does.
        result += input.weight / lightest * diagonal(patch);
    }
    return result;
}

/// The error of a cubic form as a function of the control points' displacement. To first order it is cubic * t; the
/// umbilic's way, part of it, grows as the umbilic comes nearer to |omega| = 1, where the derivative of the traceless
/// second form, of least singular value 2 ||alpha| - |beta||, becomes singular. An error e of the form takes at most
/// e (1 + 1 / sqrt(3)) / 2 from it.
class CubicError {
public:
    /// `at_rest`: error without any displacement.
    CubicError(const UmbilicSensitivity& sensitivity, const Cubic& cubic, double at_rest)
        : growth_(second_order * sensitivity.cubic),
          metric_(sensitivity.metric),
          at_rest_(at_rest),
          // 8 alpha and 8 beta stand in the denominator.
          loss_(2 * (1 + 1 / std::sqrt(3.0)) /
                std::abs(std::hypot(cubic.a - 3 * cubic.c, cubic.d - 3 * cubic.b) -
                         std::hypot(cubic.a + cubic.c, cubic.b + cubic.d))) {}

    /// Solves e = at_rest + growth t / (1 - loss e).
    double of(double displacement) const {
        const double sum = at_rest_ + growth_ * displacement, linear = 1 + loss_ * at_rest_;
        const double root = linear * linear - 4 * loss_ * sum;
        if (!(root >= 0.0)) return std::numeric_limits<double>::infinity();
        return 2 * sum / (linear + std::sqrt(root));
    }

    /// The displacement at which the error reaches `error`.
    double displacement(double error) const {
        const double e = std::min(error, (1 + loss_ * at_rest_) / (2 * loss_));
        if (!(e > at_rest_) || !std::isfinite(growth_)) return 0.0;
        return std::min((e - at_rest_) * (1 - loss_ * e) / growth_, greatest_metric_change / metric_);
    }

private:
    double growth_, metric_, at_rest_, loss_;
};

/// The break within `reach` of u across which third derivatives jump, if there is one. Across breaks of lower
/// continuity the umbilic belongs to one side only.
std::optional<double> jump_near(const KnotVector& knots, double u, double reach) {
    for (std::size_t k = 1; k + 1 < knots.breaks().size(); ++k)
        if (std::abs(knots.breaks()[k] - u) <= reach && knots.continuity(static_cast<int>(k)) == 2)
            return knots.breaks()[k];
    return std::nullopt;
}

/// Fills in curvature, cubic form and class from the derivatives of one polynomial piece, with their errors.
/// `distance`: proved distance (mm) from the umbilic; `relative`: relative error of the form on top of the rest.
void classify_piece(const SurfaceDerivatives& d, const UmbilicSensitivity& sensitivity, double distance,
                    double displacement, double relative, Umbilic& umbilic) {
    const auto [E, F, G] = first_form(d);
    const auto [L, M, N] = second_form(d);
    umbilic.kappa = -(E * N + G * L - 2 * F * M) / (2 * (E * G - F * F));
    umbilic.cubic = monge_form(d).cubic;
    if (!std::isfinite(sensitivity.cubic) || sensitivity.metric * displacement > greatest_metric_change) {
        umbilic.kappa_error = umbilic.cubic_error = std::numeric_limits<double>::infinity();
        umbilic.kind = classify(umbilic.cubic, 1.0);
        return;
    }
    const double norm = std::sqrt(umbilic.cubic.squared_norm());
    umbilic.kappa_error = second_order * sensitivity.kappa * displacement + sensitivity.kappa_slope * distance;
    const CubicError error(sensitivity, umbilic.cubic, sensitivity.cubic_slope * distance + relative * norm);
    umbilic.cubic_error = error.of(displacement);
    umbilic.kind = classify(umbilic.cubic, norm > 0.0 ? std::min(1.0, umbilic.cubic_error / norm) : 1.0);
    if (umbilic.kind.type != UmbilicType::non_generic) umbilic.margin = error.displacement(umbilic.kind.margin * norm);
}

/// Widens the errors and the class so that they cover another piece's as well.
void cover(Umbilic& umbilic, const Umbilic& other) {
    const Cubic difference{umbilic.cubic.a - other.cubic.a, umbilic.cubic.b - other.cubic.b,
                           umbilic.cubic.c - other.cubic.c, umbilic.cubic.d - other.cubic.d};
    umbilic.cubic_error = std::max(umbilic.cubic_error, std::sqrt(difference.squared_norm()) + other.cubic_error);
    umbilic.kappa_error = std::max(umbilic.kappa_error, other.kappa_error);

    UmbilicClass& kind = umbilic.kind;
    std::vector<GenericType> types = kind.possible_types();
    const std::vector<GenericType> more = other.kind.possible_types();
    types.insert(types.end(), more.begin(), more.end());
    std::sort(types.begin(), types.end());
    types.erase(std::unique(types.begin(), types.end()), types.end());
    if (types.size() > 1) {
        kind.type = UmbilicType::non_generic;
        kind.star = StarKind::none;
        kind.neighbours = std::move(types);
    }
    umbilic.margin = kind.type == UmbilicType::non_generic ? 0.0 : std::min(umbilic.margin, other.margin);
    if (kind.ridges != other.kind.ridges) kind.ridges.reset();
    kind.margin = std::min(kind.margin, other.kind.margin);
    const ClassUncertainty& outer = other.kind.uncertainty;
    kind.uncertainty.delta = std::max(kind.uncertainty.delta, std::abs(kind.delta - other.kind.delta) + outer.delta);
    kind.uncertainty.zeta = std::max(kind.uncertainty.zeta, std::abs(kind.zeta - other.kind.zeta) + outer.zeta);
    if (kind.uncertainty.omega && outer.omega)
        kind.uncertainty.omega =
            std::max(*kind.uncertainty.omega, omega_distance(*kind.omega, *other.kind.omega) + *outer.omega);
    else
        kind.uncertainty.omega.reset();
}

}  // namespace

std::optional<Umbilic> characterise(const NurbsSurface& surface, const BezierPatch& patch, const IsolatedZero& zero,
                                    const InputRounding& input, const InputAccuracy& accuracy) {
    const ParameterBox& domain = patch.domain;
    const ParameterBox whole = surface.domain();
    Umbilic result;
    result.at.u = domain.u.clamp(place(domain.u, zero.at.x()));
    result.at.v = domain.v.clamp(place(domain.v, zero.at.y()));
    const Side u_side = result.at.u >= domain.u.high ? Side::left : Side::right;
    const Side v_side = result.at.v >= domain.v.high ? Side::left : Side::right;
    const SurfaceDerivatives d = surface.derivatives(result.at.u, result.at.v, 3, u_side, v_side);
    if (!regular(d)) return std::nullopt;

    // A and B vanish also where the normal does, which is no umbilic: it must not where the zero of any surface that
    // rounds to this one may lie.
    const Vector3 normal_u = d.r_uu().cross(d.r_v()) + d.r_u().cross(d.r_uv());
    const Vector3 normal_v = d.r_uv().cross(d.r_v()) + d.r_u().cross(d.r_vv());
    const double normal_change = zero.input_radius.x() * domain.u.length() * normal_u.norm() +
                                 zero.input_radius.y() * domain.v.length() * normal_v.norm();
    if (!(d.r_u().cross(d.r_v()).norm() > second_order * normal_change)) return std::nullopt;

    result.point = d.r();
    const MongeForm monge = monge_form(d);
    result.normal = monge.normal;
    result.x_axis = monge.x;
    result.index = 0.5 * zero.sign;

    // A zero outside the patch by less than its radius is moved onto the edge, by no more than the radius again.
    const double u_radius = (zero.radius.x() * domain.u.length() + parameter_rounding(domain.u)) * bound_slack;
    const double v_radius = (zero.radius.y() * domain.v.length() + parameter_rounding(domain.v)) * bound_slack;
    const double u_moved = std::max({0.0, zero.at.x() - 1.0, -zero.at.x()}) * domain.u.length();
    const double v_moved = std::max({0.0, zero.at.y() - 1.0, -zero.at.y()}) * domain.v.length();
    result.radius = std::max((u_radius + u_moved) / whole.u.length(), (v_radius + v_moved) / whole.v.length());
    result.box = {{place(domain.u, zero.box.u.low), place(domain.u, zero.box.u.high)},
                  {place(domain.v, zero.box.v.low), place(domain.v, zero.box.v.high)}};
    result.certified = true;

    const auto [E, F, G] = first_form(d);
    const double distance = (u_radius + u_moved) * std::sqrt(E) + (v_radius + v_moved) * std::sqrt(G);
    const double displacement = rounding_displacement(patch, input) + accuracy.displacement;
    const UmbilicSensitivity sensitivity = umbilic_sensitivity(surface, result.at.u, result.at.v, u_side, v_side);
    classify_piece(d, sensitivity, distance, displacement, accuracy.cubic, result);
    for (const double angle : result.kind.angles)
        result.directions.push_back(std::cos(angle) * monge.x + std::sin(angle) * monge.y);

    const double way = second_order * sensitivity.way * displacement / std::sqrt(E * G - F * F);
    const std::optional<double> u_jump = jump_near(
        surface.u_knots(), result.at.u, u_radius + u_moved + way * std::sqrt(G) + knot_reach * whole.u.length());
    const std::optional<double> v_jump = jump_near(
        surface.v_knots(), result.at.v, v_radius + v_moved + way * std::sqrt(E) + knot_reach * whole.v.length());
    result.on_knot_line = u_jump || v_jump;
    for (const Side u_other : {Side::left, Side::right})
        for (const Side v_other : {Side::left, Side::right}) {
            if ((!u_jump && u_other != u_side) || (!v_jump && v_other != v_side)) continue;
            Umbilic other;
            const double u = u_jump.value_or(result.at.u), v = v_jump.value_or(result.at.v);
            classify_piece(surface.derivatives(u, v, 3, u_other, v_other),
                           umbilic_sensitivity(surface, u, v, u_other, v_other), distance, displacement, accuracy.cubic,
                           other);
            cover(result, other);
        }
    // A bound above the curvature of a sphere of the patch's own size says nothing.
    result.flat = std::abs(result.kappa) <= result.kappa_error && result.kappa_error * diagonal(patch) <= 1.0;
    return result;
}

}  // namespace umbilic
