// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <iosfwd>
#include <vector>

#include <umbilic/model/display_mesh.h>
#include <umbilic/model/model.h>

namespace umbilic {

/// Writes a model in Umbilic's own binary form: magic number, version, length, contents in little-endian, checksum.
void write_model(const Model& model, std::ostream& out);

/// Reads what write_model() wrote, checking magic number, version, length and checksum before anything is used, and
/// every surface and loop as their constructors do. Throws InvalidInput on anything else.
Model read_model(std::istream& in);

/// The same envelope around display meshes.
void write_display_meshes(const std::vector<DisplayMesh>& meshes, std::ostream& out);

/// Reads what write_display_meshes() wrote, with the same checks; indices of triangles lie within their mesh. Throws
/// InvalidInput on anything else.
std::vector<DisplayMesh> read_display_meshes(std::istream& in);

}  // namespace umbilic
