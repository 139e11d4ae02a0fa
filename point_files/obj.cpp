// SPDX-License-Identifier: LGPL-2.1-or-later
#include <point_files/formats.h>
#include <point_files/text_lines.h>

namespace umbilic {

namespace {

Vector3 three_numbers(std::string_view rest, const PointCloud& cloud, std::size_t line, const char* what) {
    Vector3 result;
    for (int axis = 0; axis < 3; ++axis) {
        const auto number = number_in(take_word(rest));
        if (!number)
            bad_line(cloud.source.path, line, std::string(what) + " needs three numbers; export the mesh again");
        result[axis] = *number;
    }
    return result;
}

/// Index from 0 of the point that a corner such as "7", "7/1/3" or "-2" (from the end) names.
int corner_index(std::string_view corner, std::size_t points, const std::string& path, std::size_t line) {
    const std::string_view word = corner.substr(0, corner.find('/'));
    long long index = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), index);
    if (error != std::errc() || end != word.data() + word.size())
        bad_line(path, line, "a corner of a face is no number; export the mesh again");
    const long long count = static_cast<long long>(points);
    if (index < 0) index += count + 1;
    if (index < 1 || index > count)
        bad_line(path, line, "a face refers to a vertex that is not there; export the mesh again");
    return static_cast<int>(index - 1);
}

}  // namespace

void read_obj(std::string_view bytes, PointCloud& cloud, const Progress& progress) {
    cloud.layout = "OBJ";
    TextLines lines(bytes);
    std::vector<Vector3> normals;
    while (const auto line = lines.next()) {
        if (lines.number() % progress_interval == 0) progress.check();
        std::string_view rest = *line;
        const std::string_view word = take_word(rest);
        if (word == "v") {
            cloud.points.push_back(three_numbers(rest, cloud, lines.number(), "a vertex"));
        } else if (word == "vn") {
            normals.push_back(three_numbers(rest, cloud, lines.number(), "a normal"));
        } else if (word == "f") {
            std::vector<int> corners;
            for (std::string_view corner = take_word(rest); !corner.empty(); corner = take_word(rest))
                corners.push_back(corner_index(corner, cloud.points.size(), cloud.source.path, lines.number()));
            if (corners.size() < 3)
                bad_line(cloud.source.path, lines.number(), "a face needs three corners; export the mesh again");
            for (std::size_t i = 2; i < corners.size(); ++i)
                cloud.triangles.push_back({corners[0], corners[i - 1], corners[i]});
        }
    }
    // A file of points lists a normal for each; on a mesh corners choose theirs, and the triangles say more anyway.
    if (cloud.triangles.empty() && normals.size() == cloud.points.size()) cloud.normals = std::move(normals);
}

}  // namespace umbilic
