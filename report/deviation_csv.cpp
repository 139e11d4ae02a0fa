// SPDX-License-Identifier: LGPL-2.1-or-later
#include <report/deviation_csv.h>

#include <cmath>
#include <iterator>
#include <unordered_map>

#include <fmt/format.h>

#include <report/json_geometry.h>

namespace umbilic {

namespace {

/// Faces of a model by number.
class FaceTable {
public:
    explicit FaceTable(const Model& model) {
        for (const Face& face : model.faces) faces_.emplace(face.number, &face);
    }
    const Face& at(int number) const { return *faces_.at(number); }

private:
    std::unordered_map<int, const Face*> faces_;
};

std::string field(double value) {
    return std::isfinite(value) ? fmt::format("{}", value) : "";
}
std::string field(const std::optional<double>& value) {
    return value ? field(*value) : "";
}

void write_rows(const char* model, const FaceTable& own, const FaceTable& other, const DirectedComparison& comparison,
                fmt::memory_buffer& out) {
    for (const NodeComparison& node : comparison.nodes) {
        const Vector2 at = native_parameters(own.at(node.at.face), node.at.u, node.at.v);
        std::string foot = ",,";
        if (node.foot.face > 0) {
            const Vector2 native = native_parameters(other.at(node.foot.face), node.foot.u, node.foot.v);
            foot = fmt::format("{},{},{}", node.foot.face, field(native.x()), field(native.y()));
        }
        fmt::format_to(std::back_inserter(out), "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\r\n", model, node.at.face,
                       field(at.x()), field(at.y()), field(node.point.x()), field(node.point.y()),
                       field(node.point.z()), foot, field(node.weight), field(node.distance),
                       field(node.signed_distance), field(node.kappa_max), field(node.kappa_min), field(node.direction),
                       node.covered ? 1 : 0);
    }
}

}  // namespace

std::string deviation_csv(const Model& original, const Model& suspect, const Assessment& assessment) {
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
