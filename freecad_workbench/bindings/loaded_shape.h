// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <memory>
#include <string>
#include <variant>

#include <umbilic/matching/prepared_shape.h>
#include <umbilic/similarity/compare.h>

#include "loaded_model.h"

namespace umbilic::python {

/// What Python hands over as one of two shapes.
using ShapePointer = std::variant<std::shared_ptr<const LoadedModel>, std::shared_ptr<const PointCloud>>;

/// One of two shapes with its features.
class LoadedShape {
public:
    LoadedShape(ShapePointer source, const CompareOptions& options, const Progress& progress);

    PreparedShape prepared() const { return model_ ? PreparedShape(*model_) : PreparedShape(*points_); }
    /// Triangles to show a model; none of points.
    const std::vector<DisplayMesh>& meshes() const;
    /// Where the bytes of a model can be read again; empty for points.
    std::string path() const;

private:
    ShapePointer source_;
    std::unique_ptr<PointCloud> thinned_;  ///< of points: what the prepared ones refer to
    std::unique_ptr<const PreparedModel> model_;
    std::unique_ptr<const PreparedPoints> points_;
};

}  // namespace umbilic::python
