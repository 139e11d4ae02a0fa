// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/model/coincident_borders.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <utility>

#include <nanoflann.hpp>

#include <umbilic/core/disjoint_sets.h>

namespace umbilic {

namespace {

/// Interior places at which two pieces are compared, as shares of the range.
constexpr std::array<double, 3> probes = {0.25, 0.5, 0.75};

/// The chords that stand for a curve while its neighbours are sought: so many for each polynomial span and at least.
constexpr int chords_per_span = 2;
constexpr int fewest_chords = 8;
/// The arc between two sample points reaches no farther from the nearer one than this share of the chord, as long as
/// the chord turns by less than a right angle.
constexpr double reach_of_chord = 0.75;

Vector3 position(const Borders& borders, const BorderPiece& piece, double t) {
    const Face& face = borders.face(piece.face);
    return boundary_point(face.surface, face.region, borders.curve(piece), t).r;
}

/// The ends of border pieces for search by distance: 2 i the start, 2 i + 1 the end of piece i.
struct EndTree {
    using Index = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, EndTree>, EndTree, 3>;

    std::vector<Vector3> at;
    std::unique_ptr<Index> index;

    EndTree(const Borders& borders, const std::vector<BorderPiece>& pieces) {
        for (const BorderPiece& piece : pieces) {
            at.push_back(position(borders, piece, piece.range.low));
            at.push_back(position(borders, piece, piece.range.high));
        }
        index = std::make_unique<Index>(3, *this, nanoflann::KDTreeSingleIndexAdaptorParams());
        index->buildIndex();
    }

    std::vector<std::size_t> within(const Vector3& point, double radius) const {
        std::vector<std::pair<unsigned, double>> found;
        index->radiusSearch(point.data(), radius * radius, found, nanoflann::SearchParams());
        std::vector<std::size_t> result;
        for (const auto& [end, squared] : found) result.push_back(end);
        std::sort(result.begin(), result.end());
        return result;
    }

    std::size_t kdtree_get_point_count() const { return at.size(); }
    double kdtree_get_pt(std::size_t i, std::size_t axis) const { return at[i][static_cast<int>(axis)]; }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
        return false;
    }
};

/// The curve cut at the ends of others that lie on it.
std::vector<BorderPiece> cut(const Borders& borders, const BorderPiece& whole, const EndTree& ends, double tolerance) {
    const Face& face = borders.face(whole.face);
    const std::vector<TrimmingLoop>& loops = borders.loops_of(whole.face);
    const int spans = static_cast<int>(borders.curve(whole).curve.knots().breaks().size()) - 1;
    const int chords = std::max(fewest_chords, chords_per_span * spans);
    std::vector<Vector3> samples;
    for (int i = 0; i <= chords; ++i)
        samples.push_back(position(borders, whole, whole.range.low + whole.range.length() * i / chords));
    std::vector<std::size_t> candidates;
    for (int i = 0; i <= chords; ++i) {
        double chord = 0.0;
        if (i > 0) chord = (samples[i] - samples[i - 1]).norm();
        if (i < chords) chord = std::max(chord, (samples[i + 1] - samples[i]).norm());
        for (const std::size_t end : ends.within(samples[i], reach_of_chord * chord + tolerance))
            candidates.push_back(end);
    }
    std::sort(candidates.begin(), candidates.end());
    candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());

    std::vector<double> cuts = {whole.range.low};
    std::vector<double> inner;
    for (const std::size_t end : candidates) {
        const Vector3& point = ends.at[end];
        if ((point - samples.front()).norm() <= 2 * tolerance || (point - samples.back()).norm() <= 2 * tolerance)
            continue;
        const BorderPoint foot = nearest_in_space(face, loops, whole, point, whole.range.middle(), tolerance);
        if (foot.distance <= tolerance) inner.push_back(foot.t);
    }
    std::sort(inner.begin(), inner.end());
    for (const double t : inner)
        if ((position(borders, whole, t) - position(borders, whole, cuts.back())).norm() > 2 * tolerance)
            cuts.push_back(t);
    cuts.push_back(whole.range.high);
    std::vector<BorderPiece> result;
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
        result.push_back(whole);
        result.back().range = {cuts[i], cuts[i + 1]};
    }
    return result;
}

bool coincide(const Borders& borders, const BorderPiece& a, const BorderPiece& b, double tolerance) {
    const Face& face = borders.face(b.face);
    return std::all_of(probes.begin(), probes.end(), [&](double share) {
        const Vector3 point = position(borders, a, a.range.low + share * a.range.length());
        const double guess = b.range.low + share * b.range.length();
        return nearest_in_space(face, borders.loops_of(b.face), b, point, guess, tolerance).distance <= tolerance;
    });
}

}  // namespace

Borders::Borders(const Model& of) : model(&of) {
    int greatest = 0;
    for (const Face& face : of.faces) greatest = std::max(greatest, face.number);
    index.assign(greatest + 1, -1);
    for (const Face& face : of.faces) {
        index[face.number] = static_cast<int>(loops.size());
        loops.push_back(border_loops(face));
    }
}

std::vector<std::vector<BorderPiece>> coincident_borders(const Borders& borders, const std::vector<BorderPiece>& curves,
                                                         double tolerance) {
    if (curves.empty()) return {};
    std::vector<BorderPiece> pieces;
    const EndTree curve_ends(borders, curves);
    for (const BorderPiece& curve : curves)
        for (const BorderPiece& piece : cut(borders, curve, curve_ends, tolerance)) pieces.push_back(piece);

    // Ends within the tolerance are one corner; partners have the same two corners.
    const EndTree ends(borders, pieces);
    DisjointSets corners(ends.at.size());
    for (std::size_t i = 0; i < ends.at.size(); ++i)
        for (const std::size_t other : ends.within(ends.at[i], 2 * tolerance)) corners.unite(i, other);
    std::map<std::pair<std::size_t, std::size_t>, std::vector<std::size_t>> by_corners;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const std::size_t a = corners.find(2 * i), b = corners.find(2 * i + 1);
        by_corners[{std::min(a, b), std::max(a, b)}].push_back(i);
    }

    std::vector<std::vector<BorderPiece>> result;
    for (const auto& [key, members] : by_corners) {
        std::vector<std::vector<BorderPiece>> groups;
        for (const std::size_t member : members) {
            const auto partner = std::find_if(groups.begin(), groups.end(), [&](const auto& group) {
                return coincide(borders, pieces[member], group.front(), tolerance);
            });
            if (partner == groups.end())
                groups.push_back({pieces[member]});
            else
                partner->push_back(pieces[member]);
        }
        std::move(groups.begin(), groups.end(), std::back_inserter(result));
    }
    return result;
}

}  // namespace umbilic
