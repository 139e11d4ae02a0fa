// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace umbilic {

enum class ToleranceOrigin { fixed_default, derived, user };

/// A tolerance as it was used, for the report.
struct Tolerance {
    std::string name;  ///< also the name of the command-line option
    double value = 0.0;
    std::string unit;  ///< "mm", "1/mm", "rad", "1" ...
    ToleranceOrigin origin = ToleranceOrigin::fixed_default;
    std::string inequality;  ///< the test it enters, in words and symbols
};

/// Tolerances a user may set; those left empty are derived from the models (see docs/algorithms/tolerances.md).
struct ToleranceChoices {
    std::optional<double> distance;          ///< delta_0, mm of the original: weak test
    std::optional<double> kappa;             ///< delta_1, 1/mm of the original: intermediate test
    std::optional<double> direction;         ///< delta_2, radians: intermediate test
    std::optional<double> umbilic_distance;  ///< mm of the original: strong test
    std::optional<double> cell;              ///< delta_s, relative to a face's domain: local similarity
};

const char* name(ToleranceOrigin origin);

}  // namespace umbilic
