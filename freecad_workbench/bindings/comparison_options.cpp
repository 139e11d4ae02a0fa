// SPDX-License-Identifier: LGPL-2.1-or-later
#include "comparison_options.h"

#include <pybind11/stl.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <Eigen/LU>

#include <umbilic/core/errors.h>
#include <umbilic/matching/choice_words.h>

namespace umbilic::python {

namespace py = pybind11;

namespace {

template <class T>
T value_of(const std::string& name, py::handle value, const char* expected) {
    try {
        return value.cast<T>();
    } catch (const py::cast_error&) {
        throw InvalidInput(name + " = " + std::string(py::repr(value)) + ": expected " + expected);
    }
}

template <class Choice>
Choice choice_of(const std::string& name, py::handle value, const std::map<std::string, Choice>& choices) {
    std::string words;
    for (const auto& choice : choices) words += (words.empty() ? "" : ", ") + choice.first;
    const auto found = choices.find(value_of<std::string>(name, value, ("one of " + words).c_str()));
    if (found == choices.end()) {
        throw InvalidInput(name + " = " + std::string(py::repr(value)) + ": expected one of " + words);
    }
    return found->second;
}

using Triple = std::array<double, 3>;

Vector3 vector(const Triple& triple) {
    return {triple[0], triple[1], triple[2]};
}

double positive(const std::string& name, py::handle value) {
    const double number = value_of<double>(name, value, "a number above 0");
    if (!(number > 0.0) || !std::isfinite(number)) {
        throw InvalidInput(name + " = " + std::string(py::repr(value)) + ": expected a number above 0");
    }
    return number;
}

ScaleChoice scale_of(const std::string& name, py::handle value) {
    ScaleChoice scale;
    if (py::isinstance<py::str>(value)) {
        scale.kind = choice_of<ScaleChoice::Kind>(
            name, value, {{"auto", ScaleChoice::Kind::automatic}, {"fixed", ScaleChoice::Kind::fixed}});
        return scale;
    }
    std::tie(scale.low, scale.high) =
        value_of<std::pair<double, double>>(name, value, "'auto', 'fixed' or (low, high)");
    if (!(scale.low > 0.0) || !(scale.high >= scale.low) || !std::isfinite(scale.high)) {
        throw InvalidInput(name + " = " + std::string(py::repr(value)) + ": expected 0 < low <= high");
    }
    scale.kind = ScaleChoice::Kind::range;
    return scale;
}

SimilarityTransform transform_of(const std::string& name, py::handle value) {
    const auto fields = value_of<py::dict>(name, value, "a dict with scale, rotation, translation and mirrored");
    SimilarityTransform transform;
    for (const auto& [key, field] : fields) {
        const auto word = value_of<std::string>(name, key, "the names of a transform");
        if (word == "scale") {
            transform.scale = positive(name + "['scale']", field);
        } else if (word == "rotation") {
            const auto matrix = value_of<std::array<Triple, 3>>(name + "['rotation']", field, "a 3 x 3 matrix");
            for (int row = 0; row < 3; ++row) transform.rotation.row(row) = vector(matrix[row]);
        } else if (word == "translation") {
            transform.translation = vector(value_of<Triple>(name + "['translation']", field, "three numbers"));
        } else if (word == "mirrored") {
            transform.mirrored = value_of<bool>(name + "['mirrored']", field, "True or False");
        }
    }
    // Ten thousand roundings: what survives being written with a dozen digits.
    constexpr double orthogonality = 1e-10;
    const Matrix3& r = transform.rotation;
    if (!((r * r.transpose() - Matrix3::Identity()).cwiseAbs().maxCoeff() < orthogonality) || r.determinant() < 0.0) {
        throw InvalidInput(name + "['rotation'] is not a proper rotation (orthonormal rows, determinant +1)");
    }
    return transform;
}

}  // namespace

CompareOptions comparison_options(const py::dict& keywords) {
    CompareOptions options;
    for (const auto& [key, value] : keywords) {
        const auto name = value_of<std::string>("option", key, "a name");
        if (value.is_none()) continue;
        if (name == "method") {
            options.match.method = choice_of(name, value, method_words);
        } else if (name == "scale") {
            options.match.scale = scale_of(name, value);
        } else if (name == "scale_search") {
            options.match.scale_search = choice_of(name, value, scale_search_words);
        } else if (name == "kh_solver") {
            options.match.curvature_solver = choice_of(name, value, curvature_solver_words);
        } else if (name == "mirror") {
            options.match.mirror = choice_of(name, value, mirror_words);
        } else if (name == "scope") {
            options.match.scope = choice_of(name, value, scope_words);
        } else if (name == "initial") {
            options.match.initial = transform_of(name, value);
        } else if (name == "pairs") {
            using Pairs = std::vector<std::pair<Triple, Triple>>;
            for (const auto& [a, b] : value_of<Pairs>(name, value, "pairs of points (original, suspect), in mm")) {
                options.match.pairs.emplace_back(vector(a), vector(b));
            }
        } else if (name == "match_seconds") {
            options.match.seconds = positive(name, value);
        } else if (name == "algorithm") {
            options.algorithm = value_of<int>(name, value, "1 or 2");
            if (options.algorithm != 1 && options.algorithm != 2) throw InvalidInput("algorithm: expected 1 or 2");
        } else if (name == "nodes") {
            options.nodes =
                choice_of<NodeChoice>(name, value, {{"wireframe", NodeChoice::wireframe}, {"area", NodeChoice::area}});
        } else if (name == "distance") {
            options.tolerances.distance = positive(name, value);
        } else if (name == "kappa") {
            options.tolerances.kappa = positive(name, value);
        } else if (name == "direction") {
            options.tolerances.direction = positive(name, value);
        } else if (name == "umbilic_distance") {
            options.tolerances.umbilic_distance = positive(name, value);
        } else if (name == "cell") {
            options.tolerances.cell = positive(name, value);
        } else if (name == "seed") {
            options.features.samples.seed = options.points.seed =
                value_of<std::uint64_t>(name, value, "a whole number from 0");
        } else if (name == "most_points" || name == "point_samples") {
            const int number = value_of<int>(name, value, "a whole number from 40");
            if (number < fewest_points) throw InvalidInput(name + ": expected a whole number from 40");
            if (name == "most_points")
                options.points.most_points = static_cast<std::size_t>(number);
            else
                options.points.samples = number;
        } else {
            throw InvalidInput("unknown option " + name);
        }
    }
    return options;
}

}  // namespace umbilic::python
