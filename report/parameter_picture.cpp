// SPDX-License-Identifier: LGPL-2.1-or-later
#include <report/parameter_picture.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/linestring.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <fmt/format.h>

#include <report/json_geometry.h>
#include <report/mark.h>
#include <report/readable.h>

namespace umbilic {

namespace {

/// Sizes in units of the picture, which are pixels where there is room.
constexpr double longer_side = 420.0;
constexpr double margin = 34.0;
constexpr double mark_radius = 7.0;
constexpr double stroke_length = 17.0;
/// What may be left out of a loop.
constexpr double loop_deviation = 0.25;
/// Most elongated domain drawn true to its sides.
constexpr double greatest_aspect = 4.0;
/// Knot lines that are drawn; more would be a grey ground.
constexpr std::size_t most_knot_lines = 200;
/// Points along each side at which the lengths of parameter lines are measured.
constexpr int samples = 5;

/// Places parameters of the surface in the picture; v runs upwards.
class Frame {
public:
    explicit Frame(const NurbsSurface& surface) : domain_(surface.domain()) {
        double u_length = 0.0, v_length = 0.0;
        for (int i = 0; i < samples; ++i)
            for (int j = 0; j < samples; ++j) {
                const SurfaceDerivatives d =
                    surface.derivatives(domain_.u.low + (i + 0.5) / samples * domain_.u.length(),
                                        domain_.v.low + (j + 0.5) / samples * domain_.v.length(), 1);
                u_length += d.r_u().norm() * domain_.u.length();
                v_length += d.r_v().norm() * domain_.v.length();
            }
        const double aspect = u_length > 0.0 && v_length > 0.0
                                  ? std::clamp(u_length / v_length, 1.0 / greatest_aspect, greatest_aspect)
                                  : 1.0;
        width_ = longer_side * std::min(1.0, aspect);
        height_ = longer_side * std::min(1.0, 1.0 / aspect);
    }

    double width() const { return width_; }
    double height() const { return height_; }
    double x(double u) const { return margin + (u - domain_.u.low) / domain_.u.length() * width_; }
    double y(double v) const { return margin + (domain_.v.high - v) / domain_.v.length() * height_; }
    /// A step in the parameters as a step in the picture.
    Vector2 step(const Vector2& change) const {
        return {change.x() / domain_.u.length() * width_, -change.y() / domain_.v.length() * height_};
    }

private:
    ParameterBox domain_;
    double width_ = 0.0, height_ = 0.0;
};

std::string polyline(const Frame& frame, const std::vector<Vector2>& points) {
    namespace geometry = boost::geometry;
    using Point = geometry::model::d2::point_xy<double>;
    geometry::model::linestring<Point> line, simple;
    for (const Vector2& at : points) line.emplace_back(frame.x(at.x()), frame.y(at.y()));
    geometry::simplify(line, simple, loop_deviation);
    std::string path;
    for (const Point& at : simple) path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", at.x(), at.y());
    return path;
}

/// The boxes as one path; what is smaller than a stroke shows as a stroke.
std::string boxes(const Frame& frame, const std::vector<ParameterBox>& list, const char* name) {
    std::string path;
    for (const ParameterBox& box : list)
        path += fmt::format("M{:.2f} {:.2f}H{:.2f}V{:.2f}H{:.2f}Z", frame.x(box.u.low), frame.y(box.v.low),
                            frame.x(box.u.high), frame.y(box.v.high), frame.x(box.u.low));
    return fmt::format("<path class=\"{}\" d=\"{}\"/>", name, path);
}

std::string knot_lines(const Frame& frame, const NurbsSurface& surface) {
    const std::vector<double>&u = surface.u_knots().breaks(), &v = surface.v_knots().breaks();
    if (u.size() + v.size() > most_knot_lines) return "";
    std::string path;
    for (std::size_t i = 1; i + 1 < u.size(); ++i)
        path += fmt::format("M{:.1f} {}v{:.1f}", frame.x(u[i]), margin, frame.height());
    for (std::size_t j = 1; j + 1 < v.size(); ++j)
        path += fmt::format("M{} {:.1f}h{:.1f}", margin, frame.y(v[j]), frame.width());
    return path.empty() ? "" : "<path class=\"knot-line\" d=\"" + path + "\"/>";
}

/// The tangent of space as a direction of the parameters.
Vector2 in_parameters(const SurfaceDerivatives& d, const Vector3& tangent) {
    Matrix2 metric;
    metric << d.r_u().squaredNorm(), d.r_u().dot(d.r_v()), d.r_u().dot(d.r_v()), d.r_v().squaredNorm();
    return metric.inverse() * Vector2(d.r_u().dot(tangent), d.r_v().dot(tangent));
}

std::string isolated(const Frame& frame, const Face& face, const Umbilic& umbilic, const std::string& label) {
    const bool outside = umbilic.containment == Containment::outside;
    const double x = frame.x(umbilic.at.u), y = frame.y(umbilic.at.v);
    const SurfaceDerivatives d = face.surface.derivatives(umbilic.at.u, umbilic.at.v, 1);
    std::string strokes;
    for (const Vector3& direction : umbilic.directions) {
        const Vector2 step = frame.step(in_parameters(d, direction));
        const double length = step.norm();
        if (!(length > 0.0) || !std::isfinite(length)) continue;
        const Vector2 half = step * (stroke_length / length);
        strokes += fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", x - half.x(), y - half.y(), x + half.x(), y + half.y());
    }
    std::string svg = fmt::format("<g{}>", outside ? " class=\"outside\"" : "");
    svg += boxes(frame, {umbilic.box}, "proof-box");
    if (!strokes.empty()) svg += "<path class=\"direction\" d=\"" + strokes + "\"/>";
    svg += mark_svg(umbilic.kind.type, x, y, mark_radius);
    if (!label.empty())
        svg += fmt::format("<text class=\"number\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", x + 9.0, y - 13.0, label);
    return svg + "</g>";
}

std::string cluster(const Frame& frame, const UndecidedCluster& open) {
    ParameterBox hull = open.boxes.front();
    for (const ParameterBox& box : open.boxes) {
        hull.u = {std::min(hull.u.low, box.u.low), std::max(hull.u.high, box.u.high)};
        hull.v = {std::min(hull.v.low, box.v.low), std::max(hull.v.high, box.v.high)};
    }
    return boxes(frame, open.boxes, "undecided") +
           fmt::format(
               "<g class=\"undecided-mark\" transform=\"translate({:.1f} {:.1f})\"><circle r=\"9\"/><text "
               "y=\"4\">?</text></g>",
               frame.x(hull.u.middle()), frame.y(hull.v.middle()));
}

std::string axis_labels(const Frame& frame, const Face& face) {
    const ParameterBox domain = face.surface.domain();
    const Vector2 low = native_parameters(face, domain.u.low, domain.v.low);
    const Vector2 high = native_parameters(face, domain.u.high, domain.v.high);
    const double left = margin, right = margin + frame.width(), top = margin, bottom = margin + frame.height();
    std::string svg;
    const auto text = [&](double x, double y, const char* anchor, const std::string& words) {
        svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>", x, y, anchor, words);
    };
    text(left, bottom + 16.0, "start", readable(low.x()));
    text(right, bottom + 16.0, "end", readable(high.x()));
    text(0.5 * (left + right), bottom + 16.0, "middle", "u");
    const auto beside = [&](double y, const char* anchor, const std::string& words) {
        svg += fmt::format("<text transform=\"translate({:.1f} {:.1f}) rotate(-90)\" text-anchor=\"{}\">{}</text>",
                           left - 7.0, y, anchor, words);
    };
    beside(bottom, "start", readable(low.y()));
    beside(top, "end", readable(high.y()));
    beside(0.5 * (top + bottom), "middle", "v");
    return svg;
}

}  // namespace

std::string parameter_picture_svg(const Face& face, const FaceUmbilics& found, int first_label, bool labelled) {
    const Frame frame(face.surface);
    const double width = frame.width() + 2.0 * margin, height = frame.height() + 2.0 * margin;
    std::string svg = fmt::format(
        "<svg class=\"domain\" viewBox=\"0 0 {:.0f} {:.0f}\" style=\"max-width:{:.0f}px\" role=\"img\" "
        "aria-label=\"Parameter "
        "domain of face {}\">",
        width, height, width, face.number);
    svg += fmt::format("<rect class=\"ground\" x=\"{0}\" y=\"{0}\" width=\"{1:.1f}\" height=\"{2:.1f}\"/>", margin,
                       frame.width(), frame.height());
    std::string loops;
    for (std::size_t i = 0; i < face.region.loops().size(); ++i)
        loops += polyline(frame, face.region.polyline(static_cast<int>(i))) + "Z";
    if (loops.empty()) loops = fmt::format("M{0} {0}h{1:.1f}v{2:.1f}h-{1:.1f}Z", margin, frame.width(), frame.height());
    svg += "<path class=\"face\" d=\"" + loops + "\"/>";
    svg += knot_lines(frame, face.surface);
    if (!found.regions.empty())
        svg += fmt::format(
            "<clipPath id=\"clip-{0}\"><path clip-rule=\"evenodd\" d=\"{1}\"/></clipPath>"
            "<g clip-path=\"url(#clip-{0})\">",
            face.number, loops);
    for (const UmbilicRegion& region : found.regions)
        svg += boxes(frame, region.boxes, (std::string("region ") + name(region.kind)).c_str());
    if (!found.regions.empty()) svg += "</g>";
    for (const UmbilicLine& line : found.lines) {
        svg += boxes(frame, line.boxes, "line-boxes");
        if (!line.parameters.empty())
            svg += "<path class=\"umbilic-line\" d=\"" + polyline(frame, line.parameters) + "\"/>";
    }
    svg += "<path class=\"loop\" d=\"" + loops + "\"/>";
    for (const UndecidedCluster& open : found.undecided)
        if (!open.boxes.empty()) svg += cluster(frame, open);
    for (const bool outside : {true, false})
        for (std::size_t i = 0; i < found.umbilics.size(); ++i)
            if ((found.umbilics[i].containment == Containment::outside) == outside)
                svg += isolated(frame, face, found.umbilics[i],
                                labelled ? std::to_string(first_label + static_cast<int>(i)) : "");
    return svg + axis_labels(frame, face) + "</svg>";
}

}  // namespace umbilic
