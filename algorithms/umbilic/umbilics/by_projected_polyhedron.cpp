// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/umbilics/by_projected_polyhedron.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include <umbilic/umbilics/equations.h>
#include <umbilic/umbilics/patch_systems.h>

namespace umbilic {

namespace {

MultivariatePolynomial multivariate(const TensorPolynomial& polynomial) {
    MultivariatePolynomial result{{polynomial.u_degree, polynomial.v_degree}, {}, 0.0};
    result.coefficients.resize(polynomial.scaled.size());
    result.error = polynomial.bernstein_coefficients(result.coefficients).input;
    return result;
}

/// Empty if the patch holds no umbilic.
std::vector<MultivariatePolynomial> system_of(const BezierPatch& patch, const InputRounding& input,
                                              UmbilicSystem kind) {
    UmbilicEquations equations;
    equations.form_fundamental(patch, input);
    if (equations.excluded_by_hulls()) return {};
    if (kind == UmbilicSystem::thesis) {
        const MultivariatePolynomial discriminant = multivariate(equations.discriminant());
        return {discriminant, derivative(discriminant, 0), derivative(discriminant, 1)};
    }
    equations.form_umbilic();
    return {multivariate(equations.a()), multivariate(equations.b())};
}

void add(const BezierPatch& patch, const SystemRoots& roots, ProjectedPolyhedronUmbilics& result) {
    const ParameterInterval &u = patch.domain.u, &v = patch.domain.v;
    for (const SystemRoot& root : roots.roots) {
        const PlacedCoordinate at_u = placed(root, 0, u), at_v = placed(root, 1, v);
        UmbilicPosition found;
        found.u = at_u.at;
        found.v = at_v.at;
        found.radius = {at_u.radius, at_v.radius};
        found.certified = root.exists;
        found.index = 0.5 * root.jacobian_sign;
        // Every patch at a border finds the umbilics on it.
        const bool known =
            std::any_of(result.umbilics.begin(), result.umbilics.end(), [&](const UmbilicPosition& other) {
                const Vector2 reach = found.radius + other.radius;
                return std::abs(found.u - other.u) <= reach.x() && std::abs(found.v - other.v) <= reach.y();
            });
        if (!known) result.umbilics.push_back(found);
    }
    for (const UndecidedBox& box : roots.undecided)
        result.undecided.push_back({placed(box.box[0], u), placed(box.box[1], v)});
    result.boxes += roots.statistics.boxes;
    result.exhausted = result.exhausted || roots.statistics.exhausted;
}

}  // namespace

ProjectedPolyhedronUmbilics find_umbilics_by_projected_polyhedron(const NurbsSurface& surface,
                                                                  const ProjectedPolyhedronUmbilicOptions& options,
                                                                  const Progress& progress) {
    const ProjectedPolyhedronOptions limits =
        patch_limits("umbilics by projected polyhedron", options.tolerance, options.boxes_per_patch);
    const BezierPatches patches = bezier_patches(surface);
    const InputRounding input = input_rounding(surface);
    const auto solve = [&](std::size_t k, const Progress& within) {
        const std::vector<MultivariatePolynomial> system = system_of(patches.patches[k], input, options.system);
        return system.empty() ? SystemRoots() : solve_projected_polyhedron(system, limits, within);
    };
    const auto found = on_patches<SystemRoots>(patches.patches.size(), "umbilics", progress, solve);

    ProjectedPolyhedronUmbilics result;
    for (std::size_t k = 0; k < found.size(); ++k) add(patches.patches[k], found[k], result);
    std::sort(result.umbilics.begin(), result.umbilics.end(), [](const UmbilicPosition& a, const UmbilicPosition& b) {
        return std::tuple(a.u, a.v) < std::tuple(b.u, b.v);
    });
    return result;
}

}  // namespace umbilic
