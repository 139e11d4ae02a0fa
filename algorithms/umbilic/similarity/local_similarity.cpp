// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/similarity/local_similarity.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace umbilic {

namespace {

int cell_index(double parameter, const ParameterInterval& domain, double cell) {
    const double last = std::ceil(1.0 / cell) - 1.0;
    return static_cast<int>(std::clamp(std::floor((parameter - domain.low) / (domain.length() * cell)), 0.0, last));
}

}  // namespace

LocalSimilarity local_similarity(const Model& model, std::span<const NodeComparison> nodes, Quantity quantity,
                                 double tolerance, double cell) {
    LocalSimilarity result;
    result.tolerance = tolerance;
    std::map<std::tuple<int, int, int>, bool> marked;
    double area = 0.0, alike = 0.0;
    for (const NodeComparison& node : nodes) {
        const std::optional<double> x = value(node, quantity);
        if (!x) continue;
        const ParameterBox domain = model.face(node.at.face).surface.domain();
        const bool exceeds = !(*x <= tolerance);
        marked[{node.at.face, cell_index(node.at.u, domain.u, cell), cell_index(node.at.v, domain.v, cell)}] |= exceeds;
        area += node.weight;
        if (!exceeds) alike += node.weight;
    }
    result.cells = static_cast<int>(marked.size());
    result.marked = static_cast<int>(std::ranges::count_if(marked, [](const auto& entry) { return entry.second; }));
    if (result.cells > 0) result.cell_percent = (1.0 - static_cast<double>(result.marked) / result.cells) * 100.0;
    if (area > 0.0) result.percent = alike / area * 100.0;
    return result;
}

}  // namespace umbilic
