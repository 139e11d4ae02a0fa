// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cli/lines_and_regions_text.h>

#include <report/readable.h>

namespace umbilic {

namespace {

std::string line_text(const UmbilicLine& line) {
    std::string text = line.closed ? "closed line" : "line";
    text += " of umbilics, " + readable(line.length, "mm") + " long";
    if (!line.closed) {
        const auto end = [](LineEnd reason) -> std::string {
            switch (reason) {
                case LineEnd::border:
                    return "the border";
                case LineEnd::knot:
                    return "a knot line";
                default:
                    return "a singular point";
            }
        };
        text += ", from " + end(line.ends[0]) + " to " + end(line.ends[1]);
    }
    if (line.containment == Containment::outside) text += ", outside the face's loops";
    if (line.containment == Containment::boundary) text += ", inside the face's loops in part";
    return text;
}

std::string region_text(const Face& face, const UmbilicRegion& region, bool known) {
    std::string text = region.kind == UmbilicRegionKind::planar ? "planar"
                       : region.kind == UmbilicRegionKind::spherical
                           ? "spherical, radius " + readable(region.surface.radius, "mm")
                           : "umbilic";
    if (known)
        text += ", all of it";
    else
        text += " on " + readable(region.area, "mm²") +
                (face.area > 0.0 ? " (" + readable_percent(region.area / face.area) + ")" : std::string());
    if (region.kind != UmbilicRegionKind::other && region.deviation > 0.0)
        text += ", within " + readable(region.deviation, "mm", 2);
    return text;
}

}  // namespace

std::string lines_and_regions_text(const Model& model, const std::vector<FaceUmbilics>& all) {
    std::string text;
    for (const FaceUmbilics& found : all) {
        const Face& face = model.face(found.face);
        const std::string start = "Face " + std::to_string(face.number) + ": ";
        for (const UmbilicLine& line : found.lines) text += start + line_text(line) + "\n";
        // Faces that are planes or spheres by their own kind say so already.
        if (elementary(face.kind)) continue;
        for (const UmbilicRegion& region : found.regions)
            text += start + region_text(face, region, found.recognised.has_value()) + "\n";
    }
    return text.empty() ? "" : "\n" + text;
}

}  // namespace umbilic
