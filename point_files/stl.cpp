// SPDX-License-Identifier: LGPL-2.1-or-later
#include <bit>
#include <cstring>

#include <point_files/binary_numbers.h>
#include <point_files/formats.h>
#include <point_files/stl_layout.h>
#include <point_files/text_lines.h>

namespace umbilic {

namespace {

void add_triangle(PointCloud& cloud) {
    const int n = static_cast<int>(cloud.points.size());
    cloud.triangles.push_back({n - 3, n - 2, n - 1});
}

}  // namespace

void read_stl_text(std::string_view bytes, PointCloud& cloud, const Progress& progress) {
    cloud.layout = "STL text";
    TextLines lines(bytes);
    int corners = 0;  // of the facet that is open
    bool open = false, ended = false;
    while (const auto line = lines.next()) {
        if (lines.number() % progress_interval == 0) progress.check();
        std::string_view rest = *line;
        const std::string_view word = take_word(rest);
        if (word == "vertex") {
            Vector3 point;
            for (int axis = 0; axis < 3; ++axis) {
                const auto number = number_in(take_word(rest));
                if (!number)
                    bad_line(cloud.source.path, lines.number(), "a vertex needs three numbers; export the mesh again");
                point[axis] = *number;
            }
            if (!open || ++corners > 3)
                bad_line(cloud.source.path, lines.number(),
                         "a vertex that belongs to no triangle; export the mesh again");
            cloud.points.push_back(point);
            if (corners == 3) add_triangle(cloud);
        } else if (word == "facet") {
            if (open)
                bad_line(cloud.source.path, lines.number(), "a facet begins inside another; export the mesh again");
            open = true;
            corners = 0;
        } else if (word == "endfacet") {
            if (!open || corners != 3)
                bad_line(cloud.source.path, lines.number(), "a facet without three vertices; export the mesh again");
            open = false;
        } else if (word == "endsolid") {
            ended = true;
        }
    }
    if (open || !ended) bad_line(cloud.source.path, lines.number(), "the file is cut off (no endsolid); copy it again");
}

void read_stl_binary(std::string_view bytes, PointCloud& cloud, const Progress& progress) {
    cloud.layout = "STL binary";
    need_bytes(cloud, bytes, 0, stl_header_bytes);
    const std::size_t count = binary_number<std::uint32_t>(bytes.data() + stl_count_at, std::endian::little);
    need_bytes(cloud, bytes, stl_header_bytes, count * stl_triangle_bytes);
    cloud.points.reserve(3 * count);
    cloud.triangles.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        if (i % progress_interval == 0) progress.check();
        const char* at = bytes.data() + stl_header_bytes + i * stl_triangle_bytes + 3 * sizeof(float);
        for (int corner = 0; corner < 3; ++corner) {
            Vector3 point;
            for (int axis = 0; axis < 3; ++axis, at += sizeof(float))
                point[axis] = binary_number<float>(at, std::endian::little);
            cloud.points.push_back(point);
        }
        add_triangle(cloud);
    }
}

}  // namespace umbilic
