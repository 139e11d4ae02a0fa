// SPDX-License-Identifier: LGPL-2.1-or-later
#include "peer_surfaces.h"

#include <algorithm>
#include <vector>

#ifdef UMBILIC_WITH_OPENCASCADE
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#endif

namespace umbilic::bench {

#ifdef UMBILIC_WITH_OPENCASCADE
Handle(Geom_BSplineSurface) opencascade_surface(const NurbsSurface& surface) {
    TColgp_Array2OfPnt poles(1, surface.u_pole_count(), 1, surface.v_pole_count());
    for (int i = 0; i < surface.u_pole_count(); ++i)
        for (int j = 0; j < surface.v_pole_count(); ++j) {
            const Vector3& p = surface.pole(i, j);
            poles.SetValue(i + 1, j + 1, gp_Pnt(p.x(), p.y(), p.z()));
        }
    const auto fill = [](const KnotVector& from, TColStd_Array1OfReal& knots, TColStd_Array1OfInteger& multiplicities) {
        for (std::size_t k = 0; k < from.breaks().size(); ++k) {
            const double knot = from.breaks()[k];
            knots.SetValue(static_cast<int>(k) + 1, knot);
            multiplicities.SetValue(static_cast<int>(k) + 1,
                                    static_cast<int>(std::count(from.knots().begin(), from.knots().end(), knot)));
        }
    };
    const int nu = static_cast<int>(surface.u_knots().breaks().size());
    const int nv = static_cast<int>(surface.v_knots().breaks().size());
    TColStd_Array1OfReal u(1, nu), v(1, nv);
    TColStd_Array1OfInteger mu(1, nu), mv(1, nv);
    fill(surface.u_knots(), u, mu);
    fill(surface.v_knots(), v, mv);
    return new Geom_BSplineSurface(poles, u, v, mu, mv, surface.u_degree(), surface.v_degree());
}
#endif

#ifdef UMBILIC_WITH_SISL
SislSurface sisl_surface(const NurbsSurface& surface) {
    std::vector<double> coefficients;  // u runs fastest
    for (int j = 0; j < surface.v_pole_count(); ++j)
        for (int i = 0; i < surface.u_pole_count(); ++i)
            for (int k = 0; k < 3; ++k) coefficients.push_back(surface.pole(i, j)[k]);
    std::vector<double> u = surface.u_knots().knots(), v = surface.v_knots().knots();
    constexpr int polynomial_spline = 1, dimension = 3, copy = 1;
    return {newSurf(surface.u_pole_count(), surface.v_pole_count(), surface.u_degree() + 1, surface.v_degree() + 1,
                    u.data(), v.data(), coefficients.data(), polynomial_spline, dimension, copy),
            &freeSurf};
}
#endif

}  // namespace umbilic::bench
