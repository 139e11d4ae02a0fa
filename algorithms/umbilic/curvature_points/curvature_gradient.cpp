// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/curvature_points/curvature_gradient.h>

#include <umbilic/differential/fundamental_forms.h>
#include <umbilic/differential/monge_form.h>

namespace umbilic {

CurvatureGradient curvature_gradient(const SurfaceDerivatives& d) {
    const MongeForm monge = monge_form(d);
    const Cubic& c = monge.cubic;
    // Second form in the frame (x, y) of the Monge form: r_u = a x, r_v = b x + e y.
    const SecondForm second = second_form(d);
    const double a = d.r_u().dot(monge.x), b = d.r_v().dot(monge.x), e = d.r_v().dot(monge.y);
    const double xx = second.L / (a * a);
    const double xy = (second.M - a * b * xx) / (a * e);
    const double yy = (second.N - b * b * xx - 2 * b * e * xy) / (e * e);
    CurvatureGradient result;
    result.gaussian = xx * yy - xy * xy;
    result.mean = -0.5 * (xx + yy);
    result.gaussian_slope = {c.a * yy + c.c * xx - 2 * c.b * xy, c.b * yy + c.d * xx - 2 * c.c * xy};
    result.mean_slope = {-0.5 * (c.a + c.c), -0.5 * (c.b + c.d)};
    return result;
}

}  // namespace umbilic
