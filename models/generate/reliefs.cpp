// SPDX-License-Identifier: LGPL-2.1-or-later
#include "reliefs.h"

#include <array>
#include <cmath>

#include <Geom_BezierSurface.hxx>
#include <TColgp_Array2OfPnt.hxx>

#include "surfaces.h"

namespace umbilic::models {
namespace {

double hill(double x, double y, double x0, double y0, double width_x, double width_y) {
    return std::exp(-std::pow((x - x0) / width_x, 2) - std::pow((y - y0) / width_y, 2));
}

// Height of the face in mm over the square [-1, 1] x [-1, 1], y upwards. The left eyebrow is
// raised and the mouth drawn to one side, so that the mask differs from its mirror image.
double face_height(double x, double y) {
    const double dome = 30 - 17 * x * x - 10 * y * y - 4 * x * x * y * y;
    const double nose = 11 * hill(x, y, 0.01, -0.16, 0.15, 0.17) + 7 * hill(x, y, 0, 0.12, 0.12, 0.26);
    const double brows = 5.0 * hill(x, y, -0.40, 0.42, 0.30, 0.12) + 5.5 * hill(x, y, 0.40, 0.36, 0.30, 0.11);
    const double eyes = -7 * hill(x, y, -0.37, 0.17, 0.21, 0.12) - 7 * hill(x, y, 0.38, 0.15, 0.21, 0.12);
    const double cheeks = 4 * hill(x, y, -0.48, -0.22, 0.24, 0.22) + 4.5 * hill(x, y, 0.47, -0.20, 0.24, 0.22);
    const double mouth = 5.5 * hill(x, y, 0.03, -0.46, 0.28, 0.08) - 4.5 * hill(x, y, 0.05, -0.56, 0.26, 0.05) +
                         5.0 * hill(x, y, 0.03, -0.66, 0.24, 0.08);
    const double chin = 5 * hill(x, y, -0.02, -0.88, 0.26, 0.13);
    return dome + nose + brows + eyes + cheeks + mouth + chin;
}

}  // namespace

TopoDS_Shape hood() {
    constexpr int size = 8;
    using Row = std::array<double, size>;
    constexpr Row across = {-1, -0.93, -0.58, -0.2, 0.2, 0.58, 0.93, 1};
    constexpr Row along = {0, 45, 190, 420, 660, 880, 1070, 1200};  // mm from the nose
    constexpr Row height = {-150, -72, 8, 52, 82, 104, 118, 124};   // mm, along
    constexpr Row crown = {-70, -28, 24, 6, 6, 24, -28, -70};       // mm, across: two power lines
    constexpr Row fade = {0.7, 0.85, 1.05, 1.05, 0.95, 0.85, 0.75, 0.7};
    constexpr Row width = {0.84, 0.87, 0.92, 0.96, 0.985, 1, 1, 1};
    constexpr Row sweep = {60, 52, 20, 0, 0, 20, 52, 60};  // mm; the nose runs back aside
    return whole_face(clamped_surface(make_net(size, size, [&](int i, int j) {
        return gp_Pnt{650 * across[i] * width[j], along[j] + 1.3 * sweep[i] * std::pow(1 - j / 7.0, 2),
                      height[j] + crown[i] * fade[j]};
    })));
}

TopoDS_Shape mask() {
    constexpr int size = 26;
    return whole_face(clamped_surface(make_net(size, size, [](int i, int j) {
        const double x = 2 * greville(i, size) - 1, y = 2 * greville(j, size) - 1;
        // The square is rounded to an oval outline, narrower at the chin.
        const double chin = y < 0 ? 1 + 0.16 * y : 1;
        return gp_Pnt{79 * x * std::sqrt(1 - 0.38 * y * y) * chin, 102 * y * std::sqrt(1 - 0.38 * x * x),
                      face_height(x, y)};
    })));
}

TopoDS_Shape monge_umbilics() {
    TColgp_Array2OfPnt poles{1, 4, 1, 4};
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) {
            double z = 0;
            if (j == 1 || j == 2) z = (j == 1 ? 1 : 0.6) * (i == 1 ? 1 : i == 2 ? -1 : 0);
            poles(i + 1, j + 1) = gp_Pnt{i / 3.0, j / 3.0, z};
        }
    return whole_face(new Geom_BezierSurface{poles});
}

}  // namespace umbilic::models
