// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/curves/stationary_points.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <iterator>
#include <tuple>
#include <utility>

#include <Eigen/Geometry>
#include <tbb/parallel_for.h>

#include <umbilic/bernstein/box_clusters.h>
#include <umbilic/bernstein/projected_polyhedron.h>
#include <umbilic/bernstein/rounding.h>
#include <umbilic/core/errors.h>
#include <umbilic/curves/stationary_equations.h>

namespace umbilic {

namespace {

/// Ends of the domain coincide in space if their points differ by at most this times the surface's size.
constexpr double closed_distance = 1e-9;
/// Tangent planes of two sides that differ by less than this angle (radians) are one.
constexpr double smooth_angle = 1e-6;

using Breaks = std::vector<double>;

/// A parameter line on which the surface ends or breaks: u (direction 0) or v (1) at a break.
struct EdgeLine {
    int direction = 0;
    int index = 0;  ///< of the break
};

class Finder {
public:
    Finder(const NurbsSurface& surface, const Vector3& point, const StationaryPointsOptions& options)
        : surface_(surface),
          p_(point),
          options_(options),
          patches_(bezier_patches(surface)),
          input_(input_rounding(surface)),
          breaks_{surface.u_knots().breaks(), surface.v_knots().breaks()} {}

    StationaryPoints run(const Progress& progress);

private:
    /// What one patch or one piece of an edge gave.
    struct Found {
        std::vector<StationaryPoint> points;
        std::vector<StationaryPoint> poles;  ///< points of collapsed edges
        std::vector<ParameterBox> undecided;
        long boxes = 0;
        bool exhausted = false;
    };

    const BezierPatch& patch(int i, int j) const { return patches_.patches[i * patches_.v_count + j]; }
    Vector3 point_at(double u, double v, Side u_side, Side v_side) const {
        return surface_.derivatives(u, v, 0, u_side, v_side).r();
    }
    /// Whether the side below break `low` goes over into the side above break `high`, in position and tangent plane.
    bool smooth_across(int direction, int low, int high, bool& joined) const;
    void find_edge_lines();
    StationaryPoint make_point(double u, double v, FootKind kind) const;
    Found search_patch(const BezierPatch& patch, const Progress& progress) const;
    Found search_edge(const EdgeLine& line, int piece, const Progress& progress) const;
    void add_corners(std::vector<StationaryPoint>& points) const;
    bool same(const StationaryPoint& a, const StationaryPoint& b) const;
    std::vector<StationaryPoint> merge(std::vector<StationaryPoint> points, std::vector<StationaryPoint> poles) const;

    const NurbsSurface& surface_;
    Vector3 p_;
    StationaryPointsOptions options_;
    BezierPatches patches_;
    InputRounding input_;
    std::array<Breaks, 2> breaks_;
    std::array<bool, 2> closed_{};  ///< the ends of u, of v, coincide in space
    std::vector<EdgeLine> lines_;
};

bool Finder::smooth_across(int direction, int low, int high, bool& joined) const {
    const BoundingBox box = surface_.pole_box();
    const double distance = closed_distance * box.diagonal();
    const int other_degree = direction == 0 ? surface_.v_degree() : surface_.u_degree();
    const Breaks& other = breaks_[1 - direction];
    joined = true;
    bool smooth = true;
    for (std::size_t span = 0; span + 1 < other.size(); ++span)
        // More points than a rational polynomial of that degree has coefficients, none at the ends.
        for (int k = 0; k < 2 * other_degree + 3; ++k) {
            const double t = other[span] + (other[span + 1] - other[span]) * (k + 0.5) / (2 * other_degree + 3);
            const auto side = [&](int line, Side s) {
                const double at = breaks_[direction][line];
                return direction == 0 ? surface_.derivatives(at, t, 1, s, Side::right)
                                      : surface_.derivatives(t, at, 1, Side::right, s);
            };
            const SurfaceDerivatives below = side(low, Side::left), above = side(high, Side::right);
            joined = joined && (below.r() - above.r()).norm() <= distance;
            const Vector3 a = below.r_u().cross(below.r_v()), b = above.r_u().cross(above.r_v());
            smooth = smooth && a.dot(b) >= 0.0 && a.cross(b).norm() <= smooth_angle * a.norm() * b.norm();
        }
    return joined && smooth;
}

void Finder::find_edge_lines() {
    for (int direction = 0; direction < 2; ++direction) {
        const KnotVector& knots = direction == 0 ? surface_.u_knots() : surface_.v_knots();
        const int last = static_cast<int>(breaks_[direction].size()) - 1;
        bool joined = false;
        const bool seam = smooth_across(direction, last, 0, joined);
        closed_[direction] = joined;
        for (int k = 0; k <= last; ++k) {
            const bool end = k == 0 || k == last;
            if (end ? !seam : knots.continuity(k) < 1 && !smooth_across(direction, k, k, joined))
                lines_.push_back({direction, k});
        }
    }
}

StationaryPoint Finder::make_point(double u, double v, FootKind kind) const {
    StationaryPoint result;
    result.at.u = u;
    result.at.v = v;
    result.point = surface_.value(u, v);
    result.distance = (result.point - p_).norm();
    result.kind = kind;
    return result;
}

Finder::Found Finder::search_patch(const BezierPatch& patch, const Progress& progress) const {
    const StationaryEquations equations = stationary_equations(patch, input_, p_);
    ProjectedPolyhedronOptions options;
    options.tolerance = options_.tolerance;
    options.boxes = options_.boxes_per_patch;
    const SystemRoots roots = solve_projected_polyhedron(equations.f, options, progress);

    Found result;
    result.boxes = roots.statistics.boxes;
    result.exhausted = roots.statistics.exhausted;
    const std::array<ParameterInterval, 2> domain = {patch.domain.u, patch.domain.v};
    for (const SystemRoot& root : roots.roots) {
        const PlacedCoordinate u = placed(root, 0, domain[0]), v = placed(root, 1, domain[1]);
        const auto touches = [&](int k, PatchEdge low, PatchEdge high) {
            return (equations.collapsed[static_cast<int>(low)] && root.at[k] <= root.radius[k]) ||
                   (equations.collapsed[static_cast<int>(high)] && 1.0 - root.at[k] <= root.radius[k]);
        };
        const bool at_pole =
            touches(0, PatchEdge::u_low, PatchEdge::u_high) || touches(1, PatchEdge::v_low, PatchEdge::v_high);
        if (at_pole) continue;  // every collapsed edge is reported by itself
        StationaryPoint found = make_point(u.at, v.at, FootKind::interior);
        found.radius = {u.radius, v.radius};
        found.certified = true;
        if (root.jacobian_sign < 0) found.type = StationaryType::saddle;
        if (root.jacobian_sign > 0) {
            // Definite: told by the greater diagonal entry, which is far from 0.
            const SurfaceDerivatives d = surface_.derivatives(u.at, v.at, 2);
            const Vector3 gap = d.r() - p_;
            const double uu = (d.r_u().dot(d.r_u()) + gap.dot(d.r_uu())) / d.r_u().squaredNorm();
            const double vv = (d.r_v().dot(d.r_v()) + gap.dot(d.r_vv())) / d.r_v().squaredNorm();
            found.type = uu + vv > 0.0 ? StationaryType::minimum : StationaryType::maximum;
        }
        result.points.push_back(std::move(found));
    }
    for (const UndecidedBox& undecided : roots.undecided)
        result.undecided.push_back({placed(undecided.box[0], domain[0]), placed(undecided.box[1], domain[1])});
    for (const PatchEdge edge : {PatchEdge::u_low, PatchEdge::u_high, PatchEdge::v_low, PatchEdge::v_high}) {
        if (!equations.collapsed[static_cast<int>(edge)]) continue;
        const bool stationary = equations.stationary_pole[static_cast<int>(edge)];
        StationaryPoint pole = make_point(edge == PatchEdge::u_high ? domain[0].high : domain[0].low,
                                          edge == PatchEdge::v_high ? domain[1].high : domain[1].low,
                                          stationary ? FootKind::interior : FootKind::corner);
        pole.certified = !stationary;
        result.poles.push_back(std::move(pole));
    }
    return result;
}

Finder::Found Finder::search_edge(const EdgeLine& line, int piece, const Progress& progress) const {
    const bool along_v = line.direction == 0;
    const bool last = line.index == static_cast<int>(breaks_[line.direction].size()) - 1;
    const int across = last ? line.index - 1 : line.index;
    const BezierPatch& beside = along_v ? patch(across, piece) : patch(piece, across);
    const PatchEdge edge =
        along_v ? (last ? PatchEdge::u_high : PatchEdge::u_low) : (last ? PatchEdge::v_high : PatchEdge::v_low);
    Found result;
    if (collapsed(beside, input_, edge)) return result;  // search_patch reports its point
    const MultivariatePolynomial f = stationary_edge_equation(beside, input_, p_, edge);
    const double fixed = breaks_[line.direction][line.index];
    const ParameterInterval range = along_v ? beside.domain.v : beside.domain.u;

    ProjectedPolyhedronOptions options;
    options.tolerance = options_.tolerance;
    options.boxes = options_.boxes_per_patch;
    const SystemRoots roots = solve_projected_polyhedron({&f, 1}, options, progress);
    result.boxes = roots.statistics.boxes;
    result.exhausted = roots.statistics.exhausted;
    for (const SystemRoot& root : roots.roots) {
        const PlacedCoordinate t = placed(root, 0, range);
        StationaryPoint found =
            along_v ? make_point(fixed, t.at, FootKind::edge) : make_point(t.at, fixed, FootKind::edge);
        found.radius[along_v ? 1 : 0] = t.radius;
        found.certified = true;
        if (root.jacobian_sign != 0)
            found.type = root.jacobian_sign > 0 ? StationaryType::minimum : StationaryType::maximum;
        result.points.push_back(std::move(found));
    }
    for (const UndecidedBox& undecided : roots.undecided) {
        const ParameterInterval part = placed(undecided.box[0], range), at{fixed, fixed};
        result.undecided.push_back(along_v ? ParameterBox{at, part} : ParameterBox{part, at});
    }
    return result;
}

void Finder::add_corners(std::vector<StationaryPoint>& points) const {
    for (const EdgeLine& u : lines_)
        for (const EdgeLine& v : lines_) {
            if (u.direction != 0 || v.direction != 1) continue;
            points.push_back(make_point(breaks_[0][u.index], breaks_[1][v.index], FootKind::corner));
            points.back().certified = true;
        }
}

bool Finder::same(const StationaryPoint& a, const StationaryPoint& b) const {
    const std::array<double, 2> gap = {std::abs(a.at.u - b.at.u), std::abs(a.at.v - b.at.v)};
    const auto near = [&](int k) {
        const double reach = a.radius[k] + b.radius[k];
        const ParameterInterval domain = k == 0 ? surface_.domain().u : surface_.domain().v;
        return gap[k] <= reach || (closed_[k] && std::abs(gap[k] - domain.length()) <= reach);
    };
    return near(0) && near(1);
}

std::vector<StationaryPoint> Finder::merge(std::vector<StationaryPoint> points,
                                           std::vector<StationaryPoint> poles) const {
    // The strongest statement first: interior before edge before corner.
    std::stable_sort(points.begin(), points.end(),
                     [](const StationaryPoint& a, const StationaryPoint& b) { return a.kind < b.kind; });
    const double distance = closed_distance * surface_.pole_box().diagonal();
    std::vector<StationaryPoint> result;
    // The point of a collapsed edge has any parameter along it, and every patch at it reports it.
    const auto at_pole = [&](const StationaryPoint& point) {
        return std::any_of(result.begin(), result.end(), [&](const StationaryPoint& other) {
            return (point.point - other.point).norm() <= distance;
        });
    };
    for (StationaryPoint& pole : poles)
        if (!at_pole(pole)) result.push_back(std::move(pole));
    const auto pole_count = static_cast<std::ptrdiff_t>(result.size());
    std::erase_if(points,
                  [&](const StationaryPoint& point) { return point.kind == FootKind::corner && at_pole(point); });
    for (StationaryPoint& point : points) {
        const bool known = std::any_of(result.begin() + pole_count, result.end(),
                                       [&](const StationaryPoint& other) { return same(point, other); });
        if (!known) result.push_back(std::move(point));
    }
    std::stable_sort(result.begin(), result.end(), [](const StationaryPoint& a, const StationaryPoint& b) {
        return std::tuple(a.distance, a.at.u, a.at.v) < std::tuple(b.distance, b.at.u, b.at.v);
    });
    return result;
}

StationaryPoints Finder::run(const Progress& progress) {
    find_edge_lines();
    std::vector<std::pair<EdgeLine, int>> pieces;
    for (const EdgeLine& line : lines_)
        for (std::size_t piece = 0; piece + 1 < breaks_[1 - line.direction].size(); ++piece)
            pieces.emplace_back(line, static_cast<int>(piece));

    const std::size_t patch_count = patches_.patches.size();
    std::vector<Found> found(patch_count + pieces.size());
    std::atomic<std::size_t> done{0};
    tbb::parallel_for(std::size_t(0), found.size(), [&](std::size_t k) {
        const auto fraction = [&] { return static_cast<double>(done) / static_cast<double>(found.size()); };
        // Patches end in any order, so the fraction is counted in patches; within one it stands still.
        const Progress within = progress.part(fraction(), fraction());
        within.check();
        if (k < patch_count)
            found[k] = search_patch(patches_.patches[k], within);
        else
            found[k] = search_edge(pieces[k - patch_count].first, pieces[k - patch_count].second, within);
        ++done;
        progress.report(fraction(), "stationary points");
    });

    StationaryPoints result;
    result.patches = static_cast<int>(patch_count);
    std::vector<StationaryPoint> points, poles;
    std::vector<ParameterBox> undecided;
    for (Found& part : found) {
        std::move(part.poles.begin(), part.poles.end(), std::back_inserter(poles));
        std::move(part.points.begin(), part.points.end(), std::back_inserter(points));
        undecided.insert(undecided.end(), part.undecided.begin(), part.undecided.end());
        result.boxes += part.boxes;
        result.exhausted = result.exhausted || part.exhausted;
    }
    add_corners(points);
    result.points = merge(std::move(points), std::move(poles));

    std::vector<Interval> sides;
    const ParameterBox domain = surface_.domain();
    for (const ParameterBox& box : undecided)
        for (const auto& [side, whole] : {std::pair(box.u, domain.u), std::pair(box.v, domain.v)})
            sides.emplace_back((side.low - whole.low) / whole.length(), (side.high - whole.low) / whole.length());
    const BoxClusters clusters = cluster_boxes(sides, 2, options_.tolerance);
    result.undecided.resize(clusters.count);
    for (std::size_t k = 0; k < undecided.size(); ++k)
        result.undecided[clusters.cluster[k]].boxes.push_back(undecided[k]);
    return result;
}

}  // namespace

StationaryPoints find_stationary_points(const NurbsSurface& surface, const Vector3& point,
                                        const StationaryPointsOptions& options, const Progress& progress) {
    if (!point.allFinite()) throw InvalidInput("stationary points: the given point is not finite");
    return Finder(surface, point, options).run(progress);
}

}  // namespace umbilic
