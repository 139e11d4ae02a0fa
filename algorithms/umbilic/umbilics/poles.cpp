// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/umbilics/poles.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <Eigen/QR>

#include <umbilic/bernstein/rounding.h>
#include <umbilic/differential/fundamental_forms.h>
#include <umbilic/umbilics/certificate.h>

namespace umbilic {

namespace {

constexpr double pi = std::numbers::pi;

/// Width of the strip between pole and circle that is tried, relative to the row of patches at the pole.
constexpr std::array<double, 4> circle_shares = {0.125, 0.03125, 0.0078125, 0.001953125};
/// Angle (radians) by which the normals of the meridians may differ at a pole of a smooth surface, and by which its
/// meridians may fail to close.
constexpr double smooth_angle = 1e-6;
/// Meridians looked at in each patch.
constexpr int meridians_per_patch = 5;
/// Multiple of the bound from the input's rounding below which numbers at a pole are noise, as in the search.
constexpr double noise_factor = 16.0;
/// A cubic form must fit the third derivatives of all meridians to this accuracy, relative to itself.
constexpr double cubic_fit = 1e-6;
/// Steps in which the change of a frame is followed.
constexpr int frame_steps = 32;

bool across_u(PatchEdge edge) {
    return edge == PatchEdge::u_low || edge == PatchEdge::u_high;
}

bool low_end(PatchEdge edge) {
    return edge == PatchEdge::u_low || edge == PatchEdge::v_low;
}

double turn_between(const Vector2& from, const Vector2& to) {
    return std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to));
}

/// One meridian at the pole: derivatives by the distance from the pole in the parameter across.
struct Meridian {
    Vector3 first, second, third, normal;
};

struct PoleGeometry {
    Vector3 point = Vector3::Zero(), normal = Vector3::UnitZ(), x = Vector3::UnitX(), y = Vector3::UnitY();
    bool smooth = false;
    double sweep = 0.0;  ///< angle of the meridians' tangents around the normal
    bool umbilic = false;
    double kappa = 0.0, kappa_error = 0.0;
    double cubic_error = 0.0;
    Cubic cubic;  ///< zero where it is within noise or the meridians fit no cubic form
    bool generic = false;
};

/// The patches along a side, in the direction of growing parameter.
struct Row {
    PatchEdge edge;
    const NurbsSurface& surface;
    const BezierPatches& patches;
    PatchRange range;

    int first() const { return across_u(edge) ? range.v_first : range.u_first; }
    int last() const { return across_u(edge) ? range.v_last : range.u_last; }
    std::size_t number(int k) const {
        const int at = low_end(edge) ? (across_u(edge) ? range.u_first : range.v_first)
                                     : (across_u(edge) ? range.u_last : range.v_last) - 1;
        return across_u(edge) ? static_cast<std::size_t>(at) * patches.v_count + k
                              : static_cast<std::size_t>(k) * patches.v_count + at;
    }
    const ParameterBox& domain(int k) const { return patches.patches[number(k)].domain; }
    ParameterInterval along(int k) const { return across_u(edge) ? domain(k).v : domain(k).u; }
    ParameterInterval across() const { return across_u(edge) ? domain(first()).u : domain(first()).v; }
    double pole() const { return low_end(edge) ? across().low : across().high; }
    Vector2 at(double along, double across) const {
        return across_u(edge) ? Vector2(across, along) : Vector2(along, across);
    }
};

Meridian meridian(const Row& row, int k, double along) {
    const Side side = along >= row.along(k).high ? Side::left : Side::right;
    const Side inward = low_end(row.edge) ? Side::right : Side::left;
    const Vector2 at = row.at(along, row.pole());
    const bool u = across_u(row.edge);
    const SurfaceDerivatives d = row.surface.derivatives(at.x(), at.y(), 3, u ? inward : side, u ? side : inward);
    const double sign = low_end(row.edge) ? 1.0 : -1.0;
    const auto across = [&](int order) { return u ? d(order, 0) : d(0, order); };
    Meridian result{sign * across(1), across(2), sign * across(3), Vector3::Zero()};
    // Beside the pole r_u is r_uv times the distance (v the parameter across).
    const Vector3 parallel = sign * d.r_uv();
    const Vector3 normal = u ? Vector3(across(1).cross(parallel)) : Vector3(parallel.cross(across(1)));
    if (normal.norm() > regularity * parallel.norm() * across(1).norm()) result.normal = normal.normalized();
    return result;
}

/// Bound on the error of second and third derivatives of a meridian from the rounding of the control points.
double derivative_noise(const Row& row, const InputRounding& input, int order) {
    const int degree = across_u(row.edge) ? row.surface.u_degree() : row.surface.v_degree();
    double lightest = 1.0, heaviest = 1.0;
    if (row.surface.rational()) {
        const auto [low, high] = std::minmax_element(row.surface.weights().begin(), row.surface.weights().end());
        lightest = *low;
        heaviest = *high;
    }
    const double terms = 2.0 * (row.surface.u_degree() + row.surface.v_degree()) + 4;
    double factor = terms * input.position * heaviest / lightest;
    for (int k = 0; k < order; ++k) factor *= 2.0 * std::max(degree - k, 1) / row.across().length();
    return factor;
}

PoleGeometry look_at(const Row& row, const InputRounding& input) {
    PoleGeometry result;
    std::vector<Meridian> meridians;
    for (int k = row.first(); k < row.last(); ++k)
        for (int s = 0; s < meridians_per_patch; ++s)
            meridians.push_back(
                meridian(row, k, row.along(k).low + s * row.along(k).length() / (meridians_per_patch - 1)));
    const Vector2 at = row.at(row.along(row.first()).low, row.pole());
    result.point = row.surface.value(at.x(), at.y());
    result.normal = meridians.front().normal;
    for (const Meridian& m : meridians) {
        if (m.normal.isZero() || (m.normal - result.normal).norm() > smooth_angle) return result;
        if (std::abs(m.first.dot(result.normal)) > smooth_angle * m.first.norm()) return result;
    }
    result.smooth = true;
    result.x = (meridians.front().first - meridians.front().first.dot(result.normal) * result.normal).normalized();
    result.y = result.normal.cross(result.x);
    const auto plane = [&](const Vector3& vector) { return Vector2(vector.dot(result.x), vector.dot(result.y)); };
    for (std::size_t k = 1; k < meridians.size(); ++k)
        result.sweep += turn_between(plane(meridians[k - 1].first), plane(meridians[k].first));

    const double second_noise = derivative_noise(row, input, 2), first_noise = derivative_noise(row, input, 1);
    double low = 0.0, high = 0.0, noise = 0.0;
    for (std::size_t k = 0; k < meridians.size(); ++k) {
        const double squared = meridians[k].first.squaredNorm();
        const double kappa = -result.normal.dot(meridians[k].second) / squared;
        low = k == 0 ? kappa : std::min(low, kappa);
        high = k == 0 ? kappa : std::max(high, kappa);
        noise = std::max(noise, (second_noise + 2 * std::abs(kappa) * std::sqrt(squared) * first_noise +
                                 meridians[k].second.norm() * first_noise / std::sqrt(squared)) /
                                    squared);
    }
    result.kappa = 0.5 * low + 0.5 * high;
    result.umbilic = high - low <= noise_factor * noise;
    result.kappa_error = noise_factor * noise;
    if (!result.umbilic) return result;

    // The third derivative of the height of a meridian p1 w + p2 w^2 / 2 + ... is C(p1) - 3 kappa p1 . p2.
    Eigen::MatrixXd matrix(meridians.size(), 4);
    Eigen::VectorXd values(meridians.size());
    double cubic_noise = 0.0;
    for (std::size_t k = 0; k < meridians.size(); ++k) {
        const Vector2 first = plane(meridians[k].first), second = plane(meridians[k].second);
        const double length = first.norm(), x = first.x() / length, y = first.y() / length;
        matrix.row(k) << x * x * x, 3 * x * x * y, 3 * x * y * y, y * y * y;
        const double scale = 1.0 / (length * length * length);
        values[k] = scale * (result.normal.dot(meridians[k].third) + 3 * result.kappa * first.dot(second));
        cubic_noise =
            std::max(cubic_noise,
                     scale * (derivative_noise(row, input, 3) + 3 * std::abs(result.kappa) * length * second_noise +
                              3 * noise * length * second.norm() + meridians[k].third.norm() * first_noise / length));
    }
    const auto decomposition = matrix.colPivHouseholderQr();
    const Vector4 solution = decomposition.solve(values);
    const Cubic cubic{solution[0], solution[1], solution[2], solution[3]};
    const double size = std::sqrt(cubic.squared_norm());
    // A narrow sector tells little of the form as a whole.
    const double condition = std::abs(decomposition.matrixR()(0, 0) / decomposition.matrixR()(3, 3));
    const double misfit = (matrix * solution - values).cwiseAbs().maxCoeff();
    result.cubic_error = noise_factor * condition * cubic_noise + misfit;
    result.generic = size > noise_factor * condition * cubic_noise && misfit <= cubic_fit * size;
    if (result.generic) result.cubic = cubic;
    return result;
}

/// (A, B) as double angle of a principal direction in the orthonormal frame whose y axis is r_v, lifted: the angle by
/// which the change of frame turns it.
double turn_to_meridian_frame(const SurfaceDerivatives& d, bool along_u) {
    const auto [E, F, G] = first_form(d);
    const Vector3 normal = d.r_u().cross(d.r_v());
    const double l = normal.dot(d.r_uu()), m = normal.dot(d.r_uv()), n = normal.dot(d.r_vv());
    const Vector2 pair(E * m - F * l, E * n - G * l);
    const auto framed = [&](double share) {
        const double f = share * F, D = std::sqrt(std::max(E * G - f * f, 0.0));
        if (along_u)
            return Vector2(pair.x() / E - f * pair.y() / (E * G),
                           (f * pair.x() / E + pair.y() * (E * G - 2 * f * f) / (2 * E * G)) / D);
        return Vector2(pair.x() / E, (pair.y() / 2 - pair.x() * f / E) / D);
    };
    double angle = turn_between(pair, framed(0.0));
    for (int k = 0; k < frame_steps; ++k)
        angle += turn_between(framed(static_cast<double>(k) / frame_steps),
                              framed(static_cast<double>(k + 1) / frame_steps));
    return angle;
}

/// Turning (radians) of the double angle of the principal directions along the line at `circle`, against the meridians,
/// for growing parameter; over knots of low continuity the directions themselves are what continues.
std::optional<double> circle_turning(const Row& row, const InputRounding& input, double circle) {
    double angle = 0.0;
    for (const PatchRange& block : smooth_blocks(row.surface, row.range)) {
        const std::vector<double>&u = row.surface.u_knots().breaks(), &v = row.surface.v_knots().breaks();
        const ParameterBox domain{{u[block.u_first], u[block.u_last]}, {v[block.v_first], v[block.v_last]}};
        const ParameterInterval &along = across_u(row.edge) ? domain.v : domain.u,
                                &across = across_u(row.edge) ? domain.u : domain.v;
        if (!(across.low < circle && circle < across.high)) continue;
        const Vector2 start = row.at(along.low, circle), end = row.at(along.high, circle);
        PathTurning turning(row.surface, row.patches, input, block);
        const std::optional<WayTurning> part = turning.along(start, end);
        if (!part) return std::nullopt;
        const auto correction = [&](const Vector2& at, Side side) {
            return turn_to_meridian_frame(
                row.surface.derivatives(at.x(), at.y(), 2, across_u(row.edge) ? Side::right : side,
                                        across_u(row.edge) ? side : Side::right),
                !across_u(row.edge));
        };
        angle += part->between_ends() + correction(end, Side::left) - correction(start, Side::right);
    }
    return angle;
}

/// A multiple of 1/2 within `smooth_angle`.
std::optional<double> half_turns(double turns) {
    const double nearest = 0.5 * std::round(2 * turns);
    if (std::abs(turns - nearest) > smooth_angle) return std::nullopt;
    return nearest;
}

bool in_strip(const Row& row, double circle, double low, double high) {
    return low_end(row.edge) ? low <= circle : high >= circle;
}

Umbilic make_umbilic(const Row& row, const PoleGeometry& geometry, double index, double generic_margin) {
    Umbilic result;
    const double along_low = row.along(row.first()).low, along_high = row.along(row.last() - 1).high;
    const Vector2 at = row.at(along_low, row.pole());
    result.at.u = at.x();
    result.at.v = at.y();
    const Vector2 end = row.at(along_high, row.pole());
    result.box = {{at.x(), end.x()}, {at.y(), end.y()}};
    result.point = geometry.point;
    result.normal = geometry.normal;
    result.x_axis = geometry.x;
    result.kappa = geometry.kappa;
    result.kappa_error = geometry.kappa_error;
    result.flat = std::abs(geometry.kappa) <= geometry.kappa_error;
    result.cubic = geometry.cubic;
    result.cubic_error = geometry.cubic_error;
    result.index = index;
    result.certified = true;
    const double size = std::sqrt(geometry.cubic.squared_norm());
    result.kind =
        classify(geometry.cubic, size > 0.0 ? std::min(1.0, geometry.cubic_error / size + generic_margin) : 1.0);
    if (!geometry.generic) {
        // Every meridian is a line of curvature, or higher derivatives decide.
        result.kind.angles.clear();
        return result;
    }
    if (index != (result.kind.delta > 0.0 ? -0.5 : 0.5)) result.kind.type = UmbilicType::non_generic;
    for (const double angle : result.kind.angles)
        result.directions.push_back(std::cos(angle) * geometry.x + std::sin(angle) * geometry.y);
    return result;
}

}  // namespace

std::vector<Pole> find_poles(const NurbsSurface& surface, const BezierPatches& patches, const InputRounding& input,
                             const PatchRange& range, const std::vector<PatchUmbilics>& found,
                             const std::vector<SightedUmbilic>& umbilics, double generic_margin,
                             std::vector<OpenPart>& open) {
    std::vector<Pole> result;
    for (const PatchEdge edge : {PatchEdge::u_low, PatchEdge::u_high, PatchEdge::v_low, PatchEdge::v_high}) {
        const Row row{edge, surface, patches, range};
        bool singular = true;
        for (int k = row.first(); k < row.last(); ++k)
            singular = singular && found[row.number(k)].singular[static_cast<int>(edge)];
        if (!singular) continue;

        const auto part_across = [&](const ParameterBox& box) { return across_u(edge) ? box.u : box.v; };
        const auto region_at_pole = [&](const OpenPart& part) {
            return part.zero && in_strip(row, row.pole(), part_across(part.box).low, part_across(part.box).high);
        };
        Pole pole;
        pole.edge = edge;
        for (const double share : circle_shares) {
            const double width = share * row.across().length();
            pole.circle = low_end(edge) ? row.pole() + width : row.pole() - width;
            const bool free = std::none_of(umbilics.begin(), umbilics.end(), [&](const SightedUmbilic& umbilic) {
                return std::any_of(umbilic.sightings.begin(), umbilic.sightings.end(), [&](const Sighting& sighting) {
                    const double at = across_u(edge) ? sighting.at.x() : sighting.at.y();
                    return in_strip(row, pole.circle, at, at);
                });
            });
            if (free) break;
        }
        const PoleGeometry geometry = look_at(row, input);
        const double s = edge == PatchEdge::v_high || edge == PatchEdge::u_low ? 1.0 : -1.0;
        const double sweep = s * geometry.sweep / (2 * pi);
        pole.full = geometry.smooth && std::abs(sweep - 1.0) <= smooth_angle;
        const bool region = std::any_of(open.begin(), open.end(), region_at_pole);
        if (!geometry.smooth || region || !(sweep > 0.0)) {
            result.push_back(std::move(pole));
            continue;
        }
        if (const std::optional<double> angle = circle_turning(row, input, pole.circle)) {
            const double turns = sweep + s * *angle / (4 * pi);
            pole.index = half_turns(turns / sweep);
        }
        if (!pole.full && geometry.umbilic && geometry.generic)
            pole.index = classify(geometry.cubic, 0.0).delta > 0.0 ? -0.5 : 0.5;
        if (pole.index && geometry.umbilic) {
            // Boxes left open at the pole stand for the pole.
            bool cleared = true;
            const auto at_pole = [&](const OpenPart& part) {
                const ParameterInterval interval = part_across(part.box);
                if (!in_strip(row, pole.circle, interval.low, interval.high)) return false;
                const bool touches = in_strip(row, row.pole(), interval.low, interval.high) &&
                                     interval.length() <= 0.5 * std::abs(pole.circle - row.pole());
                cleared = cleared && touches;
                return touches;
            };
            std::vector<OpenPart> kept;
            bool any = false;
            for (const OpenPart& part : open) {
                const bool here = at_pole(part);
                any = any || here;
                if (!here) kept.push_back(part);
            }
            if (cleared) open = std::move(kept);
            if (cleared) {
                pole.umbilic = make_umbilic(row, geometry, *pole.index, generic_margin);
                pole.umbilic->pole = pole.full ? PoleKind::inner : PoleKind::border;
                pole.umbilic->containment = pole.full ? Containment::inside : Containment::boundary;
                pole.umbilic->certified = !any;
            }
        }
        result.push_back(std::move(pole));
    }
    return result;
}

}  // namespace umbilic
