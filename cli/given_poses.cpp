// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cli/given_poses.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <nlohmann/json.hpp>

#include <umbilic/core/errors.h>
#include <umbilic/matching/horn.h>

namespace umbilic {

namespace {

/// Largest entry of R R^T - I of a rotation that was typed or printed with a few digits; it is made orthogonal after.
constexpr double rotation_tolerance = 1e-4;

std::string read_text(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (file.is_open() && file.peek() == std::ifstream::traits_type::eof() && !file.bad()) return {};
    std::ostringstream text;
    text << file.rdbuf();
    if (!file || !text) throw InvalidInput(path + ": cannot be read; check its name and that it may be read");
    return text.str();
}

/// The nearest rotation.
Matrix3 orthonormalized(const Matrix3& matrix) {
    Matrix3 result = matrix;
    result.row(0).normalize();
    result.row(1) = (result.row(1) - result.row(1).dot(result.row(0)) * result.row(0)).normalized();
    result.row(2) = Vector3(result.row(0)).cross(Vector3(result.row(1)));
    return result;
}

std::vector<std::string_view> words_of(std::string_view line) {
    constexpr const char* separators = " \t\r,;";
    std::vector<std::string_view> words;
    while (true) {
        const auto start = line.find_first_not_of(separators);
        if (start == std::string_view::npos) return words;
        line.remove_prefix(start);
        words.push_back(line.substr(0, line.find_first_of(separators)));
        line.remove_prefix(words.back().size());
    }
}

/// The number a word stands for, finite or not.
std::optional<double> number_of(std::string_view word) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    return error == std::errc() && end == word.data() + word.size() ? std::optional(value) : std::nullopt;
}

/// The six numbers of a line. `where` names it in errors.
std::array<double, 6> six_numbers(const std::vector<std::string_view>& words, const std::string& where) {
    constexpr const char* expected = "; write x, y, z on the original, then x, y, z on the suspect";
    if (words.size() != 6)
        throw InvalidInput(where + " holds " + std::to_string(words.size()) + " values instead of six" + expected);
    std::array<double, 6> numbers{};
    for (std::size_t k = 0; k < 6; ++k) {
        const auto value = number_of(words[k]);
        if (!value || !std::isfinite(*value))
            throw InvalidInput(where + ": '" + std::string(words[k]) + "' is no finite number" + expected);
        numbers[k] = *value;
    }
    return numbers;
}

}  // namespace

SimilarityTransform read_transform(const std::string& path) {
    const std::string contents = read_text(path);
    SimilarityTransform transform;
    try {
        nlohmann::json json = nlohmann::json::parse(contents);
        if (json.contains("alignment")) json = json.at("alignment");
        transform.scale = json.at("scale").get<double>();
        const auto rotation = json.at("rotation").get<std::array<std::array<double, 3>, 3>>();
        const auto translation = json.at("translation").get<std::array<double, 3>>();
        transform.mirrored = json.value("mirrored", false);
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) transform.rotation(i, j) = rotation[i][j];
            transform.translation(i) = translation[i];
        }
    } catch (const nlohmann::json::exception&) {
        throw InvalidInput(path +
                           ": holds no transform; it must be a JSON object with scale, rotation (three rows of three "
                           "numbers) and translation (three numbers)");
    }
    const Matrix3 excess = transform.rotation * transform.rotation.transpose() - Matrix3::Identity();
    const bool valid = std::isfinite(transform.scale) && transform.scale > 0.0 && transform.translation.allFinite() &&
                       excess.cwiseAbs().maxCoeff() <= rotation_tolerance && transform.rotation.determinant() > 0.0;
    if (!valid) {
        throw InvalidInput(path +
                           ": the transform is no similarity; scale must be positive and rotation orthogonal with "
                           "determinant +1 (use \"mirrored\": true for mirror images)");
    }
    transform.rotation = orthonormalized(transform.rotation);
    return transform;
}

std::vector<std::pair<Vector3, Vector3>> read_point_pairs(const std::string& path) {
    std::istringstream lines(read_text(path));
    std::vector<std::pair<Vector3, Vector3>> pairs;
    bool heading_allowed = true;
    int number = 0;
    const auto where = [&] { return path + ": line " + std::to_string(number); };
    for (std::string line; std::getline(lines, line);) {
        ++number;
        const auto words = words_of(line);
        if (words.empty() || words.front().front() == '#') continue;
        const bool heading =
            heading_allowed && std::none_of(words.begin(), words.end(), [](auto word) { return number_of(word); });
        heading_allowed = false;
        if (heading) continue;
        const auto n = six_numbers(words, where());
        pairs.emplace_back(Vector3(n[0], n[1], n[2]), Vector3(n[3], n[4], n[5]));
    }
    if (pairs.empty()) throw InvalidInput(path + ": holds no pair of points; write six numbers a line");
    std::vector<PointPair> points;
    for (const auto& [original, suspect] : pairs) points.push_back({original, suspect});
    try {
        check_pairs(points);
    } catch (const InvalidInput& error) {
        throw InvalidInput(where() + ", the last one: " + error.what());
    }
    return pairs;
}

}  // namespace umbilic
