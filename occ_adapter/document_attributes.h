// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <TDocStd_Document.hxx>

#include "shape_file.h"

namespace umbilic {

/// Takes names of faces and solids and colours of faces from a document into `file`, whose shape holds the same faces
/// in the same places. An attribute that belongs to a part shows on each of its instances.
void read_attributes(const Handle(TDocStd_Document) & document, ShapeFile& file);

}  // namespace umbilic
