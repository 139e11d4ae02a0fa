// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/core/similarity_transform.h>
#include <umbilic/model/display_mesh.h>
#include <umbilic/model/model.h>

namespace umbilic {

struct ReadOptions {
    double seconds = 600.0;                         ///< time limit of the child process
    std::uint64_t memory = std::uint64_t(8) << 30;  ///< memory limit of the child process, bytes
    bool display_meshes = false;                    ///< also triangulate every face
    double display_deflection = 2e-3;  ///< chordal deflection of the triangles, relative to the model's diagonal
};

struct ReadResult {
    Model model;
    std::vector<DisplayMesh> meshes;  ///< one a face, in the model's order, if asked for
};

/// Reads a STEP, IGES or BREP file (told by content) in a child process, so that nothing a file contains can end the
/// caller. Throws InvalidInput (missing, not readable, not a CAD file, truncated, no face, kernel crashed on it),
/// NumericFailure (time or memory limit) or Cancelled; each message is one line that names the file and says what to
/// do.
ReadResult read_file(const std::string& path, const ReadOptions& options = {}, const Progress& progress = {});

/// Reads `path` again, moves it by `transform` and writes it as a STEP file (in a child process); the file appears
/// whole or not at all.
void write_transformed_step(const std::string& path, const SimilarityTransform& transform, const std::string& step_path,
                            const ReadOptions& options = {});

/// Writes the whole surfaces of a model's faces (trimming loops are not kept) as a STEP file in mm, through a child
/// process; the file appears whole or not at all. Throws InvalidInput or NumericFailure, naming the file.
void write_surfaces_step(const Model& model, const std::string& step_path, const ReadOptions& options = {});

/// The same of one untrimmed surface.
void write_surface_step(const NurbsSurface& surface, const std::string& step_path, const ReadOptions& options = {});

/// Writes curves as edges of a STEP file (in a child process, see curves_to_shape.h), each through its points (mm); the
/// file appears whole or not at all.
void write_curves_step(const std::vector<std::vector<Vector3>>& curves, const std::string& step_path,
                       const ReadOptions& options = {});

/// Version of OpenCASCADE this build is linked with, e.g. "7.6.3".
std::string opencascade_version();

}  // namespace umbilic
