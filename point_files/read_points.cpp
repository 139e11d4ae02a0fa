// SPDX-License-Identifier: LGPL-2.1-or-later
#include <point_files/read_points.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <occ_adapter/file_format.h>
#include <point_files/formats.h>
#include <point_files/point_format.h>
#include <umbilic/core/errors.h>

namespace umbilic {

namespace {

std::ifstream opened(const std::string& path) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) throw InvalidInput(path + ": there is no such file");
    if (!std::filesystem::is_regular_file(status)) throw InvalidInput(path + ": is not a regular file");
    std::ifstream in(path, std::ios::binary);
    if (!in) throw InvalidInput(path + ": cannot be opened (" + std::strerror(errno) + "); check its permissions");
    return in;
}

std::string first_bytes(std::ifstream& in, std::size_t count) {
    std::string text(count, '\0');
    in.read(text.data(), static_cast<std::streamsize>(count));
    text.resize(static_cast<std::size_t>(in.gcount()));
    return text;
}

std::string amount(std::uint64_t count, const char* one, const char* many) {
    return std::to_string(count) + ' ' + (count == 1 ? one : many);
}

}  // namespace

void need_bytes(const PointCloud& cloud, std::string_view bytes, std::size_t at, std::size_t wanted) {
    if (at <= bytes.size() && wanted <= bytes.size() - at) return;
    throw InvalidInput(cloud.source.path + ": byte " + std::to_string(bytes.size()) +
                       ": the file is cut off; copy it again");
}

bool holds_points(const std::string& path) {
    std::ifstream in = opened(path);
    const std::string beginning = first_bytes(in, format_beginning);
    return point_format(beginning, std::filesystem::file_size(path)).has_value();
}

PointCloud read_points(const std::string& path, const Progress& progress) {
    progress.report(0.0, "reading points");
    std::ifstream in = opened(path);
    const std::uint64_t size = std::filesystem::file_size(path);
    const std::string bytes = first_bytes(in, size);
    if (bytes.size() != size) throw InvalidInput(path + ": reading it failed; copy it again from where it came");
    if (bytes.empty()) throw InvalidInput(path + ": is empty");
    const auto format = point_format(std::string_view(bytes).substr(0, format_beginning), size);
    if (!format)
        throw InvalidInput(path + ": holds no points; wanted is a table of x y z, PLY, STL or OBJ that is not cut off");

    PointCloud cloud;
    cloud.source = {
        .path = path, .sha256 = sha256_of_file(path), .bytes = size, .format = "points", .unit = "mm (assumed)"};
    switch (*format) {
        case PointFormat::table:
            read_table(bytes, cloud, progress);
            break;
        case PointFormat::ply:
            read_ply(bytes, cloud, progress);
            break;
        case PointFormat::stl_text:
            read_stl_text(bytes, cloud, progress);
            break;
        case PointFormat::stl_binary:
            read_stl_binary(bytes, cloud, progress);
            break;
        case PointFormat::obj:
            read_obj(bytes, cloud, progress);
            break;
    }
    clean(cloud);
    if (cloud.points.empty()) throw InvalidInput(path + ": holds no finite point; export the points again");
    if (cloud.not_finite > 0)
        cloud.warnings.push_back("skipped " + amount(cloud.not_finite, "point that is", "points that are") +
                                 " not finite");
    // In STL every triangle brings its corners along, so that repeated points are the rule.
    const bool stl = *format == PointFormat::stl_text || *format == PointFormat::stl_binary;
    if (cloud.merged > 0 && !stl)
        cloud.warnings.push_back("merged " +
                                 amount(cloud.merged, "point that repeats another", "points that repeat others"));
    if (cloud.degenerate_triangles > 0)
        cloud.warnings.push_back("left out " + amount(cloud.degenerate_triangles, "triangle", "triangles") +
                                 " without area or with a missing corner");
    progress.report(1.0, "points read");
    return cloud;
}

}  // namespace umbilic
