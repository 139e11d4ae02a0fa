// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <vector>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <umbilic/bernstein/subdivision.h>
#include <umbilic/nurbs/nurbs_surface.h>

// The equations of umbilics in multiprecision, by another way than the code under test: the power basis and naive
// products.
namespace umbilic {

/// 60 digits: the power basis costs below 25 of them at the degrees used, the bounds begin at the 16th.
using Exact = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<60>, boost::multiprecision::et_off>;

/// Polynomial in the power basis: another basis, and naive products, than the code under test.
struct Power {
    int m = 0, n = 0;
    std::vector<Exact> c = {Exact(0)};

    Power() = default;
    Power(int u_degree, int v_degree) : m(u_degree), n(v_degree), c((m + 1) * (n + 1), Exact(0)) {}
    Exact& at(int i, int j) { return c[i * (n + 1) + j]; }
    const Exact& at(int i, int j) const { return c[i * (n + 1) + j]; }

    /// Derivatives.
    Power u() const;
    Power v() const;
};

/// Homogeneous components of a Bezier patch with exact coefficients.
using Net = std::array<std::vector<Exact>, 4>;

/// Bernstein coefficients of the given degrees, row-major; they may be below the formal ones if the leading terms
/// vanish.
std::vector<Exact> bernstein(const Power& f, int p, int q);

struct Pair {
    Power a, b;
};
/// A and B of a patch of degrees (p, q), whose net is not scaled.
Pair exact_equations(const Net& net, int p, int q, bool rational);

/// Bernstein coefficients of one span in exact arithmetic by the polar form, relative to the origin.
Net exact_patch(const NurbsSurface& surface, int u_span, int v_span, const Vector3& origin);

/// de Casteljau's algorithm; keeps [0, t] or [t, 1].
void keep(std::vector<Exact>& e, CoefficientShape shape, bool along_u, const Exact& t, bool low_part);

}  // namespace umbilic
