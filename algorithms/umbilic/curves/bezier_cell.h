// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <vector>

#include <umbilic/core/types.h>
#include <umbilic/nurbs/knot_vector.h>

namespace umbilic {

/// A polynomial or rational Bezier patch on [0, 1]^2, or a Bezier curve (v_degree 0), about the origin of a
/// ClosestPointTree.
struct LocalPatch {
    int u_degree = 0;
    int v_degree = 0;
    bool rational = false;
    /// Homogeneous control points (w x, w y, w z, w), (i, j) at [i * (v_degree + 1) + j].
    std::vector<Vector4> poles;
};

/// Part of a patch, in its own parameters. low = high makes it an edge or a corner.
struct LocalBox {
    std::array<double, 2> low = {0.0, 0.0};
    std::array<double, 2> high = {1.0, 1.0};
};

struct LocalDerivatives {
    Vector3 r, r_u, r_v, r_uu, r_uv, r_vv;
};

/// Point and derivatives up to order 2 at (u, v) in [0, 1]^2.
LocalDerivatives evaluate(const LocalPatch& patch, double u, double v);

/// Control points of the part of the patch over `box`, re-parametrised to [0, 1]^2 (blossoming).
void restrict_net(const LocalPatch& patch, const LocalBox& box, std::vector<Vector4>& net);

/// The squared distance F = |S - p|^2 / 2 of a cell from any point p, up to proved errors. With x, y in [-1/2, 1/2] the
/// cell's own parameters, c = S(0, 0) and v = c - p:
///   F_x = v.r_u + (r_u.r_u + v.r_uu) x + (r_u.r_v + v.r_uv) y  +- (|v| slope_far[0] + slope_near[0]),
/// F_y likewise, and everywhere in the cell
///   F_xx = r_u.r_u + v.r_uu +- (|v| bend_far[0] + bend_near[0]),  [1]: F_xy,  [2]: F_yy.
/// Derivatives are with respect to x and y. The errors follow from balls that hold the second derivatives over the
/// cell.
struct CellModel {
    Vector3 c, r_u, r_v, r_uu, r_uv, r_vv;
    std::array<double, 2> slope_far, slope_near;
    std::array<double, 3> bend_far, bend_near;
    /// Bounds of |S_x| and |S_y| in the cell; rounding of F_x is at most this times that of a coordinate.
    std::array<double, 2> speed;
    /// Radius of a ball about c that holds the cell.
    double radius = 0.0;
};

/// `net`: what restrict_net() gave for `box`.
CellModel cell_model(const LocalPatch& patch, const LocalBox& box, const std::vector<Vector4>& net);

/// Model of a curve over [-1/2, 1/2] whose second derivative differs from `second` by at most `second_error`.
CellModel curve_model(const Vector3& c, const Vector3& tangent, const Vector3& second, double second_error);

/// Smallest Bernstein coefficient of |w (S - p)|^2 - d^2 w^2, divided by the largest w^2: a lower bound of
/// (|S - p|^2 - d^2) over the cell, if negative; if positive, every point of the cell is farther than d.
double squared_distance_bound(int u_degree, int v_degree, const std::vector<Vector4>& net, const Vector3& p, double d);

}  // namespace umbilic
