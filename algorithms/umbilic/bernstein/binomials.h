// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace umbilic {

/// Highest degree of a product that is ever formed: rational umbilic equations of surfaces of degree 25.
inline constexpr int maximum_product_degree = 208;

/// The n + 1 binomial coefficients of degree n, each with a relative error of at most n unit roundoffs (none up to n =
/// 56).
const double* binomials(int n);
/// Their reciprocals, with a relative error of at most n + 1 unit roundoffs.
const double* inverse_binomials(int n);

}  // namespace umbilic
