// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <umbilic/bernstein/tensor_polynomial.h>
#include <umbilic/nurbs/bezier_patch.h>

namespace umbilic {

/// How far the numbers of a surface may lie from those they stand for, absolutely: one ulp of the largest. It decides
/// what is called identically zero, never what is called proved.
struct InputRounding {
    double position = 0.0;  ///< of a coordinate of a control point
    double weight = 0.0;
};

/// One ulp of the largest coordinate and of the largest weight of the surface.
InputRounding input_rounding(const NurbsSurface& surface);

/// Bernstein coefficients of A and B along one edge of a patch, increasing, of one degree.
struct EdgeEquations {
    std::vector<double> a, b;
    double a_error = 0.0, b_error = 0.0;  ///< bounds on the coefficients' errors
};

/// Curvatures of a patch as polynomials (thesis 4.6.2 and Appendix B, without its auxiliary variable), all of one
/// bidegree:
///   integral  K = q / t^2,        H = -s / (2 t^(3/2)),  t = |r_u x r_v|^2, w absent;
///   rational  K = q w^4 / t^2,    H = -s w / (2 t^(3/2)).
/// Coordinates and weights are scaled as EquationScale says.
struct CurvatureEquations {
    bool rational = false;
    TensorPolynomial q, s, t, w;
    /// Nothing but exact zeros was dropped where r_u or r_v vanishes along an edge (q, s and t are divided there by the
    /// fourth, third and second power of the distance from it).
    bool exact = true;
};

/// Polynomials whose common zeros are the umbilics of a Bezier patch:
///   A = E m - F l,  B = E n - G l,  C = F n - G m,
/// with E, F, G and l, m, n the fundamental forms up to common positive factors, without the normalisation of the
/// normal (for rational patches in homogeneous form); A du^2 + B du dv + C dv^2 = 0 are the principal directions.
/// Coordinates and weights are scaled by powers of two first; parameters are the patch's own on [0, 1]^2. Derivation,
/// degrees and bounds: docs/numerics.md. Memory is kept from patch to patch.
class UmbilicEquations {
public:
    /// Forms E, F, G, l, m, n.
    void form_fundamental(const BezierPatch& patch, const InputRounding& input);
    /// The same with a bound for every single coefficient (TensorPolynomial::errors), here and in what is formed next.
    /// `patch` is one of `surface`.
    void form_fundamental_with_errors(const NurbsSurface& surface, const BezierPatch& patch,
                                      const InputRounding& input);
    /// True if interval products of coefficient hulls prove that A, B or C has no zero on the patch. Needs
    /// form_fundamental.
    bool excluded_by_hulls() const;
    /// Forms A and B and raises both to one bidegree. Needs form_fundamental.
    void form_umbilic();

    /// Forms K and H. Needs form_fundamental; `result` keeps its memory.
    void form_curvature(CurvatureEquations& result);

    /// P_N = B^2 - 4 A C, which is zero at umbilics and positive elsewhere (thesis (2.24), (2.25), (3.44)). Degrees
    /// (10p - 6, 10q - 6), rational (16p - 10, 16q - 10): below the thesis's. Needs form_fundamental only. Throws
    /// Unsupported if a degree is above maximum_product_degree.
    TensorPolynomial discriminant() const;

    const TensorPolynomial& a() const { return a_; }
    const TensorPolynomial& b() const { return b_; }

    /// Values of A and B at a point of the patch, which may lie a little outside [0, 1]^2, in interval arithmetic from
    /// the control points, taken as exact up to their extraction: far tighter than the coefficients' bounds. Needs
    /// form_fundamental only; not for equations divided by edges.
    std::array<Interval, 2> enclose(const Vector2& at) const;

    /// Restriction to an edge. Needs form_fundamental only.
    EdgeEquations edge_equations(PatchEdge edge) const;

    /// Edges along which r_u or r_v vanishes within the input's rounding: poles, where the edge is one point, and edges
    /// whose control points coincide with those of the next row. A and B are zero there, whatever the surface. Needs
    /// form_fundamental.
    bool singular(PatchEdge edge) const { return singular_[static_cast<int>(edge)]; }
    /// A and B vanish along an edge that is not singular, within the input's rounding, but not on the whole patch: a
    /// line of umbilics along a knot line, or the border of a region. Needs form_umbilic.
    bool umbilic(PatchEdge edge) const;
    /// Divides A and B by the powers of the distance from these edges that they contain, as far as they vanish there
    /// within the input's rounding, and raises both to one bidegree again. At a simple pole A contains the fourth
    /// power and B the third; both one more if the pole is umbilic, and still more if its cubic form vanishes.
    /// What is left are the equations of a surface that rounds to the given one. Needs form_umbilic.
    void divide_by_edges(const std::array<bool, 4>& edges);
    /// Divides A and B by the powers pole_powers() of the distance from these edges, which must be collapsed() to one
    /// point exactly: what is left are the equations of the given surface. Needs form_umbilic.
    void divide_by_poles(const std::array<bool, 4>& edges);

private:
    using Vector3Polynomial = std::array<TensorPolynomial, 3>;
    using Vector4Polynomial = std::array<TensorPolynomial, 4>;

    void load(const BezierPatch& patch, const InputRounding& input);
    void form_loaded();
    void find_singular_edges();
    /// |N|^2, rational |N3|^2 with N3 = w P_u x P_v + w_v P x P_u - w_u P x P_v.
    void form_normal_square(TensorPolynomial& result);
    void form_integral();
    void form_rational();
    /// Component k of the differences of order (u_order, v_order) of the control net, times `factor`, starting at pole
    /// (i + u_start, j + v_start), for the degrees that leaves (dropping further rows for `u_drop`, `v_drop`).
    void difference(int k, int u_order, int v_order, double factor, TensorPolynomial& result) const;
    /// Component k of the net without its first `u_start` (`v_start`) and last `u_drop - u_start` (...) rows, times
    /// `factor`: a polar form of P.
    void sub_net(int k, int u_start, int u_drop, int v_start, int v_drop, double factor,
                 TensorPolynomial& result) const;
    void determinant(const Vector4Polynomial& a, const Vector4Polynomial& b, const Vector4Polynomial& c,
                     const Vector4Polynomial& d, TensorPolynomial& result);

    int p_ = 0, q_ = 0;
    bool rational_ = false;
    std::array<bool, 4> singular_{};
    /// Bernstein coefficients of the homogeneous components x, y, z, w.
    std::array<std::vector<double>, 4> net_;
    std::array<double, 4> net_magnitude_{};
    std::array<CoefficientBound, 4> net_bound_;
    /// Bound for every entry of net_, the input taken as rounded; empty unless asked for.
    std::array<std::vector<double>, 4> net_errors_;

    TensorPolynomial e_, f_, g_, l_, m_, n_, a_, b_;
    Vector3Polynomial u_, v_, uu_, uv_, vv_, normal_;
    std::array<Vector4Polynomial, 4> part_;
    std::array<TensorPolynomial, 6> minor_, other_minor_;
};

/// True if the edge of the patch lies on a side of the surface's domain that is one point exactly: clamped there, and
/// all control points of that side are equal.
bool collapsed(const NurbsSurface& surface, const BezierPatch& patch, PatchEdge edge);

/// Powers of the distance from a collapsed edge that A and B contain whatever the surface.
struct PolePowers {
    int a = 0, b = 0;
};
PolePowers pole_powers(PatchEdge edge);

/// Values of A and B, scaled as in UmbilicEquations, at a point of the patch, which may lie a little outside [0, 1]^2:
/// in arithmetic of 113 bits from the control points of `surface`, taken as exact. Far tighter than
/// UmbilicEquations::enclose and a hundred times slower.
std::array<Interval, 2> enclose_precisely(const NurbsSurface& surface, const BezierPatch& patch, const Vector2& at);

/// Powers of two that coordinates and weights of a patch are multiplied by in its equations.
struct EquationScale {
    double position = 1.0;
    double weight = 1.0;
};
EquationScale equation_scale(const BezierPatch& patch);

}  // namespace umbilic
