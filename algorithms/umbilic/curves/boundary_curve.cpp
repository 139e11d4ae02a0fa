// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/curves/boundary_curve.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <umbilic/nurbs/bezier_patch.h>

namespace umbilic {

namespace {

constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();

/// Samples of the second derivative on a piece.
constexpr int sample_count = 9;
/// The greatest difference of the samples from their mean times this bounds that of the whole piece.
constexpr double sample_safety = 2.0;

}  // namespace

std::vector<double> smooth_pieces(const NurbsSurface& surface, const TrimmingRegion& region,
                                  const TrimmingCurve& curve) {
    std::vector<double> result = curve.curve.knots().breaks();
    const std::vector<double> knots = result;
    const auto crossings = [&](const std::vector<double>& native_values, int axis) {
        for (const double value : native_values)
            for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
                double low = knots[i], high = knots[i + 1];
                const double at_low = curve.curve.value(low)[axis] - value;
                const double at_high = curve.curve.value(high)[axis] - value;
                if (!(at_low * at_high < 0.0)) continue;
                while (true) {
                    const double middle = 0.5 * (low + high);
                    if (!(low < middle && middle < high)) break;
                    ((curve.curve.value(middle)[axis] - value) * at_low > 0.0 ? low : high) = middle;
                }
                result.push_back(low);
            }
    };
    // Where the map bends, and where the surface's second derivatives jump.
    const auto lines = [](const ParameterMap& map, const KnotVector& surface_knots) {
        std::vector<double> values = map.breaks();
        for (std::size_t i = 1; i + 1 < surface_knots.breaks().size(); ++i)
            if (surface_knots.continuity(static_cast<int>(i)) < 2)
                values.push_back(map.native(surface_knots.breaks()[i]));
        return values;
    };
    crossings(lines(region.u_map(), surface.u_knots()), 0);
    crossings(lines(region.v_map(), surface.v_knots()), 1);
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
}

CellModel boundary_model(const NurbsSurface& surface, const TrimmingRegion& region, const TrimmingCurve& curve,
                         double low, double high) {
    const double length = high - low;
    std::array<Vector3, sample_count> second;
    Vector3 mean = Vector3::Zero();
    BoundaryPoint middle;
    for (int k = 0; k < sample_count; ++k) {
        // Well inside the ends, where the neighbouring piece may have other derivatives.
        const double t = low + length * (k + 0.5) / sample_count;
        const BoundaryPoint point = boundary_point(surface, region, curve, t);
        if (2 * k == sample_count - 1) middle = point;
        second[k] = length * length * point.r_tt;
        mean += second[k] / sample_count;
    }
    double error = 0.0;
    for (const Vector3& sample : second) error = std::max(error, (sample - mean).norm());
    return curve_model(middle.r, length * middle.r_t, mean, sample_safety * error);
}

std::optional<ParameterBox> iso_line(const TrimmingRegion& region, const TrimmingCurve& curve) {
    const std::vector<Vector2>& poles = curve.curve.poles();
    const ParameterBox domain = region.domain();
    const Vector2 slack(rounding * domain.u.length(), rounding * domain.v.length());
    for (int fixed = 0; fixed < 2; ++fixed) {
        const int free = 1 - fixed;
        bool straight = true, up = true, down = true;
        for (std::size_t i = 0; i + 1 < poles.size(); ++i) {
            straight = straight && std::abs(poles[i + 1][fixed] - poles[0][fixed]) <= slack[fixed];
            up = up && poles[i + 1][free] >= poles[i][free];
            down = down && poles[i + 1][free] <= poles[i][free];
        }
        if (!straight || !(up || down)) continue;
        const Vector2 a(region.u_map().surface(poles.front().x()), region.v_map().surface(poles.front().y()));
        const Vector2 b(region.u_map().surface(poles.back().x()), region.v_map().surface(poles.back().y()));
        const auto interval = [](const ParameterInterval& range, double x, double y) {
            return ParameterInterval{range.clamp(std::min(x, y)), range.clamp(std::max(x, y))};
        };
        ParameterBox box{interval(domain.u, a.x(), b.x()), interval(domain.v, a.y(), b.y())};
        ParameterInterval& thin = fixed == 0 ? box.u : box.v;
        thin.high = thin.low;
        return box;
    }
    return std::nullopt;
}

std::vector<LocalPatch> flat_images(const NurbsSurface& surface, const TrimmingRegion& region,
                                    const TrimmingCurve& curve, const Vector3& origin) {
    if (surface.poles().size() != 4 || surface.rational() || !region.u_map().identity() || !region.v_map().identity())
        return {};
    const Vector3 corner = surface.pole(0, 0);
    const Vector3 along_u = surface.pole(1, 0) - corner, along_v = surface.pole(0, 1) - corner;
    const Vector3 twist = surface.pole(1, 1) - corner - along_u - along_v;
    if (twist.norm() > rounding * (corner.norm() + along_u.norm() + along_v.norm())) return {};

    const ParameterBox domain = surface.domain();
    std::vector<Vector3> poles;
    std::vector<double> weights;
    for (std::size_t i = 0; i < curve.curve.poles().size(); ++i)
        for (int side = 0; side < 2; ++side) {
            const Vector2& c = curve.curve.poles()[i];
            poles.push_back((corner - origin) + (c.x() - domain.u.low) / domain.u.length() * along_u +
                            (c.y() - domain.v.low) / domain.v.length() * along_v);
            if (!curve.curve.weights().empty()) weights.push_back(curve.curve.weights()[i]);
        }
    // A surface with two equal rows of control points: its Bezier patches hold those of the curve.
    const NurbsSurface strip(curve.curve.knots(), KnotVector::bezier(1), std::move(poles), std::move(weights));
    std::vector<LocalPatch> result;
    for (const BezierPatch& patch : bezier_patches(strip).patches) {
        LocalPatch piece{patch.u_degree, 0, patch.rational, {}};
        for (int i = 0; i <= patch.u_degree; ++i) {
            piece.poles.push_back(patch.pole(i, 0));
            piece.poles.back().head<3>() += patch.pole(i, 0)[3] * patch.origin;
        }
        result.push_back(std::move(piece));
    }
    return result;
}

}  // namespace umbilic
