// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include <TopoDS_Shape.hxx>
#include <nlohmann/json.hpp>

#include "similarity.h"

namespace umbilic::models {

/// One file of the collection.
struct Model {
    std::string file;         // name with ending; .step or .igs decides the format
    std::string part;         // name stored inside the file
    std::string description;  // one sentence
    TopoDS_Shape shape;
    nlohmann::ordered_json exact = nlohmann::ordered_json::object();  // facts that follow from the construction
};

/// An original and a suspect with what a comparison has to answer.
struct Pair {
    std::string original, suspect;
    bool related = true;          // false: no transform exists
    Similarity original_suspect;  // p_original = scale * rotation * M * p_suspect + translation
    std::string answer, level;    // in the words of the command's result
    std::string note;
    nlohmann::ordered_json facts = nlohmann::ordered_json::object();
};

struct Catalogue {
    std::vector<Model> models;
    std::vector<Pair> pairs;
};

/// Builds every model and states how they are related.
Catalogue build_catalogue();

}  // namespace umbilic::models
