// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <umbilic/nurbs/nurbs_surface.h>

#ifdef UMBILIC_WITH_OPENCASCADE
#include <Geom_BSplineSurface.hxx>
#endif
#ifdef UMBILIC_WITH_SISL
#include <memory>
#include <sisl.h>
#endif

namespace umbilic::bench {

#ifdef UMBILIC_WITH_OPENCASCADE
/// The same polynomial surface, clamped, in OpenCASCADE.
Handle(Geom_BSplineSurface) opencascade_surface(const NurbsSurface& surface);
#endif

#ifdef UMBILIC_WITH_SISL
using SislSurface = std::unique_ptr<SISLSurf, decltype(&freeSurf)>;
/// The same polynomial surface in SISL.
SislSurface sisl_surface(const NurbsSurface& surface);
#endif

}  // namespace umbilic::bench
