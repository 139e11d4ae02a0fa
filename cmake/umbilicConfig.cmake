# SPDX-License-Identifier: LGPL-2.1-or-later
include(CMakeFindDependencyMacro)
find_dependency(Eigen3 3.4)
find_dependency(Boost 1.74)
find_dependency(TBB)
include("${CMAKE_CURRENT_LIST_DIR}/umbilic_targets.cmake")
