// SPDX-License-Identifier: LGPL-2.1-or-later
#include "trimmed_box.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <umbilic/nurbs/bezier_patch.h>

namespace umbilic {

namespace {

/// A piece that exceeds the box by less than this, relative to the box's diagonal, is left as it is.
constexpr double accuracy = 1e-5;

/// A piece that the region's border crosses is not divided below this size, relative to the domain's sides. Surface
/// that turns back between there and the border exceeds the border, which is in the box, by the square of this only.
constexpr double border_width = 2e-3;

/// Pieces are halved at most this often.
constexpr int deepest_halving = 40;

/// Points on a side of the domain rectangle of an untrimmed surface, a knot span.
constexpr int border_points = 8;

struct Piece {
    std::vector<Vector4> poles;
    ParameterBox domain;
    int depth = 0;
};

BoundingBox hull(const Piece& piece, const Vector3& origin) {
    BoundingBox box;
    for (const Vector4& pole : piece.poles) box.add(Vector3(pole.head<3>() / pole[3] + origin));
    return box;
}

/// de Casteljau at 1/2 along rows or columns; `piece` keeps the lower half, the upper one is returned.
Piece split(Piece& piece, int p, int q, bool along_u) {
    Piece upper = piece;
    const int lines = along_u ? q + 1 : p + 1, degree = along_u ? p : q;
    for (int line = 0; line < lines; ++line) {
        const auto at = [&](int k) { return along_u ? k * (q + 1) + line : line * (q + 1) + k; };
        std::vector<Vector4> row(degree + 1);
        for (int k = 0; k <= degree; ++k) row[k] = piece.poles[at(k)];
        for (int level = 0; level <= degree; ++level) {
            piece.poles[at(level)] = row[0];
            upper.poles[at(degree - level)] = row[degree - level];
            for (int k = 0; k + level < degree; ++k) row[k] = 0.5 * (row[k] + row[k + 1]);
        }
    }
    ParameterInterval& low = along_u ? piece.domain.u : piece.domain.v;
    ParameterInterval& high = along_u ? upper.domain.u : upper.domain.v;
    low.high = high.low = low.middle();
    ++piece.depth;
    ++upper.depth;
    return upper;
}

bool contains(const BoundingBox& box, const BoundingBox& other, double margin) {
    return (other.low.array() >= box.low.array() - margin).all() &&
           (other.high.array() <= box.high.array() + margin).all();
}

void add_border(const NurbsSurface& surface, const TrimmingRegion& region, BoundingBox& box) {
    const ParameterBox domain = region.domain();
    for (std::size_t i = 0; i < region.loops().size(); ++i)
        for (const Vector2& p : region.polyline(static_cast<int>(i)))
            box.add(surface.value(domain.u.clamp(p.x()), domain.v.clamp(p.y())));
    if (!region.whole_domain()) return;
    const auto add_side = [&](const KnotVector& knots, const auto& point) {
        for (std::size_t k = 0; k + 1 < knots.breaks().size(); ++k)
            for (int i = 0; i <= border_points; ++i)
                box.add(point(knots.breaks()[k] + (knots.breaks()[k + 1] - knots.breaks()[k]) * i / border_points));
    };
    for (const double v : {domain.v.low, domain.v.high})
        add_side(surface.u_knots(), [&](double u) { return surface.value(u, v); });
    for (const double u : {domain.u.low, domain.u.high})
        add_side(surface.v_knots(), [&](double v) { return surface.value(u, v); });
}

class Bounding {
public:
    Bounding(const NurbsSurface& surface, const TrimmingRegion& region, BoundingBox& box)
        : surface_(surface), region_(region), box_(box) {
        add_border(surface, region, box_);
    }

    void add(const BezierPatch& patch) {
        std::vector<Piece> open = {{patch.poles, patch.domain}};
        while (!open.empty()) {
            Piece piece = std::move(open.back());
            open.pop_back();
            if (contains(box_, hull(piece, patch.origin), accuracy * box_.diagonal())) continue;
            const double u = piece.domain.u.middle(), v = piece.domain.v.middle();
            // Larger than the distance from the middle to any point of the piece, a half diagonal.
            const double size = std::max(piece.domain.u.length() / region_.domain().u.length(),
                                         piece.domain.v.length() / region_.domain().v.length());
            const Containment place = region_.classify(u, v, size);
            if (place == Containment::outside) continue;
            if (region_.classify(u, v) != Containment::outside) box_.add(surface_.value(u, v));
            if (piece.depth >= deepest_halving || (place == Containment::boundary && size < border_width)) continue;
            const bool along_u =
                piece.domain.u.length() / patch.domain.u.length() >= piece.domain.v.length() / patch.domain.v.length();
            open.push_back(split(piece, patch.u_degree, patch.v_degree, along_u));
            open.push_back(std::move(piece));
        }
    }

private:
    const NurbsSurface& surface_;
    const TrimmingRegion& region_;
    BoundingBox& box_;
};

bool overlap(const ParameterBox& a, const ParameterBox& b) {
    return a.u.low <= b.u.high && b.u.low <= a.u.high && a.v.low <= b.v.high && b.v.low <= a.v.high;
}

}  // namespace

void extend_box(const NurbsSurface& surface, const TrimmingRegion& region, BoundingBox& box) {
    Bounding bounding(surface, region, box);
    for (const BezierPatch& patch : bezier_patches(surface).patches)
        if (overlap(patch.domain, region.box())) bounding.add(patch);
}

}  // namespace umbilic
