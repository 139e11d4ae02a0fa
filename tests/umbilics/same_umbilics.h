// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <support/invariance.h>
#include <umbilic/umbilics/find.h>

namespace umbilic {

struct PlacedUmbilic {
    const Face* face = nullptr;
    Umbilic umbilic;
};

/// Ball in space around a box that the search left open: undecided, part of a line or of a region.
struct OpenPlace {
    Vector3 center = Vector3::Zero();
    double radius = 0.0;
};

/// What a search found within the loops of a model's faces. Refers to the model.
struct FoundUmbilics {
    std::vector<PlacedUmbilic> inside;
    std::vector<OpenPlace> open;
    int undecided = 0, lines = 0, regions = 0;
};

/// Searches the model and takes the first `faces` faces. Expects no certificate to be false.
FoundUmbilics search_umbilics(const Model& model, std::size_t faces);

/// Expects that every umbilic of the model, away from borders and cuts, comes out of the copy once, and nothing else:
/// place in space, curvature, delta and zeta, cubic form, type and index, within bounds that follow from the rounding
/// of control points, the stated deviation and the form of the surface at the umbilic. Where either search left a place
/// open, the other may have found an umbilic there; that returns the number of such umbilics.
int expect_same_umbilics(const Model& model, const FoundUmbilics& base, const support::ModelCopy& copy);

}  // namespace umbilic
