// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/umbilics/lines.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>

namespace umbilic {

namespace {

// All lengths are relative to the sides of the surface's domain.

/// A point belongs to a line if the last Newton step and what is left of the equations are below this.
constexpr double line_accuracy = 1e-6;
/// The Jacobian has rank 1 if its lesser singular value is below this share of the greater one.
constexpr double rank_ratio = 1e-3;
/// Newton's method ends at a step of rounding, or after as many steps.
constexpr double newton_end = 1e-15;
constexpr int newton_steps = 12;
/// Largest order to which both equations vanish along a line that is traced.
constexpr int largest_multiplicity = 4;
/// Lines shorter than this many resolutions are not told from points.
constexpr double shortest_line = 8.0;
/// A step that leaves a side of the domain by no more than this runs along it.
constexpr double along_side = 1e-9;
constexpr double longest_step = 1.0 / 32;
constexpr double shortest_step = 1e-6;
/// Largest turn of the tangent in one step, radians.
constexpr double largest_turn = 0.3;
/// Largest distance of a chord from the line, in resolutions.
constexpr double chord_distance = 0.25;
/// Boxes this many resolutions from a line belong to it, and a line keeps as near to the boxes.
constexpr double beside = 2.0;
constexpr std::size_t most_points = 100000;
/// Boxes in which no line was met before the others are left alone.
constexpr int most_failures = 64;
/// Ends of lines that are nearer in space than this share of the surface's size are one point.
constexpr double same_point = 1e-7;

/// What the umbilics are zeros of, in an orthonormal tangent frame: 2 h12 and h11 - h22 of the second fundamental form,
/// times the surface's size; and its derivatives, right on the zeros.
struct Local {
    Vector2 value = Vector2::Zero();
    Matrix2 jacobian = Matrix2::Zero();
    Eigen::Matrix<double, 3, 2> tangents;
    Vector3 point = Vector3::Zero();
};

struct LinePoint {
    Vector2 at = Vector2::Zero();
    Vector2 along = Vector2::UnitX();  ///< unit tangent in the parameters
    Vector3 point = Vector3::Zero();
    Vector3 tangent = Vector3::UnitX();  ///< the same in space, unit
    double error = 0.0;
};

double turn(const LinePoint& a, const LinePoint& b) {
    return std::acos(std::clamp(a.tangent.dot(b.tangent), -1.0, 1.0));
}

/// True if the segment meets the box (Liang and Barsky).
bool meets(const ParameterBox& box, const Vector2& from, const Vector2& to) {
    double enter = 0.0, leave = 1.0;
    const Vector2 step = to - from;
    const ParameterInterval sides[2] = {box.u, box.v};
    for (int k = 0; k < 2; ++k) {
        const double low = sides[k].low - from[k], high = sides[k].high - from[k];
        if (step[k] == 0.0) {
            if (low > 0.0 || high < 0.0) return false;
            continue;
        }
        enter = std::max(enter, std::min(low / step[k], high / step[k]));
        leave = std::min(leave, std::max(low / step[k], high / step[k]));
    }
    return enter <= leave;
}

/// Longer side of the points' box.
double extent(const std::vector<LinePoint>& points) {
    if (points.empty()) return 0.0;
    Vector2 low = points.front().at, high = low;
    for (const LinePoint& point : points) {
        low = low.cwiseMin(point.at);
        high = high.cwiseMax(point.at);
    }
    return (high - low).maxCoeff();
}

ParameterBox dilated(const ParameterBox& box, double by) {
    return {{box.u.low - by, box.u.high + by}, {box.v.low - by, box.v.high + by}};
}

/// Breaks across which curvature may jump, and the ends, relative to the domain.
std::vector<double> curvature_breaks(const KnotVector& knots) {
    const ParameterInterval domain = knots.domain();
    std::vector<double> result;
    for (std::size_t k = 0; k < knots.breaks().size(); ++k)
        if (knots.continuity(static_cast<int>(k)) < 2)
            result.push_back((knots.breaks()[k] - domain.low) / domain.length());
    return result;
}

ParameterInterval part_around(const std::vector<double>& breaks, double value) {
    const auto above = std::upper_bound(breaks.begin() + 1, breaks.end() - 1, value);
    return {*(above - 1), *above};
}

class LineTracer {
public:
    LineTracer(const NurbsSurface& surface, const std::vector<ParameterBox>& boxes, double resolution)
        : surface_(surface),
          domain_(surface.domain()),
          resolution_(resolution),
          size_(surface.pole_box().diagonal()),
          u_breaks_(curvature_breaks(surface.u_knots())),
          v_breaks_(curvature_breaks(surface.v_knots())) {
        for (const ParameterBox& box : boxes) boxes_.push_back(dilated(relative(box), beside * resolution));
    }

    std::vector<UmbilicLine> run(std::vector<ParameterBox>& boxes) {
        std::vector<bool> taken(boxes.size(), false);
        std::vector<UmbilicLine> lines;
        int failures = 0;
        for (std::size_t k = 0; k < boxes.size() && failures < most_failures; ++k) {
            if (taken[k]) continue;
            const ParameterBox box = relative(boxes[k]);
            const Vector2 middle(box.u.middle(), box.v.middle());
            block_ = {part_around(u_breaks_, middle.x()), part_around(v_breaks_, middle.y())};
            std::optional<LinePoint> start;
            for (multiplicity_ = 1; multiplicity_ <= largest_multiplicity && !start; ++multiplicity_) {
                start = correct(middle);
                if (start && !boxes_[k].contains(start->at.x(), start->at.y())) start.reset();
            }
            std::vector<LinePoint> points;
            UmbilicLine line;
            if (start) {
                --multiplicity_;
                line = trace(*start, points);
            }
            if (extent(points) < shortest_line * resolution_) {
                ++failures;
                continue;
            }
            for (std::size_t other = 0; other < boxes.size(); ++other) {
                const ParameterBox place = relative(boxes[other]);
                if (taken[other] || !block_.contains(place.u.middle(), place.v.middle())) continue;
                for (std::size_t i = 0; i + 1 < points.size() && !taken[other]; ++i)
                    taken[other] = meets(boxes_[other], points[i].at, points[i + 1].at);
                if (taken[other]) line.boxes.push_back(boxes[other]);
            }
            lines.push_back(std::move(line));
        }
        std::vector<ParameterBox> left;
        for (std::size_t k = 0; k < boxes.size(); ++k)
            if (!taken[k]) left.push_back(boxes[k]);
        boxes = std::move(left);
        return lines;
    }

private:
    ParameterBox relative(const ParameterBox& box) const {
        const auto in = [](const ParameterInterval& whole, double value) {
            return (value - whole.low) / whole.length();
        };
        return {{in(domain_.u, box.u.low), in(domain_.u, box.u.high)},
                {in(domain_.v, box.v.low), in(domain_.v, box.v.high)}};
    }

    Vector2 parameters(const Vector2& at) const {
        return {domain_.u.clamp(domain_.u.low + at.x() * domain_.u.length()),
                domain_.v.clamp(domain_.v.low + at.y() * domain_.v.length())};
    }

    std::optional<Local> evaluate(const Vector2& at) const {
        const Vector2 inside(block_.u.clamp(at.x()), block_.v.clamp(at.y()));
        const Vector2 uv = parameters(inside);
        const SurfaceDerivatives d =
            surface_.derivatives(uv.x(), uv.y(), 3, inside.x() < block_.u.high ? Side::right : Side::left,
                                 inside.y() < block_.v.high ? Side::right : Side::left);
        const double s = domain_.u.length(), t = domain_.v.length();
        const Vector3 u = s * d.r_u(), v = t * d.r_v(), uu = s * s * d.r_uu(), uv2 = s * t * d.r_uv(),
                      vv = t * t * d.r_vv(), uuu = s * s * s * d(3, 0), uuv = s * s * t * d(2, 1),
                      uvv = s * t * t * d(1, 2), vvv = t * t * t * d(0, 3);
        const double e = u.dot(u), f = u.dot(v), g = v.dot(v);
        const double squared = e * g - f * f;
        if (!(squared > 0.0)) return std::nullopt;
        const Vector3 n = u.cross(v), n_u = uu.cross(v) + u.cross(uv2), n_v = uv2.cross(v) + u.cross(vv);
        const double l = n.dot(uu), m = n.dot(uv2), k = n.dot(vv);
        const Vector2 de(2 * u.dot(uu), 2 * u.dot(uv2)), dg(2 * v.dot(uv2), 2 * v.dot(vv));
        const Vector2 df(uu.dot(v) + u.dot(uv2), uv2.dot(v) + u.dot(vv));
        const Vector2 dl(n_u.dot(uu) + n.dot(uuu), n_v.dot(uu) + n.dot(uuv));
        const Vector2 dm(n_u.dot(uv2) + n.dot(uuv), n_v.dot(uv2) + n.dot(uvv));
        const Vector2 dk(n_u.dot(vv) + n.dot(uvv), n_v.dot(vv) + n.dot(vvv));
        // A and B of the search.
        const double a = e * m - f * l, b = e * k - g * l;
        const Vector2 da = de * m + e * dm - df * l - f * dl, db = de * k + e * dk - dg * l - g * dl;
        Matrix2 to_frame;
        to_frame << 2.0, 0.0, 2.0 * f / std::sqrt(squared), -e / std::sqrt(squared);
        to_frame *= size_ / (e * squared);
        Local result;
        result.value = to_frame * Vector2(a, b);
        result.jacobian << da.transpose(), db.transpose();
        result.jacobian = (to_frame * result.jacobian).eval();
        result.tangents << u, v;
        result.point = d.r();
        return result;
    }

    /// The point of a line next to `at`; with `fixed` 0 or 1 that coordinate keeps its value.
    std::optional<LinePoint> correct(Vector2 at, int fixed = -1) const {
        double last = std::numeric_limits<double>::infinity();
        for (int step = 0; step <= newton_steps; ++step) {
            const std::optional<Local> local = evaluate(at);
            if (!local) return std::nullopt;
            const Eigen::JacobiSVD<Matrix2> svd(local->jacobian, Eigen::ComputeFullU | Eigen::ComputeFullV);
            const Vector2 singular = svd.singularValues();
            if (!(singular[0] > 0.0)) return std::nullopt;
            Vector2 change = Vector2::Zero();
            if (fixed < 0) {
                change = -svd.matrixU().col(0).dot(local->value) / singular[0] * svd.matrixV().col(0);
            } else {
                const Vector2 column = local->jacobian.col(1 - fixed);
                if (!(column.squaredNorm() > 0.0)) return std::nullopt;
                change[1 - fixed] = -column.dot(local->value) / column.squaredNorm();
            }
            // Newton's method at a zero of that order.
            change *= multiplicity_;
            const double length = change.norm();
            const bool ended = length <= newton_end || (step > 2 && length >= 0.5 * last);
            if (ended || step == newton_steps) {
                const double error = length + local->value.norm() / singular[0];
                if (!(error <= line_accuracy) || singular[1] > rank_ratio * singular[0]) return std::nullopt;
                LinePoint result;
                result.at = {block_.u.clamp(at.x()), block_.v.clamp(at.y())};
                result.along = svd.matrixV().col(1);
                result.point = local->point;
                result.tangent = (local->tangents * result.along).normalized();
                result.error = error;
                return result;
            }
            at += change;
            last = length;
        }
        return std::nullopt;
    }

    bool near_boxes(const Vector2& at) const {
        return std::any_of(boxes_.begin(), boxes_.end(),
                           [&](const ParameterBox& box) { return box.contains(at.x(), at.y()); });
    }

    /// Appends the points behind `start` in the sense of its tangent, and tells why they end.
    LineEnd walk(const LinePoint& start, std::vector<LinePoint>& points) const {
        LinePoint here = start;
        double step = std::min(longest_step, 8 * resolution_);
        while (points.size() < most_points) {
            if (step < shortest_step) return LineEnd::singular;
            double length = step;
            int side = -1;
            const ParameterInterval sides[2] = {block_.u, block_.v};
            for (int k = 0; k < 2; ++k) {
                const double end = here.along[k] > 0.0 ? sides[k].high : sides[k].low;
                if (std::abs(here.along[k]) <= newton_end) continue;
                const double to_end = (end - here.at[k]) / here.along[k];
                if ((length - to_end) * std::abs(here.along[k]) > along_side) {
                    length = std::max(to_end, 0.0);
                    side = k;
                }
            }
            const auto reason = [&] {
                const double end = here.along[side] > 0.0 ? sides[side].high : sides[side].low;
                return end == 0.0 || end == 1.0 ? LineEnd::border : LineEnd::knot;
            };
            if (length <= newton_end) return reason();
            Vector2 ahead = here.at + length * here.along;
            if (side >= 0) ahead[side] = here.along[side] > 0.0 ? sides[side].high : sides[side].low;
            std::optional<LinePoint> next = correct(ahead, side);
            if (next && next->along.dot(here.along) < 0.0) {
                next->along = -next->along;
                next->tangent = -next->tangent;
            }
            const double turned = next ? turn(here, *next) : 0.0;
            const bool fits = next && (next->at - ahead).norm() <= 0.5 * length && turned <= largest_turn &&
                              length * turned / 8 <= chord_distance * resolution_ && near_boxes(next->at);
            if (!fits) {
                // Just before a border the line may leave through another side: then a short step ends it.
                step = 0.5 * std::min(step, length);
                if (step < shortest_step && side >= 0 && length < 2 * shortest_step) return reason();
                continue;
            }
            const Vector2 passed = start.at - here.at, stride = next->at - here.at;
            const double share = passed.dot(stride) / stride.squaredNorm();
            if (points.size() > 2 && share > 0.0 && share <= 1.0 &&
                (passed - share * stride).norm() <= chord_distance * resolution_ + line_accuracy &&
                start.along.dot(next->along) > 0.0) {
                points.push_back(start);
                return LineEnd::closed;
            }
            points.push_back(*next);
            if (side >= 0) return reason();
            here = *next;
            if (2 * turned <= largest_turn && length * turned <= 2 * chord_distance * resolution_)
                step = std::min(longest_step, 2 * step);
        }
        return LineEnd::singular;
    }

    UmbilicLine trace(const LinePoint& start, std::vector<LinePoint>& points) const {
        UmbilicLine line;
        points = {start};
        line.ends[1] = walk(start, points);
        line.ends[0] = LineEnd::closed;
        if (line.ends[1] != LineEnd::closed) {
            LinePoint back = start;
            back.along = -start.along;
            back.tangent = -start.tangent;
            std::vector<LinePoint> before = {back};
            line.ends[0] = walk(back, before);
            points.insert(points.begin(), before.rbegin(), before.rend() - 1);
        }
        line.closed = line.ends[1] == LineEnd::closed;
        for (std::size_t k = 0; k < points.size(); ++k) {
            line.parameters.push_back(parameters(points[k].at));
            line.points.push_back(points[k].point);
            line.accuracy = std::max(line.accuracy, points[k].error);
            if (k == 0) continue;
            // Half the angle by which tangents turn; the arc is taken for one of a circle.
            const double half =
                0.5 * std::acos(std::min(1.0, std::abs(points[k].tangent.dot(points[k - 1].tangent))));
            const double chord = (points[k].point - points[k - 1].point).norm();
            line.length += half > 0.0 ? chord * half / std::sin(half) : chord;
        }
        return line;
    }

    const NurbsSurface& surface_;
    ParameterBox domain_;
    double resolution_;
    double size_;
    std::vector<double> u_breaks_, v_breaks_;
    std::vector<ParameterBox> boxes_;  ///< relative to the domain, dilated
    ParameterBox block_;               ///< part that is twice continuously differentiable, relative to the domain
    int multiplicity_ = 1;             ///< order to which the equations vanish along the line
};

void reverse(UmbilicLine& line) {
    std::reverse(line.parameters.begin(), line.parameters.end());
    std::reverse(line.points.begin(), line.points.end());
    std::swap(line.ends[0], line.ends[1]);
}

const Vector3& end_point(const UmbilicLine& line, int end) {
    return end == 0 ? line.points.front() : line.points.back();
}

/// Joins lines at the borders of the surface or of its smooth parts, where just two ends meet.
void join(std::vector<UmbilicLine>& lines, double near) {
    struct End {
        std::size_t line;
        int end;
    };
    for (bool joined = true; joined;) {
        joined = false;
        std::vector<End> ends;
        for (std::size_t k = 0; k < lines.size(); ++k)
            for (const int end : {0, 1})
                if (!lines[k].closed && lines[k].ends[end] != LineEnd::singular) ends.push_back({k, end});
        for (std::size_t i = 0; i < ends.size() && !joined; ++i) {
            const Vector3 place = end_point(lines[ends[i].line], ends[i].end);
            std::vector<std::size_t> partners;
            for (std::size_t j = 0; j < ends.size(); ++j)
                if (j != i && (end_point(lines[ends[j].line], ends[j].end) - place).norm() <= near)
                    partners.push_back(j);
            if (partners.size() != 1) continue;
            const End a = ends[i], b = ends[partners.front()];
            UmbilicLine& first = lines[a.line];
            joined = true;
            if (a.line == b.line) {
                first.closed = true;
                first.ends = {LineEnd::closed, LineEnd::closed};
                first.points.back() = first.points.front();
                break;
            }
            UmbilicLine& second = lines[b.line];
            if (a.end == 0) reverse(first);
            if (b.end == 1) reverse(second);
            // Across a seam the common point has other parameters; else it is one point.
            const bool same = first.parameters.back() == second.parameters.front();
            first.parameters.insert(first.parameters.end(), second.parameters.begin() + same, second.parameters.end());
            first.points.insert(first.points.end(), second.points.begin() + same, second.points.end());
            first.boxes.insert(first.boxes.end(), second.boxes.begin(), second.boxes.end());
            first.ends[1] = second.ends[1];
            first.length += second.length;
            first.accuracy = std::max(first.accuracy, second.accuracy);
            lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(b.line));
        }
    }
}

}  // namespace

std::vector<UmbilicLine> trace_lines(const NurbsSurface& surface, std::vector<ParameterBox>& boxes, double resolution) {
    std::vector<UmbilicLine> lines = LineTracer(surface, boxes, resolution).run(boxes);
    join(lines, same_point * surface.pole_box().diagonal());
    return lines;
}

Containment containment(const TrimmingRegion& region, const UmbilicLine& line) {
    bool inside = false, outside = false;
    for (const Vector2& at : line.parameters) {
        const bool out = region.classify(at.x(), at.y()) == Containment::outside;
        inside = inside || !out;
        outside = outside || out;
    }
    return inside && outside ? Containment::boundary : outside ? Containment::outside : Containment::inside;
}

}  // namespace umbilic
