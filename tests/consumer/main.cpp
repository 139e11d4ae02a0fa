// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cmath>
#include <cstdio>

#include <umbilic/differential/curvature.h>

/// A paraboloid z = -(x^2 + y^2) / 2 has both principal curvatures 1 at its top, in the thesis's sign.
int main() {
    using umbilic::KnotVector;
    std::vector<umbilic::Vector3> poles;
    const double height[3] = {-0.5, 0.5, -0.5};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) poles.emplace_back(i - 1.0, j - 1.0, height[i] + height[j]);
    const umbilic::NurbsSurface surface(KnotVector::bezier(2), KnotVector::bezier(2), poles);
    const umbilic::Curvature top = umbilic::curvature(surface, 0.5, 0.5);
    std::printf("kappa %.12f %.12f\n", top.kappa_max, top.kappa_min);
    return std::abs(top.kappa_max - 1) < 1e-12 && std::abs(top.kappa_min - 1) < 1e-12 ? 0 : 1;
}
