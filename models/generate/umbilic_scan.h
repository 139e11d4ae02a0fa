// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <complex>
#include <string>
#include <vector>

#include <gp_Dir.hxx>
#include <gp_Pnt.hxx>

#include "surfaces.h"

namespace umbilic::models {

/// An isolated umbilic, described as in the thesis: kappa = -II/I, normal r_u x r_v, x axis along r_u.
struct Umbilic {
    double u, v;
    gp_Pnt point;
    gp_Dir normal;
    double kappa;                      // 1/mm
    std::array<double, 4> cubic;       // Monge form: a x^3 + 3 b x^2 y + 3 c x y^2 + d y^3, over 6
    std::complex<double> alpha, beta;  // of the cubic's complex form; alpha is 0 on quadrics
    std::string type;                  // star, monstar, lemon
    std::string star;                  // elliptic, hyperbolic, or empty
    double index;                      // -1/2 or +1/2
    /// Distance of omega from the nearest curve of the omega diagram that divides the types
    /// (Gamma_1, |omega| = 1, Gamma_2); infinite where alpha = 0.
    double type_margin;
    /// Distance to the nearest inner knot line, as a share of the span it lies in; 1 without any.
    double knot_margin;
};

struct ScanOptions {
    int cells_per_span = 32;  // sampling density in u and in v; patterns finer than a cell are missed
};

/// Umbilics of a surface found by sampling: the turn of the principal directions around every cell
/// and the local minima of their difference give the starts, Newton's method on E M - F L and
/// E N - G L the points. Derivatives come from OpenCASCADE. A check by other means than the
/// library's own solver, and no proof of completeness.
std::vector<Umbilic> scan_umbilics(const Surface& surface, double u0, double u1, double v0, double v1,
                                   const ScanOptions& options = {});

/// Parameters from `low` to `high` along u or v: cells_per_span equal steps in every knot span.
std::vector<double> sample_parameters(const Surface& surface, bool along_u, double low, double high,
                                      int cells_per_span);

/// True if the principal curvatures agree at every sampled point, relative to 1 / `size` (mm):
/// a plane or a sphere, whatever its representation.
bool all_umbilic(const Surface& surface, double u0, double u1, double v0, double v1, double size);

}  // namespace umbilic::models
