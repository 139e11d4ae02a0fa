// SPDX-License-Identifier: LGPL-2.1-or-later
#include <report/deviation_csv.h>

#include <cmath>
#include <iterator>
#include <unordered_map>

#include <fmt/format.h>

#include <report/json_geometry.h>

namespace umbilic {

namespace {

std::string field(double value) {
    return std::isfinite(value) ? fmt::format("{}", value) : "";
}
std::string field(const std::optional<double>& value) {
    return value ? field(*value) : "";
}

/// Faces of a model by number; none of measured points.
class FaceTable {
public:
    explicit FaceTable(const PreparedShape& shape) {
        if (!shape.model()) return;
        for (const Face& face : shape.model()->model.faces) faces_.emplace(face.number, &face);
    }
    /// "face,u,v", or nothing between the commas.
    std::string fields(const SurfacePoint& at) const {
        if (at.face <= 0) return ",,";
        const Vector2 native = native_parameters(*faces_.at(at.face), at.u, at.v);
        return fmt::format("{},{},{}", at.face, field(native.x()), field(native.y()));
    }

private:
    std::unordered_map<int, const Face*> faces_;
};

void write_rows(const char* model, const FaceTable& own, const FaceTable& other, const DirectedComparison& comparison,
                fmt::memory_buffer& out) {
    for (const NodeComparison& node : comparison.nodes) {
        fmt::format_to(std::back_inserter(out), "{},{},{},{},{},{},{},{},{},{},{},{},{}\r\n", model,
                       own.fields(node.at), field(node.point.x()), field(node.point.y()), field(node.point.z()),
                       other.fields(node.foot), field(node.weight), field(node.distance), field(node.signed_distance),
                       field(node.kappa_max), field(node.kappa_min), field(node.direction), node.covered ? 1 : 0);
    }
}

}  // namespace

std::string deviation_csv(const PreparedShape& original, const PreparedShape& suspect, const Assessment& assessment) {
    fmt::memory_buffer out;
    fmt::format_to(std::back_inserter(out),
                   "node_of,face,u,v,x_mm,y_mm,z_mm,foot_face,foot_u,foot_v,area_mm2,distance_mm,signed_distance_mm,"
                   "kappa_max_difference_per_mm,kappa_min_difference_per_mm,direction_difference_rad,covered\r\n");
    const FaceTable original_faces(original);
    const FaceTable suspect_faces(suspect);
    write_rows("suspect", suspect_faces, original_faces, assessment.suspect_on_original, out);
    write_rows("original", original_faces, suspect_faces, assessment.original_on_suspect, out);
    return fmt::to_string(out);
}

}  // namespace umbilic
