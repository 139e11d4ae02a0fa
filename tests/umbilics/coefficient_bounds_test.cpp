// SPDX-License-Identifier: LGPL-2.1-or-later
// Error bounds against multiprecision: extraction, equations (for the surface as given and for surfaces that round to
// it), points, edges, subdivision.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <support/random_faces.h>
#include <support/surfaces.h>
#include <umbilic/bernstein/coefficient_errors.h>
#include <umbilic/bernstein/rounding.h>
#include <umbilic/bernstein/subdivision.h>
#include <umbilic/nurbs/bezier_patch.h>
#include <umbilic/umbilics/equations.h>

#include "exact_equations.h"

namespace umbilic {
namespace {

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

/// Largest errors seen, as shares of their bounds.
struct Shares {
    double extraction = 0.0, rounding = 0.0, input = 0.0, edge = 0.0, halving = 0.0, restriction = 0.0, single = 0.0;
};

double share(const Exact& error, double bound) {
    const Exact size = abs(error);
    if (size == 0) return 0.0;
    return bound > 0.0 ? static_cast<double>(size / Exact(bound)) : std::numeric_limits<double>::infinity();
}

/// A surface whose numbers are within one ulp of the largest coordinate, and weight, of the given one's.
NurbsSurface within_an_ulp(const NurbsSurface& surface, std::mt19937& random) {
    // A little less, since the sum is rounded again.
    std::uniform_real_distribution<double> part(-0.99, 0.99);
    const InputRounding ulp = input_rounding(surface);
    std::vector<Vector3> poles = surface.poles();
    std::vector<double> weights = surface.weights();
    for (Vector3& pole : poles)
        for (int k = 0; k < 3; ++k) pole[k] += ulp.position * (random() % 2 ? 0.99 : part(random));
    for (double& weight : weights) weight += ulp.weight * (random() % 2 ? 0.99 : part(random));
    return NurbsSurface(surface.u_knots(), surface.v_knots(), std::move(poles), std::move(weights));
}

/// The coefficients in halves chosen at random, and in a part that is no dyadic box, beside exact ones.
void expect_subdivision_within_bounds(const std::vector<double>& start, std::vector<Exact> exact,
                                      CoefficientShape shape, double bound, std::mt19937& random, Shares& shares) {
    std::vector<double> c = start, first(c.size());
    const auto largest = [](const std::vector<double>& values) {
        double result = 0.0;
        for (const double value : values) result = std::max(result, std::abs(value));
        return result;
    };
    std::vector<Exact> part = exact;
    double error = bound;
    for (int level = 0; level < 12; ++level) {
        const bool along_u = random() % 2, low_part = random() % 2;
        error = (error + gamma_bound(along_u ? shape.p : shape.q) * largest(c)) * bound_slack;
        (along_u ? halve_u : halve_v)(shape, c.data(), first.data());
        if (low_part) c = first;
        keep(part, shape, along_u, Exact(0.5), low_part);
        for (std::size_t k = 0; k < c.size(); ++k)
            shares.halving = std::max(shares.halving, share(c[k] - part[k], error));
    }
    std::uniform_real_distribution<double> parameter(-0.2, 1.2);
    double u[2] = {parameter(random), parameter(random)}, v[2] = {parameter(random), parameter(random)};
    if (u[0] > u[1]) std::swap(u[0], u[1]);
    if (v[0] > v[1]) std::swap(v[0], v[1]);
    // As the search uses it: parts that reach inside from both ends, or out by less than half a side.
    if (u[1] < 0.3 || v[1] < 0.3 || u[0] > 0.7 || v[0] > 0.7) return;
    c = start;
    part = std::move(exact);
    const double before = largest(c);
    const double factor = restrict_u(shape, c.data(), u[0], u[1]) * restrict_v(shape, c.data(), v[0], v[1]);
    error = (bound * factor + gamma_bound(6 * (shape.p + shape.q)) * factor * before) * bound_slack;
    keep(part, shape, true, Exact(u[1]), true);
    keep(part, shape, true, Exact(u[0]) / Exact(u[1]), false);
    keep(part, shape, false, Exact(v[1]), true);
    keep(part, shape, false, Exact(v[0]) / Exact(v[1]), false);
    for (std::size_t k = 0; k < c.size(); ++k)
        shares.restriction = std::max(shares.restriction, share(c[k] - part[k], error));
}

/// Bounds for single coefficients, in halves and in a part inside.
void expect_single_bounds(const TensorPolynomial& computed, const std::vector<Exact>& wanted, std::mt19937& random,
                          Shares& shares) {
    const CoefficientShape shape{computed.u_degree, computed.v_degree};
    std::vector<double> start(shape.size()), bounds(shape.size());
    computed.bernstein_coefficients(start);
    computed.bernstein_errors(bounds);
    const auto check = [&](const std::vector<double>& c, const std::vector<Exact>& exact,
                           const std::vector<double>& errors) {
        for (std::size_t k = 0; k < c.size(); ++k)
            shares.single = std::max(shares.single, share(c[k] - exact[k], errors[k]));
    };
    check(start, wanted, bounds);
    std::vector<double> c = start, errors = bounds, first(c.size());
    std::vector<Exact> exact = wanted;
    for (int level = 0; level < 12; ++level) {
        const bool along_u = random() % 2, low_part = random() % 2;
        halve_errors(shape, along_u, c.data(), errors.data(), first.data());
        if (low_part) errors = first;
        (along_u ? halve_u : halve_v)(shape, c.data(), first.data());
        if (low_part) c = first;
        keep(exact, shape, along_u, Exact(0.5), low_part);
        check(c, exact, errors);
    }
    std::uniform_real_distribution<double> parameter(0.0, 1.0), magnitude(-8.0, 0.0);
    const auto part = [&] {
        const double length = std::pow(10.0, magnitude(random)), low = parameter(random) * (1.0 - length);
        return ParameterInterval{low, low + length};
    };
    const ParameterBox box{part(), part()};
    c = start;
    errors = bounds;
    exact = wanted;
    restrict_u(shape, c.data(), box.u.low, box.u.high);
    restrict_v(shape, c.data(), box.v.low, box.v.high);
    restrict_errors(shape, start.data(), c.data(), box, errors.data());
    for (const bool along_u : {true, false}) {
        const ParameterInterval& side = along_u ? box.u : box.v;
        keep(exact, shape, along_u, Exact(side.high), true);
        keep(exact, shape, along_u, Exact(side.low) / Exact(side.high), false);
    }
    check(c, exact, errors);
}

void measure(const NurbsSurface& surface, unsigned seed, Shares& shares) {
    std::mt19937 random(seed);
    const int p = surface.u_degree(), q = surface.v_degree();
    const BezierPatches patches = bezier_patches(surface);
    const std::size_t chosen = random() % patches.patches.size();
    const BezierPatch& patch = patches.patches[chosen];
    const auto spans = [](const KnotVector& knots) {
        std::vector<int> result;
        for (int k = knots.degree(); k < knots.pole_count(); ++k)
            if (knots.knots()[k] < knots.knots()[k + 1]) result.push_back(k);
        return result;
    };
    const int u_span = spans(surface.u_knots())[chosen / patches.v_count];
    const int v_span = spans(surface.v_knots())[chosen % patches.v_count];
    const Net net = exact_patch(surface, u_span, v_span, patch.origin);
    for (int k = 0; k < (patch.rational ? 4 : 3); ++k)
        for (std::size_t at = 0; at < patch.poles.size(); ++at)
            shares.extraction = std::max(shares.extraction, share(Exact(patch.poles[at][k]) - net[k][at],
                                                                  k < 3 ? patch.position_error : patch.weight_error));

    UmbilicEquations equations;
    equations.form_fundamental(patch, input_rounding(surface));
    equations.form_umbilic();
    const Exact scale = scale_of(patch);
    const Pair exact = exact_equations(net, p, q, surface.rational());
    const Pair other = exact_equations(exact_patch(within_an_ulp(surface, random), u_span, v_span, patch.origin), p, q,
                                       surface.rational());
    const TensorPolynomial* computed[2] = {&equations.a(), &equations.b()};
    const Power* wanted[2] = {&exact.a, &exact.b};
    const Power* rounded[2] = {&other.a, &other.b};
    for (int f = 0; f < 2; ++f) {
        const CoefficientShape shape{computed[f]->u_degree, computed[f]->v_degree};
        std::vector<double> c(shape.size());
        const CoefficientBound bound = computed[f]->bernstein_coefficients(c);
        std::vector<Exact> b = bernstein(*wanted[f], shape.p, shape.q);
        const std::vector<Exact> b_rounded = bernstein(*rounded[f], shape.p, shape.q);
        for (int k = 0; k < shape.size(); ++k) {
            b[k] *= scale;
            shares.rounding = std::max(shares.rounding, share(Exact(c[k]) - b[k], bound.rounding));
            shares.input = std::max(shares.input, share(Exact(c[k]) - scale * b_rounded[k], bound.input));
        }
        expect_subdivision_within_bounds(c, std::move(b), shape, bound.rounding, random, shares);
    }
    // Bounds for single coefficients hold for all surfaces that round to the given one. Every third patch: slow.
    UmbilicEquations single;
    single.form_fundamental_with_errors(surface, patch, input_rounding(surface));
    single.form_umbilic();
    for (int f = 0; f < 2 && seed % 3 == 0; ++f) {
        const TensorPolynomial& polynomial = f == 0 ? single.a() : single.b();
        std::vector<Exact> b = bernstein(*rounded[f], polynomial.u_degree, polynomial.v_degree);
        for (Exact& value : b) value *= scale;
        expect_single_bounds(polynomial, b, random, shares);
    }
    // The pointwise enclosure holds the exact value.
    std::uniform_real_distribution<double> parameter(-0.05, 1.05);
    for (int k = 0; k < 3; ++k) {
        const Vector2 at(parameter(random), parameter(random));
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
    // The restriction to an edge.
    const PatchEdge edge =
        std::array{PatchEdge::u_low, PatchEdge::u_high, PatchEdge::v_low, PatchEdge::v_high}[random() % 4];
    const EdgeEquations pair = equations.edge_equations(edge);
    const bool across_u = edge == PatchEdge::u_low || edge == PatchEdge::u_high;
    const bool high = edge == PatchEdge::u_high || edge == PatchEdge::v_high;
    for (int f = 0; f < 2; ++f) {
        const std::vector<double>& c = f == 0 ? pair.a : pair.b;
        const Power& w = *wanted[f];
        Power along(0, across_u ? w.n : w.m);
        for (int i = 0; i <= w.m; ++i)
            for (int j = 0; j <= w.n; ++j)
                if (high || (across_u ? i : j) == 0) along.at(0, across_u ? j : i) += w.at(i, j);
        const std::vector<Exact> b = bernstein(along, 0, static_cast<int>(c.size()) - 1);
        for (std::size_t k = 0; k < c.size(); ++k)
            shares.edge =
                std::max(shares.edge, share(scale * b[k] - Exact(c[k]), f == 0 ? pair.a_error : pair.b_error));
    }
}

/// Moved by up to `reach` and turned: the poles are rounded where they arrive.
NurbsSurface shifted(const NurbsSurface& surface, unsigned seed, double reach) {
    return support::transformed(surface, support::random_similarity(seed, 1.0, seed % 2 == 1, reach));
}

/// Degrees from 1 to 4 in one direction and 1 to 3 in the other.
NurbsSurface random_patch(unsigned seed, double height, double weight_ratio) {
    const int p = 1 + static_cast<int>(seed % 4), q = 1 + static_cast<int>(seed / 4 % 3);
    return support::random_surface(p, std::max(q, p == 1 ? 2 : 1), p + 2 + static_cast<int>(seed % 2), q + 3, seed,
                                   height, weight_ratio);
}

/// Two thousand times the size of the surfaces, which is about 1.
constexpr double far = 2e3;

struct Construction {
    const char* name;
    unsigned count;  ///< patches, 1000 in all
    NurbsSurface (*surface)(unsigned seed);
};

double ratio(unsigned seed) {
    return seed % 3 == 0 ? 2.0 : seed % 3 == 1 ? 10.0 : 100.0;
}

const Construction constructions[] = {
    {"integral", 220, [](unsigned seed) { return random_patch(seed, 0.3, 1.0); }},
    {"integral_far", 140, [](unsigned seed) { return shifted(random_patch(seed, 0.3, 1.0), seed, far); }},
    {"tilted_planes", 100, [](unsigned seed) { return shifted(random_patch(seed, 0.0, 1.0), seed, 10.0); }},
    {"tilted_planes_far", 100, [](unsigned seed) { return shifted(random_patch(seed, 0.0, 1.0), seed, far); }},
    {"rational", 160, [](unsigned seed) { return random_patch(seed % 8 + 8 * (seed / 8), 0.3, ratio(seed)); }},
    {"rational_far", 100, [](unsigned seed) { return shifted(random_patch(seed, 0.3, ratio(seed)), seed, far); }},
    {"rational_planes", 60, [](unsigned seed) { return shifted(random_patch(seed, 0.0, ratio(seed)), seed, far); }},
    {"uneven_knots", 100,
     [](unsigned seed) {
         // Random knots of every multiplicity, of low degrees.
         unsigned number = 17 * seed;
         while (true) {
             support::RandomFace face = support::random_face(++number);
             const int degrees = face.surface.u_degree() + face.surface.v_degree();
             if (degrees <= (face.surface.rational() ? 5 : 8)) return face.surface;
         }
     }},
    {"rational_bicubic", 20, [](unsigned seed) { return support::random_surface(3, 3, 4, 5, seed, 0.3, 100.0); }},
};

class CoefficientBounds : public testing::TestWithParam<Construction> {};

TEST_P(CoefficientBounds, HoldAgainstMultiprecision) {
    Shares shares;
    for (unsigned seed = 0; seed < GetParam().count; ++seed) {
        SCOPED_TRACE(seed);
        measure(GetParam().surface(seed), seed, shares);
    }
    std::printf(
        "%s, %u patches: largest share of the bound used by extraction %.3f, coefficients %.4f, perturbed input %.3f, "
        "edges %.4f, halving %.4f, parts %.4f, single %.4f\n",
        GetParam().name, GetParam().count, shares.extraction, shares.rounding, shares.input, shares.edge,
        shares.halving, shares.restriction, shares.single);
    EXPECT_LE(shares.extraction, 1.0);
    EXPECT_LE(shares.rounding, 1.0);
    EXPECT_LE(shares.input, 1.0);
    EXPECT_LE(shares.edge, 1.0);
    EXPECT_LE(shares.halving, 1.0);
    EXPECT_LE(shares.restriction, 1.0);
    EXPECT_LE(shares.single, 1.0);
    // The measure itself works: nothing is computed without an error.
    EXPECT_GT(shares.rounding, 0.0);
    EXPECT_GT(shares.input, shares.rounding * 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Umbilics, CoefficientBounds, testing::ValuesIn(constructions),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace umbilic
