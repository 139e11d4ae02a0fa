// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <umbilic/model/display_mesh.h>
#include <umbilic/similarity/compare.h>

#include <report/html.h>

namespace umbilic {

/// Two models with umbilics and a comparison of them whose every number was chosen by hand: what a report shows does
/// not depend on whether it is right.
struct MadeComparison {
    Model original_model, suspect_model;
    std::unique_ptr<PreparedModel> original, suspect;
    std::vector<DisplayMesh> original_meshes, suspect_meshes;
    CompareOptions options;
    Comparison comparison;
    Timing timing = {{"read", 0.25}, {"features", 0.5}};

    ReportInput input() const {
        return {*original, *suspect,   original_meshes, suspect_meshes,
                options,   comparison, timing,          "umbilic compare a b"};
    }
};

/// The wave-like patch of thesis Table 3.1 and its image under a similarity. `name` becomes part of every string that
/// would come from a file.
std::unique_ptr<MadeComparison> made_comparison(const std::string& name = "part");

/// The same without a pose.
std::unique_ptr<MadeComparison> made_comparison_without_pose();

}  // namespace umbilic
