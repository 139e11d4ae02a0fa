// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
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

/// Factors the derived tolerances are made of. `size` is the square root of the smaller model's area, in mm of the
/// original: curvatures are relative to 1 / size. docs/algorithms/tolerances.md says where each number comes from.
namespace tolerance {

/// delta_0 = relative_distance * size: re-approximated copies (1e-4) stay within, redesigned ones (rms 6e-4) do not.
inline constexpr double relative_distance = 3e-4;
/// Files that state a poorer accuracy raise delta_0 to it, but not above this times size: farther apart, unrelated
/// shapes begin to fit.
inline constexpr double largest_relative_distance = 1e-3;
/// delta_1 = relative_kappa / size (thesis 6.2.3: 0.03 / mm on a model of size 33 mm).
inline constexpr double relative_kappa = 1.0;
/// delta_2, radians (thesis 6.2.3).
inline constexpr double direction = 0.06;
/// delta_u = relative_umbilic_distance * size: four times the largest displacement of Table 6.13.
inline constexpr double relative_umbilic_distance = 0.01;
/// delta_s: 20 x 20 cells on a face (thesis 6.2.3).
inline constexpr double cell = 0.05;
/// Copies that deviate by less than this times size (and the files' accuracy) are called exact.
inline constexpr double relative_exactness = 1e-5;

}  // namespace tolerance

/// The tolerances of one comparison, by name: distance, kappa, direction, umbilic-distance, cell, exact-distance. What
/// the user chose stays as it is. `size` and `accuracy` (how far the files themselves may be from the shape they mean)
/// in mm of the original. Throws InvalidInput if size is not positive, or a choice is not finite and positive, or cell
/// is above 1.
std::vector<Tolerance> derive_tolerances(double size, double accuracy, const ToleranceChoices& choices = {});

/// The tolerance of that name. Throws InvalidInput if there is none.
const Tolerance& find_tolerance(std::span<const Tolerance> tolerances, std::string_view name);

const char* name(ToleranceOrigin origin);

}  // namespace umbilic
