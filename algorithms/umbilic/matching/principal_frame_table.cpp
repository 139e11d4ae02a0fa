// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/principal_frame_table.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <nanoflann.hpp>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <umbilic/matching/occupied_grid.h>

namespace umbilic {

namespace {

/// The point set as nanoflann asks for it, apart from the entries so that look-ups stay within the processor's caches.
struct Positions {
    std::vector<Vector3> points;

    std::size_t kdtree_get_point_count() const { return points.size(); }
    double kdtree_get_pt(std::size_t i, std::size_t axis) const { return points[i][axis]; }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
        return false;
    }
};

using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Positions>, Positions, 3>;

/// For approximate distances a sample will do that is at most this many times as far as the nearest one, half a step or
/// so away.
constexpr float near_enough = 2.0f;

Cubic scaled(const Cubic& c, double factor) {
    return {c.a * factor, c.b * factor, c.c * factor, c.d * factor};
}

}  // namespace

ShapeSignature shape_signature(const SurfaceDerivatives& d, bool outward) {
    const Curvature frame = curvature(d);
    const MongeForm monge = monge_form(d);
    ShapeSignature result;
    result.magnitude = std::hypot(frame.kappa_max, frame.kappa_min);
    result.angle = std::atan2(frame.kappa_min, frame.kappa_max);
    if (result.magnitude > 0.0) {
        result.anisotropy = (frame.kappa_max - frame.kappa_min) / result.magnitude;
        const double turn = std::atan2(frame.direction_max.dot(monge.y), frame.direction_max.dot(monge.x));
        result.cubic = scaled(monge.cubic.rotated(turn), 1.0 / (result.magnitude * result.magnitude));
    }
    return outward ? result : seen_from_behind(result);
}

ShapeSignature half_turned(const ShapeSignature& signature) {
    ShapeSignature result = signature;
    result.cubic = scaled(signature.cubic, -1.0);
    return result;
}

ShapeSignature seen_from_behind(const ShapeSignature& signature) {
    // kappa_max and kappa_min change sign and roles; the frame (e1, e2) becomes (e2, e1); the cubic form changes sign.
    ShapeSignature result = signature;
    result.angle =
        std::atan2(-signature.magnitude * std::cos(signature.angle), -signature.magnitude * std::sin(signature.angle));
    const Cubic& c = signature.cubic;
    result.cubic = {-c.d, -c.c, -c.b, -c.a};
    return result;
}

ShapeSignature mirrored(const ShapeSignature& signature) {
    ShapeSignature result = signature;
    result.cubic.b = -signature.cubic.b;
    result.cubic.d = -signature.cubic.d;
    return result;
}

struct PrincipalFrameTable::Index {
    explicit Index(const std::vector<Entry>& entries)
        : positions(positions_of(entries)), tree(3, positions, {10}), grid(positions.points) {}

    static Positions positions_of(const std::vector<Entry>& entries) {
        Positions result;
        for (const Entry& entry : entries) result.points.push_back(entry.frame.point);
        return result;
    }

    /// Sample nearest to a point; another one may be returned that is at most `slack` times as far.
    const Entry* find(const std::vector<Entry>& entries, const Vector3& point, double limit, float slack) const;

    Positions positions;
    Tree tree;
    OccupiedGrid grid;
};

PrincipalFrameTable::~PrincipalFrameTable() = default;
PrincipalFrameTable::PrincipalFrameTable(PrincipalFrameTable&&) noexcept = default;

PrincipalFrameTable::PrincipalFrameTable(const Model& model, int count, const Progress& progress) {
    const std::vector<AreaSample> samples = area_samples(model, {.count = count}, progress.part(0.0, 0.5));
    std::vector<int> place(1, -1);
    for (std::size_t i = 0; i < model.faces.size(); ++i) {
        const int number = model.faces[i].number;
        if (number >= static_cast<int>(place.size())) place.resize(number + 1, -1);
        place[number] = static_cast<int>(i);
    }
    entries_.resize(samples.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, samples.size(), 256), [&](const auto& range) {
        progress.check();
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            const Face& face = model.faces[place[samples[i].at.face]];
            const SurfaceDerivatives d = face.surface.derivatives(samples[i].at.u, samples[i].at.v, 3);
            // The frame is taken anew: the sign of its directions must be the one the signature's cubic refers to.
            const Curvature frame = curvature(d);
            entries_[i] = {face.reversed ? flipped(frame) : frame, shape_signature(d, !face.reversed), face.number};
        }
    });
    step_ = entries_.empty() ? 0.0 : std::sqrt(model.area / static_cast<double>(entries_.size()));
    arrange();
}

PrincipalFrameTable::PrincipalFrameTable(std::vector<Entry> entries, double step, std::optional<double> extent)
    : entries_(std::move(entries)), step_(step) {
    arrange();
    if (extent) extent_ = *extent;
}

PrincipalFrameTable PrincipalFrameTable::of_face(int face) const {
    std::vector<Entry> entries;
    std::copy_if(entries_.begin(), entries_.end(), std::back_inserter(entries),
                 [&](const Entry& entry) { return entry.face == face; });
    return PrincipalFrameTable(std::move(entries), step_);
}

void PrincipalFrameTable::arrange() {
    std::stable_sort(entries_.begin(), entries_.end(),
                     [](const Entry& a, const Entry& b) { return a.signature.angle < b.signature.angle; });

    Vector3 centroid = Vector3::Zero();
    for (const Entry& entry : entries_) centroid += entry.frame.point / static_cast<double>(entries_.size());
    double spread = 0.0;
    for (const Entry& entry : entries_) spread += (entry.frame.point - centroid).squaredNorm();
    extent_ = entries_.empty() ? 0.0 : 2 * std::sqrt(spread / static_cast<double>(entries_.size()));
    index_ = std::make_unique<const Index>(entries_);
}

std::pair<int, int> PrincipalFrameTable::angle_range(double low, double high) const {
    const auto first = std::lower_bound(entries_.begin(), entries_.end(), low,
                                        [](const Entry& e, double x) { return e.signature.angle < x; });
    const auto last =
        std::upper_bound(first, entries_.end(), high, [](double x, const Entry& e) { return x < e.signature.angle; });
    return {static_cast<int>(first - entries_.begin()), static_cast<int>(last - entries_.begin())};
}

const PrincipalFrameTable::Entry* PrincipalFrameTable::Index::find(const std::vector<Entry>& entries,
                                                                   const Vector3& point, double limit,
                                                                   float slack) const {
    if (grid.distance_bound(point) > limit) return nullptr;
    unsigned nearest = 0;
    double squared = 0.0;
    nanoflann::KNNResultSet<double, unsigned> result(1);
    result.init(&nearest, &squared);
    squared = limit * limit;  // the set looks for what is nearer than this
    nanoflann::SearchParams parameters;
    parameters.eps = slack * slack - 1.0f;  // nanoflann multiplies squared distances by 1 + eps
    tree.findNeighbors(result, point.data(), parameters);
    return result.size() == 0 ? nullptr : &entries[nearest];
}

const PrincipalFrameTable::Entry* PrincipalFrameTable::nearest(const Vector3& point, double limit) const {
    return index_->find(entries_, point, limit, 1.0f);
}

std::optional<double> PrincipalFrameTable::approximate_distance(const Vector3& point, double limit) const {
    // Beyond this, either the tangential offset is above the border's or the height above the limit.
    const Entry* entry = index_->find(entries_, point, std::hypot(border_steps * step_, limit), near_enough);
    if (!entry) return {};
    const Vector3 offset = point - entry->frame.point;
    const double squared = offset.squaredNorm();
    const double height = offset.dot(entry->frame.normal);
    const double tangential = std::sqrt(std::max(0.0, squared - height * height));
    const double distance = tangential <= border_steps * step_ ? std::abs(height) : std::sqrt(squared);
    return distance <= limit ? std::optional(distance) : std::nullopt;
}

}  // namespace umbilic
