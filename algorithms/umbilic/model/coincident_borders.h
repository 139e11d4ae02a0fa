// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <umbilic/model/face_border.h>

namespace umbilic {

/// Faces and their border loops, in the order of Model::faces.
struct Borders {
    const Model* model;
    std::vector<std::vector<TrimmingLoop>> loops;
    /// Index into Model::faces by Face::number; -1 where there is none.
    std::vector<int> index;

    /// Refers to the model: it must stay alive and in place.
    explicit Borders(const Model& model);
    const Face& face(int number) const { return model->faces[index[number]]; }
    const std::vector<TrimmingLoop>& loops_of(int number) const { return loops[index[number]]; }
    const TrimmingCurve& curve(const BorderPiece& piece) const { return loops_of(piece.face)[piece.loop][piece.curve]; }
};

/// Finds which of the given whole curves coincide in space within `tolerance` (mm), wholly or in part: every curve is
/// cut where an end of another one lies on it, and pieces with the same ends that run along each other are put
/// together. Returns groups of pieces that cover all given curves; a group of one has no partner.
std::vector<std::vector<BorderPiece>> coincident_borders(const Borders& borders, const std::vector<BorderPiece>& curves,
                                                         double tolerance);

}  // namespace umbilic
