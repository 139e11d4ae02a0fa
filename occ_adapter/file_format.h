// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace umbilic {

enum class FileFormat {
    step,
    iges,
    brep_text,    ///< BRepTools::Write or DRAW
    brep_binary,  ///< BinTools::Write, or the exportBinary of FreeCAD; what follows the shape set tells them apart
};

/// What a file says about itself, told without the CAD kernel.
struct FileDescription {
    FileFormat format = FileFormat::step;
    std::uint64_t bytes = 0;
    /// Number of faces the text declares; -1 if it cannot be told.
    int declared_faces = -1;
    std::vector<std::string> warnings;
};

/// Looks at a file's content. Throws InvalidInput, naming the file, if it is missing, not a readable regular file,
/// empty, of no known format or cut off.
FileDescription describe_file(const std::string& path);

/// SHA-256 of a file's bytes, lower-case hexadecimal. Throws InvalidInput if it cannot be read.
std::string sha256_of_file(const std::string& path);

}  // namespace umbilic
