// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/differential/area_samples.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include <Eigen/Geometry>
#include <tbb/parallel_for.h>

#include <umbilic/core/errors.h>

namespace umbilic {

namespace {

/// Cells of the density grid along each parameter, at least and at most, and how many per root of a face's samples.
constexpr int fewest_cells = 6;
constexpr int most_cells = 64;
constexpr double cells_per_root = 2.0;
/// Members of the sequence that are tried for each sample wanted, plus as many once for the face.
constexpr int tries_per_sample = 64;

/// Fractions of 1 by which the two coordinates of the R2 sequence advance: 1 / g and 1 / g^2 with g^3 = g + 1
/// (M. Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018).
constexpr double first_advance = 0.75487766624669276;
constexpr double second_advance = 0.56984029099805327;

/// SplitMix64 (Steele, Lea, Flood 2014): consecutive seeds give independent numbers.
std::uint64_t mixed(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
    x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
    return x ^ (x >> 31);
}

double unit(std::uint64_t x) {
    return static_cast<double>(x >> 11) * 0x1.0p-53;
}

double area_element(const NurbsSurface& surface, double u, double v) {
    const SurfaceDerivatives d = surface.derivatives(u, v, 1);
    return d.r_u().cross(d.r_v()).norm();
}

/// Ends of about `wanted` cells of a parameter range: the knots inside it, their spans evenly divided.
std::vector<double> grid_lines(const KnotVector& knots, const ParameterInterval& range, int wanted) {
    std::vector<double> lines = {range.low};
    for (const double knot : knots.breaks())
        if (range.low < knot && knot < range.high) lines.push_back(knot);
    lines.push_back(range.high);
    const int spans = static_cast<int>(lines.size()) - 1;
    std::vector<double> result;
    if (spans > most_cells) {
        for (int i = 0; i <= most_cells; ++i) result.push_back(range.low + range.length() * i / most_cells);
        return result;
    }
    const int parts = (wanted + spans - 1) / spans;
    for (int i = 0; i < spans; ++i)
        for (int k = 0; k < parts; ++k) result.push_back(lines[i] + (lines[i + 1] - lines[i]) * k / parts);
    result.push_back(range.high);
    return result;
}

/// Density on the parameter plane of a face: constant on each cell of a grid, there proportional to the area of the
/// cell, and 0 on cells outside the face.
class AreaDensity {
public:
    AreaDensity(const Face& face, int samples);

    bool empty() const { return !(total() > 0.0); }

    struct Place {
        double u = 0.0, v = 0.0;
        double area_per_density = 0.0;  ///< area element at (u, v) over density, up to a constant
    };
    /// Point for (x, y) in [0, 1)^2: marginal distribution in u, conditional in v.
    Place at(double x, double y) const;

private:
    double total() const { return columns_.back(); }

    const NurbsSurface& surface_;
    std::vector<double> u_, v_;
    std::vector<double> columns_;  ///< area up to each u line
    std::vector<double> cells_;    ///< area within a column up to each v line
};

AreaDensity::AreaDensity(const Face& face, int samples) : surface_(face.surface) {
    const int wanted = std::clamp(static_cast<int>(cells_per_root * std::sqrt(samples)), fewest_cells, most_cells);
    const ParameterBox box = face.region.box();
    const ParameterBox domain = face.region.domain();
    u_ = grid_lines(face.surface.u_knots(), box.u, wanted);
    v_ = grid_lines(face.surface.v_knots(), box.v, wanted);
    columns_ = {0.0};
    for (std::size_t i = 0; i + 1 < u_.size(); ++i) {
        double column = 0.0;
        cells_.push_back(0.0);
        for (std::size_t j = 0; j + 1 < v_.size(); ++j) {
            const double du = u_[i + 1] - u_[i], dv = v_[j + 1] - v_[j];
            const double u = u_[i] + 0.5 * du, v = v_[j] + 0.5 * dv;
            const double radius = 0.5 * std::hypot(du / domain.u.length(), dv / domain.v.length());
            if (face.region.whole_domain() || face.region.classify(u, v, radius) != Containment::outside)
                column += area_element(surface_, u, v) * du * dv;
            cells_.push_back(column);
        }
        columns_.push_back(columns_.back() + column);
    }
}

/// Index of the interval of increasing `sums` that holds `value`, and where in it.
std::pair<std::size_t, double> locate(std::span<const double> sums, double value) {
    const auto next = std::upper_bound(sums.begin() + 1, sums.end() - 1, value);
    const auto i = static_cast<std::size_t>(next - sums.begin()) - 1;
    const double width = sums[i + 1] - sums[i];
    return {i, width > 0.0 ? std::clamp((value - sums[i]) / width, 0.0, 1.0) : 0.5};
}

AreaDensity::Place AreaDensity::at(double x, double y) const {
    const auto [i, s] = locate(columns_, x * total());
    const std::span<const double> column(cells_.data() + i * v_.size(), v_.size());
    const auto [j, t] = locate(column, y * column.back());
    Place place;
    place.u = u_[i] + s * (u_[i + 1] - u_[i]);
    place.v = v_[j] + t * (v_[j + 1] - v_[j]);
    const double mass = column[j + 1] - column[j];
    const double size = (u_[i + 1] - u_[i]) * (v_[j + 1] - v_[j]);
    place.area_per_density = mass > 0.0 ? size / mass : 0.0;
    return place;
}

/// A point inside the loops however thin the face is: the middle of the longest stretch on a line v = const that passes
/// between the vertices of the loops.
std::optional<Vector2> inner_point(const TrimmingRegion& region) {
    std::vector<double> heights;
    for (std::size_t k = 0; k < region.loops().size(); ++k)
        for (const Vector2& p : region.polyline(static_cast<int>(k))) heights.push_back(p.y());
    if (heights.empty()) return Vector2(region.domain().u.middle(), region.domain().v.middle());
    std::sort(heights.begin(), heights.end());
    // The widest gap between the heights of two vertices; no edge ends there.
    double v = heights.front(), gap = 0.0;
    for (std::size_t i = 0; i + 1 < heights.size(); ++i)
        if (heights[i + 1] - heights[i] > gap) {
            gap = heights[i + 1] - heights[i];
            v = 0.5 * (heights[i] + heights[i + 1]);
        }
    std::vector<double> crossings;
    for (std::size_t k = 0; k < region.loops().size(); ++k) {
        const std::vector<Vector2>& line = region.polyline(static_cast<int>(k));
        for (std::size_t i = 0; i + 1 < line.size(); ++i)
            if ((line[i].y() > v) != (line[i + 1].y() > v))
                crossings.push_back(line[i].x() + (v - line[i].y()) / (line[i + 1].y() - line[i].y()) *
                                                      (line[i + 1].x() - line[i].x()));
    }
    std::sort(crossings.begin(), crossings.end());
    std::optional<Vector2> best;
    double width = -1.0;
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2)
        if (crossings[i + 1] - crossings[i] > width) {
            width = crossings[i + 1] - crossings[i];
            best =
                Vector2(region.domain().u.clamp(0.5 * (crossings[i] + crossings[i + 1])), region.domain().v.clamp(v));
        }
    return best;
}

std::vector<AreaSample> face_samples(const Face& face, int wanted, std::uint64_t seed) {
    std::vector<AreaSample> result;
    const auto add = [&](double u, double v, double area_per_density) {
        const SurfaceDerivatives d = face.surface.derivatives(u, v, 2);
        AreaSample sample{{face.number, u, v}, curvature(d), 0.0};
        if (!sample.curvature.regular) return;
        if (face.reversed) sample.curvature = flipped(sample.curvature);
        sample.weight = area_per_density * d.r_u().cross(d.r_v()).norm();
        result.push_back(sample);
    };
    const AreaDensity density(face, wanted);
    if (!density.empty()) {
        const std::uint64_t key = mixed(seed ^ mixed(static_cast<std::uint64_t>(face.number)));
        const double x0 = unit(key), y0 = unit(mixed(key));
        const int tries = tries_per_sample * (wanted + 1);
        for (int k = 1; k <= tries && static_cast<int>(result.size()) < wanted; ++k) {
            double whole = 0.0;
            const double x = std::modf(x0 + k * first_advance, &whole);
            const double y = std::modf(y0 + k * second_advance, &whole);
            const AreaDensity::Place place = density.at(x, y);
            if (!(place.area_per_density > 0.0)) continue;
            if (!face.region.whole_domain() && face.region.classify(place.u, place.v) == Containment::outside) continue;
            add(place.u, place.v, place.area_per_density);
        }
    }
    if (result.empty())
        if (const std::optional<Vector2> point = inner_point(face.region)) add(point->x(), point->y(), 1.0);
    double sum = 0.0;
    for (const AreaSample& sample : result) sum += sample.weight;
    for (AreaSample& sample : result) sample.weight *= face.area / sum;
    return result;
}

}  // namespace

std::vector<AreaSample> area_samples(const Model& model, const AreaSampleOptions& options, const Progress& progress) {
    if (options.count < 1) throw InvalidInput("area samples: the number of samples must be positive");
    double area = 0.0;
    for (const Face& face : model.faces) area += face.area;
    std::vector<std::vector<AreaSample>> parts(model.faces.size());
    std::atomic<std::size_t> done = 0;
    tbb::parallel_for(std::size_t{0}, model.faces.size(), [&](std::size_t i) {
        const double share = area > 0.0 ? model.faces[i].area / area : 0.0;
        const int wanted = std::max(1, static_cast<int>(std::lround(options.count * share)));
        parts[i] = face_samples(model.faces[i], wanted, options.seed);
        progress.report(static_cast<double>(++done) / static_cast<double>(parts.size()), "sampling");
    });
    std::vector<AreaSample> result;
    for (const std::vector<AreaSample>& part : parts) result.insert(result.end(), part.begin(), part.end());
    return result;
}

}  // namespace umbilic
