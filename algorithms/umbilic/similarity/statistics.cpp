// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/similarity/statistics.h>

#include <algorithm>
#include <cmath>

namespace umbilic {

std::optional<double> value(const NodeComparison& node, Quantity quantity) {
    switch (quantity) {
        case Quantity::distance:
            return node.distance;
        case Quantity::kappa_max:
            return node.kappa_max;
        case Quantity::kappa_min:
            return node.kappa_min;
        case Quantity::direction:
            return node.direction;
    }
    return std::nullopt;
}

Statistics statistics(std::span<const NodeComparison> nodes, Quantity quantity, double limit) {
    Statistics result;
    double weight = 0.0, sum = 0.0;
    for (const NodeComparison& node : nodes) {
        const std::optional<double> x = value(node, quantity);
        if (!x || !(node.distance <= limit)) continue;
        ++result.count;
        result.max = std::max(result.max, *x);
        weight += node.weight;
        sum += node.weight * *x;
    }
    if (!(weight > 0.0)) return result;
    result.mean = sum / weight;
    // Second pass: the one-pass formula cancels where the spread is small beside the mean.
    double squares = 0.0;
    for (const NodeComparison& node : nodes) {
        const std::optional<double> x = value(node, quantity);
        if (x && node.distance <= limit) squares += node.weight * (*x - result.mean) * (*x - result.mean);
    }
    result.standard_deviation = std::sqrt(squares / weight);
    return result;
}

}  // namespace umbilic
