// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <TopoDS_Shape.hxx>

#include <umbilic/model/model.h>

namespace umbilic {

/// The whole surfaces of a model's faces as one shape: a face if there is one, a compound otherwise. Trimming loops are
/// not kept. Throws NumericFailure if the kernel refuses a surface.
TopoDS_Shape shape_of(const Model& model);

}  // namespace umbilic
