// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/core/types.h>
#include <umbilic/model/coincident_borders.h>
#include <umbilic/model/face_border.h>
#include <umbilic/model/model.h>

namespace umbilic {

/// One of the faces' border pieces that make an edge.
struct EdgeUse {
    BorderPiece piece;
    /// The parameter of the border curve grows along the edge, that is as it does in the edge's first use.
    bool along = true;
};

/// An edge of a model: one use is a free border, two are shared (by two faces, or as a seam by one face with itself),
/// more are not a surface there.
struct Edge {
    std::vector<EdgeUse> uses;
    /// The uses belong together because the file says so (TrimmingCurve::edge); otherwise because they coincide.
    bool stated = false;
    /// Largest distance in space (mm) between its uses, seen at samples.
    double gap = 0.0;
};

/// Faces connected by shared edges.
struct Shell {
    std::vector<int> faces;  ///< numbers, increasing
    /// Every edge stands between exactly two sides.
    bool closed = false;
    int vertices = 0, edges = 0;  ///< points to which an edge has shrunk are no edges
    /// V - E + F with 2 - b for a face of b loops (1 for a face with one loop): 2 - 2 genus for a closed shell. It
    /// supposes that each face is connected.
    int euler_characteristic = 0;
};

/// Which faces of a model meet at which edges.
struct FaceAdjacency {
    /// Refers to the model: it must stay alive and in place.
    Borders borders;
    double tolerance = 0.0;  ///< mm, as used for coincident borders
    std::vector<Edge> edges;
    /// Indices into `edges` of the pieces of each border curve by growing parameter, empty for a curve that is a single
    /// point in space: edges_of[index of the face in Model::faces][loop][curve].
    std::vector<std::vector<std::vector<std::vector<int>>>> edges_of;
    std::vector<Shell> shells;
    std::vector<int> shell_of;  ///< index into `shells`, by index of the face in Model::faces
};

struct FaceAdjacencyOptions {
    /// Borders that the file does not join are one edge where they coincide within this length (mm). Empty: the larger
    /// of relative_coincidence times the diagonal of the model's box and the largest tolerance the file states for
    /// these borders, but not above largest_relative_coincidence times that diagonal.
    std::optional<double> tolerance;
};

/// Accuracy at which loose faces of files were seen to meet, relative to the diagonal of the model's box.
inline constexpr double relative_coincidence = 1e-5;
inline constexpr double largest_relative_coincidence = 1e-3;

/// The edges of a model, from the edge numbers of its trimming loops and, for borders without a partner there, from
/// coincidence in space, in part or as a whole. Faces without loops take part with the four sides of their domain.
/// Cost grows with the number of border curves n as n log n. Throws InvalidInput if the tolerance is not finite and
/// positive.
FaceAdjacency face_adjacency(const Model& model, const FaceAdjacencyOptions& options = {},
                             const Progress& progress = {});

/// A point of a border as it lies on the border of another face, or of the same face at the other side of its seam.
struct EdgeCrossing {
    int edge = 0;  ///< index into FaceAdjacency::edges
    BorderPoint from, to;
    /// The parameters of both border curves grow in the same direction in space.
    bool same_direction = true;
    /// `from` and `to` have their faces on the left of their curves (BorderPiece::face_on_left).
    bool from_on_left = true, to_on_left = true;
};

/// The other sides of the edge at a point of a border, as nearest_in_parameters() finds it: none on a free border, more
/// than one where more than two faces meet.
std::vector<EdgeCrossing> across(const FaceAdjacency& adjacency, const BorderPoint& from);

}  // namespace umbilic
