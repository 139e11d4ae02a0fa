// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/umbilics/known_kinds.h>

#include <string>
#include <utility>

namespace umbilic {

namespace {

bool umbilic_everywhere(SurfaceKind kind) {
    return kind == SurfaceKind::plane || kind == SurfaceKind::sphere;
}

}  // namespace

std::optional<FaceUmbilics> known_umbilics(const Face& face, const UmbilicOptions& options) {
    FaceUmbilics result;
    result.searched = face.surface.domain();
    SurfaceKind kind = face.kind;
    ElementarySurface parameters;
    double deviation = face.conversion_error;
    bool exact = true;
    if (elementary(kind)) {
        if (face.elementary) parameters = *face.elementary;
    } else {
        if (options.recognition == 0.0) return std::nullopt;
        const std::optional<RecognisedSurface> recognised =
            recognise(face.surface, {.tolerance = options.recognition, .swept = false});
        if (!recognised || !(recognised->exact || umbilic_everywhere(recognised->kind))) return std::nullopt;
        kind = recognised->kind;
        parameters = recognised->surface;
        deviation += recognised->deviation;
        exact = recognised->exact;
        result.recognised = recognised;
    }
    if (umbilic_everywhere(kind)) {
        UmbilicRegion region;
        region.kind = kind == SurfaceKind::plane ? UmbilicRegionKind::planar : UmbilicRegionKind::spherical;
        region.boxes = {face.surface.domain()};
        region.area = face.area;
        region.surface = parameters;
        region.deviation = deviation;
        result.regions.push_back(std::move(region));
        if (exact) {
            result.certificate.complete = true;
            result.certificate.why = std::string("every point of a ") + name(kind) + " is an umbilic";
        } else {
            result.certificate.why = std::string("not evaluated: the surface was taken for the ") + name(kind) +
                                     " that it deviates little from";
        }
        return result;
    }
    // One principal curvature is everywhere the greater one (a torus of this kind has major > minor radius), and the
    // directions are those of the parameters: no umbilics, no turning.
    result.certificate.complete = true;
    result.certificate.why = std::string("a ") + name(kind) + " has no umbilics";
    return result;
}

}  // namespace umbilic
