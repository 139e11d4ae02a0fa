// SPDX-License-Identifier: LGPL-2.1-or-later
#include "loaded_shape.h"

namespace umbilic::python {

LoadedShape::LoadedShape(ShapePointer source, const CompareOptions& options, const Progress& progress)
    : source_(std::move(source)) {
    if (const auto* model = std::get_if<std::shared_ptr<const LoadedModel>>(&source_)) {
        model_.reset(new PreparedModel(prepare((*model)->file.model, options.features, progress)));
        return;
    }
    thinned_ = std::make_unique<PointCloud>(*std::get<std::shared_ptr<const PointCloud>>(source_));
    thin_out(*thinned_, options.points.most_points, options.points.seed);
    points_.reset(new PreparedPoints(prepare(*thinned_, options.points, progress)));
}

const std::vector<DisplayMesh>& LoadedShape::meshes() const {
    static const std::vector<DisplayMesh> none;
    const auto* model = std::get_if<std::shared_ptr<const LoadedModel>>(&source_);
    return model ? (*model)->file.meshes : none;
}

std::string LoadedShape::path() const {
    const auto* model = std::get_if<std::shared_ptr<const LoadedModel>>(&source_);
    return model ? (*model)->path : std::string();
}

}  // namespace umbilic::python
