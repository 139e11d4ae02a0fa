// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <umbilic/wireframe/wireframe.h>

#include <report/json.h>

namespace umbilic {

/// Schema "umbilic.wireframe/1". The parameters u and v are those of the file's own surfaces.
Json wireframe_json(const Model& model, const Wireframe& wireframe);

}  // namespace umbilic
