// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <limits>
#include <optional>
#include <span>

#include <umbilic/similarity/assessment.h>

namespace umbilic {

/// The four quantities of the thesis's assessment (4.4.4): eps_0, eps_1, eps_1', eps_2.
enum class Quantity { distance, kappa_max, kappa_min, direction };

/// A node's value of a quantity, or none where it is not defined.
std::optional<double> value(const NodeComparison& node, Quantity quantity);

/// Largest value, mean and standard deviation (of the population) of a quantity, weighted by the nodes' areas, over the
/// nodes that have it and whose distance is at most `limit` (mm). All 0 where there is none.
Statistics statistics(std::span<const NodeComparison> nodes, Quantity quantity,
                      double limit = std::numeric_limits<double>::infinity());

}  // namespace umbilic
