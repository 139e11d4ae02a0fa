// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/bernstein/coefficient_errors.h>

#include <algorithm>
#include <cmath>

#include <umbilic/bernstein/rounding.h>

namespace umbilic {

namespace {

/// Adds what `roundings` of every coefficient are at most, and as many of the bound's own on its way.
void add_roundings(CoefficientShape shape, int roundings, const double* coefficients, double* errors) {
    const double relative = gamma_bound(roundings);
    for (int k = 0; k < shape.size(); ++k)
        errors[k] = (errors[k] + relative * std::abs(coefficients[k])) * (1.0 + relative) * bound_slack;
}

/// Largest difference of coefficients that are `step` apart, of which there are `count` in every row.
double largest_difference(CoefficientShape shape, const double* c, int rows, int count, int step) {
    double largest = 0.0;
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < count; ++j) {
            const int at = i * shape.row_length() + j;
            largest = std::max(largest, std::abs(c[at + step] - c[at]));
        }
    return largest;
}

}  // namespace

void halve_errors(CoefficientShape shape, bool along_u, const double* coefficients, double* errors, double* first) {
    add_roundings(shape, along_u ? shape.p : shape.q, coefficients, errors);
    (along_u ? halve_u : halve_v)(shape, errors, first);
}

void restrict_errors(CoefficientShape shape, const double* whole, const double* part, const ParameterBox& box,
                     double* errors) {
    add_roundings(shape, 8 * (shape.p + shape.q), whole, errors);
    restrict_u(shape, errors, box.u.low, box.u.high);
    restrict_v(shape, errors, box.v.low, box.v.high);
    // The lower end is rounded relative to the upper one, by a unit roundoff at most: the coefficients are those of a
    // part that starts beside it, and each of their at most p (q) arguments that is this end moves them by a difference
    // over the part's length. The factor covers terms of higher order.
    const double u =
        shape.p * largest_difference(shape, part, shape.p, shape.row_length(), shape.row_length()) / box.u.length();
    const double v = shape.q * largest_difference(shape, part, shape.p + 1, shape.q, 1) / box.v.length();
    const double placing = 4 * unit_roundoff * (u + v);
    for (int k = 0; k < shape.size(); ++k) errors[k] = (errors[k] + placing) * bound_slack;
}

}  // namespace umbilic
