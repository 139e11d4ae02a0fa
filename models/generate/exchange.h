// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>

#include <TopoDS_Shape.hxx>

namespace umbilic::models {

/// Writes STEP (AP214) or IGES (5.3) by the ending of `path` (.step, .igs). The header holds the
/// given part name, a fixed date and no path, so that the same shape gives the same bytes.
/// IGES: a shape with solids is written as manifold solid B-rep (entity 186), everything else as
/// trimmed surfaces (entity 144). Throws std::runtime_error if OpenCASCADE refuses.
void write_cad(const TopoDS_Shape& shape, const std::string& part_name, const std::filesystem::path& path);

/// The shape of a STEP or IGES file, all roots. Throws std::runtime_error if nothing arrives.
TopoDS_Shape read_cad(const std::filesystem::path& path);

}  // namespace umbilic::models
