// SPDX-License-Identifier: LGPL-2.1-or-later
#include "readme.h"

#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>
#include <stdexcept>
#include <string>

namespace umbilic::models {
namespace {

using Json = nlohmann::ordered_json;

// Longer lists of umbilics stay in ground_truth.json.
constexpr std::size_t kMostUmbilicsListed = 12;

std::string number(const Json& value, const char* format = "%.6g") {
    if (value.is_null()) return "–";
    char text[64];
    std::snprintf(text, sizeof text, format, value.get<double>());
    return text;
}

void append(std::string& text, const char* separator, const std::string& item) {
    if (!text.empty()) text += separator;
    text += item;
}

std::string list(const Json& values, const char* format, const char* separator = ", ") {
    std::string text;
    for (const Json& value : values) append(text, separator, number(value, format));
    return text;
}

std::string faces_of(const Json& model) {
    std::map<std::string, int> kinds;
    for (const Json& face : model["face_list"]) {
        std::string kind = face["surface"];
        if (face.contains("degree")) {
            append(kind, " ", list(face["degree"], "%.0f", "×"));
            append(kind, ", ", list(face["poles"], "%.0f", "×"));
            kind += face["rational"] ? " poles, rational" : " poles";
        }
        ++kinds[kind];
    }
    std::string text;
    for (const auto& [kind, count] : kinds) append(text, "; ", std::to_string(count) + " " + kind);
    return text;
}

std::string umbilics_of(const Json& model) {
    std::map<std::string, int> types;
    bool regions = false, splines = false;
    for (const Json& face : model["face_list"]) {
        if (!face.contains("umbilics")) continue;
        splines = true;
        regions = regions || face["all_umbilic"];
        for (const Json& umbilic : face["umbilics"])
            if (umbilic["inside"]) ++types[umbilic["type"]];
    }
    std::string text = regions ? "whole faces" : "";
    for (const auto& [type, count] : types) append(text, ", ", std::to_string(count) + " " + type);
    return text.empty() ? (splines ? "none" : "–") : text;
}

std::string model_table(const Json& truth) {
    std::string text =
        "| file | what it is | size, mm | faces | area, mm² | volume, mm³ | isolated umbilics |\n"
        "| --- | --- | --- | --- | --- | --- | --- |\n";
    for (const Json& model : truth["models"]) {
        const Json &low = model["box"][0], &high = model["box"][1];
        Json size = Json::array();
        for (int i = 0; i < 3; ++i) size.push_back(high[i].get<double>() - low[i].get<double>());
        text += "| `" + model["file"].get<std::string>() + "` | " + model["description"].get<std::string>() + " | " +
                list(size, "%.1f", " × ") + " | " + faces_of(model) + " | " + number(model["area"], "%.8g") + " | " +
                number(model["volume"], "%.8g") + " | " + umbilics_of(model) + " |\n";
    }
    return text;
}

std::string umbilic_table(const Json& truth) {
    std::string text =
        "| file | face | u | v | κ, 1/mm | type | ω | δ | inside |\n"
        "| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n";
    for (const Json& model : truth["models"])
        for (const Json& face : model["face_list"]) {
            if (!face.contains("umbilics") || face["umbilics"].size() > kMostUmbilicsListed) continue;
            for (const Json& umbilic : face["umbilics"]) {
                const std::string star =
                    umbilic["star"].is_null() ? "" : " (" + umbilic["star"].get<std::string>() + ")";
                text += "| `" + model["file"].get<std::string>() + "` | " + number(face["face"], "%.0f") + " | " +
                        number(umbilic["u"], "%.9f") + " | " + number(umbilic["v"], "%.9f") + " | " +
                        number(umbilic["kappa"], "%.9g") + " | " + umbilic["type"].get<std::string>() + star + " | " +
                        (umbilic["omega"].is_null() ? "–" : list(umbilic["omega"], "%+.4f")) + " | " +
                        number(umbilic["delta"], "%+.4f") + " | " + (umbilic["inside"] ? "yes" : "no") + " |\n";
            }
        }
    return text;
}

std::string pair_table(const Json& truth) {
    std::string text =
        "| original | suspect | answer | level | s | mirrored | R, by rows | t, mm | remarks |\n"
        "| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n";
    for (const Json& pair : truth["pairs"]) {
        text += "| `" + pair["original"].get<std::string>() + "` | `" + pair["suspect"].get<std::string>() + "` | " +
                pair["answer"].get<std::string>() + " | " + pair["level"].get<std::string>() + " | ";
        if (const Json& transform = pair["transform"]; transform.is_null()) {
            text += "– | – | – | – | ";
        } else {
            std::string rows;
            for (const Json& row : transform["rotation"]) append(rows, "; ", list(row, "%.15g"));
            text += number(transform["scale"], "%.15g") + " | " + (transform["mirrored"] ? "yes" : "no") + " | " +
                    rows + " | " + list(transform["translation"], "%.15g") + " | ";
        }
        std::string remarks = pair["note"];
        for (const auto& [name, value] : pair["facts"].items())
            append(remarks, "; ", name + " = " + number(value, "%.4g"));
        text += remarks + " |\n";
    }
    return text;
}

std::string malformed_table(const Json& truth) {
    std::string text = "| file | what is wrong | a reader owes |\n| --- | --- | --- |\n";
    for (const Json& file : truth["malformed"])
        text += "| `" + file["file"].get<std::string>() + "` | " + file["what"].get<std::string>() + " | " +
                file["expected"].get<std::string>() + " |\n";
    return text;
}

}  // namespace

void update_readme(const std::filesystem::path& readme, const Json& truth) {
    if (!std::filesystem::exists(readme)) return;
    std::ifstream input{readme, std::ios::binary};
    std::string text{std::istreambuf_iterator<char>{input}, {}};
    const std::map<std::string, std::string> tables = {{"models", model_table(truth)},
                                                       {"umbilics", umbilic_table(truth)},
                                                       {"pairs", pair_table(truth)},
                                                       {"malformed", malformed_table(truth)}};
    for (const auto& [name, table] : tables) {
        const std::string mark = "<!-- table " + name + " -->\n";
        const std::size_t begin = text.find(mark);
        const std::size_t end = begin == std::string::npos ? begin : text.find("<!-- end -->", begin);
        if (end == std::string::npos) throw std::runtime_error(readme.string() + ": no place for the table " + name);
        text.replace(begin + mark.size(), end - begin - mark.size(), "\n" + table + "\n");
    }
    std::ofstream output{readme, std::ios::binary};
    output << text;
    if (!output.flush()) throw std::runtime_error(readme.string() + ": cannot write");
}

}  // namespace umbilic::models
