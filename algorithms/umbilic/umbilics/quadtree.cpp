// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/umbilics/quadtree.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include <Eigen/Core>
#include <tbb/parallel_for.h>

#include <umbilic/bernstein/box_clusters.h>
#include <umbilic/bernstein/projected_polyhedron.h>
#include <umbilic/bernstein/rounding.h>
#include <umbilic/bernstein/subdivision.h>
#include <umbilic/core/errors.h>
#include <umbilic/umbilics/equations.h>

namespace umbilic {

namespace {

using Array = Eigen::Map<const Eigen::ArrayXd>;

/// All coefficients below this multiple of the bound from the input's rounding: identically zero, as in common_zeros.
constexpr double zero_factor = 4.0;
constexpr long boxes_per_check = 1024;

struct Found {
    std::vector<QuadtreeLeaf> leaves;
    long boxes = 0;
    bool exhausted = false;
};

/// A square of the tree at `depth`: column r, row s of 2^depth.
struct Node {
    int depth = 0;
    long r = 0, s = 0;
    double error = 0.0;
};

class PatchTree {
public:
    PatchTree(const BezierPatch& patch, const TensorPolynomial& discriminant) : patch_(patch) {
        shape_ = {discriminant.u_degree, discriminant.v_degree};
        slots_.resize(shape_.size());
        root_error_ = discriminant.bernstein_coefficients(slots_).input;
    }

    /// Quarters down to boxes of `depth`.
    Found search(int depth, long budget, const Progress& progress);

private:
    double* slot(std::size_t k) { return slots_.data() + k * shape_.size(); }
    ParameterBox box(const Node& node) const;
    /// Replaces the last node by its quarters.
    void quarter();

    const BezierPatch& patch_;
    CoefficientShape shape_;
    double root_error_ = 0.0;
    std::vector<double> slots_;  ///< coefficients of the open nodes of the depth-first tree
    std::vector<Node> nodes_;
};

ParameterBox PatchTree::box(const Node& node) const {
    const double count = std::ldexp(1.0, node.depth);
    const auto side = [&](const ParameterInterval& whole, long index) {
        return placed(Interval(index / count, (index + 1) / count), whole);
    };
    return {side(patch_.domain.u, node.r), side(patch_.domain.v, node.s)};
}

void PatchTree::quarter() {
    const std::size_t top = nodes_.size() - 1;
    slots_.resize((top + 4) * shape_.size());
    const double magnitude = Array(slot(top), shape_.size()).abs().maxCoeff();
    Node high = nodes_[top];
    high.error = (high.error + gamma_bound(shape_.p + shape_.q) * magnitude) * bound_slack;
    ++high.depth;
    high.r = 2 * high.r + 1;
    high.s = 2 * high.s + 1;
    Node low_u = high, low_v = high, low = high;
    low_u.r = low.r = high.r - 1;
    low_v.s = low.s = high.s - 1;
    // The slots follow the nodes: (high, high), (low, high), (high, low), (low, low).
    halve_u(shape_, slot(top), slot(top + 1));
    halve_v(shape_, slot(top), slot(top + 2));
    halve_v(shape_, slot(top + 1), slot(top + 3));
    nodes_[top] = high;
    nodes_.insert(nodes_.end(), {low_u, low_v, low});
}

Found PatchTree::search(int depth, long budget, const Progress& progress) {
    Found result;
    nodes_.assign(1, {0, 0, 0, root_error_});
    while (!nodes_.empty()) {
        if (result.boxes == budget) {
            result.exhausted = true;
            for (const Node& node : nodes_) result.leaves.push_back({box(node), 0, false});
            break;
        }
        if (++result.boxes % boxes_per_check == 0) progress.check();
        const Node& node = nodes_.back();
        const Array c(slot(nodes_.size() - 1), shape_.size());
        const bool positive = c.minCoeff() > node.error;
        const bool zero = c.abs().maxCoeff() <= zero_factor * node.error;
        if (positive || zero || node.depth == depth) {
            if (!positive) result.leaves.push_back({box(node), 0, zero});
            nodes_.pop_back();
        } else {
            quarter();
        }
    }
    return result;
}

}  // namespace

QuadtreeUmbilics find_umbilics_by_quadtree(const NurbsSurface& surface, const QuadtreeOptions& options,
                                           const Progress& progress) {
    if (!(options.tolerance >= 1e-6 && options.tolerance < 1.0))
        throw InvalidInput("umbilics by quadtree: the tolerance must lie between 1e-6 and 1");
    if (options.boxes_per_patch < 1) throw InvalidInput("umbilics by quadtree: boxes_per_patch must be at least 1");

    const BezierPatches patches = bezier_patches(surface);
    const InputRounding input = input_rounding(surface);
    const ParameterBox domain = surface.domain();
    std::vector<Found> found(patches.patches.size());
    std::atomic<std::size_t> done{0};
    tbb::parallel_for(std::size_t(0), found.size(), [&](std::size_t k) {
        progress.check();
        const BezierPatch& patch = patches.patches[k];
        double side =
            std::max(patch.domain.u.length() / domain.u.length(), patch.domain.v.length() / domain.v.length());
        int depth = 0;
        for (; side >= options.tolerance; side /= 2) ++depth;
        UmbilicEquations equations;
        equations.form_fundamental(patch, input);
        found[k] = PatchTree(patch, equations.discriminant()).search(depth, options.boxes_per_patch, progress);
        progress.report(static_cast<double>(++done) / static_cast<double>(found.size()), "umbilics");
    });

    QuadtreeUmbilics result;
    result.patches = static_cast<int>(found.size());
    std::vector<Interval> sides;
    for (const Found& part : found) {
        result.boxes += part.boxes;
        result.exhausted = result.exhausted || part.exhausted;
        result.leaves.insert(result.leaves.end(), part.leaves.begin(), part.leaves.end());
    }
    for (const QuadtreeLeaf& leaf : result.leaves) {
        sides.emplace_back((leaf.box.u.low - domain.u.low) / domain.u.length(),
                           (leaf.box.u.high - domain.u.low) / domain.u.length());
        sides.emplace_back((leaf.box.v.low - domain.v.low) / domain.v.length(),
                           (leaf.box.v.high - domain.v.low) / domain.v.length());
    }
    // Boxes that touch; the gap covers the rounding of their corners.
    const BoxClusters clusters = cluster_boxes(sides, 2, 1e-3 * options.tolerance);
    result.clusters = clusters.count;
    for (std::size_t k = 0; k < result.leaves.size(); ++k) result.leaves[k].cluster = clusters.cluster[k];
    return result;
}

}  // namespace umbilic
