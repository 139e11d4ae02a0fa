// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/similarity/local_similarity.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace umbilic {

namespace {

using Cell = std::tuple<long long, long long, long long>;

int cell_index(double parameter, const ParameterInterval& domain, double cell) {
    const double last = std::ceil(1.0 / cell) - 1.0;
    return static_cast<int>(std::clamp(std::floor((parameter - domain.low) / (domain.length() * cell)), 0.0, last));
}

template <class CellOf>
LocalSimilarity counted(std::span<const NodeComparison> nodes, Quantity quantity, double tolerance,
                        const CellOf& cell_of) {
    LocalSimilarity result;
    result.tolerance = tolerance;
    std::map<Cell, bool> marked;
    double area = 0.0, alike = 0.0;
    for (const NodeComparison& node : nodes) {
        const std::optional<double> x = value(node, quantity);
        if (!x) continue;
        const bool exceeds = !(*x <= tolerance);
        marked[cell_of(node)] |= exceeds;
        area += node.weight;
        if (!exceeds) alike += node.weight;
    }
    result.cells = static_cast<int>(marked.size());
    result.marked = static_cast<int>(std::ranges::count_if(marked, [](const auto& entry) { return entry.second; }));
    if (result.cells > 0) result.cell_percent = (1.0 - static_cast<double>(result.marked) / result.cells) * 100.0;
    if (area > 0.0) result.percent = alike / area * 100.0;
    return result;
}

}  // namespace

LocalSimilarity local_similarity(const Model& model, std::span<const NodeComparison> nodes, Quantity quantity,
                                 double tolerance, double cell) {
    return counted(nodes, quantity, tolerance, [&](const NodeComparison& node) {
        const ParameterBox domain = model.face(node.at.face).surface.domain();
        return Cell{node.at.face, cell_index(node.at.u, domain.u, cell), cell_index(node.at.v, domain.v, cell)};
    });
}

LocalSimilarity local_similarity(std::span<const NodeComparison> nodes, Quantity quantity, double tolerance,
                                 double side) {
    return counted(nodes, quantity, tolerance, [&](const NodeComparison& node) {
        const auto index = [&](double coordinate) { return static_cast<long long>(std::floor(coordinate / side)); };
        return Cell{index(node.point.x()), index(node.point.y()), index(node.point.z())};
    });
}

}  // namespace umbilic
