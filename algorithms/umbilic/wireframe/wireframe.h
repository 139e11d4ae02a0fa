// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/differential/curvature.h>
#include <umbilic/model/model.h>
#include <umbilic/umbilics/umbilic.h>

namespace umbilic {

enum class WireKind {
    maximum,   ///< part of a line of curvature of the greater normal curvature, as seen from outside
    minimum,   ///< of the smaller
    geodesic,  ///< shortest way between two nodes
    boundary   ///< part of the face's border
};

/// A node of a wireframe: a point that the shape alone determines.
struct WireNode {
    SurfacePoint at;
    /// Principal frame; the normal points to the face's outward side.
    Curvature curvature;
    bool on_border = false;
    /// mm^2, for inner nodes: the face's area as its cells measure it, shared among their inner corners. 0 on borders.
    double area = 0.0;
};

struct WireEdge {
    int from = 0, to = 0;  ///< nodes of the face
    WireKind kind = WireKind::geodesic;
    /// mm: arc length of lines of curvature and borders; for geodesics that of the circle through both nodes which has
    /// the angle of their normals (error of the fourth order in the length).
    double length = 0.0;
    std::vector<Vector3> between;  ///< points of the edge from `from` to `to`, without its ends
};

struct FaceWireframe {
    int face = 0;
    std::vector<WireNode> nodes;
    std::vector<WireEdge> edges;
    /// Nodes of each triangle or quadrilateral, in order. Between four parts of lines of alternating families there are
    /// quadrilaterals; so there are elsewhere where no corner of two neighbouring triangles is too far from a right
    /// angle.
    std::vector<std::vector<int>> cells;
    int quadrilaterals = 0;
    /// Share of the face's area within `step` of a node of the same face, seen at samples in every cell.
    double coverage = 0.0;
    double farthest = 0.0;  ///< greatest distance of those samples from their nearest node, mm
    std::string why;        ///< what is missing; empty if the face is meshed
};

struct WireframeOptions {
    /// Distance of neighbouring lines, mm; without it, `relative_step` times sqrt(area of the model).
    std::optional<double> step;
    double relative_step = 0.05;
    /// Only this face; all if 0.
    int face = 0;
    /// Begin at star umbilics where there are any.
    bool umbilics = true;
    /// Nodes a face may have, as a multiple of its area / step^2, plus as many for its border.
    double most_nodes = 64.0;
    /// Points of edges between their nodes, and the coverage. Without them edges are only pairs of nodes with a length,
    /// and coverage and farthest are 0.
    bool drawn = true;
    /// Umbilics as they were found before, one entry a face in the model's order; looked for if there are none.
    std::span<const FaceUmbilics> umbilics_found = {};
};

struct Wireframe {
    double step = 0.0;  ///< as used, mm
    std::vector<FaceWireframe> faces;
};

/// The shape-intrinsic wireframe of a model (thesis 3.7): nodes, edges and cells that depend on the shape of each
/// trimmed face and on the step, not on its parametrisation or position. From a start chosen by the shape (net_start.h)
/// lines of curvature of both families cover the face at about equal distances (line_net.h); their crossings are nodes,
/// with those on the border (border_nodes.h), which faces share. What the lines leave open, near umbilics, borders
/// and in umbilic regions, is filled with points of the surface that are equally far from three nodes, until none is
/// farther from a node than the step; these are joined by geodesics. A face that cannot be meshed says why.
///
/// Throws InvalidInput if a length is not finite and positive, if the step asks for more than a million nodes, or there
/// is no such face; Cancelled.
Wireframe wireframe(const Model& model, const WireframeOptions& options = {}, const Progress& progress = {});

/// Lower-case words of the JSON results.
const char* name(WireKind kind);

}  // namespace umbilic
