// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/model/display_mesh.h>
#include <umbilic/model/model.h>
#include <umbilic/umbilics/find.h>
#include <umbilic/umbilics/shell_certificate.h>

namespace umbilic {

/// Everything the report on the umbilics of one model tells. References must outlive the call they are given to.
struct UmbilicsReportInput {
    const Model& model;
    const std::vector<DisplayMesh>& meshes;
    const std::vector<FaceUmbilics>& umbilics;  ///< of all faces or of some
    const UmbilicOptions& options;
    std::string command_line;                   ///< that computes the same again
    std::vector<ShellCertificate> shells = {};  ///< none where not all faces were searched
};

/// The report as one HTML page that needs no other file and no network: what was found and how far it is proved, the
/// model in space, the omega plane, and for each face with umbilics its parameter domain and a table. Strings that come
/// from files are escaped. Throws Cancelled.
std::string umbilics_html(const UmbilicsReportInput& input, const Progress& progress = {});

}  // namespace umbilic
