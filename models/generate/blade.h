// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <TopoDS_Shape.hxx>

namespace umbilic::models {

/// Twisted fan blade of two bicubic faces, suction and pressure side, which share the leading and the
/// trailing edge. About 60 mm of chord and 200 mm of span; no umbilic.
TopoDS_Shape blade();

}  // namespace umbilic::models
