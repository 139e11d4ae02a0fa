// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/nurbs/area.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <Eigen/Geometry>
#include <boost/math/quadrature/gauss.hpp>

namespace umbilic {

namespace {

using Rule = boost::math::quadrature::gauss<double, 7>;

double integral(const NurbsSurface& surface, const ParameterInterval& u, const ParameterInterval& v) {
    const auto element = [&](double s, double t) {
        const SurfaceDerivatives d = surface.derivatives(s, t, 1);
        return d.r_u().cross(d.r_v()).norm();
    };
    const auto along_v = [&](double s) {
        return Rule::integrate([&](double t) { return element(s, t); }, v.low, v.high);
    };
    return Rule::integrate(along_v, u.low, u.high);
}

/// The integral by halves, until they change it by no more than `accuracy` (mm^2).
double refined(const NurbsSurface& surface, const ParameterInterval& u, const ParameterInterval& v, double coarse,
               double accuracy, int halvings) {
    const ParameterInterval us[2] = {{u.low, u.middle()}, {u.middle(), u.high}};
    const ParameterInterval vs[2] = {{v.low, v.middle()}, {v.middle(), v.high}};
    double parts[2][2];
    double sum = 0.0;
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) sum += parts[i][j] = integral(surface, us[i], vs[j]);
    if (halvings == 0 || std::abs(sum - coarse) <= accuracy) return sum;
    sum = 0.0;
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) sum += refined(surface, us[i], vs[j], parts[i][j], accuracy / 2, halvings - 1);
    return sum;
}

}  // namespace

double surface_area(const NurbsSurface& surface, double relative_accuracy) {
    const std::vector<double>& us = surface.u_knots().breaks();
    const std::vector<double>& vs = surface.v_knots().breaks();
    std::vector<double> coarse;
    for (std::size_t i = 0; i + 1 < us.size(); ++i)
        for (std::size_t j = 0; j + 1 < vs.size(); ++j)
            coarse.push_back(integral(surface, {us[i], us[i + 1]}, {vs[j], vs[j + 1]}));
    const double mean = std::accumulate(coarse.begin(), coarse.end(), 0.0) / coarse.size();

    double area = 0.0;
    for (std::size_t i = 0; i + 1 < us.size(); ++i)
        for (std::size_t j = 0; j + 1 < vs.size(); ++j) {
            const double piece = coarse[i * (vs.size() - 1) + j];
            area += refined(surface, {us[i], us[i + 1]}, {vs[j], vs[j + 1]}, piece,
                            relative_accuracy * std::max(piece, mean), area_halvings);
        }
    return area;
}

}  // namespace umbilic
