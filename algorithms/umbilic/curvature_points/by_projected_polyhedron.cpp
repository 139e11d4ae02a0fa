// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/curvature_points/by_projected_polyhedron.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include <umbilic/core/errors.h>
#include <umbilic/nurbs/bezier_patch.h>
#include <umbilic/umbilics/equations.h>
#include <umbilic/umbilics/patch_systems.h>

namespace umbilic {

namespace {

/// The polynomial in u and v as one in `unknowns` of them.
MultivariatePolynomial multivariate(const TensorPolynomial& polynomial, int unknowns) {
    MultivariatePolynomial result{{polynomial.u_degree, polynomial.v_degree}, {}, 0.0};
    result.coefficients.resize(polynomial.scaled.size());
    result.error = polynomial.bernstein_coefficients(result.coefficients).input;
    result.degrees.resize(unknowns, 0);
    return result;
}

/// The equations of one sign of H on a patch.
class PatchSystem {
public:
    PatchSystem(const BezierPatch& patch, const InputRounding& input, const CurvatureQuery& query) {
        UmbilicEquations forms;
        forms.form_fundamental(patch, input);
        forms.form_curvature(equations_);
        const EquationScale scale = equation_scale(patch);
        const double unit = scale.position / scale.weight;
        gaussian_ = query.gaussian / (unit * unit);
        mean_ = query.mean / unit;
    }

    std::vector<MultivariatePolynomial> auxiliary(bool opposite) const {
        const Interval t = equations_.t.coefficient_hull();
        if (!(t.high > 0.0)) return {};
        // n runs over [low, high] as the third unknown runs over [0, 1].
        const Interval range = sqrt(t);
        const MultivariatePolynomial n{{0, 0, 1}, {range.low, range.high}, 0.0}, n2 = n * n;
        return {n2 - multivariate(equations_.t, 3), gaussian_numerator(3) - gaussian_ * (n2 * n2),
                mean_numerator(3) + (opposite ? -2.0 : 2.0) * mean_ * (n2 * n)};
    }
    std::vector<MultivariatePolynomial> squared() const {
        const MultivariatePolynomial t = multivariate(equations_.t, 2), t2 = t * t, s = mean_numerator(2);
        return {gaussian_numerator(2) - gaussian_ * t2, s * s - 4 * mean_ * mean_ * (t2 * t)};
    }

private:
    MultivariatePolynomial gaussian_numerator(int unknowns) const {
        const MultivariatePolynomial q = multivariate(equations_.q, unknowns);
        if (!equations_.rational) return q;
        const MultivariatePolynomial w = multivariate(equations_.w, unknowns), w2 = w * w;
        return q * (w2 * w2);
    }
    MultivariatePolynomial mean_numerator(int unknowns) const {
        const MultivariatePolynomial s = multivariate(equations_.s, unknowns);
        return equations_.rational ? s * multivariate(equations_.w, unknowns) : s;
    }

    CurvatureEquations equations_;
    double gaussian_ = 0.0, mean_ = 0.0;
};

struct PatchRoots {
    SystemRoots roots[2];  ///< of H and of -H
};

}  // namespace

ProjectedPolyhedronCurvaturePoints find_curvature_points_by_projected_polyhedron(
    const NurbsSurface& surface, const CurvatureQuery& query, const ProjectedPolyhedronCurvatureOptions& options,
    const Progress& progress) {
    const ProjectedPolyhedronOptions limits =
        patch_limits("curvatures by projected polyhedron", options.tolerance, options.boxes_per_patch);
    if (query.gaussian_tolerance != 0.0 || query.mean_tolerance != 0.0)
        throw InvalidInput("curvatures by projected polyhedron: the query must not have tolerances");
    const BezierPatches patches = bezier_patches(surface);
    const InputRounding input = input_rounding(surface);
    const bool squared = options.system == CurvatureSystem::squared;
    const auto solve = [&](std::size_t k, const Progress& within) {
        PatchRoots result;
        const PatchSystem system(patches.patches[k], input, query);
        for (const bool opposite : {false, true}) {
            if (opposite && (squared || query.mean == 0.0)) continue;
            const auto equations = squared ? system.squared() : system.auxiliary(opposite);
            if (!equations.empty()) result.roots[opposite] = solve_projected_polyhedron(equations, limits, within);
        }
        return result;
    };
    const auto found = on_patches<PatchRoots>(patches.patches.size(), "points of given curvature", progress, solve);

    ProjectedPolyhedronCurvaturePoints result;
    for (std::size_t k = 0; k < found.size(); ++k) {
        const ParameterInterval &u = patches.patches[k].domain.u, &v = patches.patches[k].domain.v;
        for (const bool opposite : {false, true}) {
            const SystemRoots& roots = found[k].roots[opposite];
            for (const SystemRoot& root : roots.roots) {
                const PlacedCoordinate at_u = placed(root, 0, u), at_v = placed(root, 1, v);
                CurvaturePosition point{opposite, at_u.at, at_v.at, {at_u.radius, at_v.radius}, root.exists};
                if (squared) point.opposite = curvature(surface, point.u, point.v).mean() * query.mean < 0.0;
                // Every patch at a border finds the points on it.
                const auto same = [&](const CurvaturePosition& other) {
                    const Vector2 reach = point.radius + other.radius;
                    return point.opposite == other.opposite && std::abs(point.u - other.u) <= reach.x() &&
                           std::abs(point.v - other.v) <= reach.y();
                };
                if (std::none_of(result.points.begin(), result.points.end(), same)) result.points.push_back(point);
            }
            for (const UndecidedBox& box : roots.undecided)
                result.undecided.push_back({placed(box.box[0], u), placed(box.box[1], v)});
            result.boxes += roots.statistics.boxes;
            result.exhausted = result.exhausted || roots.statistics.exhausted;
        }
    }
    std::sort(result.points.begin(), result.points.end(), [](const CurvaturePosition& a, const CurvaturePosition& b) {
        return std::tuple(a.opposite, a.u, a.v) < std::tuple(b.opposite, b.u, b.v);
    });
    return result;
}

}  // namespace umbilic
