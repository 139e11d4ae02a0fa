// SPDX-License-Identifier: LGPL-2.1-or-later
#include <point_files/write_ply.h>

#include <iterator>
#include <utility>

#include <fmt/format.h>

namespace umbilic {

std::string ply_text(const PointCloud& cloud, const SimilarityTransform& transform) {
    fmt::memory_buffer out;
    const auto append = [&](fmt::string_view text, const auto&... values) {
        fmt::format_to(std::back_inserter(out), fmt::runtime(text), values...);
    };
    const bool normals = !cloud.normals.empty();
    append("ply\nformat ascii 1.0\nelement vertex {}\n", cloud.points.size());
    append("property double x\nproperty double y\nproperty double z\n");
    if (normals) append("property double nx\nproperty double ny\nproperty double nz\n");
    if (cloud.is_mesh()) append("element face {}\nproperty list uchar int vertex_indices\n", cloud.triangles.size());
    append("end_header\n");
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
        const Vector3 p = transform.apply(cloud.points[i]);
        append("{} {} {}", p.x(), p.y(), p.z());
        if (normals) {
            const Vector3 n = transform.apply_direction(cloud.normals[i]);
            append(" {} {} {}", n.x(), n.y(), n.z());
        }
        append("\n");
    }
    for (auto [a, b, c] : cloud.triangles) {
        // A mirror image turns triangles inside out.
        if (transform.mirrored) std::swap(b, c);
        append("3 {} {} {}\n", a, b, c);
    }
    return fmt::to_string(out);
}

}  // namespace umbilic
