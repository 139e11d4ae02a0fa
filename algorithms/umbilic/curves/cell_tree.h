// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <vector>

#include <umbilic/curves/bezier_cell.h>
#include <umbilic/curves/oriented_box.h>
#include <umbilic/model/model.h>

namespace umbilic {

/// Where a patch of a CellTree comes from.
struct TreePatch {
    enum class Kind { surface, flat_curve, curve };
    Kind kind = Kind::surface;
    /// Empty for Kind::curve, which is evaluated through its surface and trimming curve.
    LocalPatch local;
    int face = 0;  ///< index into CellTree::faces
    /// Part of the surface's domain, or (u only) of the trimming curve's, that [0, 1] stands for.
    ParameterBox domain;
    int loop = -1, curve = -1;
};

/// A piece of a patch or of a trimming loop, small enough that the squared distance from most points is convex in it,
/// or has no minimum.
struct Cell {
    int patch = 0;
    LocalBox box;
    /// The sides u = low, u = high, v = low, v = high at which the search has to stop: the smooth surface or curve
    /// ends.
    std::array<bool, 4> border = {false, false, false, false};
    bool on_loop = false;
    /// A trimming loop passes through the cell: its points may be outside the face.
    bool trimmed = false;
    CellModel model;
};

/// Four oriented boxes side by side, and what is inside them.
struct BoxNode {
    std::array<std::array<double, 4>, 3> center, half;
    std::array<std::array<std::array<double, 4>, 3>, 3> axis;
    /// At least 0: a node; negative: cell number -1 - child.
    std::array<int, 4> child;
    int count = 0;
};

/// Bounding-volume tree over the cells of all trimmed faces of a model. Coordinates are relative to `origin`.
struct CellTree {
    struct TreeFace {
        int number = 0;
        NurbsSurface surface;
        TrimmingRegion region;
        bool whole = true;  ///< no trimming loops: the borders of the domain are the face's edges
    };

    explicit CellTree(const std::vector<Face>& model_faces);

    Vector3 origin = Vector3::Zero();
    /// Radius of a ball about the origin that holds everything.
    double radius = 0.0;
    /// A patch is halved at most this often when the tree is built, for points far from it and near it.
    int far_halvings = 0, near_halvings = 0;
    std::vector<TreeFace> faces;
    std::vector<TreePatch> patches;
    std::vector<Cell> cells;
    std::vector<BoxNode> nodes;  ///< the root comes first; empty if there are no cells

    /// Point and derivatives of a patch.
    LocalDerivatives evaluate(const TreePatch& patch, double u, double v) const;
    /// Surface parameters of a point of a patch.
    Vector2 parameters(const TreePatch& patch, double u, double v) const;
    /// Model of part of a patch; `net` receives its control points, or is emptied if it has none.
    CellModel model(const TreePatch& patch, const LocalBox& box, std::vector<Vector4>& net) const;
    /// Side (0: u, 1: v) in which a cell is longer and should be halved.
    static int longer_side(const CellModel& model);

private:
    struct Growth;
    void add_surface(int face, Growth& growth) const;
    void add_loops(int face, Growth& growth) const;
    void grow(Growth& growth, int patch, const Cell& cell, int depth) const;
    int build(std::vector<int>& order, std::size_t begin, std::size_t end, const std::vector<OrientedBox>& boxes);
};

}  // namespace umbilic
