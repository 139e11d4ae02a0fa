// SPDX-License-Identifier: LGPL-2.1-or-later
#include "knot_check.h"

#include <IGESGeom_BSplineSurface.hxx>
#include <StepGeom_BSplineSurfaceWithKnots.hxx>
#include <StepGeom_BSplineSurfaceWithKnotsAndRationalBSplineSurface.hxx>
#include <TCollection_HAsciiString.hxx>

namespace umbilic {

namespace {

/// Number (from 1) of the first knot that is smaller than its predecessor, or 0; `knot(i)` for i = first ... last.
template <typename Knot>
int first_decrease(int first, int last, const Knot& knot) {
    for (int i = first + 1; i <= last; ++i)
        if (knot(i) < knot(i - 1)) return i - first + 1;
    return 0;
}

int first_decrease(const Handle(StepGeom_BSplineSurfaceWithKnots) & surface) {
    const int in_u = first_decrease(1, surface->NbUKnots(), [&](int i) { return surface->UKnotsValue(i); });
    return in_u ? in_u : first_decrease(1, surface->NbVKnots(), [&](int i) { return surface->VKnotsValue(i); });
}

int first_decrease(const Handle(IGESGeom_BSplineSurface) & surface) {
    const int u_last = surface->UpperIndexU() + 1, v_last = surface->UpperIndexV() + 1;
    const int in_u = first_decrease(-surface->DegreeU(), u_last, [&](int i) { return surface->KnotU(i); });
    return in_u ? in_u : first_decrease(-surface->DegreeV(), v_last, [&](int i) { return surface->KnotV(i); });
}

}  // namespace

std::vector<std::string> decreasing_knots(const Handle(Interface_InterfaceModel) & model) {
    std::vector<std::string> warnings;
    for (int i = 1; i <= model->NbEntities(); ++i) {
        const Handle(Standard_Transient) entity = model->Value(i);
        Handle(StepGeom_BSplineSurfaceWithKnots) step = Handle(StepGeom_BSplineSurfaceWithKnots)::DownCast(entity);
        if (const auto rational = Handle(StepGeom_BSplineSurfaceWithKnotsAndRationalBSplineSurface)::DownCast(entity))
            step = rational->BSplineSurfaceWithKnots();
        const auto iges = Handle(IGESGeom_BSplineSurface)::DownCast(entity);
        const int knot = !step.IsNull() ? first_decrease(step) : !iges.IsNull() ? first_decrease(iges) : 0;
        if (knot > 0)
            warnings.push_back(
                "entity " + std::string(model->StringLabel(entity)->ToCString()) + ": knot " + std::to_string(knot) +
                " of the surface is smaller than its predecessor; OpenCASCADE drops it and reads another "
                "surface than the file describes");
    }
    return warnings;
}

}  // namespace umbilic
