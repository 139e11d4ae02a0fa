// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>

#include <nlohmann/json.hpp>

#include "catalogue.h"

namespace umbilic::models {

/// Facts about one written file, measured on what OpenCASCADE reads back from it: faces in the order of
/// TopExp's map, area, volume, bounding box, and the umbilics of every spline face (see umbilic_scan.h)
/// with the parameters of the face's own surface as read.
nlohmann::ordered_json measure(const Model& model, const std::filesystem::path& file);

/// The stated relation of two measured models. With a transform, also how well the files keep it: the area of
/// the moved suspect over the original's, and for each umbilic inside the suspect's faces the distance (mm)
/// from its image to the nearest umbilic of the original.
nlohmann::ordered_json describe(const Pair& pair, const nlohmann::ordered_json& original,
                                const nlohmann::ordered_json& suspect);

}  // namespace umbilic::models
