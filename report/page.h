// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

namespace umbilic {

// Files that were put into the library when it was built.

std::string page_report();           ///< page/report.html, a Mustache template
std::string page_umbilics();         ///< page/umbilics.html, a Mustache template
std::string page_fit();              ///< page/fit.html, a Mustache template
std::string page_style();            ///< page/report.css
std::string page_stage();            ///< page/stage.js, what both viewers are built on
std::string page_viewer();           ///< page/viewer.js
std::string page_umbilics_viewer();  ///< page/umbilics.js
std::string page_three();            ///< three.js, minified
std::string page_orbit_controls();   ///< OrbitControls.js of three.js

}  // namespace umbilic
