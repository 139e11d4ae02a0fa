// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/model/model.h>

#include <algorithm>
#include <cmath>

#include <umbilic/core/errors.h>

namespace umbilic {

double Model::size() const {
    return std::sqrt(area);
}

const Face& Model::face(int number) const {
    const auto found = std::find_if(faces.begin(), faces.end(), [&](const Face& f) { return f.number == number; });
    if (found != faces.end()) return *found;
    const auto lost = std::find_if(skipped.begin(), skipped.end(), [&](const Skipped& s) { return s.face == number; });
    if (lost != skipped.end())
        throw InvalidInput(source.path + ": face " + std::to_string(number) + " was skipped: " + lost->why);
    throw InvalidInput(source.path + ": there is no face " + std::to_string(number) + "; the model has " +
                       std::to_string(faces.size()) + " faces, numbered from 1");
}

bool Model::oriented() const {
    return !faces.empty() && std::all_of(faces.begin(), faces.end(), [](const Face& f) { return f.solid >= 0; });
}

bool elementary(SurfaceKind kind) {
    switch (kind) {
        case SurfaceKind::plane:
        case SurfaceKind::sphere:
        case SurfaceKind::cylinder:
        case SurfaceKind::cone:
        case SurfaceKind::torus:
            return true;
        default:
            return false;
    }
}

const char* name(SurfaceKind kind) {
    switch (kind) {
        case SurfaceKind::plane:
            return "plane";
        case SurfaceKind::cylinder:
            return "cylinder";
        case SurfaceKind::cone:
            return "cone";
        case SurfaceKind::sphere:
            return "sphere";
        case SurfaceKind::torus:
            return "torus";
        case SurfaceKind::bezier:
            return "bezier";
        case SurfaceKind::bspline:
            return "bspline";
        case SurfaceKind::revolution:
            return "revolution";
        case SurfaceKind::extrusion:
            return "extrusion";
        case SurfaceKind::offset:
            return "offset";
        case SurfaceKind::other:
            return "other";
    }
    return "other";
}

}  // namespace umbilic
