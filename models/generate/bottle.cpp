// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bottle.h"

#include <array>

namespace umbilic::models {
namespace {

constexpr int kSize = 8;  // poles of a panel in each direction
using Row = std::array<double, kSize>;

// Poles 2...5 of rows 1...6, pushed outwards by so many mm. These numbers decide where the umbilics
// lie. They were found by a random search for few and well-conditioned ones.
using Push = std::array<std::array<double, 4>, 6>;

// A panel: row j of poles is a flattened half ring (ring_x, ring_y), blended into the half circle of the neck.
struct Panel {
    Row ring_y;
    Row depth;  // mm, by row
    Push push;
};

struct Design {
    Row ring_x;
    Row height, half_width, shift;  // mm, by row
    double neck;                    // mm, height of the neck
    Panel front, back;
};

constexpr Row kNeckX = {-1, -1, -0.80, -0.32, 0.32, 0.80, 1, 1};
constexpr Row kNeckY = {0, 0.45, 0.86, 1.08, 1.08, 0.86, 0.45, 0};
constexpr Row kNeckBlend = {0, 0, 0, 0, 0.05, 0.2, 0.8, 1};

constexpr Design kBottle = {.ring_x = {-1, -1, -0.76, -0.27, 0.25, 0.77, 1, 1},
                            .height = {0, 8.4, 43, 77.4, 107.3, 139.5, 163.4, 182},
                            .half_width = {38.8, 37.8, 40.3, 36.7, 42.1, 41.6, 20.4, 13},
                            .shift = {-0.3, -2.8, 2.5, 1.2, 1.4, 1.6, 1.1, -2.1},
                            .neck = 22,
                            .front = {.ring_y = {0, 0.52, 0.90, 1.10, 1.12, 0.88, 0.52, 0},
                                      .depth = {14.6, 22.2, 25.2, 19.1, 26.2, 22.4, 12.9, 12},
                                      .push = {{{1.9, 2.7, 0.8, 0.5},
                                                {-0.7, 2.3, 0.6, -1.1},
                                                {-0.9, -0.7, -0.9, -1.1},
                                                {-0.1, -1.6, 1.6, 1.8},
                                                {2.6, 0.1, 2.9, 0.8},
                                                {1.2, 1.5, 2.4, 1.2}}}},
                            .back = {.ring_y = {0, 0.52, 0.90, 1.08, 1.05, 0.90, 0.52, 0},
                                     .depth = {14.6, 21.6, 25.7, 19.1, 26.4, 22.4, 11.9, 12},
                                     .push = {{{0.1, -0.1, -0.4, 0.0},
                                               {0.7, 0.6, -0.4, 0.5},
                                               {-0.6, 0.1, 0.3, 0.8},
                                               {-0.6, 0.1, 0.5, 0.0},
                                               {0.3, 0.0, 0.4, -1.1},
                                               {1.0, 0.2, -0.5, -0.1}}}}};

constexpr Design kOtherBottle = {.ring_x = {-1, -1, -0.74, -0.25, 0.26, 0.74, 1, 1},
                                 .height = {0, 9.8, 50.4, 95.2, 127.8, 159.2, 184.8, 206},
                                 .half_width = {28, 28.3, 27.7, 39, 27.4, 26.9, 17.9, 11},
                                 .shift = {2.1, 2.1, -1.0, -1.3, 1.5, 3.8, 0.7, 3},
                                 .neck = 16,
                                 .front = {.ring_y = {0, 0.5, 0.92, 1.12, 1.10, 0.94, 0.5, 0},
                                           .depth = {20.5, 22.2, 20.3, 29, 19.4, 20.6, 10.4, 10.2},
                                           .push = {{{1.2, -2.3, -1.9, 0.1},
                                                     {0.3, 2.2, 0.7, 2.0},
                                                     {0.4, 1.1, -3.1, -3.5},
                                                     {2.2, -2.5, -0.3, -0.9},
                                                     {2.9, 0.2, 3.3, -3.5},
                                                     {-1.7, -0.9, -0.8, 0.4}}}},
                                 .back = {.ring_y = {0, 0.5, 0.92, 1.12, 1.10, 0.94, 0.5, 0},
                                          .depth = {19.5, 20.9, 20.9, 26.6, 19.4, 18.9, 10.4, 10.2},
                                          .push = {{{1.1, -2.7, -3.3, -3.2},
                                                    {0.2, -1.1, 2.4, -3.0},
                                                    {2.7, -1.2, 0.4, -0.6},
                                                    {-3.1, 1.0, 2.8, 2.1},
                                                    {-2.0, 0.8, 0.1, -0.5},
                                                    {-0.1, -2.0, -0.7, 2.0}}}}};

// Row j of the front (side = -1, towards -y) or of the back (side = +1).
BSpline panel_surface(const Design& design, const Panel& panel, int side) {
    Net net = make_net(kSize, kSize, [&](int i, int j) {
        const double blend = kNeckBlend[j];
        const double x = (1 - blend) * design.ring_x[i] + blend * kNeckX[i];
        double y = panel.depth[j] * ((1 - blend) * panel.ring_y[i] + blend * kNeckY[i]);
        if (i >= 2 && i <= 5 && j >= 1 && j <= 6) y += panel.push[j - 1][i - 2];
        return gp_Pnt{design.shift[j] + design.half_width[j] * x, side * y, design.height[j]};
    });
    // The normal r_u x r_v points out of the bottle on both sides.
    if (side > 0) net = Net{net.rbegin(), net.rend()};
    return clamped_surface(net);
}

BSpline neck_surface(const BSpline& panel, double height) {
    return clamped_surface(make_net(kSize, 2, [&](int i, int j) {
        return panel->Pole(i + 1, kSize).Translated(gp_Vec{0, 0, j * height});
    }));
}

Bottle build(const Design& design) {
    Bottle bottle;
    bottle.front = panel_surface(design, design.front, -1);
    bottle.back = panel_surface(design, design.back, +1);
    bottle.neck_front = neck_surface(bottle.front, design.neck);
    bottle.neck_back = neck_surface(bottle.back, design.neck);
    return bottle;
}

}  // namespace

Bottle bottle() {
    return build(kBottle);
}

Bottle other_bottle() {
    return build(kOtherBottle);
}

TopoDS_Shape shell_of(const Bottle& bottle) {
    std::vector<TopoDS_Face> faces;
    for (const BSpline& surface : bottle.faces()) faces.push_back(whole_face(surface));
    return shell_of(faces);
}

}  // namespace umbilic::models
