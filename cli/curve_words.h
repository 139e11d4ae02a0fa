// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include <umbilic/core/types.h>
#include <umbilic/model/model.h>

namespace umbilic {

/// Two or three numbers with commas between them, as "0.2,0.3". Throws WrongUse, naming the option, for anything else.
Vector2 two_numbers(const std::string& option, const std::string& text);
Vector3 three_numbers(const std::string& option, const std::string& text);

/// The face of that number; the only one if 0. Throws WrongUse if there is none, or several and 0.
const Face& chosen_face(const Model& model, int number, const std::string& option);

/// A point given by the parameters of the face's own surface, in those of its NURBS form. Throws WrongUse if it lies
/// outside of the face.
Vector2 chosen_point(const Model& model, const Face& face, const std::string& option, const std::string& text);

/// The points of all curves of a result of schema "umbilic.curve/1". Throws InvalidInput, naming the file, if it is
/// none.
std::vector<std::vector<Vector3>> curves_of_result(const std::string& path);

/// True if the file holds JSON, by its first character that is not space.
bool holds_json(const std::string& path);

}  // namespace umbilic
