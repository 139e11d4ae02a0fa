// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include <umbilic/bernstein/coefficient_array.h>
#include <umbilic/bernstein/subdivision.h>
#include <umbilic/bernstein/tensor_polynomial.h>
#include <umbilic/core/progress.h>
#include <umbilic/core/types.h>

namespace umbilic {

/// Both polynomials below this multiple of the bound from the input's rounding: identically zero. A few ulps, since
/// control points rarely come from a single rounding.
inline constexpr double zero_factor = 4.0;

/// A proved simple common zero.
struct IsolatedZero {
    Vector2 at = Vector2::Zero();
    /// Bound on the distance of `at` from the zero, per coordinate, with the input taken as exact.
    Vector2 radius = Vector2::Zero();
    /// The same, with the input taken as rounded.
    Vector2 input_radius = Vector2::Zero();
    ParameterBox box;  ///< exactly one zero lies in it; may reach out of [0, 1]^2, to which both polynomials continue
    int sign = 0;      ///< sign of the Jacobian determinant of (a, b) at the zero
};

/// A box that could be neither excluded nor proved.
struct OpenBox {
    ParameterBox box;
    bool zero = false;  ///< both polynomials are zero on it within the input's rounding
    /// Greater share that the bound from the input's rounding has in the size of the two polynomials on it.
    double doubt = 0.0;
    ParameterBox origin;  ///< the box of the first search that it was refined from, or itself
};

struct CommonZeros {
    std::vector<IsolatedZero> isolated;
    std::vector<OpenBox> open;
    long boxes = 0;  ///< visited
    bool exhausted = false;

    void clear();
};

struct SearchLimits {
    double u_size = 1e-3;  ///< boxes are not split in a direction in which they are at most this long
    double v_size = 1e-3;
    long boxes = 100000;  ///< visited before the rest is left open
    /// Radius (in u and v) above which a zero's place is improved by the precise enclosure, if there is one.
    double u_radius = 0.0, v_radius = 0.0;
};

/// Common zeros in [0, 1]^2 of two bivariate polynomials of the same bidegree by subdivision in the Bernstein basis,
/// with exclusion by convex hulls, preconditioning by the mean derivative and proof by a contraction (docs/numerics.md,
/// section "Search"). Memory is kept from call to call.
class CommonZeroSearch {
public:
    /// Values of both polynomials at a point, enclosed.
    using Enclosure = std::function<std::array<Interval, 2>(const Vector2& at)>;

    /// Takes the polynomials; they are scaled to one magnitude by powers of two. If both have `errors`, every box has
    /// its own bounds. `enclosure`, if there is one, gives tighter values at single points than the coefficients with
    /// their common bound; it makes the radii smaller. `precise` is slow and used only for radii that are still too
    /// large.
    void set_polynomials(const TensorPolynomial& a, const TensorPolynomial& b, Enclosure enclosure = {},
                         Enclosure precise = {});

    /// Largest bound on the coefficients' errors on a part of [0, 1]^2, relative to the polynomials' sizes.
    double largest_error(const ParameterBox& part);

    /// Searches `part` of [0, 1]^2 and appends what it finds. Throws Cancelled.
    void search(const ParameterBox& part, const SearchLimits& limits, const Progress& progress, CommonZeros& result);

    /// Number of zeros in `part` of [0, 1]^2, 0 or 1, if it can be proved without splitting; the one is appended.
    std::optional<int> count(const ParameterBox& part, CommonZeros& result);

    /// Appends a zero unless `result` holds the same one already.
    static void add_zero(const IsolatedZero& zero, CommonZeros& result);

private:
    /// Bounds on the errors of the coefficients of a and b on one box.
    struct Bounds {
        CoefficientBound a, b;
    };
    struct Node {
        ParameterBox box;
        Bounds bounds;
    };
    enum class Outcome { empty, isolated, zero, split };
    struct Residual {
        Vector2 value;
        double rounding[2];  ///< bounds on the error of each component of `value`
        double input[2];
    };

    /// Brings the polynomials, and the errors, to `part` of [0, 1]^2 in the first slot, with their bounds.
    Bounds load(const ParameterBox& part);
    Bounds with_local_errors(const double* coefficients, Bounds bounds) const;
    void sharpen(const Matrix2& preconditioner, double norm, const Vector2& scale, const ParameterBox& box,
                 IsolatedZero& zero) const;
    Outcome examine(const Node& node, const double* coefficients, CommonZeros& result);
    Outcome isolate(const Node& node, const double* coefficients, const Matrix2& preconditioner, double contraction,
                    CommonZeros& result);
    /// True if the combination of a and b with these weights has positive coefficients only.
    bool combination_excludes(const Node& node, const double* coefficients, const Vector2& weights) const;
    /// The same for weights turned from the mean pair of coefficients towards the point of the pairs' convex hull that
    /// is nearest to 0 (Gilbert's algorithm). Gives up at once if a pair lies farther behind 0 than their mean before
    /// it.
    bool excluded_beside(const Node& node, const double* coefficients, const Vector2& mean);
    bool newton(const double* coefficients, Vector2& at);
    void evaluate(const double* coefficients, const Vector2& at, Vector2& value, Matrix2* jacobian);
    Residual residual(const double* coefficients, const Bounds& bounds, const Matrix2& preconditioner,
                      const Vector2& at);
    /// Row-sum norm of I - g', g = preconditioner (a, b), over the whole box; none if g has a component without zero.
    std::optional<double> contraction(const double* coefficients, const Bounds& bounds, const Matrix2& preconditioner);

    CoefficientShape shape_;
    int arrays_ = 2;            ///< per box: coefficients of a, of b, and their errors if there are any
    std::vector<double> root_;  ///< these arrays on [0, 1]^2
    Bounds root_bounds_;
    std::array<double, 2> scale_{};
    Enclosure enclosure_, precise_;
    Vector2 wanted_radius_ = Vector2::Zero();
    std::vector<double> slots_;  ///< `arrays_` arrays per open node of the depth-first tree
    std::vector<Node> nodes_;
    std::vector<double> combined_, enlarged_;
    BernsteinPoint point_;
    std::array<double, 2> magnitude_{};
    double u_variation_ = 0.0, v_variation_ = 0.0;
};

}  // namespace umbilic
