// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/curvature_points/curvature_points.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <tuple>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <umbilic/bernstein/box_clusters.h>
#include <umbilic/core/disjoint_sets.h>
#include <umbilic/core/errors.h>
#include <umbilic/curvature_points/curvature_gradient.h>
#include <umbilic/curvature_points/curvature_levels.h>
#include <umbilic/curvature_points/dependence.h>
#include <umbilic/nurbs/bezier_patch.h>

namespace umbilic {

namespace {

/// Boxes count as fine at this share of their patch at least, however small the patch is.
constexpr double coarsest_patch_size = 1.0 / 16;
/// Solutions that two neighbouring patches see at one place differ by their radii times the ratio of their Jacobians.
constexpr double jacobian_ratio = 64.0;
/// Boxes of a connected part that are tried as starts for its candidate, and steps from each.
constexpr std::size_t most_starts = 4;
constexpr int most_steps = 12;

struct Place {
    CurvaturePoint point;
    Vector2 radius = Vector2::Zero();  ///< in the surface's parameters
    std::size_t patch = 0;
};

struct LooseBox {
    BoxPart part;
    double misfit = 0.0;
};

/// What all patches found for one level.
struct LevelResult {
    std::vector<Place> points;
    std::vector<LooseBox> boxes;
};

/// The connected parts of what the boxes hold.
std::vector<std::vector<LooseBox>> connected(const std::vector<LooseBox>& boxes, const ParameterBox& domain) {
    std::vector<Interval> sides;
    std::vector<std::size_t> owner;
    for (std::size_t k = 0; k < boxes.size(); ++k)
        for (const ParameterBox& contact : contacts(boxes[k].part)) {
            const auto add = [&](const ParameterInterval& side, const ParameterInterval& whole) {
                sides.emplace_back((side.low - whole.low) / whole.length(), (side.high - whole.low) / whole.length());
            };
            add(contact.u, domain.u);
            add(contact.v, domain.v);
            owner.push_back(k);
        }
    // Sides of neighbouring boxes are the same numbers up to the rounding of the change of parameters.
    constexpr double gap = 1e-13;
    const BoxClusters clusters = cluster_boxes(sides, 2, gap);
    DisjointSets sets(boxes.size());
    std::vector<std::size_t> first(clusters.count, boxes.size());
    for (std::size_t k = 0; k < owner.size(); ++k) {
        std::size_t& in_cluster = first[clusters.cluster[k]];
        if (in_cluster == boxes.size())
            in_cluster = owner[k];
        else
            sets.unite(in_cluster, owner[k]);
    }
    std::vector<std::vector<LooseBox>> result;
    std::vector<std::size_t> number(boxes.size());
    for (std::size_t k = 0; k < boxes.size(); ++k) {
        const std::size_t set = sets.find(k);
        if (set == k) {
            number[k] = result.size();
            result.emplace_back();
        }
        result[number[set]].push_back(boxes[k]);
    }
    return result;
}

/// A level in the surface's unit, and what it stands for.
struct Wanted {
    CurvatureLevel level;
    int query = 0;
    bool opposite = false;
};

void check(std::span<const CurvatureQuery> queries, const CurvaturePointOptions& options) {
    if (!(options.resolution > 0.0 && options.resolution < 1.0))
        throw InvalidInput("search for curvatures: the resolution must lie between 0 and 1");
    if (options.boxes_per_patch < 1) throw InvalidInput("search for curvatures: boxes_per_patch must be at least 1");
    if (!(options.recognition >= 0.0)) throw InvalidInput("search for curvatures: recognition must not be negative");
    for (const CurvatureQuery& query : queries) {
        if (!std::isfinite(query.gaussian) || !std::isfinite(query.mean))
            throw InvalidInput("search for curvatures: the values must be finite");
        const double k = query.gaussian_tolerance, h = query.mean_tolerance;
        if (!(std::isfinite(k) && std::isfinite(h) && ((k == 0.0 && h == 0.0) || (k > 0.0 && h > 0.0))))
            throw InvalidInput("search for curvatures: both tolerances must be 0 or both positive");
    }
}

/// Exact levels and, where there are tolerances, the regions within them; H seen from r_u x r_v.
std::vector<Wanted> wanted_levels(std::span<const CurvatureQuery> queries, bool both_signs, bool reversed) {
    std::vector<Wanted> result;
    for (std::size_t k = 0; k < queries.size(); ++k)
        for (const bool opposite : {false, true}) {
            const CurvatureQuery& query = queries[k];
            if (opposite && (!both_signs || query.mean == 0.0)) continue;
            const double mean = opposite == reversed ? query.mean : -query.mean;
            result.push_back({{query.gaussian, mean}, static_cast<int>(k), opposite});
            if (query.gaussian_tolerance > 0.0)
                result.push_back({{query.gaussian, mean, query.gaussian_tolerance, query.mean_tolerance},
                                  static_cast<int>(k),
                                  opposite});
        }
    return result;
}

bool overlap(const ParameterBox& a, const ParameterBox& b) {
    return a.u.low <= b.u.high && b.u.low <= a.u.high && a.v.low <= b.v.high && b.v.low <= a.v.high;
}

/// One patch after the other, memory kept.
struct PatchSearch {
    UmbilicEquations forms;
    CurvatureEquations equations;
    CurvatureLevelSearch search;
    std::vector<CurvatureLevel> levels;
};

class SurfaceSearch {
public:
    SurfaceSearch(const NurbsSurface& surface, bool reversed, const CurvaturePointOptions& options)
        : surface_(surface), reversed_(reversed), options_(options) {}

    CurvaturePoints search(std::span<const CurvatureQuery> queries, const ParameterBox& part,
                           const Progress& progress) const;

private:
    LevelSets search_patch(PatchSearch& search, const BezierPatch& patch, const InputRounding& input,
                           const std::vector<Wanted>& wanted, bool& exact, const Progress& progress) const;
    std::vector<CurvaturePoint> without_duplicates(std::vector<Place> places, const BezierPatches& patches) const;
    std::vector<CurvaturePoint> parts(const Wanted& wanted, const std::vector<LooseBox>& boxes,
                                      std::vector<CurvaturePoint>& points) const;
    void improve(const Wanted& wanted, const std::vector<LooseBox>& starts, CurvaturePoint& point) const;
    Curvature curvature_at(double u, double v) const {
        const Curvature result = curvature(surface_, u, v);
        return reversed_ ? flipped(result) : result;
    }

    const NurbsSurface& surface_;
    bool reversed_;
    CurvaturePointOptions options_;
};

LevelSets SurfaceSearch::search_patch(PatchSearch& search, const BezierPatch& patch, const InputRounding& input,
                                      const std::vector<Wanted>& wanted, bool& exact, const Progress& progress) const {
    search.forms.form_fundamental(patch, input);
    search.forms.form_curvature(search.equations);
    exact = search.equations.exact;
    search.search.set_equations(search.equations);
    // Lengths in the equations are those of the surface times `unit`, a power of two.
    const EquationScale scale = equation_scale(patch);
    const double unit = scale.position / scale.weight;
    search.levels.clear();
    for (const auto& [level, query, opposite] : wanted)
        search.levels.push_back({level.gaussian / (unit * unit), level.mean / unit,
                                 level.gaussian_tolerance / (unit * unit), level.mean_tolerance / unit});
    const ParameterBox domain = surface_.domain();
    LevelLimits limits;
    limits.u_size = std::min(coarsest_patch_size, options_.resolution * domain.u.length() / patch.domain.u.length());
    limits.v_size = std::min(coarsest_patch_size, options_.resolution * domain.v.length() / patch.domain.v.length());
    limits.boxes = options_.boxes_per_patch;
    LevelSets result;
    search.search.search(search.levels, limits, progress, result);
    return result;
}

CurvaturePoints SurfaceSearch::search(std::span<const CurvatureQuery> queries, const ParameterBox& part,
                                      const Progress& progress) const {
    const BezierPatches patches = bezier_patches(surface_);
    const InputRounding input = input_rounding(surface_);
    const std::vector<Wanted> wanted = wanted_levels(queries, options_.both_signs, reversed_);
    std::vector<std::size_t> searched;
    for (std::size_t k = 0; k < patches.patches.size(); ++k)
        if (overlap(patches.patches[k].domain, part)) searched.push_back(k);

    struct Found {
        LevelSets sets;
        bool exact = true;
    };
    std::vector<Found> found(searched.size());
    tbb::enumerable_thread_specific<PatchSearch> searches;
    std::atomic<std::size_t> done{0};
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, searched.size()), [&](const auto& range) {
        PatchSearch& search = searches.local();
        for (std::size_t k = range.begin(); k != range.end(); ++k) {
            progress.check();
            found[k].sets = search_patch(search, patches.patches[searched[k]], input, wanted, found[k].exact, progress);
        }
        done += range.size();
        progress.report(static_cast<double>(done) / static_cast<double>(searched.size()), "points of given curvature");
    });

    CurvaturePoints result;
    result.patches = static_cast<int>(searched.size());
    std::vector<LevelResult> levels(wanted.size());
    const ParameterBox domain = surface_.domain();
    for (std::size_t k = 0; k < searched.size(); ++k) {
        const ParameterBox& place = patches.patches[searched[k]].domain;
        const Vector2 corner(place.u.low, place.v.low), side(place.u.length(), place.v.length());
        result.boxes += found[k].sets.visited;
        result.exhausted = result.exhausted || found[k].sets.exhausted;
        for (const LevelPoint& p : found[k].sets.points) {
            const Vector2 at = corner + side.cwiseProduct(p.at);
            Place entry;
            entry.patch = searched[k];
            entry.radius = side.cwiseProduct(p.radius);
            entry.point.query = wanted[p.level].query;
            entry.point.opposite = wanted[p.level].opposite;
            // A solution on the border of the domain may be found beside it, within its radius.
            entry.point.at = {0, domain.u.clamp(at.x()), domain.v.clamp(at.y())};
            entry.point.certified = found[k].exact;
            entry.point.radius = std::max(entry.radius.x() / domain.u.length(), entry.radius.y() / domain.v.length());
            entry.point.solutions = found[k].exact ? 1 : 0;
            entry.point.extent = mapped({p.box, {}}, corner, side).box;
            levels[p.level].points.push_back(std::move(entry));
        }
        for (const LevelBox& box : found[k].sets.boxes)
            levels[box.level].boxes.push_back({mapped(box.part, corner, side), box.misfit});
    }
    for (std::size_t k = 0; k < wanted.size(); ++k) {
        std::vector<CurvaturePoint> points = without_duplicates(std::move(levels[k].points), patches);
        const bool with_tolerances = k + 1 < wanted.size() && !wanted[k + 1].level.exact();
        // With tolerances, boxes that the exact level left open lie within the region anyway.
        const std::size_t region = with_tolerances ? k + 1 : k;
        const std::vector<CurvaturePoint> connected = parts(wanted[region], levels[region].boxes, points);
        if (with_tolerances)
            ++k;
        else
            result.points.insert(result.points.end(), points.begin(), points.end());
        result.points.insert(result.points.end(), connected.begin(), connected.end());
    }
    for (CurvaturePoint& point : result.points) point.curvature = curvature_at(point.at.u, point.at.v);
    std::sort(result.points.begin(), result.points.end(), [](const CurvaturePoint& a, const CurvaturePoint& b) {
        return std::tie(a.query, a.opposite, a.at.u, a.at.v) < std::tie(b.query, b.opposite, b.at.u, b.at.v);
    });
    progress.report(1.0, "points of given curvature");
    return result;
}

std::vector<CurvaturePoint> SurfaceSearch::without_duplicates(std::vector<Place> places,
                                                              const BezierPatches& patches) const {
    const ParameterBox domain = surface_.domain();
    const Vector2 period(domain.u.length(), domain.v.length());
    const Vector2 rounding =
        8 * std::numeric_limits<double>::epsilon() *
        Vector2(std::abs(domain.u.low) + std::abs(domain.u.high), std::abs(domain.v.low) + std::abs(domain.v.high));
    const auto on_edge = [&](const Place& place) {
        const ParameterBox& box = patches.patches[place.patch].domain;
        const Vector2 reach = place.radius + rounding;
        return std::min(place.point.at.u - box.u.low, box.u.high - place.point.at.u) <= reach.x() ||
               std::min(place.point.at.v - box.v.low, box.v.high - place.point.at.v) <= reach.y();
    };
    std::vector<CurvaturePoint> result;
    std::vector<const Place*> kept_on_edge;
    for (const Place& place : places) {
        if (on_edge(place)) {
            const bool known = std::any_of(kept_on_edge.begin(), kept_on_edge.end(), [&](const Place* other) {
                if (other->patch == place.patch) return false;
                Vector2 gap =
                    Vector2(place.point.at.u - other->point.at.u, place.point.at.v - other->point.at.v).cwiseAbs();
                const Vector2 reach = jacobian_ratio * (place.radius + other->radius + rounding);
                if ((gap.array() <= reach.array()).all()) return true;
                gap = gap.cwiseMin((period - gap).cwiseAbs());
                if ((gap.array() > reach.array()).any()) return false;
                // Across a side of the domain: the same point if the surface closes there.
                const SurfaceDerivatives d = surface_.derivatives(place.point.at.u, place.point.at.v, 1);
                const Vector3 there = surface_.value(other->point.at.u, other->point.at.v);
                const double distance = reach.x() * d.r_u().norm() + reach.y() * d.r_v().norm() +
                                        jacobian_ratio * input_rounding(surface_).position;
                return (d.r() - there).norm() <= distance;
            });
            if (known) continue;
            kept_on_edge.push_back(&place);
        }
        result.push_back(place.point);
    }
    return result;
}

std::vector<CurvaturePoint> SurfaceSearch::parts(const Wanted& wanted, const std::vector<LooseBox>& boxes,
                                                 std::vector<CurvaturePoint>& points) const {
    if (boxes.empty()) return wanted.level.exact() ? std::vector<CurvaturePoint>{} : points;
    const std::vector<std::vector<LooseBox>> members = connected(boxes, surface_.domain());
    const std::size_t count = members.size();
    std::vector<CurvaturePoint> result(count);
    for (std::size_t k = 0; k < count; ++k) {
        CurvaturePoint& part = result[k];
        part.query = wanted.query;
        part.opposite = wanted.opposite;
        part.extent = extent(members[k].front().part);
        for (const auto& [piece, misfit] : members[k]) {
            const ParameterBox box = extent(piece);
            part.extent.u = {std::min(part.extent.u.low, box.u.low), std::max(part.extent.u.high, box.u.high)};
            part.extent.v = {std::min(part.extent.v.low, box.v.low), std::max(part.extent.v.high, box.v.high)};
        }
    }
    if (!wanted.level.exact())
        for (const CurvaturePoint& point : points)
            for (std::size_t k = 0; k < count; ++k) {
                CurvaturePoint& part = result[k];
                const auto holds = [&](const LooseBox& loose) { return contains(loose.part, point.at.u, point.at.v); };
                if (!part.extent.contains(point.at.u, point.at.v) ||
                    std::none_of(members[k].begin(), members[k].end(), holds))
                    continue;
                part.solutions += point.solutions;
                if (!part.certified) {
                    part.at = point.at;
                    part.certified = point.certified;
                    part.radius = point.radius;
                }
                break;
            }
    for (std::size_t k = 0; k < count; ++k)
        if (!result[k].certified) improve(wanted, members[k], result[k]);
    return result;
}

void SurfaceSearch::improve(const Wanted& wanted, const std::vector<LooseBox>& boxes, CurvaturePoint& point) const {
    const CurvatureLevel& level = wanted.level;
    std::vector<LooseBox> starts = boxes;
    const std::size_t count = std::min(most_starts, starts.size());
    std::partial_sort(starts.begin(), starts.begin() + count, starts.end(),
                      [](const LooseBox& a, const LooseBox& b) { return a.misfit < b.misfit; });
    const double k_unit = level.exact() ? level.mean * level.mean + std::abs(level.gaussian) : level.gaussian_tolerance;
    const double h_unit = level.exact() ? std::sqrt(k_unit) : level.mean_tolerance;
    const ParameterBox& extent = point.extent;
    double least = std::numeric_limits<double>::infinity();
    const auto middle = [](const LooseBox& start) {
        const ParameterBox box = umbilic::extent(start.part);
        return Vector2(box.u.middle(), box.v.middle());
    };
    point.at = {0, middle(starts.front()).x(), middle(starts.front()).y()};
    for (std::size_t k = 0; k < count; ++k) {
        Vector2 at = middle(starts[k]);
        for (int step = 0; step < most_steps; ++step) {
            const SurfaceDerivatives d = surface_.derivatives(at.x(), at.y(), 3);
            if (!regular(d)) break;
            const CurvatureGradient c = curvature_gradient(d);
            const Vector2 miss((c.gaussian - level.gaussian) / k_unit, (c.mean - level.mean) / h_unit);
            if (!(miss.norm() < least)) break;
            least = miss.norm();
            point.at = {0, at.x(), at.y()};
            // Gauss-Newton in the tangent plane, where the gradients live; its frame has r_u along x.
            Matrix2 jacobian;
            jacobian << c.gaussian_slope.transpose() / k_unit, c.mean_slope.transpose() / h_unit;
            const Vector2 move = -jacobian.fullPivLu().solve(miss);
            const Vector3 normal = unit_normal(d), x = d.r_u().normalized(), y = normal.cross(x);
            const double dv = move.y() / d.r_v().dot(y);
            const double du = (move.x() - dv * d.r_v().dot(x)) / d.r_u().norm();
            if (!std::isfinite(du) || !std::isfinite(dv)) break;
            at = {extent.u.clamp(at.x() + du), extent.v.clamp(at.y() + dv)};
        }
    }
}

ParameterBox searched_box(const TrimmingRegion& region) {
    const ParameterBox domain = region.domain(), box = region.box();
    const double u = TrimmingRegion::polyline_deviation * domain.u.length();
    const double v = TrimmingRegion::polyline_deviation * domain.v.length();
    return {{box.u.low - u, box.u.high + u}, {box.v.low - v, box.v.high + v}};
}

}  // namespace

CurvaturePoints find_curvature_points(const NurbsSurface& surface, std::span<const CurvatureQuery> queries,
                                      const CurvaturePointOptions& options, const Progress& progress) {
    check(queries, options);
    if (options.recognition > 0.0)
        if (const auto why = curvature_dependence(surface, options.recognition)) return {.refused = why};
    return SurfaceSearch(surface, false, options).search(queries, surface.domain(), progress);
}

CurvaturePoints find_curvature_points(const Face& face, std::span<const CurvatureQuery> queries,
                                      const CurvaturePointOptions& options, const Progress& progress) {
    check(queries, options);
    if (options.recognition > 0.0)
        if (const auto why = curvature_dependence(face, options.recognition))
            return {.face = face.number, .refused = why};
    const bool whole = face.region.whole_domain();
    CurvaturePoints result = SurfaceSearch(face.surface, face.reversed, options)
                                 .search(queries, whole ? face.surface.domain() : searched_box(face.region), progress);
    result.face = face.number;
    for (CurvaturePoint& point : result.points) {
        point.at.face = face.number;
        if (!whole) point.containment = face.region.classify(point.at.u, point.at.v, point.radius);
    }
    return result;
}

std::vector<CurvaturePoints> find_curvature_points(const Model& model, std::span<const CurvatureQuery> queries,
                                                   const CurvaturePointOptions& options, const Progress& progress) {
    check(queries, options);
    std::vector<CurvaturePoints> result(model.faces.size());
    std::atomic<std::size_t> done{0};
    tbb::parallel_for(std::size_t(0), model.faces.size(), [&](std::size_t k) {
        progress.check();
        const auto fraction = [&] { return static_cast<double>(done) / static_cast<double>(result.size()); };
        result[k] = find_curvature_points(model.faces[k], queries, options, progress.part(fraction(), fraction()));
        ++done;
        progress.report(fraction(), "points of given curvature");
    });
    return result;
}

}  // namespace umbilic
