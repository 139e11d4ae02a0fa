// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/model/face_adjacency.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <tbb/parallel_for.h>

#include <umbilic/core/disjoint_sets.h>
#include <umbilic/core/errors.h>

namespace umbilic {

namespace {

/// Interior places at which the uses of an edge are compared, as shares of the first one's range.
constexpr std::array<double, 3> probes = {0.5, 0.2, 0.8};

/// Samples that tell whether a border curve is a single point in space.
constexpr int point_samples = 5;

bool single_point(const Face& face, const TrimmingCurve& curve, double tolerance) {
    if (curve.degenerate) return true;
    const ParameterInterval range = curve.curve.domain();
    const Vector3 start = boundary_point(face.surface, face.region, curve, range.low).r;
    for (int i = 1; i <= point_samples; ++i) {
        const double t = range.low + range.length() * i / point_samples;
        if ((boundary_point(face.surface, face.region, curve, t).r - start).norm() > tolerance) return false;
    }
    return true;
}

BorderPoint border_point(const Borders& borders, const BorderPiece& piece, double t) {
    const Face& face = borders.face(piece.face);
    const BoundaryPoint b = boundary_point(face.surface, face.region, borders.curve(piece), t);
    return {piece.face, piece.loop, piece.curve, t, b.parameters, b.r, b.r_t, 0.0};
}

/// The point of `to` next to `from`, which lies at the parameter `t` of `piece`.
BorderPoint counterpart(const Borders& borders, const BorderPiece& piece, double t, const BorderPoint& from,
                        const EdgeUse& to, bool same_direction, double tolerance) {
    const double share = (t - piece.range.low) / piece.range.length();
    const ParameterInterval& range = to.piece.range;
    const double guess = range.low + (same_direction ? share : 1 - share) * range.length();
    return nearest_in_space(borders.face(to.piece.face), borders.loops_of(to.piece.face), to.piece, from.point, guess,
                            tolerance);
}

/// Direction and gap of the uses after the first one.
void compare_uses(const Borders& borders, double tolerance, Edge& edge) {
    const BorderPiece& first = edge.uses.front().piece;
    for (std::size_t i = 1; i < edge.uses.size(); ++i) {
        EdgeUse& use = edge.uses[i];
        for (std::size_t k = 0; k < probes.size(); ++k) {
            const double t = first.range.low + probes[k] * first.range.length();
            const BorderPoint here = border_point(borders, first, t);
            const BorderPoint there = counterpart(borders, first, t, here, use, use.along, tolerance);
            if (k == 0) use.along = here.tangent.dot(there.tangent) >= 0.0;
            edge.gap = std::max(edge.gap, there.distance);
        }
    }
}

double derived_tolerance(const Model& model) {
    const double diagonal = model.box.diagonal();
    double stated = 0.0;
    for (const Face& face : model.faces) stated = std::max(stated, face.tolerance);
    return std::clamp(stated, relative_coincidence * diagonal, largest_relative_coincidence * diagonal);
}

/// Vertices: ends of edges (2 i the start, 2 i + 1 the end of edge i) that follow each other in some loop are one.
struct LoopWalk {
    FaceAdjacency& adjacency;
    DisjointSets& ends;

    /// Number of the face's loops that are not single points.
    int visit(std::size_t face) {
        int loops = 0;
        const auto& curves_of = adjacency.borders.loops[face];
        const int number = adjacency.borders.model->faces[face].number;
        for (int loop = 0; loop < static_cast<int>(curves_of.size()); ++loop) {
            std::vector<std::pair<std::size_t, std::size_t>> passed;  // ends through which the loop enters and leaves
            for (int curve = 0; curve < static_cast<int>(curves_of[loop].size()); ++curve) {
                std::vector<int> pieces = adjacency.edges_of[face][loop][curve];
                const bool backwards = curves_of[loop][curve].reversed;
                if (backwards) std::reverse(pieces.begin(), pieces.end());
                for (const int piece : pieces) {
                    const Edge& edge = adjacency.edges[piece];
                    const auto use = std::find_if(edge.uses.begin(), edge.uses.end(), [&](const EdgeUse& u) {
                        return u.piece.face == number && u.piece.loop == loop && u.piece.curve == curve;
                    });
                    const bool forward = use->along != backwards;
                    const std::size_t start = 2 * static_cast<std::size_t>(piece);
                    passed.emplace_back(forward ? start : start + 1, forward ? start + 1 : start);
                }
            }
            for (std::size_t i = 0; i < passed.size(); ++i)
                ends.unite(passed[i].second, passed[(i + 1) % passed.size()].first);
            loops += !passed.empty();
        }
        return loops;
    }
};

void find_shells(FaceAdjacency& adjacency) {
    const std::vector<Face>& faces = adjacency.borders.model->faces;
    const std::vector<int>& index = adjacency.borders.index;
    DisjointSets joined(faces.size());
    for (const Edge& edge : adjacency.edges)
        for (const EdgeUse& use : edge.uses) joined.unite(index[edge.uses.front().piece.face], index[use.piece.face]);

    adjacency.shell_of.assign(faces.size(), -1);
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const std::size_t root = joined.find(i);
        if (root == i) {
            adjacency.shell_of[i] = static_cast<int>(adjacency.shells.size());
            adjacency.shells.emplace_back();
            adjacency.shells.back().closed = true;
        }
        adjacency.shell_of[i] = adjacency.shell_of[root];
        adjacency.shells[adjacency.shell_of[i]].faces.push_back(faces[i].number);
    }

    DisjointSets ends(2 * adjacency.edges.size());
    LoopWalk walk{adjacency, ends};
    for (std::size_t i = 0; i < faces.size(); ++i)
        adjacency.shells[adjacency.shell_of[i]].euler_characteristic += 2 - walk.visit(i);
    for (std::size_t i = 0; i < adjacency.edges.size(); ++i) {
        const Edge& edge = adjacency.edges[i];
        Shell& shell = adjacency.shells[adjacency.shell_of[index[edge.uses.front().piece.face]]];
        shell.closed = shell.closed && edge.uses.size() == 2;
        ++shell.edges;
        for (const std::size_t end : {2 * i, 2 * i + 1}) shell.vertices += ends.find(end) == end;
    }
    for (Shell& shell : adjacency.shells) {
        std::sort(shell.faces.begin(), shell.faces.end());
        shell.closed = shell.closed && shell.edges > 0;
        shell.euler_characteristic += shell.vertices - shell.edges;
    }
}

}  // namespace

FaceAdjacency face_adjacency(const Model& model, const FaceAdjacencyOptions& options, const Progress& progress) {
    if (options.tolerance && !(std::isfinite(*options.tolerance) && *options.tolerance > 0.0))
        throw InvalidInput("the tolerance for coincident borders must be a positive length in mm");
    FaceAdjacency result{.borders = Borders(model), .tolerance = options.tolerance.value_or(derived_tolerance(model))};
    const Borders& borders = result.borders;

    progress.report(0.0, "joining faces");
    std::map<int, std::vector<BorderPiece>> by_number;
    std::vector<BorderPiece> loose;
    for (std::size_t i = 0; i < model.faces.size(); ++i) {
        result.edges_of.emplace_back(borders.loops[i].size());
        for (int loop = 0; loop < static_cast<int>(borders.loops[i].size()); ++loop) {
            const TrimmingLoop& curves = borders.loops[i][loop];
            result.edges_of[i][loop].resize(curves.size());
            for (int curve = 0; curve < static_cast<int>(curves.size()); ++curve) {
                if (single_point(model.faces[i], curves[curve], result.tolerance)) continue;
                const BorderPiece piece{model.faces[i].number, loop, curve, curves[curve].curve.domain()};
                if (curves[curve].edge > 0)
                    by_number[curves[curve].edge].push_back(piece);
                else
                    loose.push_back(piece);
            }
        }
    }
    for (const auto& [number, pieces] : by_number) {
        if (pieces.size() == 1) {
            loose.push_back(pieces.front());
            continue;
        }
        Edge edge{.stated = true};
        for (const BorderPiece& piece : pieces) edge.uses.push_back({piece});
        result.edges.push_back(std::move(edge));
    }
    progress.report(0.2, "joining faces");
    for (const std::vector<BorderPiece>& group : coincident_borders(borders, loose, result.tolerance)) {
        Edge edge;
        for (const BorderPiece& piece : group) edge.uses.push_back({piece});
        result.edges.push_back(std::move(edge));
    }

    progress.report(0.6, "joining faces");
    tbb::parallel_for(std::size_t{0}, result.edges.size(), [&](std::size_t i) {
        progress.check();
        for (EdgeUse& use : result.edges[i].uses)
            use.piece.face_on_left =
                face_on_left(borders.face(use.piece.face), borders.curve(use.piece), use.piece.range);
        compare_uses(borders, result.tolerance, result.edges[i]);
    });

    for (std::size_t i = 0; i < result.edges.size(); ++i)
        for (const EdgeUse& use : result.edges[i].uses)
            result.edges_of[borders.index[use.piece.face]][use.piece.loop][use.piece.curve].push_back(
                static_cast<int>(i));
    const auto start_on = [&](int edge, int face, int loop, int curve) {
        for (const EdgeUse& use : result.edges[edge].uses)
            if (use.piece.face == face && use.piece.loop == loop && use.piece.curve == curve)
                return use.piece.range.low;
        return 0.0;
    };
    for (std::size_t i = 0; i < model.faces.size(); ++i)
        for (int loop = 0; loop < static_cast<int>(result.edges_of[i].size()); ++loop)
            for (int curve = 0; curve < static_cast<int>(result.edges_of[i][loop].size()); ++curve) {
                std::vector<int>& pieces = result.edges_of[i][loop][curve];
                std::sort(pieces.begin(), pieces.end(), [&](int a, int b) {
                    return start_on(a, model.faces[i].number, loop, curve) <
                           start_on(b, model.faces[i].number, loop, curve);
                });
            }
    find_shells(result);
    progress.report(1.0, "joining faces");
    return result;
}

std::vector<EdgeCrossing> across(const FaceAdjacency& adjacency, const BorderPoint& from) {
    const Borders& borders = adjacency.borders;
    std::vector<EdgeCrossing> result;
    for (const int number : adjacency.edges_of[borders.index[from.face]][from.loop][from.curve]) {
        const Edge& edge = adjacency.edges[number];
        for (const EdgeUse& own : edge.uses) {
            const BorderPiece& piece = own.piece;
            const bool holds = piece.face == from.face && piece.loop == from.loop && piece.curve == from.curve &&
                               piece.range.contains(from.t);
            if (!holds) continue;
            for (const EdgeUse& other : edge.uses) {
                if (&other == &own) continue;
                const bool same = own.along == other.along;
                const BorderPoint to =
                    counterpart(borders, piece, from.t, from, other, same, adjacency.tolerance + edge.gap);
                result.push_back({number, from, to, same, piece.face_on_left, other.piece.face_on_left});
            }
        }
    }
    return result;
}

}  // namespace umbilic
