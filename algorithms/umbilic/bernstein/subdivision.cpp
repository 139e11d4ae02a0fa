// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/bernstein/subdivision.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <umbilic/bernstein/binomials.h>
#include <umbilic/bernstein/rounding.h>

namespace umbilic {

namespace {

/// Rows that are halved together, side by side.
constexpr int lanes = 8;

/// Keeps [0, t] of every column of length p + 1 (rows of `length`), `from_high` keeps [t, 1] instead.
void keep_part(int p, int length, double* c, double t, bool from_high) {
    const double s = 1.0 - t;
    for (int step = 1; step <= p; ++step) {
        if (from_high)
            for (int i = 0; i <= p - step; ++i)
                for (int j = 0; j < length; ++j)
                    c[i * length + j] = s * c[i * length + j] + t * c[(i + 1) * length + j];
        else
            for (int i = p; i >= step; --i)
                for (int j = 0; j < length; ++j)
                    c[i * length + j] = s * c[(i - 1) * length + j] + t * c[i * length + j];
    }
}

/// Growth of errors at parameter t: 1 within [0, 1].
double growth(int degree, double t) {
    const double factor = std::abs(t) + std::abs(1.0 - t);
    return t >= 0.0 && t <= 1.0 ? 1.0 : std::pow(factor, degree) * bound_slack;
}

template <typename Keep>
double restrict_interval(int degree, double low, double high, const Keep& keep) {
    // The end that is farther inside first, so that the second parameter, relative to the part kept, stays benign.
    keep(high, false);
    const double relative = low / high;
    keep(relative, true);
    return growth(degree, high) * growth(degree, relative);
}

}  // namespace

void halve_u(CoefficientShape shape, double* c, double* first) {
    const int p = shape.p, length = shape.row_length();
    double power = 1.0;
    for (int step = 0; step <= p; ++step) {
        for (int j = 0; j < length; ++j) first[step * length + j] = c[j] * power;
        const int count = (p - step) * length;
        for (int at = 0; at < count; ++at) c[at] += c[at + length];
        power *= 0.5;
    }
    power = 1.0;
    for (int i = p; i >= 0; --i) {
        for (int j = 0; j < length; ++j) c[i * length + j] *= power;
        power *= 0.5;
    }
}

void halve_v(CoefficientShape shape, double* c, double* first) {
    const int q = shape.q, length = shape.row_length();
    // As halve_u, on some rows at a time that are transposed, so that the inner loop runs over them.
    std::array<double, (maximum_product_degree + 1) * lanes> columns;
    for (int begin = 0; begin <= shape.p; begin += lanes) {
        const int count = std::min(lanes, shape.p + 1 - begin);
        double* rows = c + begin * length;
        double* first_rows = first + begin * length;
        if (count < lanes) std::fill(columns.begin(), columns.begin() + length * lanes, 0.0);
        for (int k = 0; k < count; ++k)
            for (int j = 0; j < length; ++j) columns[j * lanes + k] = rows[k * length + j];
        double power = 1.0;
        for (int step = 0; step <= q; ++step) {
            for (int k = 0; k < count; ++k) first_rows[k * length + step] = columns[k] * power;
            const int end = (q - step) * lanes;
            for (int at = 0; at < end; ++at) columns[at] += columns[at + lanes];
            power *= 0.5;
        }
        power = 1.0;
        for (int j = q; j >= 0; --j) {
            for (int k = 0; k < count; ++k) rows[k * length + j] = columns[j * lanes + k] * power;
            power *= 0.5;
        }
    }
}

double restrict_u(CoefficientShape shape, double* c, double low, double high) {
    return restrict_interval(
        shape.p, low, high, [&](double t, bool from_high) { keep_part(shape.p, shape.row_length(), c, t, from_high); });
}

double restrict_v(CoefficientShape shape, double* c, double low, double high) {
    return restrict_interval(shape.q, low, high, [&](double t, bool from_high) {
        for (int i = 0; i <= shape.p; ++i) keep_part(shape.q, 1, c + i * shape.row_length(), t, from_high);
    });
}

double keep_below_u(CoefficientShape shape, double* c, double t) {
    keep_part(shape.p, shape.row_length(), c, t, false);
    return growth(shape.p, t);
}

double keep_above_u(CoefficientShape shape, double* c, double t) {
    keep_part(shape.p, shape.row_length(), c, t, true);
    return growth(shape.p, t);
}

void bernstein_basis(int n, double t, double* values, double* derivatives) {
    const double s = 1.0 - t;
    std::fill(derivatives, derivatives + n + 1, 0.0);
    values[0] = 1.0;
    for (int degree = 1; degree <= n; ++degree) {
        if (degree == n) {
            for (int k = 0; k < n; ++k) {
                derivatives[k] -= n * values[k];
                derivatives[k + 1] += n * values[k];
            }
        }
        values[degree] = t * values[degree - 1];
        for (int k = degree - 1; k > 0; --k) values[k] = s * values[k] + t * values[k - 1];
        values[0] *= s;
    }
}

void bernstein_basis(int n, double t, Interval* values) {
    const Interval s = Interval(1.0) - Interval(t);
    values[0] = 1.0;
    for (int degree = 1; degree <= n; ++degree) {
        values[degree] = Interval(t) * values[degree - 1];
        for (int k = degree - 1; k > 0; --k) values[k] = s * values[k] + Interval(t) * values[k - 1];
        values[0] = s * values[0];
    }
}

}  // namespace umbilic
