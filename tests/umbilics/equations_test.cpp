// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/umbilics/equations.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <Eigen/Geometry>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include <support/surfaces.h>
#include <umbilic/nurbs/bezier_patch.h>

namespace umbilic {
namespace {

/// 150 digits: its rounding is nothing beside any bound tested here.
using Exact = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<150>, boost::multiprecision::et_off>;

/// Polynomial in the power basis: another basis, and naive products, than the code under test.
struct Power {
    int m = 0, n = 0;
    std::vector<Exact> c = {Exact(0)};

    Power() = default;
    Power(int u_degree, int v_degree) : m(u_degree), n(v_degree), c((m + 1) * (n + 1), Exact(0)) {}
    Exact& at(int i, int j) { return c[i * (n + 1) + j]; }
    const Exact& at(int i, int j) const { return c[i * (n + 1) + j]; }

    Power u() const {
        Power result(std::max(m - 1, 0), n);
        for (int i = 1; i <= m; ++i)
            for (int j = 0; j <= n; ++j) result.at(i - 1, j) = i * at(i, j);
        return result;
    }
    Power v() const {
        Power result(m, std::max(n - 1, 0));
        for (int i = 0; i <= m; ++i)
            for (int j = 1; j <= n; ++j) result.at(i, j - 1) = j * at(i, j);
        return result;
    }
};

Power operator*(const Power& a, const Power& b) {
    Power result(a.m + b.m, a.n + b.n);
    for (int i = 0; i <= a.m; ++i)
        for (int j = 0; j <= a.n; ++j) {
            if (a.at(i, j) == 0) continue;
            for (int k = 0; k <= b.m; ++k)
                for (int l = 0; l <= b.n; ++l) result.at(i + k, j + l) += a.at(i, j) * b.at(k, l);
        }
    return result;
}

Power combine(const Power& a, const Power& b, int sign) {
    Power result(std::max(a.m, b.m), std::max(a.n, b.n));
    for (int i = 0; i <= a.m; ++i)
        for (int j = 0; j <= a.n; ++j) result.at(i, j) += a.at(i, j);
    for (int i = 0; i <= b.m; ++i)
        for (int j = 0; j <= b.n; ++j) result.at(i, j) += sign * b.at(i, j);
    return result;
}
Power operator+(const Power& a, const Power& b) {
    return combine(a, b, 1);
}
Power operator-(const Power& a, const Power& b) {
    return combine(a, b, -1);
}

Exact binomial(int n, int k) {
    Exact result = 1;
    for (int i = 1; i <= k; ++i) result = result * (n - k + i) / i;
    return result;
}

/// Homogeneous components of a Bezier patch with exact coefficients.
using Net = std::array<std::vector<Exact>, 4>;

Power power_form(const std::vector<Exact>& b, int p, int q) {
    Power result(p, q);
    for (int i = 0; i <= p; ++i)
        for (int j = 0; j <= q; ++j)
            for (int k = 0; k <= i; ++k)
                for (int l = 0; l <= j; ++l)
                    result.at(i, j) += ((i - k + j - l) % 2 ? -1 : 1) * binomial(p, i) * binomial(i, k) *
                                       binomial(q, j) * binomial(j, l) * b[k * (q + 1) + l];
    return result;
}

/// Bernstein coefficient (k, l) of the given degrees, which may be below the formal ones if the leading terms vanish.
Exact bernstein(const Power& f, int p, int q, int k, int l) {
    Exact sum = 0;
    for (int i = 0; i <= std::min(f.m, k); ++i)
        for (int j = 0; j <= std::min(f.n, l); ++j)
            sum += binomial(k, i) / binomial(p, i) * binomial(l, j) / binomial(q, j) * f.at(i, j);
    return sum;
}

struct Pair {
    Power a, b;
};

Pair exact_equations(const Net& net, int p, int q, bool rational) {
    std::array<Power, 4> x;
    for (int k = 0; k < (rational ? 4 : 3); ++k) x[k] = power_form(net[k], p, q);
    using Vector = std::array<Power, 3>;
    const auto dot = [](const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
    Vector u, v, normal;
    std::array<Power, 3> second;
    if (rational) {
        // r_u w^2 and r_v w^2, and the normal N = (r_u x r_v), each up to a power of w that is divided out below.
        for (int k = 0; k < 3; ++k) {
            u[k] = x[3] * x[k].u() - x[k] * x[3].u();
            v[k] = x[3] * x[k].v() - x[k] * x[3].v();
        }
        // det(P, P_u, P_v, Y) expanded by its last column.
        const auto determinant = [&](const std::array<Power, 4>& y) {
            const auto minor = [&](int i, int j, int k) {
                return x[i] * (x[j].u() * x[k].v() - x[k].u() * x[j].v()) -
                       x[j] * (x[i].u() * x[k].v() - x[k].u() * x[i].v()) +
                       x[k] * (x[i].u() * x[j].v() - x[j].u() * x[i].v());
            };
            return minor(0, 1, 2) * y[3] - minor(0, 1, 3) * y[2] + minor(0, 2, 3) * y[1] - minor(1, 2, 3) * y[0];
        };
        second = {determinant({x[0].u().u(), x[1].u().u(), x[2].u().u(), x[3].u().u()}),
                  determinant({x[0].u().v(), x[1].u().v(), x[2].u().v(), x[3].u().v()}),
                  determinant({x[0].v().v(), x[1].v().v(), x[2].v().v(), x[3].v().v()})};
    } else {
        for (int k = 0; k < 3; ++k) {
            u[k] = x[k].u();
            v[k] = x[k].v();
        }
        for (int k = 0; k < 3; ++k) {
            const int i = (k + 1) % 3, j = (k + 2) % 3;
            normal[k] = u[i] * v[j] - u[j] * v[i];
        }
        second = {dot(normal, {x[0].u().u(), x[1].u().u(), x[2].u().u()}),
                  dot(normal, {x[0].u().v(), x[1].u().v(), x[2].u().v()}),
                  dot(normal, {x[0].v().v(), x[1].v().v(), x[2].v().v()})};
    }
    const Power e = dot(u, u), f = dot(u, v), g = dot(v, v);
    return {e * second[1] - f * second[0], e * second[2] - g * second[0]};
}

/// Power of two by which the code scales its input, told from the patch.
Exact scale_of(const BezierPatch& patch) {
    double position = 0.0, weight = 0.0;
    for (const Vector4& pole : patch.poles) {
        position = std::max(position, pole.head<3>().cwiseAbs().maxCoeff());
        weight = std::max(weight, pole[3]);
    }
    const double s = std::ldexp(1.0, -std::ilogb(position)), t = std::ldexp(1.0, -std::ilogb(weight));
    // A and B are of degree 5 in the coordinates (with local weights 3 more: a is of degree 2, l of degree 4).
    const Exact s5 = Exact(s) * s * s * s * s;
    return patch.rational ? s5 * t * t * t : s5;
}

/// Bernstein coefficients of one span in exact arithmetic by the polar form.
Net exact_patch(const NurbsSurface& surface, int u_span, int v_span, const Vector3& origin) {
    const int p = surface.u_degree(), q = surface.v_degree();
    const auto polar = [](const KnotVector& knots, int span, int low_arguments, std::vector<Exact> d) {
        const int degree = knots.degree();
        const std::vector<double>& t = knots.knots();
        for (int level = 1; level <= degree; ++level) {
            const Exact argument = level <= low_arguments ? t[span] : t[span + 1];
            for (int i = degree; i >= level; --i) {
                const Exact low = t[span - degree + i], high = t[span + 1 + i - level];
                const Exact alpha = (argument - low) / (high - low);
                d[i] = (1 - alpha) * d[i - 1] + alpha * d[i];
            }
        }
        return d[degree];
    };
    Net result;
    for (int k = 0; k < 4; ++k)
        for (int i = 0; i <= p; ++i)
            for (int j = 0; j <= q; ++j) {
                std::vector<Exact> column;
                for (int a = 0; a <= p; ++a) {
                    std::vector<Exact> row;
                    for (int b = 0; b <= q; ++b) {
                        const int iu = u_span - p + a, iv = v_span - q + b;
                        const Exact w = surface.weight(iu, iv);
                        row.push_back(k == 3 ? w : w * (Exact(surface.pole(iu, iv)[k]) - Exact(origin[k])));
                    }
                    column.push_back(polar(surface.v_knots(), v_span, q - j, row));
                }
                result[k].push_back(polar(surface.u_knots(), u_span, p - i, column));
            }
    return result;
}

void expect_within_bounds(const NurbsSurface& surface) {
    const int p = surface.u_degree(), q = surface.v_degree();
    const BezierPatches patches = bezier_patches(surface);
    const BezierPatch& patch = patches.patches.back();
    const Net net = exact_patch(surface, surface.u_pole_count() - 1, surface.v_pole_count() - 1, patch.origin);
    const Pair exact = exact_equations(net, p, q, surface.rational());
    const Exact scale = scale_of(patch);

    UmbilicEquations equations;
    equations.form_fundamental(patch, input_rounding(surface));
    equations.form_umbilic();
    const TensorPolynomial* computed[2] = {&equations.a(), &equations.b()};
    const Power* wanted[2] = {&exact.a, &exact.b};
    for (int f = 0; f < 2; ++f) {
        std::vector<double> c(computed[f]->scaled.size());
        const CoefficientBound bound = computed[f]->bernstein_coefficients(c);
        for (int k = 0; k <= computed[f]->u_degree; ++k)
            for (int l = 0; l <= computed[f]->v_degree; ++l) {
                const Exact b = scale * bernstein(*wanted[f], computed[f]->u_degree, computed[f]->v_degree, k, l);
                ASSERT_LE(abs(Exact(c[k * computed[f]->row_length() + l]) - b), Exact(bound.rounding))
                    << (f == 0 ? "A " : "B ") << k << ' ' << l;
            }
    }
    // The pointwise enclosure holds the exact value.
    for (const Vector2& at : {Vector2(0.0, 1.0), Vector2(0.3, 0.8), Vector2(1.01, 0.5)}) {
        const std::array<Interval, 2> value = equations.enclose(at);
        for (int f = 0; f < 2; ++f) {
            Exact sum = 0, power_u = 1;
            for (int i = 0; i <= wanted[f]->m; ++i, power_u *= Exact(at.x())) {
                Exact power_v = power_u;
                for (int j = 0; j <= wanted[f]->n; ++j, power_v *= Exact(at.y())) sum += wanted[f]->at(i, j) * power_v;
            }
            EXPECT_GE(scale * sum, Exact(value[f].low));
            EXPECT_LE(scale * sum, Exact(value[f].high));
        }
    }
    // The restriction to the edges agrees with the first and last rows and columns.
    for (const Edge edge : {Edge::u_low, Edge::u_high, Edge::v_low, Edge::v_high}) {
        const EdgeEquations pair = equations.edge_equations(edge);
        const bool across_u = edge == Edge::u_low || edge == Edge::u_high;
        const Exact fixed = edge == Edge::u_high || edge == Edge::v_high ? 1 : 0;
        for (int f = 0; f < 2; ++f) {
            const std::vector<double>& c = f == 0 ? pair.a : pair.b;
            const Power& w = *wanted[f];
            const int degree = static_cast<int>(c.size()) - 1;
            for (int k = 0; k <= degree; ++k) {
                Exact sum = 0;
                for (int i = 0; i <= w.m; ++i)
                    for (int j = 0; j <= w.n; ++j) {
                        const int across = across_u ? i : j, along = across_u ? j : i;
                        if (along > k || (across > 0 && fixed == 0)) continue;
                        sum += w.at(i, j) * binomial(k, along) / binomial(degree, along);
                    }
                ASSERT_LE(abs(scale * sum - Exact(c[k])), Exact(f == 0 ? pair.a_error : pair.b_error));
            }
        }
    }
}

NurbsSurface shifted(const NurbsSurface& surface, unsigned seed, double reach) {
    return support::transformed(surface, support::random_similarity(seed, 1.0, seed % 2 == 1, reach));
}

TEST(UmbilicEquations, IntegralCoefficientsStayWithinTheirBound) {
    for (unsigned seed = 0; seed < 30; ++seed)
        for (const auto& [p, q] : {std::pair{2, 2}, std::pair{3, 3}, std::pair{1, 3}, std::pair{3, 2}})
            expect_within_bounds(support::random_surface(p, q, p + 2, q + 2, seed, 0.3));
}

TEST(UmbilicEquations, BoundsHoldFarFromTheOriginAndTilted) {
    for (unsigned seed = 0; seed < 15; ++seed) {
        expect_within_bounds(shifted(support::random_surface(3, 3, 5, 4, seed, 0.3), seed, 2e3));
        expect_within_bounds(shifted(support::random_surface(3, 3, 5, 4, seed, 0.0), seed, 2e3));
    }
}

TEST(UmbilicEquations, RationalCoefficientsStayWithinTheirBound) {
    for (unsigned seed = 0; seed < 8; ++seed)
        for (const double ratio : {2.0, 100.0}) {
            expect_within_bounds(support::random_surface(2, 2, 3, 4, seed, 0.3, ratio));
            expect_within_bounds(support::random_surface(1, 2, 3, 3, seed, 0.3, ratio));
            expect_within_bounds(shifted(support::random_surface(2, 2, 3, 3, seed, 0.3, ratio), seed, 2e3));
        }
    for (unsigned seed = 0; seed < 3; ++seed)
        expect_within_bounds(support::random_surface(3, 3, 4, 5, seed, 0.3, 100.0));
}

TEST(UmbilicEquations, RoundedTiltedPlaneIsZeroWithinTheInput) {
    const NurbsSurface plane = shifted(support::smooth_bicubic(6, 1, 0.0), 5, 1e3);
    for (const BezierPatch& patch : bezier_patches(plane).patches) {
        UmbilicEquations equations;
        equations.form_fundamental(patch, input_rounding(plane));
        equations.form_umbilic();
        EXPECT_LE(equations.a().magnitude, 4 * equations.a().bound.input);
        EXPECT_LE(equations.b().magnitude, 4 * equations.b().bound.input);
    }
}

TEST(UmbilicEquations, CollapsedEdgesAreSeen) {
    const NurbsSurface octant = support::ellipsoid_octant(3, 2, 1);
    UmbilicEquations equations;
    equations.form_fundamental(bezier_patches(octant).patches[0], input_rounding(octant));
    EXPECT_TRUE(equations.collapsed(Edge::v_high));
    EXPECT_FALSE(equations.collapsed(Edge::v_low));
    EXPECT_FALSE(equations.collapsed(Edge::u_low));
    EXPECT_FALSE(equations.collapsed(Edge::u_high));
    equations.form_umbilic();
    const int before = equations.a().v_degree;
    equations.divide_by_collapsed_edges();
    EXPECT_LT(equations.a().v_degree, before);
    // The pole of a triaxial ellipsoid is no umbilic: the divided forms do not vanish together on the edge.
    EXPECT_GT(std::max(edge_magnitude(equations.a(), Edge::v_high), edge_magnitude(equations.b(), Edge::v_high)), 1e-3);
}

}  // namespace
}  // namespace umbilic
