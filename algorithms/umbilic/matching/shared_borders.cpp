// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/shared_borders.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <Eigen/Geometry>

#include <umbilic/differential/edge_smoothness.h>
#include <umbilic/points/neighbours.h>

namespace umbilic {

namespace {

/// Points that measure the length of an edge, and samples that it gets at least.
constexpr int measuring_points = 16, fewest_on_edge = 4;
/// Width of a bin of votes, in steps of the samples.
constexpr double bin_steps = 2.0;
/// Width of a cross-section, in steps.
constexpr double section_steps = 1.0;
/// Bins with the most votes that are refined, and steps of a refinement.
constexpr std::size_t refined_bins = 24;
constexpr int refining_steps = 12;
/// Amounts that part the borders by less than this share of a step are one.
constexpr double same_place = 0.1;

/// What a turn or slide does to a point: the orbit it stays on, and how far along it is.
class Orbits {
public:
    explicit Orbits(const FreeMotion& motion) : motion_(motion), x_(motion.direction.unitOrthogonal()) {
        y_ = motion.direction.cross(x_);
    }

    bool turns() const { return motion_.kind == FreeMotionKind::turn; }

    /// Radius and height of a turn, place in the plane across a slide; mm.
    Vector3 orbit(const Vector3& point) const {
        const Vector3 p = point - motion_.point;
        const double x = x_.dot(p), y = y_.dot(p);
        return turns() ? Vector3(std::hypot(x, y), motion_.direction.dot(p), 0.0) : Vector3(x, y, 0.0);
    }

    /// Radians or mm.
    double along(const Vector3& point) const {
        const Vector3 p = point - motion_.point;
        return turns() ? std::atan2(y_.dot(p), x_.dot(p)) : motion_.direction.dot(p);
    }

    /// Change of the point per unit of the amount.
    Vector3 velocity(const Vector3& point) const {
        return turns() ? motion_.direction.cross(point - motion_.point) : motion_.direction;
    }

private:
    FreeMotion motion_;
    Vector3 x_, y_;
};

using Samples = std::vector<BorderSamples::Sample>;

/// Suspect's borders in the original's space beside the original's.
struct Lay {
    const FreeMotion& motion;
    const BorderSamples& original;
    const Samples& suspect;
    Orbits orbits;
    Neighbours places;  ///< of the original's samples
    double unit;        ///< a step of the samples, as an amount
    double tolerance;

    /// For each sample the foot on the original's borders after the motion, if any is within `limit`.
    template <class Use>
    void each_foot(double amount, double limit, const Use& use) const {
        const SimilarityTransform move = motion.by(amount);
        for (const BorderSamples::Sample& sample : suspect) {
            const Vector3 point = move.apply(sample.point);
            const auto near = places.nearest(point, 1);
            if (near.empty() || near.front().squared_distance > std::pow(limit + original.step(), 2)) continue;
            const Vector3 foot = original.foot(original.samples()[near.front().index], point);
            if ((foot - point).norm() <= limit) use(sample, move.rotation * sample.tangent, point, foot);
        }
    }

    double refined(double amount) const {
        double limit = bin_steps * original.step();
        for (int i = 0; i < refining_steps; ++i) {
            double numerator = 0.0, denominator = 0.0;
            each_foot(amount, limit,
                      [&](const auto& sample, const Vector3& tangent, const auto& point, const auto& foot) {
                          // Across the border: along it the foot says nothing.
                          const Vector3 velocity = orbits.velocity(point);
                          const Vector3 across = velocity - tangent.dot(velocity) * tangent;
                          numerator += sample.length * across.dot(foot - point);
                          denominator += sample.length * across.squaredNorm();
                      });
            if (!(denominator > 0.0)) break;
            amount += numerator / denominator;
            limit = std::max(0.5 * limit, 2.0 * tolerance);
        }
        return amount;
    }

    /// How far the suspect's borders are apart at two amounts, mm.
    double apart(double a, double b) const {
        const SimilarityTransform at_a = motion.by(a), at_b = motion.by(b);
        double greatest = 0.0;
        for (const BorderSamples::Sample& sample : suspect)
            greatest = std::max(greatest, (at_a.apply(sample.point) - at_b.apply(sample.point)).norm());
        return greatest;
    }

    double shared_length(double amount) const {
        std::vector<std::pair<double, double>> shared;  // along the motion, mm across it
        double sum = 0.0;
        each_foot(amount, tolerance, [&](const auto& sample, const Vector3& tangent, const auto& point, const auto&) {
            shared.emplace_back(orbits.along(sample.point), sample.length * across_share(tangent, point));
            sum += shared.back().second;
        });
        // The heaviest cross-section.
        std::sort(shared.begin(), shared.end());
        double heaviest = 0.0, window = 0.0;
        for (std::size_t first = 0, last = 0; last < shared.size(); ++last) {
            window += shared[last].second;
            while (shared[last].first - shared[first].first > section_steps * unit) window -= shared[first++].second;
            heaviest = std::max(heaviest, window);
        }
        return sum - heaviest;
    }

    /// Part of a stretch of border at `point` that lies across the motion.
    double across_share(const Vector3& tangent, const Vector3& point) const {
        const Vector3 velocity = orbits.velocity(point);
        const double speed = velocity.squaredNorm();
        return speed > 0.0 ? std::max(0.0, 1.0 - std::pow(tangent.dot(velocity), 2) / speed) : 0.0;
    }
};

/// The amounts in the middle of the bins of amounts that the longest borders vote for, best first.
std::vector<double> voted_amounts(const Lay& lay, const Progress& progress) {
    const auto& originals = lay.original.samples();
    std::vector<Vector3> orbits;
    for (const BorderSamples::Sample& sample : originals) orbits.push_back(lay.orbits.orbit(sample.point));
    const Neighbours by_orbit(orbits);
    const bool turns = lay.orbits.turns();
    const double bin = bin_steps * lay.unit;
    const double around = 2.0 * std::numbers::pi;
    std::map<long, double> votes;
    for (const BorderSamples::Sample& sample : lay.suspect) {
        progress.check();
        const double own = lay.orbits.along(sample.point);
        const double weight = lay.across_share(sample.tangent, sample.point);
        std::vector<long> bins;
        for (const Neighbour& near : by_orbit.within(lay.orbits.orbit(sample.point), lay.original.step())) {
            double amount = lay.orbits.along(originals[near.index].point) - own;
            if (turns) amount -= around * std::floor(amount / around + 0.5);
            bins.push_back(std::lround(amount / bin));
        }
        std::sort(bins.begin(), bins.end());
        bins.erase(std::unique(bins.begin(), bins.end()), bins.end());
        for (const long b : bins) votes[b] += weight * sample.length;
    }
    std::vector<std::pair<double, long>> ranked;
    for (const auto& [b, length] : votes)
        if (length > 0.0) ranked.emplace_back(-length, b);
    std::sort(ranked.begin(), ranked.end());
    if (ranked.size() > refined_bins) ranked.resize(refined_bins);
    std::vector<double> amounts;
    for (const auto& [length, b] : ranked) amounts.push_back(bin * static_cast<double>(b));
    return amounts;
}

}  // namespace

BorderSamples::BorderSamples(const Model& model, int wanted, const Progress& progress)
    : adjacency_(face_adjacency(model, {}, progress.part(0.0, 0.5))) {
    const std::vector<EdgeSmoothness> smoothness = edge_smoothness(adjacency_, progress.part(0.5, 0.9));
    const auto at = [&](const Edge& edge, double share) {
        const BorderPiece& piece = edge.uses.front().piece;
        const Face& face = adjacency_.borders.face(piece.face);
        return boundary_point(face.surface, face.region, adjacency_.borders.curve(piece),
                              piece.range.low + share * piece.range.length());
    };
    std::vector<double> lengths(adjacency_.edges.size(), 0.0);
    double total = 0.0;
    for (std::size_t i = 0; i < lengths.size(); ++i) {
        if (smoothness[i].smooth(default_largest_bend)) continue;
        for (int k = 0; k < measuring_points; ++k)
            lengths[i] += at(adjacency_.edges[i], (k + 0.5) / measuring_points).r_t.norm() *
                          adjacency_.edges[i].uses.front().piece.range.length() / measuring_points;
        total += lengths[i];
    }
    for (std::size_t i = 0; i < lengths.size(); ++i) {
        if (!(lengths[i] > 0.0)) continue;
        const Edge& edge = adjacency_.edges[i];
        const int count = std::max(fewest_on_edge, static_cast<int>(std::ceil(wanted * lengths[i] / total)));
        for (int k = 0; k < count; ++k) {
            const double share = (k + 0.5) / count;
            const BoundaryPoint b = at(edge, share);
            const double speed = b.r_t.norm();
            if (!(speed > 0.0)) continue;
            const ParameterInterval& range = edge.uses.front().piece.range;
            const double length = speed * range.length() / count;
            samples_.push_back({b.r, b.r_t / speed, length, static_cast<int>(i), range.low + share * range.length()});
            step_ = std::max(step_, length);
        }
    }
}

Vector3 BorderSamples::foot(const Sample& sample, const Vector3& point) const {
    const BorderPiece& piece = adjacency_.edges[sample.edge].uses.front().piece;
    return nearest_in_space(adjacency_.borders.face(piece.face), adjacency_.borders.loops_of(piece.face), piece, point,
                            sample.t, step_)
        .point;
}

std::vector<SharedBorder> shared_borders(const FreeMotion& motion, const SimilarityTransform& pose,
                                         const BorderSamples& original, const BorderSamples& suspect, double tolerance,
                                         const Progress& progress) {
    if (motion.kind != FreeMotionKind::turn && motion.kind != FreeMotionKind::slide) return {};
    if (original.samples().empty() || suspect.samples().empty()) return {};
    Samples moved = suspect.samples();
    for (BorderSamples::Sample& sample : moved) {
        sample.tangent = (pose.apply(sample.point + sample.tangent) - pose.apply(sample.point)).normalized();
        sample.point = pose.apply(sample.point);
        sample.length *= pose.scale;
    }
    const Orbits orbits(motion);
    std::vector<Vector3> places;
    double reach = 0.0;
    for (const BorderSamples::Sample& sample : original.samples()) {
        places.push_back(sample.point);
        reach = std::max(reach, orbits.orbit(sample.point).x());
    }
    if (orbits.turns() && !(reach > 0.0)) return {};
    const double unit = original.step() / (orbits.turns() ? reach : 1.0);
    const Lay lay{motion, original, moved, orbits, Neighbours(places), unit, tolerance};

    std::vector<SharedBorder> all;
    for (const double start : voted_amounts(lay, progress)) {
        progress.check();
        const double amount = lay.refined(start);
        all.push_back({amount, lay.shared_length(amount)});
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const SharedBorder& a, const SharedBorder& b) { return a.length > b.length; });
    std::vector<SharedBorder> best;
    for (const SharedBorder& border : all) {
        // Less than a step is no stretch of border.
        if (border.length < std::max(original.step(), as_long_border * all.front().length)) break;
        const bool known = std::any_of(best.begin(), best.end(), [&](const SharedBorder& other) {
            return lay.apart(border.amount, other.amount) <= std::max(same_place * original.step(), 2.0 * tolerance);
        });
        if (!known) best.push_back(border);
    }
    return best;
}

}  // namespace umbilic
