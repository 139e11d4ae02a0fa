// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cli/curve_words.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <vector>

#include <umbilic/core/errors.h>

#include <cli/exit_status.h>
#include <report/json_geometry.h>
#include <report/readable.h>

namespace umbilic {

namespace {

std::vector<double> numbers(const std::string& option, const std::string& text, std::size_t count,
                            const char* example) {
    std::vector<double> result;
    const char* at = text.data();
    const char* const end = at + text.size();
    while (result.size() < count) {
        double value = 0.0;
        if (at != end && *at == '+') ++at;
        const auto [next, error] = std::from_chars(at, end, value);
        if (error != std::errc() || !std::isfinite(value)) break;
        result.push_back(value);
        at = next;
        if (result.size() < count) {
            if (at == end || *at != ',') break;
            ++at;
        }
    }
    if (result.size() != count || at != end)
        throw WrongUse(option + ": \"" + text + "\" is not " + std::to_string(count) +
                       " numbers with commas between them; write it as " + example);
    return result;
}

}  // namespace

Vector2 two_numbers(const std::string& option, const std::string& text) {
    const std::vector<double> n = numbers(option, text, 2, "0.2,0.3");
    return {n[0], n[1]};
}

Vector3 three_numbers(const std::string& option, const std::string& text) {
    const std::vector<double> n = numbers(option, text, 3, "1,0,0.5");
    return {n[0], n[1], n[2]};
}

const Face& chosen_face(const Model& model, int number, const std::string& option) {
    if (number == 0 && model.faces.size() == 1) return model.faces.front();
    const auto face =
        std::find_if(model.faces.begin(), model.faces.end(), [&](const Face& f) { return f.number == number; });
    if (face != model.faces.end()) return *face;
    if (number == 0)
        throw WrongUse(model.source.path + ": has " + std::to_string(model.faces.size()) + " faces; choose one with " +
                       option);
    throw WrongUse(model.source.path + ": has no face " + std::to_string(number) + "; umbilic info lists its faces");
}

Vector2 chosen_point(const Model& model, const Face& face, const std::string& option, const std::string& text) {
    const Vector2 native = two_numbers(option, text);
    const Vector2 at = surface_parameters(face, native.x(), native.y());
    const ParameterBox domain = face.surface.domain();
    const bool on_surface = domain.contains(at.x(), at.y());
    if (on_surface && face.region.classify(at.x(), at.y()) != Containment::outside) return at;
    const ParameterBox box = face.region.box();
    const Vector2 low = native_parameters(face, box.u.low, box.v.low);
    const Vector2 high = native_parameters(face, box.u.high, box.v.high);
    throw WrongUse(model.source.path + ": " + option + " " + text + " is outside of face " +
                   std::to_string(face.number) + ", whose u runs from " + readable(low.x(), 8) + " to " +
                   readable(high.x(), 8) + " and v from " + readable(low.y(), 8) + " to " + readable(high.y(), 8) +
                   (on_surface ? "; there it is cut away by a trimming loop" : ""));
}

std::vector<std::vector<Vector3>> curves_of_result(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    const Json json = Json::parse(in, nullptr, false);
    const std::string wrong = path + ": is no result of umbilic curve";
    if (!json.is_object() || !json.contains("schema") || json["schema"] != "umbilic.curve/1" ||
        !json.contains("curves") || !json["curves"].is_array())
        throw InvalidInput(wrong + "; write one with --json");
    std::vector<std::vector<Vector3>> result;
    try {
        for (const Json& curve : json.at("curves")) {
            result.emplace_back();
            for (const Json& one : curve.at("points")) {
                const Json& p = one.at("point");
                const Vector3 point(p.at(0).get<double>(), p.at(1).get<double>(), p.at(2).get<double>());
                // A point on an edge stands there for both faces.
                if (result.back().empty() || (point - result.back().back()).norm() > 0.0)
                    result.back().push_back(point);
            }
        }
    } catch (const Json::exception& error) {
        throw InvalidInput(wrong + " (" + error.what() + "); write one with --json");
    }
    if (result.empty()) throw InvalidInput(path + ": holds no curve");
    return result;
}

bool holds_json(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    char first = '\0';
    return in >> first && first == '{';
}

}  // namespace umbilic
