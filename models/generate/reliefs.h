// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <TopoDS_Shape.hxx>

namespace umbilic::models {

/// Car hood, one bicubic face of 8 x 8 poles, 1.3 x 1.2 m; mirror-symmetric in x = 0 as hoods are.
TopoDS_Shape hood();

/// Mask-like relief, one bicubic face of 26 x 26 poles, about 158 x 204 x 42 mm, not symmetric.
TopoDS_Shape mask();

/// The wave-like bicubic Bezier patch over the unit square (1 mm) with five known umbilics: control
/// points (i/3, j/3, z_ij), all z_ij = 0 but z_11 = 1, z_12 = 0.6, z_21 = -1, z_22 = -0.6.
/// Patrikalakis, Maekawa and Cho, Shape Interrogation for Computer Aided Design and Manufacturing,
/// section 9.6; Ko 2003, Table 3.1.
TopoDS_Shape monge_umbilics();

}  // namespace umbilic::models
