// SPDX-License-Identifier: LGPL-2.1-or-later
#include <array>
#include <cmath>
#include <vector>

#include <point_files/formats.h>
#include <point_files/text_lines.h>

namespace umbilic {

namespace {

constexpr int most_columns = 64;
/// Columns four to six are normals if every row of them has this length within this error; colours and intensities
/// have not.
constexpr double unit_length_error = 0.02;
constexpr int absent = -1;

/// How the fields of a row are separated.
struct Separators {
    const char* fields = " \t,;";
    bool decimal_comma = false;
};

/// Semicolons between fields whose numbers contain a comma: the comma is the decimal one.
Separators separators_of(std::string_view text) {
    TextLines lines(text);
    while (const auto line = lines.next()) {
        std::string_view rest = *line;
        const std::string_view first = take_word(rest, " \t;");
        if (first.find_first_of("0123456789") == std::string_view::npos || first.starts_with('#')) continue;
        const bool comma = first.find(',') != std::string_view::npos;
        if (comma && line->find(';') != std::string_view::npos) return {" \t;", true};
        return {};
    }
    return {};
}

std::optional<double> field_number(std::string_view word, bool decimal_comma) {
    if (!decimal_comma) return number_in(word);
    std::string text(word);
    if (const std::size_t comma = text.find(','); comma != std::string::npos) text[comma] = '.';
    return number_in(text);
}

std::string lower_case(std::string_view word) {
    std::string text;
    for (const char c : word)
        if (c != '"') text += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return text;
}

bool is_comment(std::string_view line) {
    const std::size_t start = line.find_first_not_of(" \t");
    return start == std::string_view::npos || line[start] == '#' || line.substr(start).starts_with("//");
}

/// Which columns hold what.
struct Columns {
    std::array<int, 3> position = {0, 1, 2};
    std::array<int, 3> normal = {absent, absent, absent};
    bool named = false;

    bool has_normal() const { return normal[0] != absent && normal[1] != absent && normal[2] != absent; }
};

/// Reads names such as x, y, z, nx, ny, nz above the columns, whatever their order.
void take_names(std::string_view line, const char* fields, Columns& columns) {
    if (line.starts_with('#')) line.remove_prefix(1);
    Columns named{.position = {absent, absent, absent}, .named = true};
    int column = 0;
    for (std::string_view word = take_word(line, fields); !word.empty(); word = take_word(line, fields), ++column) {
        const std::string name = lower_case(word);
        for (int axis = 0; axis < 3; ++axis) {
            const char letter = static_cast<char>('x' + axis);
            if (name == std::string{letter}) named.position[axis] = column;
            if (name == std::string{'n', letter}) named.normal[axis] = column;
        }
    }
    if (named.position[0] != absent && named.position[1] != absent && named.position[2] != absent) columns = named;
}

}  // namespace

void read_table(std::string_view bytes, PointCloud& cloud, const Progress& progress) {
    cloud.layout = "table";
    const Separators separators = separators_of(bytes);
    Columns columns;
    TextLines lines(bytes);
    bool begun = false;
    bool units = true;  // every row has a unit vector in columns four to six
    std::vector<Vector3> normals;
    while (const auto line = lines.next()) {
        if (lines.number() % progress_interval == 0) progress.check();
        if (is_comment(*line)) {
            if (!begun) take_names(*line, separators.fields, columns);
            continue;
        }
        std::string_view rest = *line;
        std::array<double, most_columns> row;
        int count = 0;
        bool numbers = true;
        for (std::string_view word = take_word(rest, separators.fields); !word.empty() && count < most_columns;
             word = take_word(rest, separators.fields)) {
            const auto number = field_number(word, separators.decimal_comma);
            numbers = numbers && number;
            row[count++] = number.value_or(0.0);
        }
        const int needed = 1 + std::max({columns.position[0], columns.position[1], columns.position[2]});
        if (!numbers || count < needed) {
            if (begun)
                bad_line(
                    cloud.source.path, lines.number(),
                    "not " + std::to_string(needed) + " or more numbers; a table of points has x y z on each line");
            take_names(*line, separators.fields, columns);
            continue;
        }
        begun = true;
        cloud.points.emplace_back(row[columns.position[0]], row[columns.position[1]], row[columns.position[2]]);
        std::array<int, 3> at = columns.normal;
        if (!columns.named && count == 6) at = {3, 4, 5};
        const bool has = at[0] != absent && std::max({at[0], at[1], at[2]}) < count;
        const Vector3 normal = has ? Vector3(row[at[0]], row[at[1]], row[at[2]]) : Vector3::Zero();
        units = units && has && (columns.named || std::abs(normal.norm() - 1.0) < unit_length_error);
        if (units) normals.push_back(normal);
    }
    if (units && begun) cloud.normals = std::move(normals);
}

}  // namespace umbilic
