// SPDX-License-Identifier: LGPL-2.1-or-later
#include "blade.h"

#include <array>
#include <cmath>

#include "surfaces.h"

namespace umbilic::models {
namespace {

constexpr int kChordPoles = 6, kSpanPoles = 7;
constexpr double kSpan = 200, kRootChord = 62, kTipChord = 34;  // mm
constexpr double kTwist = 0.75;                                 // rad from root to tip

using Section = std::array<double, kChordPoles>;
constexpr Section kStation = {0, 0.01, 0.22, 0.55, 0.82, 1};  // share of the chord
constexpr Section kSuction = {0, 0.075, 0.185, 0.175, 0.085, 0};
constexpr Section kPressure = {0, -0.02, 0.03, 0.07, 0.045, 0};

BSpline side(const Section& section) {
    return clamped_surface(make_net(kChordPoles, kSpanPoles, [&](int i, int j) {
        const double t = greville(j, kSpanPoles);
        const double chord = kRootChord + (kTipChord - kRootChord) * t * t;
        const double twist = kTwist * t, camber = 1.25 - 0.5 * t;
        const double x = chord * (kStation[i] - 0.42), y = chord * section[i] * camber;
        const double sweep = 14 * t * t, lean = 9 * t * t;
        return gp_Pnt{x * std::cos(twist) - y * std::sin(twist) + sweep,
                      x * std::sin(twist) + y * std::cos(twist) + lean, kSpan * t};
    }));
}

}  // namespace

TopoDS_Shape blade() {
    return shell_of({whole_face(side(kSuction)), whole_face(side(kPressure))});
}

}  // namespace umbilic::models
