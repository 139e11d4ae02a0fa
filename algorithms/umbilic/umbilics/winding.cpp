// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/umbilics/winding.h>

#include <algorithm>
#include <cmath>

#include <umbilic/bernstein/rounding.h>
#include <umbilic/bernstein/subdivision.h>

namespace umbilic {

namespace {

double largest(const std::vector<double>& values) {
    double result = 0.0;
    for (const double value : values) result = std::max(result, std::abs(value));
    return result;
}

/// Number of the piece between `breaks` that holds `value`, the nearest one of [first, last).
int piece_number(const std::vector<double>& breaks, double value, int first, int last) {
    const auto after = std::upper_bound(breaks.begin(), breaks.end(), value);
    return std::clamp(static_cast<int>(after - breaks.begin()) - 1, first, last - 1);
}

/// Growth of errors in de Casteljau's algorithm at t, which may lie outside [0, 1].
double growth(int degree, double t) {
    return t >= 0.0 && t <= 1.0 ? 1.0 : std::pow(std::abs(t) + std::abs(1.0 - t), degree) * bound_slack;
}

/// The univariate polynomials of a tensor array's rows (along v) or columns at the parameter t across them.
std::vector<double> across(CoefficientShape shape, const std::vector<double>& c, bool along_u, double t) {
    const int degree = along_u ? shape.p : shape.q, other = along_u ? shape.q : shape.p;
    const int stride = along_u ? 1 : shape.row_length(), next = along_u ? shape.row_length() : 1;
    std::vector<double> result(degree + 1), column(other + 1);
    for (int k = 0; k <= degree; ++k) {
        for (int i = 0; i <= other; ++i) column[i] = c[k * next + i * stride];
        if (t == 1.0) {
            column[0] = column[other];
        } else if (t != 0.0) {
            for (int step = 1; step <= other; ++step)
                for (int i = 0; i <= other - step; ++i) column[i] = (1.0 - t) * column[i] + t * column[i + 1];
        }
        result[k] = column[0];
    }
    return result;
}

/// The part [low, high] of coefficients; returns the growth of errors.
double restrict_to(std::vector<double>& coefficients, double low, double high) {
    // restrict_v takes the upper end first, which must be well inside.
    const bool mirrored = low + high < 1.0;
    if (mirrored) std::reverse(coefficients.begin(), coefficients.end());
    const int degree = static_cast<int>(coefficients.size()) - 1;
    const double factor =
        restrict_v({0, degree}, coefficients.data(), mirrored ? 1.0 - high : low, mirrored ? 1.0 - low : high);
    if (mirrored) std::reverse(coefficients.begin(), coefficients.end());
    return factor;
}

/// How far coefficients of a part move because its ends are known to a unit roundoff of the whole only: each of a
/// coefficient's arguments that is an end moves it by a difference over the part's length.
double placing_error(const std::vector<double>& coefficients, double length) {
    double difference = 0.0;
    for (std::size_t k = 1; k < coefficients.size(); ++k)
        difference = std::max(difference, std::abs(coefficients[k] - coefficients[k - 1]));
    return 4 * unit_roundoff * static_cast<double>(coefficients.size() - 1) * difference / length * bound_slack;
}

/// What a tensor array is along the line at t across it, on `part` of that line. Errors of single coefficients are
/// followed within the patch only, where all steps are convex.
BoundedCurve along_line(CoefficientShape shape, const std::vector<double>& c, double error,
                        const std::vector<double>& errors, bool along_u, double t, const ParameterInterval& part) {
    const int other = along_u ? shape.q : shape.p;
    const auto inside = [](double value) { return value >= 0.0 && value <= 1.0; };
    const bool single_errors = !errors.empty() && inside(t) && inside(part.low) && inside(part.high);
    BoundedCurve result;
    result.coefficients = across(shape, c, along_u, t);
    if (single_errors) result.errors = across(shape, errors, along_u, t);
    result.error = error;
    result.widen(gamma_bound(6 * other) * largest(c), gamma_bound(6 * other));
    result.error *= growth(other, t);
    if (part.low == 0.0 && part.high == 1.0) return result;
    const double relative = gamma_bound(6 * result.degree()), arithmetic = relative * largest(result.coefficients);
    const double factor = restrict_to(result.coefficients, part.low, part.high);
    if (single_errors) restrict_to(result.errors, part.low, part.high);
    result.widen(arithmetic, relative);
    result.error *= factor * bound_slack;
    result.widen(placing_error(result.coefficients, part.length()), 0.0);
    return result;
}

}  // namespace

PathTurning::PathTurning(const NurbsSurface& surface, const BezierPatches& patches, const InputRounding& input,
                         const PatchRange& range)
    : surface_(surface), patches_(patches), input_(input), range_(range) {}

PathTurning::Formed& PathTurning::formed(std::size_t patch) {
    const auto [entry, added] = formed_.try_emplace(patch);
    if (added) {
        equations_.form_fundamental(patches_.patches[patch], input_);
        take_equations(entry->second);
    }
    return entry->second;
}

void PathTurning::take_equations(Formed& result) {
    equations_.form_umbilic();
    result.shape = {equations_.a().u_degree, equations_.a().v_degree};
    for (int k = 0; k < 2; ++k) {
        const TensorPolynomial& polynomial = k == 0 ? equations_.a() : equations_.b();
        result.coefficients[k].resize(result.shape.size());
        result.error[k] = polynomial.bernstein_coefficients(result.coefficients[k]).rounding;
        if (polynomial.errors.empty()) continue;
        result.errors[k].resize(result.shape.size());
        polynomial.bernstein_errors(result.errors[k]);
    }
}

std::optional<WayTurning> PathTurning::piece(bool along_u, double from, double to, double line, BorderSide* obstacle) {
    const double middle = 0.5 * (from + to);
    const Vector2 at = along_u ? Vector2(middle, line) : Vector2(line, middle);
    const int i = piece_number(surface_.u_knots().breaks(), at.x(), range_.u_first, range_.u_last);
    const int j = piece_number(surface_.v_knots().breaks(), at.y(), range_.v_first, range_.v_last);
    const std::size_t number = static_cast<std::size_t>(i) * patches_.v_count + j;
    const ParameterBox& domain = patches_.patches[number].domain;
    const ParameterInterval &own = along_u ? domain.u : domain.v, &other = along_u ? domain.v : domain.u;
    const double t = (line - other.low) / other.length(), low = (from - own.low) / own.length(),
                 high = (to - own.low) / own.length();
    Formed& patch = formed(number);
    ParameterInterval zero;
    const auto evaluate = [&] {
        const auto polynomial = [&](int k) {
            return along_line(patch.shape, patch.coefficients[k], patch.error[k], patch.errors[k], along_u, t,
                              {low, high});
        };
        return turning(polynomial(0), polynomial(1), domain.u.length(), domain.v.length(), zero);
    };
    std::optional<WayTurning> result = evaluate();
    if (!result && patch.errors[0].empty()) {
        // The one bound for all coefficients may be what hides the sign.
        equations_.form_fundamental_with_errors(surface_, patches_.patches[number], input_);
        take_equations(patch);
        result = evaluate();
    }
    if (!result && obstacle) {
        const double start = from + zero.low * (to - from), end = from + zero.high * (to - from);
        *obstacle = along_u ? BorderSide{{start, line}, {end, line}} : BorderSide{{line, start}, {line, end}};
    }
    return result;
}

std::optional<WayTurning> PathTurning::along(const Vector2& from, const Vector2& to, BorderSide* obstacle) {
    const bool along_u = from.y() == to.y();
    const double start = along_u ? from.x() : from.y(), end = along_u ? to.x() : to.y();
    const double low = std::min(start, end), high = std::max(start, end), across = along_u ? from.y() : from.x();
    const std::array<double, 4> key = {static_cast<double>(along_u), across, low, high};
    auto way = ways_.find(key);
    if (way == ways_.end()) {
        const std::vector<double>& breaks = (along_u ? surface_.u_knots() : surface_.v_knots()).breaks();
        const int first = along_u ? range_.u_first : range_.v_first, last = along_u ? range_.u_last : range_.v_last;
        WayTurning whole;
        double at = low;
        for (int k = first + 1; k <= last; ++k) {
            const double next = k == last ? high : std::min(high, breaks[k]);
            if (next <= at) continue;
            const std::optional<WayTurning> part = piece(along_u, at, next, across, obstacle);
            if (!part) return std::nullopt;
            if (!whole.append(*part)) {
                if (obstacle)
                    *obstacle =
                        along_u ? BorderSide{{at, across}, {at, across}} : BorderSide{{across, at}, {across, at}};
                return std::nullopt;
            }
            at = next;
        }
        way = ways_.emplace(key, whole).first;
    }
    return start < end ? way->second : way->second.reversed();
}

std::optional<double> PathTurning::winding(std::span<const BorderSide> sides, std::vector<BorderSide>* obstacles) {
    std::vector<DirectedWay> ways;
    bool known = true;
    for (const BorderSide& side : sides) {
        BorderSide obstacle;
        if (const std::optional<WayTurning> turning = along(side.from, side.to, &obstacle)) {
            ways.push_back({side, *turning});
            continue;
        }
        known = false;
        if (!obstacles) return std::nullopt;
        obstacles->push_back(obstacle);
    }
    if (!known) return std::nullopt;
    return umbilic::winding(ways);
}

}  // namespace umbilic
