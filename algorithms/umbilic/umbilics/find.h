// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/model/model.h>
#include <umbilic/umbilics/umbilic.h>

namespace umbilic {

struct UmbilicOptions {
    /// Side of the smallest box of the search relative to the domain's sides; boxes that are still undecided then are
    /// returned as such.
    double resolution = 1e-3;
    /// Boxes a Bezier patch may use before what is left of it is returned undecided.
    int boxes_per_patch = 100000;
    /// Relative error of the cubic forms that is assumed on top of what follows from the numbers' rounding and from
    /// `accuracy`: a type that another one lies within is called non-generic.
    double generic_margin = 1e-6;
    /// Greatest distance (mm) of a control point of the surface from where it should be. It widens the errors of
    /// curvatures, cubic forms and types; existence is proved for the surface as given. A face adds the error of its
    /// conversion.
    double accuracy = 0.0;
    /// Also prove completeness by the winding along the boundary.
    bool certificate = true;
    /// A face that is within this of a plane or sphere, relative to the diagonal of its control points, is answered as
    /// one umbilic region whose deviation is told; 0 asks for the umbilics of every ripple.
    double recognition = 1e-6;
};

/// All umbilics of a NURBS surface on its whole domain, each isolated one with a proof of existence and uniqueness from
/// its control points (thesis 2.1.4, 3.6; formulation in docs/numerics.md). Every `containment` is inside. Throws
/// Cancelled.
FaceUmbilics find_umbilics(const NurbsSurface& surface, const UmbilicOptions& options = {},
                           const Progress& progress = {});

/// All umbilics of a face: elementary kinds, and NURBS surfaces that are recognised as such (see
/// UmbilicOptions::recognition), are answered without a search; `containment` is told from the trimming loops.
FaceUmbilics find_umbilics(const Face& face, const UmbilicOptions& options = {}, const Progress& progress = {});

/// All umbilics of all faces, in the model's order, faces in parallel.
std::vector<FaceUmbilics> find_umbilics(const Model& model, const UmbilicOptions& options = {},
                                        const Progress& progress = {});

}  // namespace umbilic
