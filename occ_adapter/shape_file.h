// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS_Shape.hxx>

#include <umbilic/core/progress.h>
#include <umbilic/model/model.h>

#include "file_format.h"

namespace umbilic {

/// The contents of a CAD file as the kernel reads them, in mm.
struct ShapeFile {
    TopoDS_Shape shape;
    std::string format;  ///< as in Source
    std::string unit = "mm";
    double unit_in_mm = 1.0;
    /// By number in TopExp's map of faces and of solids of `shape`.
    std::map<int, std::string> face_names, solid_names;
    std::map<int, std::array<double, 3>> face_colors;  ///< red, green, blue in [0, 1], sRGB
    /// What the kernel complained about first, for the message if nothing arrives.
    std::string first_complaint;
    /// What arrived otherwise than the file describes it.
    std::vector<std::string> warnings;
};

/// Reads a file of the described format. The shape is the one compound (or single shape) FreeCAD's Part.read() gives,
/// so that faces have the same numbers there. Throws InvalidInput (without the path) if the kernel cannot read it.
ShapeFile read_shape_file(const std::string& path, const FileDescription& description, const Progress& progress);

}  // namespace umbilic
