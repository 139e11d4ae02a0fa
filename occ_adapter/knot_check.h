// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include <Interface_InterfaceModel.hxx>

namespace umbilic {

/// One warning for each B-spline surface of a STEP or IGES file whose knots decrease. OpenCASCADE drops such knots
/// without a word and delivers another surface than the file describes.
std::vector<std::string> decreasing_knots(const Handle(Interface_InterfaceModel) & model);

}  // namespace umbilic
