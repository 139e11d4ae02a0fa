// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <umbilic/bernstein/interval.h>

namespace umbilic {

/// Row-major array of (p + 1) x (q + 1) Bernstein coefficients.
struct CoefficientShape {
    int p = 0;
    int q = 0;

    int row_length() const { return q + 1; }
    int size() const { return (p + 1) * (q + 1); }
};

/// de Casteljau's algorithm at u = 1/2: `coefficients` becomes the half u >= 1/2, `first` receives the half u <= 1/2.
/// The coefficients of both are in error by at most p unit roundoffs of the largest one more than before.
void halve_u(CoefficientShape shape, double* coefficients, double* first);
/// The same at v = 1/2; q unit roundoffs.
void halve_v(CoefficientShape shape, double* coefficients, double* first);

/// Coefficients of the same polynomial on [low, high] in u, in place; the interval may reach out of [0, 1]. Returns a
/// bound on the factor by which errors and magnitudes may have grown, 1 if the interval is within [0, 1]; the
/// arithmetic itself adds at most 6 p unit roundoffs of that factor times the largest coefficient before.
double restrict_u(CoefficientShape shape, double* coefficients, double low, double high);
/// The same in v.
double restrict_v(CoefficientShape shape, double* coefficients, double low, double high);

/// One end alone: coefficients on [0, t] or on [t, 1] in u, in place; t may lie outside [0, 1]. Returns the growth as
/// above; the arithmetic adds at most 3 p unit roundoffs of that factor times the largest coefficient before.
double keep_below_u(CoefficientShape shape, double* coefficients, double t);
double keep_above_u(CoefficientShape shape, double* coefficients, double t);

/// Values and first derivatives of the Bernstein polynomials of degree n at t, n + 1 numbers each. In [0, 1] each value
/// has a relative error of at most 3 n unit roundoffs.
void bernstein_basis(int n, double t, double* values, double* derivatives);
/// Enclosures of the values, for any t.
void bernstein_basis(int n, double t, Interval* values);

}  // namespace umbilic
