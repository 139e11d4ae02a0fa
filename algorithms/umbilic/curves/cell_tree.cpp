// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/curves/cell_tree.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <tbb/parallel_for.h>

#include <umbilic/curves/boundary_curve.h>
#include <umbilic/nurbs/bezier_patch.h>

namespace umbilic {

namespace {

/// A patch is halved at most `deepest` times when the tree is built, and less where there are so many patches that the
/// tree would get more cells than this, until the cells are accurate for points within a part of the model's radius:
/// far ones as long as that is cheap, near ones, which cost most queries, farther on. Queries halve further where they
/// must.
struct Halving {
    double distance, most_cells;
    int deepest;
};
constexpr Halving far_points{1.0, 32768, 8}, near_points{0.02, 65536, 12};
/// Cells are accurate if the second derivatives of the squared distance are known up to this part of those of the
/// surface's own metric.
constexpr double wanted_accuracy = 0.5;
/// Boxes are widened by this times the coordinates, against rounding.
constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();

bool accurate(const CellModel& m, double distance) {
    const double e = m.r_u.squaredNorm(), g = m.r_v.squaredNorm();
    const auto error = [&](int k) { return m.bend_far[k] * distance + m.bend_near[k]; };
    return error(0) <= wanted_accuracy * e && error(2) <= wanted_accuracy * g &&
           error(1) <= wanted_accuracy * std::sqrt(e * g);
}

int halvings_of(const Halving& halving, double patch_count) {
    return std::clamp(static_cast<int>(std::log2(halving.most_cells / patch_count)), 0, halving.deepest);
}

}  // namespace

/// What one face contributes; the numbers of patches are its own.
struct CellTree::Growth {
    std::vector<TreePatch> patches;
    std::vector<Cell> cells;
    std::vector<OrientedBox> boxes;
    std::vector<Vector4> net;
};

CellTree::CellTree(const std::vector<Face>& model_faces) {
    BoundingBox box;
    double patch_count = 0.0;
    for (const Face& face : model_faces) {
        box.add(face.surface.pole_box());
        patch_count += static_cast<double>((face.surface.u_knots().breaks().size() - 1) *
                                           (face.surface.v_knots().breaks().size() - 1));
        faces.push_back({face.number, face.surface, face.region, face.region.loops().empty()});
    }
    if (box.empty()) return;
    origin = box.center();
    radius = 0.5 * box.diagonal();
    far_halvings = halvings_of(far_points, patch_count);
    near_halvings = halvings_of(near_points, patch_count);

    std::vector<Growth> growths(faces.size());
    tbb::parallel_for(std::size_t{0}, faces.size(), [&](std::size_t i) {
        add_surface(static_cast<int>(i), growths[i]);
        add_loops(static_cast<int>(i), growths[i]);
    });
    std::vector<OrientedBox> boxes;
    for (Growth& growth : growths) {
        const int first = static_cast<int>(patches.size());
        std::move(growth.patches.begin(), growth.patches.end(), std::back_inserter(patches));
        for (Cell& cell : growth.cells) {
            cell.patch += first;
            cells.push_back(cell);
        }
        boxes.insert(boxes.end(), growth.boxes.begin(), growth.boxes.end());
    }
    if (cells.empty()) return;
    std::vector<int> order(cells.size());
    std::iota(order.begin(), order.end(), 0);
    build(order, 0, order.size(), boxes);
}

LocalDerivatives CellTree::evaluate(const TreePatch& patch, double u, double v) const {
    if (patch.kind != TreePatch::Kind::curve) return umbilic::evaluate(patch.local, u, v);
    const TreeFace& face = faces[patch.face];
    const double length = patch.domain.u.length();
    const BoundaryPoint point = boundary_point(face.surface, face.region, face.region.loops()[patch.loop][patch.curve],
                                               patch.domain.u.low + u * length);
    return {point.r - origin, length * point.r_t, Vector3::Zero(), length * length * point.r_tt,
            Vector3::Zero(),  Vector3::Zero()};
}

Vector2 CellTree::parameters(const TreePatch& patch, double u, double v) const {
    const auto at = [](const ParameterInterval& range, double t) {
        return t <= 0.0 ? range.low : t >= 1.0 ? range.high : range.low + t * range.length();
    };
    if (patch.kind == TreePatch::Kind::surface) return {at(patch.domain.u, u), at(patch.domain.v, v)};
    const TreeFace& face = faces[patch.face];
    const Vector2 p = face.region.curve_point(face.region.loops()[patch.loop][patch.curve], at(patch.domain.u, u));
    const ParameterBox domain = face.surface.domain();
    return {domain.u.clamp(p.x()), domain.v.clamp(p.y())};
}

CellModel CellTree::model(const TreePatch& patch, const LocalBox& box, std::vector<Vector4>& net) const {
    if (patch.kind != TreePatch::Kind::curve) {
        restrict_net(patch.local, box, net);
        return cell_model(patch.local, box, net);
    }
    net.clear();
    const TreeFace& face = faces[patch.face];
    CellModel result = boundary_model(face.surface, face.region, face.region.loops()[patch.loop][patch.curve],
                                      patch.domain.u.low + box.low[0] * patch.domain.u.length(),
                                      patch.domain.u.low + box.high[0] * patch.domain.u.length());
    result.c -= origin;
    return result;
}

int CellTree::longer_side(const CellModel& model) {
    return model.speed[0] >= model.speed[1] ? 0 : 1;
}

void CellTree::grow(Growth& growth, int patch, const Cell& cell, int depth) const {
    const TreePatch& source = growth.patches[patch];
    const TrimmingRegion& region = faces[source.face].region;
    Cell grown = cell;
    grown.patch = patch;
    if (!cell.on_loop && cell.trimmed) {
        const Vector2 low = parameters(source, cell.box.low[0], cell.box.low[1]);
        const Vector2 high = parameters(source, cell.box.high[0], cell.box.high[1]);
        const ParameterBox domain = region.domain();
        const Vector2 side((high - low).x() / domain.u.length(), (high - low).y() / domain.v.length());
        const Vector2 middle = 0.5 * (low + high);
        const Containment place = region.classify(middle.x(), middle.y(), 0.5 * side.norm());
        if (place == Containment::outside) return;
        grown.trimmed = place == Containment::boundary;
    }
    grown.model = model(source, cell.box, growth.net);
    if ((depth < far_halvings && !accurate(grown.model, far_points.distance * radius)) ||
        (depth < near_halvings && !accurate(grown.model, near_points.distance * radius))) {
        const int side = longer_side(grown.model);
        const double middle = 0.5 * (cell.box.low[side] + cell.box.high[side]);
        Cell low = grown, high = grown;
        low.box.high[side] = high.box.low[side] = middle;
        low.border[2 * side + 1] = high.border[2 * side] = false;
        grow(growth, patch, low, depth + 1);
        grow(growth, patch, high, depth + 1);
        return;
    }

    OrientedBox box;
    const CellModel& m = grown.model;
    if (growth.net.empty()) {
        const double off = 0.125 * (m.r_uu.norm() + m.bend_far[0]);
        box = {m.c, frame_along(m.r_u, m.r_uu), Vector3(0.5 * m.r_u.norm() + off, off, off)};
    } else {
        std::vector<Vector3> points;
        for (const Vector4& h : growth.net) points.push_back(h.head<3>() / h[3]);
        box = box_around(points, frame_along(m.r_u, m.r_v));
    }
    box.half.array() += rounding * radius;
    growth.cells.push_back(grown);
    growth.boxes.push_back(box);
}

void CellTree::add_surface(int face, Growth& growth) const {
    const TreeFace& source = faces[face];
    const BezierPatches pieces = bezier_patches(source.surface);
    const ParameterBox domain = source.surface.domain();
    ParameterBox part = domain;
    if (!source.whole) {
        const double u_slack = TrimmingRegion::polyline_deviation * domain.u.length();
        const double v_slack = TrimmingRegion::polyline_deviation * domain.v.length();
        const ParameterBox box = source.region.box();
        part = {{domain.u.clamp(box.u.low - u_slack), domain.u.clamp(box.u.high + u_slack)},
                {domain.v.clamp(box.v.low - v_slack), domain.v.clamp(box.v.high + v_slack)}};
    }
    for (int i = 0; i < pieces.u_count; ++i)
        for (int j = 0; j < pieces.v_count; ++j) {
            const BezierPatch& piece = pieces.patches[i * pieces.v_count + j];
            Cell cell;
            const std::array<ParameterInterval, 2> whole = {piece.domain.u, piece.domain.v};
            const std::array<ParameterInterval, 2> wanted = {part.u, part.v};
            const std::array<int, 2> number = {i, j};
            bool empty = false;
            for (int side = 0; side < 2; ++side) {
                const KnotVector& knots = side == 0 ? source.surface.u_knots() : source.surface.v_knots();
                cell.box.low[side] = std::clamp((wanted[side].low - whole[side].low) / whole[side].length(), 0.0, 1.0);
                cell.box.high[side] =
                    std::clamp((wanted[side].high - whole[side].low) / whole[side].length(), 0.0, 1.0);
                empty = empty || !(cell.box.low[side] < cell.box.high[side]);
                // Continuity is -1 at the ends of the domain.
                cell.border[2 * side] = cell.box.low[side] == 0.0 && knots.continuity(number[side]) <= 0;
                cell.border[2 * side + 1] = cell.box.high[side] == 1.0 && knots.continuity(number[side] + 1) <= 0;
            }
            TreePatch patch{TreePatch::Kind::surface, {}, face, piece.domain, -1, -1};
            patch.local = {piece.u_degree, piece.v_degree, piece.rational, piece.poles};
            for (Vector4& h : patch.local.poles) h.head<3>() += h[3] * (piece.origin - origin);
            growth.patches.push_back(std::move(patch));
            cell.trimmed = !source.region.whole_domain();
            if (!empty) grow(growth, static_cast<int>(growth.patches.size()) - 1, cell, 0);
        }
}

void CellTree::add_loops(int face, Growth& growth) const {
    const TreeFace& source = faces[face];
    const int surface_patches = static_cast<int>(growth.patches.size());
    for (std::size_t loop = 0; loop < source.region.loops().size(); ++loop)
        for (std::size_t number = 0; number < source.region.loops()[loop].size(); ++number) {
            const TrimmingCurve& curve = source.region.loops()[loop][number];
            Cell cell;
            cell.on_loop = true;
            cell.border = {true, true, true, true};
            if (const std::optional<ParameterBox> line = iso_line(source.region, curve)) {
                // Along a parameter line the loop is an edge of a part of the surface's patches.
                const bool along_u = line->u.length() > 0.0;
                for (int k = 0; k < surface_patches; ++k) {
                    const ParameterBox& domain = growth.patches[k].domain;
                    const std::array<ParameterInterval, 2> whole = {domain.u, domain.v};
                    const std::array<ParameterInterval, 2> wanted = {line->u, line->v};
                    bool touches = true;
                    for (int side = 0; side < 2; ++side) {
                        const bool thin = side == (along_u ? 1 : 0);
                        cell.box.low[side] =
                            std::clamp((wanted[side].low - whole[side].low) / whole[side].length(), 0.0, 1.0);
                        cell.box.high[side] =
                            std::clamp((wanted[side].high - whole[side].low) / whole[side].length(), 0.0, 1.0);
                        touches = touches && wanted[side].low <= whole[side].high &&
                                  whole[side].low <= wanted[side].high &&
                                  (thin || line->u.length() + line->v.length() == 0.0 ||
                                   cell.box.low[side] < cell.box.high[side]);
                    }
                    if (!touches) continue;
                    grow(growth, k, cell, 0);
                }
                continue;
            }
            cell.box.high[1] = 0.0;
            const std::vector<LocalPatch> flat = flat_images(source.surface, source.region, curve, origin);
            const std::vector<double> breaks =
                flat.empty() ? smooth_pieces(source.surface, source.region, curve) : curve.curve.knots().breaks();
            for (std::size_t k = 0; k + 1 < breaks.size(); ++k) {
                const TreePatch::Kind kind = flat.empty() ? TreePatch::Kind::curve : TreePatch::Kind::flat_curve;
                growth.patches.push_back({kind,
                                          flat.empty() ? LocalPatch{} : flat[k],
                                          face,
                                          {{breaks[k], breaks[k + 1]}, {0.0, 0.0}},
                                          static_cast<int>(loop),
                                          static_cast<int>(number)});
                grow(growth, static_cast<int>(growth.patches.size()) - 1, cell, 0);
            }
        }
}

int CellTree::build(std::vector<int>& order, std::size_t begin, std::size_t end,
                    const std::vector<OrientedBox>& boxes) {
    const int number = static_cast<int>(nodes.size());
    nodes.emplace_back();
    // Halve at the median of the centres along the longest side of their box; twice makes four parts.
    const auto halve = [&](std::size_t from, std::size_t to) {
        BoundingBox range;
        for (std::size_t i = from; i < to; ++i) range.add(boxes[order[i]].center);
        int axis = 0;
        (range.high - range.low).maxCoeff(&axis);
        const std::size_t middle = from + (to - from) / 2;
        std::nth_element(order.begin() + from, order.begin() + middle, order.begin() + to, [&](int a, int b) {
            const double x = boxes[a].center[axis], y = boxes[b].center[axis];
            return x < y || (x == y && a < b);
        });
        return middle;
    };
    std::vector<std::pair<std::size_t, std::size_t>> parts = {{begin, end}};
    for (int round = 0; round < 2; ++round) {
        std::vector<std::pair<std::size_t, std::size_t>> finer;
        for (const auto& [from, to] : parts) {
            if (to - from < 2) {
                finer.push_back({from, to});
                continue;
            }
            const std::size_t middle = halve(from, to);
            finer.push_back({from, middle});
            finer.push_back({middle, to});
        }
        parts = std::move(finer);
    }

    BoxNode node;
    node.center = node.half = {};
    node.axis = {};
    node.child = {};
    node.count = static_cast<int>(parts.size());
    for (int k = 0; k < node.count; ++k) {
        const auto [from, to] = parts[k];
        OrientedBox box = boxes[order[from]];
        if (to - from > 1) {
            std::vector<Vector3> points;
            for (std::size_t i = from; i < to; ++i)
                for (const Vector3& corner : boxes[order[i]].corners()) points.push_back(corner);
            box = box_around(points);
            box.half.array() += rounding * radius;
            node.child[k] = build(order, from, to, boxes);
        } else {
            node.child[k] = -1 - order[from];
        }
        for (int a = 0; a < 3; ++a) {
            node.center[a][k] = box.center[a];
            node.half[a][k] = box.half[a];
            for (int b = 0; b < 3; ++b) node.axis[a][b][k] = box.axes(a, b);
        }
    }
    nodes[number] = node;
    return number;
}

}  // namespace umbilic
