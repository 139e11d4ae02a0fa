// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/wireframe/border_nodes.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include <Eigen/Geometry>

#include <umbilic/nurbs/boundary_point.h>

namespace umbilic {

namespace {

/// Nodes and weights of Gauss and Legendre's quadrature on [-1, 1].
constexpr std::array<double, 4> gauss_node = {-0.8611363115940526, -0.3399810435848563, 0.3399810435848563,
                                              0.8611363115940526};
constexpr std::array<double, 4> gauss_weight = {0.3478548451374538, 0.6521451548625461, 0.6521451548625461,
                                                0.3478548451374538};
/// Parts of a knot span of a border curve, on each of which the quadrature is used.
constexpr int parts_per_span = 2;
/// A part is halved while that changes its length by more than this share: knots of the surface that the curve crosses
/// spoil the quadrature.
constexpr double relative_accuracy = 1e-8;
constexpr int most_halvings = 16;
/// Between knots nearer to each other than this share of the curve rounding decides: such a part is not halved, and
/// the tangent is not asked for there.
constexpr double narrow_part = 1e-9;
/// Tangents are taken this share of a part inside of its ends.
constexpr double inset = 1e-6;
/// Greatest turn of the tangent between neighbours.
constexpr double greatest_turn = std::numbers::pi / 3;
constexpr int most_parts = 100000;

/// A border curve of a face by arc length.
class ArcLength {
public:
    ArcLength(const Face& face, const TrimmingCurve& curve, const ParameterInterval& range)
        : face_(face), curve_(curve) {
        std::vector<double> ends = {range.low};
        for (const double knot : breaks(face, curve))
            if (range.low < knot && knot < range.high) ends.push_back(knot);
        ends.push_back(range.high);
        t_ = {range.low};
        s_ = {0.0};
        for (std::size_t i = 0; i + 1 < ends.size(); ++i)
            for (int k = 0; k < parts_per_span; ++k) {
                const double low = t_.back(), high = ends[i] + (ends[i + 1] - ends[i]) * (k + 1) / parts_per_span;
                const bool narrow = !(high - low > narrow_part * range.length());
                add(low, high, quadrature(low, high), narrow ? most_halvings : 0);
            }
        // From end to end: what lies beyond the outermost nodes of a quadrature depends on the knots. At a knot itself
        // the tangent may be that of a piece too narrow to have one.
        Vector3 before = Vector3::Zero();
        for (std::size_t i = 0; i + 1 < t_.size(); ++i) {
            const double width = t_[i + 1] - t_[i];
            if (!(width > narrow_part * range.length())) continue;
            for (const double t : {t_[i] + inset * width, t_[i + 1] - inset * width}) {
                const Vector3 tangent = at(t).r_t;
                if (before.norm() > 0.0 && tangent.norm() > 0.0)
                    turn_ += std::atan2(before.cross(tangent).norm(), before.dot(tangent));
                before = tangent;
            }
        }
    }

    double length() const { return s_.back(); }
    double turn() const { return turn_; }

    BoundaryPoint at(double t) const { return boundary_point(face_.surface, face_.region, curve_, t); }

    /// Curve parameter at the arc length s.
    double parameter(double s) const {
        const auto above = std::upper_bound(s_.begin() + 1, s_.end() - 1, s);
        const std::size_t i = static_cast<std::size_t>(above - s_.begin()) - 1;
        const double low = t_[i], high = t_[i + 1], wanted = s - s_[i], whole = s_[i + 1] - s_[i];
        if (!(whole > 0.0)) return low;
        double t = low + (high - low) * wanted / whole;
        for (int n = 0; n < 4; ++n) {
            const double speed = at(t).r_t.norm();
            if (!(speed > 0.0)) break;
            const double correction = (quadrature(low, t) - wanted) / speed;
            t = std::clamp(t - correction, low, high);
            if (std::abs(correction) <= 1e-13 * (high - low)) break;
        }
        return t;
    }

private:
    double quadrature(double low, double high) const {
        double sum = 0.0;
        for (int g = 0; g < 4; ++g)
            sum += gauss_weight[g] * at(low + 0.5 * (high - low) * (1 + gauss_node[g])).r_t.norm();
        return 0.5 * (high - low) * sum;
    }

    /// Adds a part of the curve whose quadrature gave `length`, halved until that is accurate.
    void add(double low, double high, double length, int halvings) {
        const double middle = 0.5 * (low + high), first = quadrature(low, middle), second = quadrature(middle, high);
        if (halvings < most_halvings && std::abs(first + second - length) > relative_accuracy * (first + second)) {
            add(low, middle, first, halvings + 1);
            add(middle, high, second, halvings + 1);
            return;
        }
        t_.insert(t_.end(), {middle, high});
        s_.push_back(s_.back() + first);
        s_.push_back(s_.back() + second);
    }

    static std::vector<double> breaks(const Face& face, const TrimmingCurve& curve) {
        std::vector<double> result = curve.curve.knots().breaks();
        // A straight border along a parameter line meets the knot lines of the surface.
        if (curve.curve.knots().degree() == 1 && curve.curve.poles().size() == 2 && curve.curve.weights().empty()) {
            const Vector2 a = face.region.curve_point(curve, result.front()),
                          b = face.region.curve_point(curve, result.back());
            for (int k = 0; k < 2; ++k) {
                const KnotVector& knots = k == 0 ? face.surface.u_knots() : face.surface.v_knots();
                const bool identity = (k == 0 ? face.region.u_map() : face.region.v_map()).identity();
                if (!identity || !(std::abs(b[k] - a[k]) > 1e-6 * knots.domain().length())) continue;
                for (const double knot : knots.breaks()) {
                    const double share = (knot - a[k]) / (b[k] - a[k]);
                    if (share > 1e-9 && share < 1 - 1e-9)
                        result.push_back(curve.curve.domain().low + share * curve.curve.domain().length());
                }
            }
            std::sort(result.begin(), result.end());
        }
        return result;
    }

    const Face& face_;
    const TrimmingCurve& curve_;
    std::vector<double> t_, s_;
    double turn_ = 0.0;
};

/// An edge in equal parts: its ends and inner points on each of its uses, in the order of the edge.
struct DividedEdge {
    int parts = 1;
    double length = 0.0;
    /// All marks: parts * (between_count + 1) + 1 points of the first use.
    std::vector<Vector3> points;
    /// By use: (u, v) of the parts' ends, along the edge.
    std::vector<std::vector<Vector2>> parameters;
};

DividedEdge divide(const FaceAdjacency& adjacency, int number, double step, int multiple, int least,
                   const Progress& progress) {
    const Edge& edge = adjacency.edges[number];
    const Borders& borders = adjacency.borders;
    const BorderPiece& first = edge.uses.front().piece;
    const Face& face = borders.face(first.face);
    const ArcLength arc(face, borders.curve(first), first.range);
    DividedEdge result;
    result.length = arc.length();
    // The odd share keeps edges whose length is a multiple of the step away from the decision.
    const double by_step = std::ceil(result.length / (step * longest_stretch));
    const double by_turn = std::ceil(arc.turn() / greatest_turn - 0.037);
    result.parts = static_cast<int>(
        std::clamp(std::max({by_step, by_turn, double(least)}) * multiple, 1.0, static_cast<double>(most_parts)));
    const int marks = result.parts * (between_count + 1);
    std::vector<double> t(result.parts + 1);
    result.parameters.resize(edge.uses.size());
    for (int i = 0; i <= marks; ++i) {
        progress.check();
        const double at = i == 0       ? first.range.low
                          : i == marks ? first.range.high
                                       : arc.parameter(result.length * i / marks);
        const BoundaryPoint b = arc.at(at);
        result.points.push_back(b.r);
        if (i % (between_count + 1) == 0) {
            t[i / (between_count + 1)] = at;
            result.parameters[0].push_back(b.parameters);
        }
    }
    for (std::size_t use = 1; use < edge.uses.size(); ++use) {
        const BorderPiece& piece = edge.uses[use].piece;
        const Face& other = borders.face(piece.face);
        for (int i = 0; i <= result.parts; ++i) {
            const double share = (t[i] - first.range.low) / first.range.length();
            const double guess = edge.uses[use].along ? piece.range.low + share * piece.range.length()
                                                      : piece.range.high - share * piece.range.length();
            if (i == 0 || i == result.parts) {
                const bool low = (i == 0) == edge.uses[use].along;
                const BoundaryPoint end = boundary_point(other.surface, other.region, borders.curve(piece),
                                                         low ? piece.range.low : piece.range.high);
                result.parameters[use].push_back(end.parameters);
                continue;
            }
            const Vector3& point = result.points[i * (between_count + 1)];
            result.parameters[use].push_back(nearest_in_space(other, borders.loops_of(piece.face), piece, point, guess,
                                                              std::max(edge.gap, adjacency.tolerance))
                                                 .parameters);
        }
    }
    return result;
}

/// Equivalence classes of places.
struct Classes {
    std::vector<int> parent;
    int add() {
        parent.push_back(static_cast<int>(parent.size()));
        return parent.back();
    }
    int find(int i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    }
    void join(int a, int b) { parent[find(a)] = find(b); }
};

FaceBorder face_border(const FaceAdjacency& adjacency, std::size_t index, const std::vector<DividedEdge>& divided) {
    const Face& face = adjacency.borders.model->faces[index];
    const std::vector<TrimmingLoop>& loops = adjacency.borders.loops[index];
    FaceBorder result;
    Classes classes;
    std::vector<bool> on_border;
    /// First and last place of each use of a seam in this face, along the edge, and those between.
    std::map<int, std::vector<std::vector<int>>> seams;
    for (std::size_t l = 0; l < loops.size(); ++l) {
        std::vector<BorderNode> nodes;
        struct Stretch {
            int edge;
            std::vector<int> places;  ///< positions in `nodes`, the last one belongs to the next stretch
            bool along;
        };
        std::vector<Stretch> stretches;
        for (std::size_t c = 0; c < loops[l].size(); ++c) {
            const TrimmingCurve& curve = loops[l][c];
            std::vector<int> pieces = adjacency.edges_of[index][l][c];
            if (pieces.empty()) {
                const double t = curve.reversed ? curve.curve.domain().high : curve.curve.domain().low;
                const BoundaryPoint b = boundary_point(face.surface, face.region, curve, t);
                stretches.push_back({-1, {static_cast<int>(nodes.size())}, true});
                nodes.push_back({.parameters = b.parameters, .point = b.r, .kind = BorderKind::pole});
                continue;
            }
            if (curve.reversed) std::reverse(pieces.begin(), pieces.end());
            for (const int number : pieces) {
                const Edge& edge = adjacency.edges[number];
                const DividedEdge& marks = divided[number];
                std::size_t use = 0;
                double nearest = 1e300;
                for (std::size_t k = 0; k < edge.uses.size(); ++k) {
                    const BorderPiece& piece = edge.uses[k].piece;
                    if (piece.face != face.number || piece.loop != static_cast<int>(l) ||
                        piece.curve != static_cast<int>(c))
                        continue;
                    if (piece.range.low < nearest) {
                        nearest = piece.range.low;
                        use = k;
                    }
                }
                const bool seam = edge.uses.size() == 2 && edge.uses[0].piece.face == edge.uses[1].piece.face;
                // The loop runs against the edge's own direction?
                const bool along = edge.uses[use].along != curve.reversed;
                Stretch stretch{seam ? number : -1, {}, along};
                const int stride = between_count + 1;
                for (int i = 0; i < marks.parts; ++i) {
                    const int at = along ? i : marks.parts - i;
                    BorderNode node{.parameters = marks.parameters[use][at],
                                    .point = marks.points[at * stride],
                                    .kind = seam ? BorderKind::seam : BorderKind::border,
                                    .length = marks.length / marks.parts,
                                    .edge = number};
                    for (int k = 1; k < stride; ++k)
                        node.between.push_back(marks.points[at * stride + (along ? k : -k)]);
                    stretch.places.push_back(static_cast<int>(nodes.size()));
                    nodes.push_back(std::move(node));
                }
                stretches.push_back(std::move(stretch));
            }
        }
        // Places are numbered over all loops; the last of a stretch is the first of the next.
        std::vector<int> place(nodes.size());
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            place[i] = classes.add();
            on_border.push_back(false);
            nodes[i].identity = place[i];
        }
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            const std::size_t next = (i + 1) % nodes.size();
            if (nodes[i].kind == BorderKind::border) on_border[place[i]] = on_border[place[next]] = true;
            if (nodes[i].kind == BorderKind::pole) classes.join(place[i], place[next]);
        }
        for (const Stretch& stretch : stretches) {
            if (stretch.edge < 0) continue;
            std::vector<int> run;
            for (const int at : stretch.places) run.push_back(place[at]);
            run.push_back(place[(stretch.places.back() + 1) % nodes.size()]);
            if (!stretch.along) std::reverse(run.begin(), run.end());
            seams[stretch.edge].push_back(std::move(run));
        }
        result.loops.push_back(std::move(nodes));
    }
    for (const auto& [edge, runs] : seams)
        for (std::size_t k = 1; k < runs.size(); ++k)
            for (std::size_t i = 0; i < runs[0].size() && i < runs[k].size(); ++i) classes.join(runs[0][i], runs[k][i]);

    std::map<int, int> numbers;
    for (std::vector<BorderNode>& loop : result.loops)
        for (BorderNode& node : loop) {
            const auto [found, added] = numbers.emplace(classes.find(node.identity), static_cast<int>(numbers.size()));
            if (added) result.on_border.push_back(false);
            if (on_border[node.identity]) result.on_border[found->second] = true;
            node.identity = found->second;
        }
    result.identities = static_cast<int>(numbers.size());
    return result;
}

}  // namespace

std::vector<FaceBorder> border_nodes(const FaceAdjacency& adjacency, const BorderNodeOptions& options,
                                     const Progress& progress) {
    const std::size_t faces = adjacency.borders.model->faces.size();
    // A loop needs three nodes at least.
    std::vector<int> least(adjacency.edges.size(), 1);
    for (std::size_t f = 0; f < faces; ++f)
        for (std::size_t l = 0; l < adjacency.edges_of[f].size(); ++l) {
            std::vector<int> own;
            for (const std::vector<int>& pieces : adjacency.edges_of[f][l])
                own.insert(own.end(), pieces.begin(), pieces.end());
            if (own.empty() || own.size() > 2) continue;
            for (const int edge : own) least[edge] = std::max(least[edge], own.size() == 1 ? 3 : 2);
        }
    // Around a closed surface there shall be triangles, whose corners are three different nodes.
    for (std::size_t e = 0; e < adjacency.edges.size(); ++e)
        for (const EdgeUse& use : adjacency.edges[e].uses) {
            const Face& face = adjacency.borders.face(use.piece.face);
            if (face.u_closed || face.v_closed || face.u_periodic || face.v_periodic) least[e] = std::max(least[e], 3);
        }
    std::vector<DividedEdge> divided;
    for (std::size_t e = 0; e < adjacency.edges.size(); ++e) {
        progress.report(static_cast<double>(e) / static_cast<double>(adjacency.edges.size()), "border nodes");
        const int multiple = e < options.multiples.size() ? std::max(1, options.multiples[e]) : 1;
        divided.push_back(divide(adjacency, static_cast<int>(e), options.step, multiple, least[e], progress));
    }
    std::vector<FaceBorder> result;
    for (std::size_t f = 0; f < faces; ++f) result.push_back(face_border(adjacency, f, divided));
    return result;
}

}  // namespace umbilic
