// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/umbilic_marks.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace umbilic {

namespace {

/// A cubic smaller than this part of kappa^2 (or of 1 / size^2 where flat) has no direction.
constexpr double vanishing_cubic = 1e-9;

}  // namespace

double UmbilicMark::cubic_norm() const {
    return std::sqrt(std::norm(alpha) + 3.0 * std::norm(beta));
}

double UmbilicMark::bend() const {
    return std::atan2(kappa * std::abs(kappa), cubic_norm());
}

double UmbilicMark::steadiness() const {
    return 4.0 * std::abs(std::abs(alpha) - std::abs(beta));
}

std::vector<UmbilicMark> umbilic_marks(const Model& model, const Features& features) {
    std::vector<UmbilicMark> marks;
    std::size_t face = 0;
    for (const FaceUmbilics& entry : features.umbilics) {
        while (face < model.faces.size() && model.faces[face].number != entry.face) ++face;
        const bool reversed = face < model.faces.size() && model.faces[face].reversed;
        for (const Umbilic& umbilic : entry.umbilics) {
            if (umbilic.containment != Containment::inside) continue;
            UmbilicMark mark{.point = umbilic.point,
                             .normal = umbilic.normal,
                             .x = umbilic.x_axis,
                             .y = umbilic.normal.cross(umbilic.x_axis),
                             .kappa = umbilic.kappa,
                             .alpha = umbilic.kind.alpha,
                             .beta = umbilic.kind.beta,
                             .delta = umbilic.kind.delta,
                             .zeta = umbilic.kind.zeta,
                             .omega = umbilic.kind.omega,
                             .type = umbilic.kind.type,
                             .flat = umbilic.flat,
                             .directions = umbilic.directions,
                             .delta_error = umbilic.kind.uncertainty.delta,
                             .zeta_error = umbilic.kind.uncertainty.zeta};
            const double unit = std::max(umbilic.kappa * umbilic.kappa, 1.0 / std::max(model.area, 1e-300));
            if (!(mark.cubic_norm() > vanishing_cubic * unit)) continue;
            // The norm of alpha and beta is a quarter of the form's; the arctangent's slope is at most a half of the
            // relative error.
            const double relative = 0.25 * umbilic.cubic_error / mark.cubic_norm();
            mark.bend_error = relative < 1.0 ? 0.5 * relative / (1.0 - relative) : std::numbers::pi;
            marks.push_back(reversed ? flipped(mark) : mark);
        }
    }
    return marks;
}

UmbilicMark flipped(const UmbilicMark& mark) {
    UmbilicMark result = mark;
    result.normal = -mark.normal;
    result.y = -mark.y;
    result.kappa = -mark.kappa;
    result.alpha = -std::conj(mark.alpha);
    result.beta = -std::conj(mark.beta);
    result.zeta = std::conj(mark.zeta);
    if (mark.omega) result.omega = std::conj(*mark.omega);
    return result;
}

UmbilicMark mirrored(const UmbilicMark& mark) {
    UmbilicMark result = mark;
    result.y = -mark.y;
    result.alpha = std::conj(mark.alpha);
    result.beta = std::conj(mark.beta);
    result.zeta = std::conj(mark.zeta);
    if (mark.omega) result.omega = std::conj(*mark.omega);
    return result;
}

std::vector<UmbilicReading> umbilic_readings(const std::vector<UmbilicMark>& suspect, bool oriented,
                                             MirrorChoice mirror) {
    std::vector<UmbilicReading> readings;
    for (const bool mirror_image : {false, true})
        for (const bool flip : {false, true}) {
            if ((mirror_image && mirror == MirrorChoice::never) || (flip && oriented)) continue;
            UmbilicReading& reading = readings.emplace_back(UmbilicReading{flip, mirror_image, {}});
            for (const UmbilicMark& mark : suspect) {
                const UmbilicMark turned = flip ? flipped(mark) : mark;
                reading.marks.push_back(mirror_image ? mirrored(turned) : turned);
            }
        }
    return readings;
}

}  // namespace umbilic
