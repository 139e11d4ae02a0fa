// SPDX-License-Identifier: LGPL-2.1-or-later
#include <point_files/point_format.h>

#include <array>
#include <bit>
#include <cstring>

#include <point_files/stl_layout.h>
#include <point_files/text_lines.h>

namespace umbilic {

namespace {

/// Lines without a number that may stand above a table.
constexpr int most_heading_lines = 20;
constexpr std::size_t iges_section = 72;

bool is_cad_text(std::string_view text) {
    const std::size_t start = text.find_first_not_of(" \t\r\n\xef\xbb\xbf");
    if (start == std::string_view::npos) return false;
    const std::string_view body = text.substr(start);
    const std::string_view line = text.substr(0, text.find_first_of("\r\n"));
    return body.starts_with("ISO-10303") || body.starts_with("DBRep_Draw") || body.starts_with("CASCADE Topology") ||
           body.starts_with("Open CASCADE Topology") || (line.size() > iges_section && line[iges_section] == 'S');
}

std::uint32_t little_endian(std::string_view bytes) {
    std::uint32_t value = 0;
    for (int i = 3; i >= 0; --i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
    return value;
}

bool is_obj(std::string_view text) {
    TextLines lines(text);
    while (const auto line = lines.next()) {
        std::string_view rest = *line;
        if (take_word(rest) != "v") continue;
        for (int i = 0; i < 3; ++i)
            if (!number_in(take_word(rest))) return false;
        return true;
    }
    return false;
}

bool is_table(std::string_view text) {
    if (text.find('\0') != std::string_view::npos) return false;
    TextLines lines(text);
    for (int heading = 0; heading <= most_heading_lines;) {
        const auto line = lines.next();
        if (!line) return false;
        std::string_view rest = *line;
        int numbers = 0;
        for (std::string_view word = take_word(rest, " \t,;"); !word.empty() && number_in(word);
             word = take_word(rest, " \t,;"))
            ++numbers;
        if (numbers >= 3) return true;
        ++heading;
    }
    return false;
}

}  // namespace

std::optional<PointFormat> point_format(std::string_view beginning, std::uint64_t bytes) {
    if (beginning.starts_with("ply\n") || beginning.starts_with("ply\r")) return PointFormat::ply;
    // Binary STL may begin with anything, the word solid or what looks like IGES included, so its size is asked first.
    // No text has it: there the number of triangles would be four characters, and the file above a gigabyte.
    const bool has_header = beginning.size() >= stl_header_bytes;
    if (has_header) {
        const std::uint64_t triangles = little_endian(beginning.substr(stl_count_at, 4));
        if (bytes == stl_header_bytes + triangles * stl_triangle_bytes) return PointFormat::stl_binary;
    }
    if (is_cad_text(beginning)) return {};
    std::string_view start = beginning.substr(std::min(beginning.find_first_not_of(" \t\r\n"), beginning.size()));
    const bool solid = start.starts_with("solid");
    if (solid && beginning.find("facet") != std::string_view::npos) return PointFormat::stl_text;
    if (solid && beginning.find("endsolid") != std::string_view::npos) return PointFormat::stl_text;
    if (is_obj(beginning)) return PointFormat::obj;
    if (is_table(beginning)) return PointFormat::table;
    return {};
}

}  // namespace umbilic
