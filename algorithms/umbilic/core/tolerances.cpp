// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/core/tolerances.h>

#include <algorithm>
#include <cmath>

#include <umbilic/core/errors.h>

namespace umbilic {

namespace {

void check_choice(const std::optional<double>& choice, const char* name) {
    if (choice && !(std::isfinite(*choice) && *choice > 0.0))
        throw InvalidInput("tolerance '" + std::string(name) + "' must be a positive number");
}

Tolerance make(const char* name, const std::optional<double>& choice, double value, ToleranceOrigin origin,
               const char* unit, const char* inequality) {
    check_choice(choice, name);
    return {name, choice.value_or(value), unit, choice ? ToleranceOrigin::user : origin, inequality};
}

}  // namespace

std::vector<Tolerance> derive_tolerances(double size, double accuracy, const ToleranceChoices& choices) {
    if (!(std::isfinite(size) && size > 0.0))
        throw InvalidInput("tolerances cannot be derived: the model has no area; check that its faces were read");
    const double distance = std::clamp(accuracy, tolerance::relative_distance * size,  //
                                       tolerance::largest_relative_distance * size);
    const double exact = std::min(tolerance::relative_exactness * size + accuracy, choices.distance.value_or(distance));
    std::vector<Tolerance> result = {
        make("distance", choices.distance, distance, ToleranceOrigin::derived, "mm",
             "weak test: distance of a node to its foot point <= delta_0"),
        make("kappa", choices.kappa, tolerance::relative_kappa / size, ToleranceOrigin::derived, "1/mm",
             "intermediate test: difference of principal curvatures at node and foot point <= delta_1"),
        make("direction", choices.direction, tolerance::direction, ToleranceOrigin::fixed_default, "rad",
             "intermediate test: angle between the principal directions at node and foot point <= delta_2"),
        make("umbilic-distance", choices.umbilic_distance, tolerance::relative_umbilic_distance * size,
             ToleranceOrigin::derived, "mm", "strong test: distance of two umbilics of the same type <= delta_u"),
        make("cell", choices.cell, tolerance::cell, ToleranceOrigin::fixed_default, "1",
             "local similarity: side of a cell, relative to the face's parameter domain"),
        make("exact-distance", std::nullopt, exact, ToleranceOrigin::derived, "mm",
             "a copy is called exact: distance of every node <= this"),
    };
    if (find_tolerance(result, "cell").value > 1.0)
        throw InvalidInput("tolerance 'cell' must not be above 1: it is relative to a face's domain");
    return result;
}

const Tolerance& find_tolerance(std::span<const Tolerance> tolerances, std::string_view name) {
    const auto found = std::ranges::find(tolerances, name, &Tolerance::name);
    if (found == tolerances.end()) throw InvalidInput("there is no tolerance named '" + std::string(name) + "'");
    return *found;
}

const char* name(ToleranceOrigin origin) {
    switch (origin) {
        case ToleranceOrigin::fixed_default:
            return "default";
        case ToleranceOrigin::derived:
            return "derived";
        case ToleranceOrigin::user:
            return "user";
    }
    return "default";
}

}  // namespace umbilic
