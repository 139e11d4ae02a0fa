// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/umbilics/block_border.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <umbilic/umbilics/rectangle_border.h>

namespace umbilic {

namespace {

/// Half sides of a detour around an umbilic on the border that are tried, relative to its patch: large beside the
/// radius of the umbilic, small beside its distance from others.
constexpr std::array<double, 4> detour_sizes = {1e-4, 1e-5, 1e-6, 1e-7};
/// An umbilic nearer to the border than this share of its patch is gone around where the border cannot be evaluated.
constexpr double near_border = 1e-5;
/// Half sides of what is left out around a place where (A, B) may vanish, relative to its patch: the first one, the
/// factor by which it grows where it does not do, and the largest.
constexpr double first_cut = 1e-4, cut_growth = 4.0, largest_cut = 0.125;
constexpr std::size_t most_cuts = 64;
/// Rounds of leaving out.
constexpr int most_attempts = 32;

/// Distance of a place from the nearest side of its block, relative to its patch.
double border_gap(const Place& place, const ParameterBox& block) {
    return std::min({std::abs(place.at.x() - block.u.low) / place.patch_size.x(),
                     std::abs(place.at.x() - block.u.high) / place.patch_size.x(),
                     std::abs(place.at.y() - block.v.low) / place.patch_size.y(),
                     std::abs(place.at.y() - block.v.high) / place.patch_size.y()});
}

bool meet(const ParameterInterval& a, const ParameterInterval& b) {
    return a.low <= b.high && b.low <= a.high;
}

ParameterBox widened(const ParameterBox& box, const Vector2& margin) {
    return {{box.u.low - margin.x(), box.u.high + margin.x()}, {box.v.low - margin.y(), box.v.high + margin.y()}};
}

bool holds(const std::vector<ParameterBox>& boxes, const Vector2& at) {
    return std::any_of(boxes.begin(), boxes.end(),
                       [&](const ParameterBox& box) { return box.contains(at.x(), at.y()); });
}

double piece_length(const KnotVector& knots, double value) {
    const int piece = knots.piece(value);
    return knots.breaks()[piece + 1] - knots.breaks()[piece];
}

}  // namespace

bool on_border(const Place& place, const ParameterBox& block) {
    return border_gap(place, block) <= near_border;
}

bool meet(const ParameterBox& a, const ParameterBox& b) {
    return meet(a.u, b.u) && meet(a.v, b.v);
}

BlockBorder::BlockBorder(const NurbsSurface& surface, const BezierPatches& patches, const InputRounding& input,
                         const PatchRange& range, const ParameterBox& domain, const std::vector<Place>& places,
                         std::vector<ParameterBox> open)
    : surface_(surface),
      turning_(surface, patches, input, range),
      domain_(domain),
      places_(places),
      kept_{domain},
      removed_(std::move(open)) {}

std::optional<double> BlockBorder::excess() {
    for (const Place& place : places_)
        if (on_border(place, domain_) && !left_out(place.at)) go_around(place);
    for (int attempt = 0; attempt < most_attempts; ++attempt) {
        const std::vector<BorderSide> border = border_of_difference(kept_, removed_);
        std::vector<BorderSide> obstacles;
        if (const std::optional<double> winding = turning_.winding(border, &obstacles)) return excess_of(*winding);
        if (obstacles.empty()) obstacle_ = border.front().from;
        if (obstacles.empty() || !leave_out(obstacles)) break;
    }
    return std::nullopt;
}

double BlockBorder::excess_of(double winding) const {
    double result = 0.5 * winding;
    for (const Place& place : places_)
        if (holds(kept_, place.at) && !left_out(place.at)) result -= place.index;
    return result;
}

bool BlockBorder::left_out(const Vector2& at) const {
    return holds(removed_, at);
}

void BlockBorder::go_around(const Place& place) {
    const double gap = border_gap(place, domain_);
    for (const double size : detour_sizes) {
        const Vector2 half = size * place.patch_size;
        if (gap > 0.25 * size) continue;
        const auto crowds = [&](const Place& other) {
            return &other != &place && ((other.at - place.at).cwiseAbs().array() <= 4 * half.array()).all();
        };
        if (std::any_of(places_.begin(), places_.end(), crowds)) continue;
        const ParameterBox box = widened({{place.at.x(), place.at.x()}, {place.at.y(), place.at.y()}}, half);
        if (std::any_of(removed_.begin(), removed_.end(), [&](const ParameterBox& other) { return meet(box, other); }))
            continue;
        const std::optional<double> winding = turning_.winding(border_of_difference(std::span(&box, 1), {}));
        if (winding && 0.5 * *winding == place.index) {
            kept_.push_back(box);
            return;
        }
    }
    leave_out({{place.at, place.at}});
}

bool BlockBorder::leave_out(const std::vector<BorderSide>& obstacles) {
    const std::size_t before = cuts_.size();
    std::vector<bool> grown(before, false);
    for (const BorderSide& side : obstacles) {
        const Vector2 low = side.from.cwiseMin(side.to), high = side.from.cwiseMax(side.to);
        const ParameterBox box{{low.x(), high.x()}, {low.y(), high.y()}};
        obstacle_ = 0.5 * (low + high);
        bool known = false;
        for (std::size_t k = 0; k < before; ++k) {
            Cut& cut = cuts_[k];
            if (!meet(box, widened(removed_[cut.number], 1e-3 * cut.size * cut.patch_size))) continue;
            known = true;
            if (grown[k]) continue;
            grown[k] = true;
            cut.size *= cut_growth;
            if (cut.size > largest_cut) return false;
            removed_[cut.number] = widened(cut.core, cut.size * cut.patch_size);
        }
        if (known) continue;
        if (cuts_.size() == most_cuts) return false;
        const Vector2 patch_size(piece_length(surface_.u_knots(), obstacle_.x()),
                                 piece_length(surface_.v_knots(), obstacle_.y()));
        cuts_.push_back({box, patch_size, first_cut, removed_.size()});
        removed_.push_back(widened(box, first_cut * patch_size));
    }
    return true;
}

}  // namespace umbilic
