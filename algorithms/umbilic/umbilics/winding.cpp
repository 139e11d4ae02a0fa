// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/umbilics/winding.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <umbilic/bernstein/rounding.h>
#include <umbilic/bernstein/subdivision.h>

namespace umbilic {

namespace {

/// Pieces an edge is halved into, one within the other, before it is given up.
constexpr int maximum_depth = 40;

/// An angle farther than this from whole turns (in turns) does not close: rounding errors add up to far less.
constexpr double closure = 1e-3;

struct Curve {
    std::vector<double> a, b;
    double a_error, b_error;
};

std::optional<double> turning(Curve curve, int depth) {
    const int degree = static_cast<int>(curve.a.size()) - 1;
    double a_mean = 0.0, b_mean = 0.0, a_size = 0.0, b_size = 0.0;
    for (int k = 0; k <= degree; ++k) {
        a_mean += curve.a[k];
        b_mean += curve.b[k];
        a_size = std::max(a_size, std::abs(curve.a[k]));
        b_size = std::max(b_size, std::abs(curve.b[k]));
    }
    double least = a_mean * curve.a[0] + b_mean * curve.b[0];
    for (int k = 1; k <= degree; ++k) least = std::min(least, a_mean * curve.a[k] + b_mean * curve.b[k]);
    const double error = (std::abs(a_mean) * (curve.a_error + 3 * unit_roundoff * a_size) +
                          std::abs(b_mean) * (curve.b_error + 3 * unit_roundoff * b_size)) *
                         bound_slack;
    if (least > error) {
        // The whole piece lies in an open half plane: it turns by less than half a turn, told by its ends.
        const double cross = curve.a.front() * curve.b.back() - curve.b.front() * curve.a.back();
        const double dot = curve.a.front() * curve.a.back() + curve.b.front() * curve.b.back();
        return std::atan2(cross, dot);
    }
    if (depth == maximum_depth || (a_size <= curve.a_error && b_size <= curve.b_error)) return std::nullopt;
    Curve first = curve;
    halve_v({0, degree}, curve.a.data(), first.a.data());
    halve_v({0, degree}, curve.b.data(), first.b.data());
    first.a_error = curve.a_error = (curve.a_error + gamma_bound(degree) * a_size) * bound_slack;
    first.b_error = curve.b_error = (curve.b_error + gamma_bound(degree) * b_size) * bound_slack;
    const std::optional<double> low = turning(std::move(first), depth + 1);
    if (!low) return std::nullopt;
    const std::optional<double> high = turning(std::move(curve), depth + 1);
    if (!high) return std::nullopt;
    return *low + *high;
}

}  // namespace

std::optional<double> turning(const EdgeEquations& edge, double u_length, double v_length) {
    Curve curve{edge.a, edge.b, edge.a_error, edge.b_error};
    // One factor for both keeps the ratio; it only avoids extreme sizes.
    const double a_scale = v_length / std::max(u_length, v_length), b_scale = u_length / std::max(u_length, v_length);
    for (double& value : curve.a) value *= a_scale;
    for (double& value : curve.b) value *= b_scale;
    const auto largest = [](const std::vector<double>& c) {
        double result = 0.0;
        for (const double value : c) result = std::max(result, std::abs(value));
        return result;
    };
    curve.a_error = (curve.a_error * a_scale + 2 * unit_roundoff * largest(curve.a)) * bound_slack;
    curve.b_error = (curve.b_error * b_scale + 2 * unit_roundoff * largest(curve.b)) * bound_slack;
    return turning(std::move(curve), 0);
}

namespace {

bool smooth_inside(const KnotVector& knots, const ParameterInterval& interval) {
    for (std::size_t k = 1; k + 1 < knots.breaks().size(); ++k)
        if (interval.low < knots.breaks()[k] && knots.breaks()[k] < interval.high &&
            knots.continuity(static_cast<int>(k)) < 2)
            return false;
    return true;
}

/// Number of the piece between `breaks` that holds `value`, the nearest one of [first, last).
int piece_number(const std::vector<double>& breaks, double value, int first, int last) {
    const auto after = std::upper_bound(breaks.begin(), breaks.end(), value);
    return std::clamp(static_cast<int>(after - breaks.begin()) - 1, first, last - 1);
}

/// Univariate coefficients on an edge or at a parameter across it, with a bound on their errors.
struct Line {
    std::vector<double> coefficients;
    double error = 0.0;
};

double largest(const std::vector<double>& values) {
    double result = 0.0;
    for (const double value : values) result = std::max(result, std::abs(value));
    return result;
}

/// Growth of errors in de Casteljau's algorithm at t, which may lie outside [0, 1].
double growth(int degree, double t) {
    return t >= 0.0 && t <= 1.0 ? 1.0 : std::pow(std::abs(t) + std::abs(1.0 - t), degree) * bound_slack;
}

Line line_across(CoefficientShape shape, const std::vector<double>& c, double error, bool along_u, double t) {
    const int degree = along_u ? shape.p : shape.q, other = along_u ? shape.q : shape.p;
    const int stride = along_u ? 1 : shape.row_length(), next = along_u ? shape.row_length() : 1;
    Line line;
    line.coefficients.resize(degree + 1);
    std::vector<double> column(other + 1);
    for (int k = 0; k <= degree; ++k) {
        for (int i = 0; i <= other; ++i) column[i] = c[k * next + i * stride];
        if (t == 1.0) {
            column[0] = column[other];
        } else if (t != 0.0) {
            for (int step = 1; step <= other; ++step)
                for (int i = 0; i <= other - step; ++i) column[i] = (1.0 - t) * column[i] + t * column[i + 1];
        }
        line.coefficients[k] = column[0];
    }
    const double factor = growth(other, t);
    line.error = (error + gamma_bound(6 * other) * largest(c)) * factor * bound_slack;
    return line;
}

void restrict_to(Line& line, double low, double high) {
    if (low == 0.0 && high == 1.0) return;
    // restrict_v takes the upper end first, which must be well inside.
    const bool mirrored = low + high < 1.0;
    if (mirrored) std::reverse(line.coefficients.begin(), line.coefficients.end());
    const int degree = static_cast<int>(line.coefficients.size()) - 1;
    const double size = largest(line.coefficients);
    const double factor =
        restrict_v({0, degree}, line.coefficients.data(), mirrored ? 1.0 - high : low, mirrored ? 1.0 - low : high);
    if (mirrored) std::reverse(line.coefficients.begin(), line.coefficients.end());
    line.error = (line.error + gamma_bound(6 * degree) * size) * factor * bound_slack;
}

}  // namespace

std::optional<double> whole_turns(double angle) {
    const double turns = angle / (2 * std::numbers::pi);
    if (std::abs(turns - std::round(turns)) > closure) return std::nullopt;
    return std::round(turns);
}

PathTurning::PathTurning(const NurbsSurface& surface, const BezierPatches& patches, const InputRounding& input,
                         const PatchRange& range)
    : surface_(surface), patches_(patches), input_(input), range_(range) {}

const PathTurning::Formed& PathTurning::formed(int i, int j) {
    const std::size_t number = static_cast<std::size_t>(i) * patches_.v_count + j;
    const auto [entry, added] = formed_.try_emplace(number);
    Formed& result = entry->second;
    if (!added) return result;
    equations_.form_fundamental(patches_.patches[number], input_);
    equations_.form_umbilic();
    result.shape = {equations_.a().u_degree, equations_.a().v_degree};
    for (int k = 0; k < 2; ++k) {
        result.coefficients[k].resize(result.shape.size());
        result.error[k] =
            (k == 0 ? equations_.a() : equations_.b()).bernstein_coefficients(result.coefficients[k]).rounding;
    }
    return result;
}

std::optional<double> PathTurning::piece(bool along_u, double from, double to, double across) {
    const double middle = 0.5 * (from + to);
    const Vector2 at = along_u ? Vector2(middle, across) : Vector2(across, middle);
    const int i = piece_number(surface_.u_knots().breaks(), at.x(), range_.u_first, range_.u_last);
    const int j = piece_number(surface_.v_knots().breaks(), at.y(), range_.v_first, range_.v_last);
    const Formed& patch = formed(i, j);
    const ParameterBox& domain = patches_.patches[static_cast<std::size_t>(i) * patches_.v_count + j].domain;
    const ParameterInterval &own = along_u ? domain.u : domain.v, &other = along_u ? domain.v : domain.u;
    Line line[2];
    for (int k = 0; k < 2; ++k) {
        line[k] = line_across(patch.shape, patch.coefficients[k], patch.error[k], along_u,
                              (across - other.low) / other.length());
        restrict_to(line[k], (from - own.low) / own.length(), (to - own.low) / own.length());
    }
    return turning({line[0].coefficients, line[1].coefficients, line[0].error, line[1].error}, domain.u.length(),
                   domain.v.length());
}

std::optional<double> PathTurning::along(const Vector2& from, const Vector2& to) {
    const bool along_u = from.y() == to.y();
    const double start = along_u ? from.x() : from.y(), end = along_u ? to.x() : to.y();
    if (start == end) return 0.0;
    const double low = std::min(start, end), high = std::max(start, end);
    const std::vector<double>& breaks = (along_u ? surface_.u_knots() : surface_.v_knots()).breaks();
    const int first = along_u ? range_.u_first : range_.v_first, last = along_u ? range_.u_last : range_.v_last;
    double angle = 0.0, at = low;
    for (int k = first + 1; k <= last; ++k) {
        const double next = k == last ? high : std::min(high, breaks[k]);
        if (next <= at) continue;
        const std::optional<double> part = piece(along_u, at, next, along_u ? from.y() : from.x());
        if (!part) return std::nullopt;
        angle += *part;
        at = next;
    }
    return start < end ? angle : -angle;
}

std::optional<double> PathTurning::winding(std::span<const Vector2> corners) {
    double angle = 0.0;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const std::optional<double> part = along(corners[k], corners[(k + 1) % corners.size()]);
        if (!part) return std::nullopt;
        angle += *part;
    }
    return whole_turns(angle);
}

std::optional<double> rectangle_winding(const NurbsSurface& surface, const BezierPatches& patches,
                                        const InputRounding& input, const ParameterBox& rectangle) {
    const KnotVector &u_knots = surface.u_knots(), &v_knots = surface.v_knots();
    if (!smooth_inside(u_knots, rectangle.u) || !smooth_inside(v_knots, rectangle.v)) return std::nullopt;
    const auto first = [](const KnotVector& knots, double low, int count) {
        return piece_number(knots.breaks(), low, 0, count);
    };
    const auto end = [](const KnotVector& knots, double high, int count) {
        const auto at = std::lower_bound(knots.breaks().begin(), knots.breaks().end(), high);
        return std::clamp(static_cast<int>(at - knots.breaks().begin()), 1, count);
    };
    PatchRange range{first(u_knots, rectangle.u.low, patches.u_count), end(u_knots, rectangle.u.high, patches.u_count),
                     first(v_knots, rectangle.v.low, patches.v_count), end(v_knots, rectangle.v.high, patches.v_count)};
    range.u_last = std::max(range.u_last, range.u_first + 1);
    range.v_last = std::max(range.v_last, range.v_first + 1);
    const Vector2 corners[4] = {{rectangle.u.low, rectangle.v.low},
                                {rectangle.u.high, rectangle.v.low},
                                {rectangle.u.high, rectangle.v.high},
                                {rectangle.u.low, rectangle.v.high}};
    return PathTurning(surface, patches, input, range).winding(corners);
}

}  // namespace umbilic
