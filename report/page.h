// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

namespace umbilic {

// Files that were put into the library when it was built.

std::string page_report();           ///< page/report.html, a Mustache template
std::string page_umbilics();         ///< page/umbilics.html, a Mustache template
std::string page_fit();              ///< page/fit.html, a Mustache template
std::string page_head();             ///< page/head.html, the start of every page
std::string page_parameters();       ///< page/parameters.html, a table of parameters
std::string page_scripts();          ///< page/scripts.html, the end of a page with a viewer
std::string page_style();            ///< page/report.css
std::string page_stage();            ///< page/stage.js, what both viewers are built on
std::string page_viewer();           ///< page/viewer.js
std::string page_umbilics_viewer();  ///< page/umbilics.js
std::string page_three();            ///< three.js, minified
std::string page_orbit_controls();   ///< OrbitControls.js of three.js

}  // namespace umbilic
