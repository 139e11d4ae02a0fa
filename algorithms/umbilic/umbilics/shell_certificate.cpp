// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/umbilics/shell_certificate.h>

#include <algorithm>
#include <cmath>
#include <map>

#include <tbb/parallel_for.h>

#include <umbilic/core/disjoint_sets.h>
#include <umbilic/core/errors.h>
#include <umbilic/differential/edge_smoothness.h>
#include <umbilic/differential/fundamental_forms.h>

namespace umbilic {

namespace {

/// Two faces place an umbilic on their edge this well if they agree exactly, relative to the diagonal of the model's
/// box: beyond the rounding of a file's digits.
constexpr double exact_reach = 1e-8;
/// Factor on first-order estimates of how far two faces disagree about the place of an umbilic.
constexpr double estimate_factor = 2.0;
/// Points at which the normals around a collapsed edge are compared, at this distance from it relative to the domain.
constexpr int tip_samples = 9;
constexpr double tip_distance = 1e-5;

/// Something with an index on a face or on its border.
struct Counted {
    Vector3 point;
    double index = 0.0;
    double reach = 0.0;   ///< mm: how far from it another face may see the same
    bool shared = false;  ///< another face should see it too
};

/// What is needed to count and judge one shell.
class ShellWork {
public:
    /// `edges`: those of the shell.
    ShellWork(const Model& model, const std::vector<FaceUmbilics>& found, const FaceAdjacency& adjacency,
              const Shell& shell, std::vector<const Edge*> edges)
        : model_(model), found_(found), adjacency_(adjacency), shell_(shell), edges_(std::move(edges)) {}

    ShellCertificate certify(const Progress& progress) {
        ShellCertificate result;
        result.faces = shell_.faces;
        result.closed = shell_.closed;
        if (shell_.closed) result.euler_characteristic = shell_.euler_characteristic;
        look_at_topology();
        look_at_faces();
        if (shell_.closed) {
            look_at_edges(progress);
            if (reasons_.empty()) look_within_faces(progress);
        }
        if (reasons_.empty()) result.index_sum = sum_of_indices();
        if (!reasons_.empty()) {
            for (const std::string& reason : reasons_) result.why += (result.why.empty() ? "" : "; ") + reason;
            result.why = "not evaluated: " + result.why;
            return result;
        }
        const bool equal = result.index_sum == *result.euler_characteristic;
        if (!equal && seen_by_one_) {
            result.why = "not evaluated: an umbilic lies nearer to an edge than its two faces agree";
            return result;
        }
        result.complete = equal;
        result.why = equal ? "the indices sum to Euler's characteristic of the closed smooth shell"
                           : "an umbilic is missing: the indices found do not sum to Euler's characteristic";
        return result;
    }

private:
    std::size_t index_of(int face) const { return static_cast<std::size_t>(adjacency_.borders.index[face]); }
    const Face& face(int number) const { return model_.faces[index_of(number)]; }
    const FaceUmbilics& found(int number) const { return found_[index_of(number)]; }
    void refuse(std::string reason) { reasons_.push_back(std::move(reason)); }

    static std::string count(std::size_t number, const std::string& noun) {
        return std::to_string(number) + " " + noun + (number == 1 ? "" : "s");
    }

    void look_at_topology() {
        if (!shell_.closed) {
            std::size_t free = 0, crowded = 0;
            for (const Edge* edge : edges_) {
                free += edge->uses.size() == 1;
                crowded += edge->uses.size() > 2;
            }
            if (free > 0) refuse("the shell is open, with " + count(free, "free edge"));
            if (crowded > 0) refuse("more than two faces meet at " + count(crowded, "edge"));
        } else if (shell_.euler_characteristic % 2 != 0) {
            refuse("the shell has an odd Euler characteristic, so its faces are not joined as they should be");
        }
    }

    void look_at_faces() {
        std::size_t whole = 0, lines = 0, undecided = 0, exhausted = 0;
        for (const int number : shell_.faces) {
            const FaceUmbilics& on = found(number);
            whole += !on.regions.empty();
            for (const UmbilicLine& line : on.lines) lines += line.containment != Containment::outside;
            for (const UndecidedCluster& cluster : on.undecided) {
                const Containment place = containment(number, cluster);
                undecided += place == Containment::boundary || (place == Containment::inside && !cluster.index);
            }
            exhausted += on.statistics.budget_exhausted;
        }
        if (whole > 0) refuse(count(whole, "face") + (whole == 1 ? " has" : " have") + " umbilic regions");
        if (lines > 0)
            refuse("there " + std::string(lines == 1 ? "is " : "are ") + count(lines, "line") + " of umbilics");
        if (undecided > 0) refuse(count(undecided, "place") + " could not be decided");
        if (exhausted > 0) refuse("the search used up its boxes on " + count(exhausted, "face"));
    }

    /// Boundary unless all corners of all boxes are on one side of the loops and none of them is met.
    Containment containment(int number, const UndecidedCluster& cluster) const {
        const TrimmingRegion& region = face(number).region;
        const ParameterBox domain = region.domain();
        if (region.whole_domain()) {
            const bool within = std::all_of(cluster.boxes.begin(), cluster.boxes.end(), [&](const ParameterBox& box) {
                return domain.u.low < box.u.low && box.u.high < domain.u.high && domain.v.low < box.v.low &&
                       box.v.high < domain.v.high;
            });
            return within ? Containment::inside : Containment::boundary;
        }
        std::optional<Containment> result;
        for (const ParameterBox& box : cluster.boxes) {
            const double radius = std::hypot(box.u.length() / domain.u.length(), box.v.length() / domain.v.length());
            const Containment place =
                region.classify(domain.u.clamp(box.u.middle()), domain.v.clamp(box.v.middle()), radius);
            if (place == Containment::boundary || (result && place != *result)) return Containment::boundary;
            result = place;
        }
        return result.value_or(Containment::outside);
    }

    void look_at_edges(const Progress& progress) {
        smoothness_.resize(edges_.size());
        tbb::parallel_for(std::size_t{0}, edges_.size(), [&](std::size_t i) {
            progress.check();
            smoothness_[i] = edge_smoothness(adjacency_, *edges_[i]);
        });
        std::size_t sharp = 0, jumps = 0, unknown = 0;
        for (const EdgeSmoothness& edge : smoothness_) {
            if (edge.samples == 0)
                ++unknown;
            else if (!edge.smooth(default_largest_bend))
                ++sharp;
            else if (edge.direction_jump > default_largest_direction_jump)
                ++jumps;
        }
        const std::string of = " of " + count(edges_.size(), "edge");
        if (sharp > 0) refuse(std::to_string(sharp) + of + (sharp == 1 ? " is sharp" : " are sharp"));
        if (jumps > 0) refuse("the curvature jumps across " + std::to_string(jumps) + of);
        if (unknown > 0) refuse("the faces have no normals along " + std::to_string(unknown) + of);
    }

    void look_within_faces(const Progress& progress) {
        std::size_t creases = 0, jumps = 0, tips = 0;
        for (const int number : shell_.faces) {
            progress.check();
            const EdgeSmoothness knots =
                elementary(face(number).kind) ? EdgeSmoothness{} : knot_smoothness(face(number));
            creases += knots.bend > default_largest_bend;
            jumps += knots.bend <= default_largest_bend && knots.direction_jump > default_largest_direction_jump;
            tips += has_tip(number);
        }
        if (creases > 0) refuse("there are creases within " + count(creases, "face"));
        if (jumps > 0) refuse("the curvature jumps within " + count(jumps, "face"));
        if (tips > 0) refuse("there are tips on " + count(tips, "face"));
    }

    /// A border curve that is a single point, around which the normals do not agree.
    bool has_tip(int number) const {
        const Face& here = face(number);
        const auto& loops = adjacency_.borders.loops_of(number);
        const ParameterBox domain = here.surface.domain();
        for (std::size_t loop = 0; loop < loops.size(); ++loop)
            for (std::size_t curve = 0; curve < loops[loop].size(); ++curve) {
                if (!adjacency_.edges_of[index_of(number)][loop][curve].empty()) continue;
                const TrimmingCurve& point = loops[loop][curve];
                std::optional<Vector3> first;
                for (int i = 0; i < tip_samples; ++i) {
                    const ParameterInterval range = point.curve.domain();
                    const Vector2 at =
                        here.region.curve_point(point, range.low + range.length() * (i + 0.5) / tip_samples);
                    // Towards the middle of the domain, off the point.
                    const auto inward = [](const ParameterInterval& interval, double value) {
                        return interval.clamp(value) + tip_distance * 2 * (interval.middle() - value);
                    };
                    const SurfaceDerivatives d =
                        here.surface.derivatives(inward(domain.u, at.x()), inward(domain.v, at.y()), 1);
                    if (!regular(d)) return true;
                    const Vector3 normal = unit_normal(d);
                    if (!first) first = normal;
                    if (std::acos(std::clamp(first->dot(normal), -1.0, 1.0)) > default_largest_bend) return true;
                }
            }
        return false;
    }

    /// How far (mm) the faces at the edges of one face may place an umbilic apart, as they disagree by the edges' gaps
    /// and curvature jumps. The derivative of the traceless second form has the least singular value
    /// 2 ||alpha| - |beta||.
    struct Disagreement {
        double gap = 0.0, jump = 0.0;

        double reach(const Umbilic& umbilic) const {
            const double slope = 2 * std::abs(std::abs(umbilic.kind.alpha) - std::abs(umbilic.kind.beta));
            return estimate_factor * (slope > 0.0 ? gap + jump / slope : gap);
        }
    };

    std::map<int, Disagreement> disagreements() const {
        std::map<int, Disagreement> result;
        for (std::size_t i = 0; i < edges_.size(); ++i)
            for (const EdgeUse& use : edges_[i]->uses) {
                Disagreement& of = result[use.piece.face];
                of.gap = std::max(of.gap, edges_[i]->gap);
                of.jump = std::max(of.jump, smoothness_[i].curvature_jump);
            }
        return result;
    }

    /// Another face lies at the border curve.
    bool shared(const BorderPoint& at) const {
        const std::vector<int>& pieces = adjacency_.edges_of[index_of(at.face)][at.loop][at.curve];
        return std::any_of(pieces.begin(), pieces.end(), [&](int piece) {
            const std::vector<EdgeUse>& uses = adjacency_.edges[piece].uses;
            return std::any_of(uses.begin(), uses.end(), [&](const EdgeUse& use) { return use.piece.face != at.face; });
        });
    }

    double sum_of_indices() {
        double sum = 0.0;
        std::vector<Counted> border;
        std::map<int, Disagreement> disagreement = disagreements();
        for (const int number : shell_.faces) {
            for (const UndecidedCluster& cluster : found(number).undecided)
                if (containment(number, cluster) == Containment::inside) sum += *cluster.index;
            for (const Umbilic& umbilic : found(number).umbilics) {
                Counted entry;
                entry.point = umbilic.point;
                entry.index = umbilic.index;
                entry.reach = exact_reach * model_.box.diagonal() + disagreement[number].reach(umbilic);
                bool on_border = umbilic.pole != PoleKind::none || umbilic.containment == Containment::boundary;
                if (umbilic.pole == PoleKind::none) {
                    const BorderPoint nearest = nearest_in_parameters(face(number), adjacency_.borders.loops_of(number),
                                                                      Vector2(umbilic.at.u, umbilic.at.v));
                    on_border = on_border || (nearest.point - umbilic.point).norm() <= entry.reach;
                    entry.shared = shared(nearest);
                }
                if (on_border)
                    border.push_back(entry);
                else if (umbilic.containment != Containment::outside)
                    sum += entry.index;
            }
        }
        return sum + sum_on_border(border);
    }

    /// What several faces see at one place counts once.
    double sum_on_border(const std::vector<Counted>& border) {
        DisjointSets same(border.size());
        for (std::size_t i = 0; i < border.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                if ((border[i].point - border[j].point).norm() <= border[i].reach + border[j].reach) same.unite(i, j);
        std::vector<std::size_t> members(border.size(), 0);
        double sum = 0.0;
        for (std::size_t i = 0; i < border.size(); ++i) {
            const std::size_t first = same.find(i);
            ++members[first];
            if (first == i) sum += border[i].index;
            if (border[i].index != border[first].index)
                refuse("two faces see umbilics of different index at one place of their edge");
        }
        for (std::size_t i = 0; i < border.size(); ++i)
            seen_by_one_ = seen_by_one_ || (border[i].shared && members[same.find(i)] == 1);
        return sum;
    }

    const Model& model_;
    const std::vector<FaceUmbilics>& found_;
    const FaceAdjacency& adjacency_;
    const Shell& shell_;
    std::vector<const Edge*> edges_;
    std::vector<EdgeSmoothness> smoothness_;
    std::vector<std::string> reasons_;
    /// An umbilic on an edge is listed for one of its faces only.
    bool seen_by_one_ = false;
};

}  // namespace

std::optional<int> ShellCertificate::genus() const {
    if (!euler_characteristic || *euler_characteristic % 2 != 0 || *euler_characteristic > 2) return std::nullopt;
    return (2 - *euler_characteristic) / 2;
}

std::vector<ShellCertificate> shell_certificates(const Model& model, const std::vector<FaceUmbilics>& found,
                                                 const Progress& progress) {
    if (found.size() != model.faces.size())
        throw InvalidInput("shell certificates: there must be one result of the umbilic search for each face");
    for (std::size_t k = 0; k < found.size(); ++k)
        if (found[k].face != model.faces[k].number)
            throw InvalidInput("shell certificates: the results of the umbilic search are not in the model's order");
    const FaceAdjacency adjacency = face_adjacency(model, {}, progress.part(0.0, 0.8));
    std::vector<std::vector<const Edge*>> edges(adjacency.shells.size());
    for (const Edge& edge : adjacency.edges)
        edges[adjacency.shell_of[adjacency.borders.index[edge.uses.front().piece.face]]].push_back(&edge);
    std::vector<ShellCertificate> result;
    for (std::size_t k = 0; k < edges.size(); ++k) {
        result.push_back(
            ShellWork(model, found, adjacency, adjacency.shells[k], std::move(edges[k])).certify(progress));
        progress.report(0.8 + 0.2 * static_cast<double>(k + 1) / static_cast<double>(edges.size()),
                        "certifying shells");
    }
    return result;
}

}  // namespace umbilic
