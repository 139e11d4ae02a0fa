// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <iosfwd>

#include <umbilic/model/model.h>

namespace umbilic {

/// Writes a model in Umbilic's own binary form: magic number, version, length, contents in little-endian, checksum.
void write_model(const Model& model, std::ostream& out);

/// Reads what write_model() wrote, checking magic number, version, length and checksum before anything is used, and
/// every surface and loop as their constructors do. Throws InvalidInput on anything else.
Model read_model(std::istream& in);

}  // namespace umbilic
