// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include <occ_adapter/read_file.h>

namespace umbilic::python {

/// A model as it was read, with the triangles to show it. Python holds it by shared_ptr, so that results may keep it.
struct LoadedModel {
    ReadResult file;
    /// Where the bytes can be read again: the file, or the memory file that holds a shape's snapshot.
    std::string path;
};

}  // namespace umbilic::python
