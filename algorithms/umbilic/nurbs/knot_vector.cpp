// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/nurbs/knot_vector.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <string>
#include <utility>

#include <umbilic/core/errors.h>

namespace umbilic {

namespace {

void check(int degree, const std::vector<double>& knots) {
    if (degree < 1 || degree > maximum_degree)
        throw InvalidInput("knot vector: degree " + std::to_string(degree) + " is outside [1, " +
                           std::to_string(maximum_degree) + "]");
    const int count = static_cast<int>(knots.size());
    if (count < 2 * (degree + 1))
        throw InvalidInput("knot vector: " + std::to_string(count) + " knots are too few for degree " +
                           std::to_string(degree) + " (at least " + std::to_string(2 * (degree + 1)) + ")");
    for (int i = 0; i < count; ++i) {
        if (!std::isfinite(knots[i])) throw InvalidInput("knot vector: knot " + std::to_string(i) + " is not finite");
        if (i > 0 && knots[i] < knots[i - 1])
            throw InvalidInput("knot vector: knot " + std::to_string(i) + " (" + std::to_string(knots[i]) +
                               ") is smaller than its predecessor (" + std::to_string(knots[i - 1]) + ")");
    }
    const double low = knots[degree];
    const double high = knots[count - degree - 1];
    if (!(low < high)) throw InvalidInput("knot vector: the parameter domain is empty");
    for (int i = 0, run = 1; i + 1 < count; ++i) {
        run = knots[i + 1] == knots[i] ? run + 1 : 1;
        const bool interior = low < knots[i] && knots[i] < high;
        const int most = interior ? degree : degree + 1;
        if (run > most)
            throw InvalidInput("knot vector: knot " + std::to_string(knots[i]) + " has multiplicity above " +
                               std::to_string(most));
    }
}

/// Directory entries for each polynomial piece: with two, most searches end at once on uneven knots too.
constexpr int directory_entries_per_piece = 2;
/// More pieces than this in one directory entry are searched by halving.
constexpr int longest_walk = 4;

}  // namespace

KnotVector::KnotVector(int degree, std::vector<double> knots) : degree_(degree), knots_(std::move(knots)) {
    check(degree_, knots_);
    const ParameterInterval range = domain();
    for (const double knot : knots_)
        if (range.contains(knot) && (breaks_.empty() || knot > breaks_.back())) breaks_.push_back(knot);
    for (const double value : breaks_) {
        const auto multiplicity = std::count(knots_.begin(), knots_.end(), value);
        continuity_.push_back(degree_ - static_cast<int>(multiplicity));
    }
    continuity_.front() = -1;
    continuity_.back() = -1;

    for (int i = degree_; i < pole_count(); ++i)
        if (knots_[i] < knots_[i + 1]) piece_spans_.push_back(i);
    const int pieces = static_cast<int>(piece_spans_.size());
    const int entries = directory_entries_per_piece * pieces;
    directory_scale_ = entries / range.length();
    for (int k = 0, piece = 0; k <= entries; ++k) {
        const double start = range.low + k / directory_scale_;
        while (piece + 1 < pieces && breaks_[piece + 1] <= start) ++piece;
        directory_.push_back(piece);
    }
    if (degree_ <= maximum_tabulated_degree)
        for (int k = 0; k < pieces; ++k) basis_pieces_.push_back(tabulate(piece_spans_[k]));
}

KnotVector KnotVector::bezier(int degree) {
    std::vector<double> knots(2 * (std::max(degree, 0) + 1), 0.0);
    std::fill(knots.begin() + static_cast<std::ptrdiff_t>(knots.size() / 2), knots.end(), 1.0);
    return KnotVector(degree, std::move(knots));
}

BasisPiece KnotVector::tabulate(int span) const {
    const int p = degree_;
    const std::vector<double> matrix = bernstein_matrix(span);
    BasisPiece piece;
    piece.low = knots_[span];
    piece.high = knots_[span + 1];
    piece.first_pole = span - p;
    const double scale = p / (piece.high - piece.low);
    const double second_scale = (p - 1) / (piece.high - piece.low);
    for (int k = 0; k <= p; ++k) {
        for (int j = 0; j <= p; ++j) piece.value[j][k] = matrix[j * (p + 1) + k];
        for (int j = 0; j < p; ++j) piece.first[j][k] = scale * (piece.value[j + 1][k] - piece.value[j][k]);
        for (int j = 0; j + 1 < p; ++j) piece.second[j][k] = second_scale * (piece.first[j + 1][k] - piece.first[j][k]);
    }
    return piece;
}

int KnotVector::piece(double u) const {
    const int last = static_cast<int>(piece_spans_.size()) - 1;
    const double entry = (u - breaks_.front()) * directory_scale_;
    if (!(entry > 0.0)) return 0;
    const int entries = static_cast<int>(directory_.size()) - 1;
    if (entry >= entries) return last;
    const int k = static_cast<int>(entry);
    int result = directory_[k];
    if (directory_[k + 1] - result > longest_walk) {
        const auto next = std::upper_bound(breaks_.begin() + result, breaks_.begin() + directory_[k + 1] + 1, u);
        result = std::max(static_cast<int>(next - breaks_.begin()) - 1, 0);
    }
    // Rounding of `entry` may have taken the neighbouring part.
    while (result > 0 && u < breaks_[result]) --result;
    while (result < last && breaks_[result + 1] <= u) ++result;
    return result;
}

// The polar form at degree - j arguments low and j arguments high. Both factors of every de Boor step lie in [0, 1] and
// are formed without cancellation of rounded numbers: 3 unit roundoffs per quotient of two differences, one product,
// one sum, per step.
std::vector<double> KnotVector::bernstein_matrix(int span) const {
    const int p = degree_;
    std::vector<double> result((p + 1) * (p + 1));
    std::vector<double> column(p + 1);
    for (int k = 0; k <= p; ++k)
        for (int j = 0; j <= p; ++j) {
            column.assign(p + 1, 0.0);
            column[k] = 1.0;
            for (int level = 1; level <= p; ++level) {
                const double argument = level <= p - j ? knots_[span] : knots_[span + 1];
                for (int i = p; i >= level; --i) {
                    const double low = knots_[span - p + i];
                    const double high = knots_[span + 1 + i - level];
                    const double alpha = (argument - low) / (high - low);
                    const double beta = (high - argument) / (high - low);
                    column[i] = beta * column[i - 1] + alpha * column[i];
                }
            }
            result[j * (p + 1) + k] = column[p];
        }
    return result;
}

int KnotVector::span(double u, Side side) const {
    if (side == Side::right) return piece_spans_[piece(u)];
    const auto first = knots_.begin() + degree_;
    const auto last = knots_.begin() + pole_count();
    if (u <= *first) return piece_spans_.front();
    if (u >= *last) return piece_spans_.back();
    return static_cast<int>(std::lower_bound(first, last, u) - knots_.begin()) - 1;
}

void KnotVector::basis(int span, double u, int order, double* result) const {
    assert(0 <= order && order <= maximum_derivative);
    const int p = degree_;
    constexpr int size = maximum_degree + 1;
    // Upper triangle: basis functions of lower degree; lower triangle: the knot differences that divide them.
    std::array<std::array<double, size>, size> table;
    std::array<double, size> left, right;
    table[0][0] = 1.0;
    for (int j = 1; j <= p; ++j) {
        left[j] = u - knots_[span + 1 - j];
        right[j] = knots_[span + j] - u;
        double saved = 0.0;
        for (int r = 0; r < j; ++r) {
            table[j][r] = right[r + 1] + left[j - r];
            const double quotient = table[r][j - 1] / table[j][r];
            table[r][j] = saved + right[r + 1] * quotient;
            saved = left[j - r] * quotient;
        }
        table[j][j] = saved;
    }
    const int stride = p + 1;
    for (int j = 0; j <= p; ++j) result[j] = table[j][p];

    const int highest = std::min(order, p);
    for (int r = 0; r <= p && highest > 0; ++r) {
        std::array<std::array<double, size>, 2> a;
        a[0][0] = 1.0;
        int now = 0;
        for (int k = 1; k <= highest; ++k) {
            const int next = 1 - now;
            double derivative = 0.0;
            const int rk = r - k;
            const int pk = p - k;
            if (r >= k) {
                a[next][0] = a[now][0] / table[pk + 1][rk];
                derivative = a[next][0] * table[rk][pk];
            }
            const int low = rk >= -1 ? 1 : -rk;
            const int high = r - 1 <= pk ? k - 1 : p - r;
            for (int j = low; j <= high; ++j) {
                a[next][j] = (a[now][j] - a[now][j - 1]) / table[pk + 1][rk + j];
                derivative += a[next][j] * table[rk + j][pk];
            }
            if (r <= pk) {
                a[next][k] = -a[now][k - 1] / table[pk + 1][r];
                derivative += a[next][k] * table[r][pk];
            }
            result[k * stride + r] = derivative;
            now = next;
        }
    }
    double factor = 1.0;
    for (int k = 1; k <= highest; ++k) {
        factor *= p - k + 1;
        for (int j = 0; j <= p; ++j) result[k * stride + j] *= factor;
    }
    for (int k = highest + 1; k <= order; ++k) std::fill_n(result + k * stride, stride, 0.0);
}

}  // namespace umbilic
