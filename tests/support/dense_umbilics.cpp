// SPDX-License-Identifier: LGPL-2.1-or-later
#include <support/dense_umbilics.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>

namespace umbilic::support {

namespace {

using Real = long double;

/// Cells a side of each piece at the start, and how often a cell is halved at most.
constexpr int first_cells = 8;
constexpr int deepest = 14;
/// Remainders of linear models are taken to be this many times what second differences show.
constexpr double safety = 4.0;
/// A cell whose remainder is below this share of the linear part holds at most one umbilic.
constexpr double single = 0.15;
constexpr double outside = 1e-9;

/// Coefficients of 1, s, s^2 ... with t = centre + half * s of the B-splines that do not vanish on a span, by the
/// recursion of Cox and de Boor on polynomials: row a belongs to control point span - degree + a.
std::vector<std::vector<Real>> power_basis(const KnotVector& knots, int span) {
    const std::vector<double>& t = knots.knots();
    const int p = knots.degree();
    const Real centre = (Real(t[span]) + t[span + 1]) / 2, half = (Real(t[span + 1]) - t[span]) / 2;
    // rows[a]: the function number span - degree + a of the current degree, zero polynomials around.
    std::vector<std::vector<Real>> rows(p + 2, std::vector<Real>(p + 1, 0));
    rows[p][0] = 1;
    for (int degree = 1; degree <= p; ++degree) {
        std::vector<std::vector<Real>> next(p + 2, std::vector<Real>(p + 1, 0));
        for (int a = p - degree; a <= p; ++a) {
            const int i = span - p + a;
            const auto add = [&](const std::vector<Real>& lower, Real at_centre, Real slope) {
                for (int k = 0; k < degree; ++k) {
                    next[a][k] += at_centre * lower[k];
                    next[a][k + 1] += slope * lower[k];
                }
            };
            if (a > p - degree) {
                const Real length = Real(t[i + degree]) - t[i];
                add(rows[a], (centre - t[i]) / length, half / length);
            }
            if (a < p) {
                const Real length = Real(t[i + degree + 1]) - t[i + 1];
                add(rows[a + 1], (t[i + degree + 1] - centre) / length, -half / length);
            }
        }
        rows = std::move(next);
    }
    rows.resize(p + 1);
    return rows;
}

/// One polynomial piece over s, t in [-1, 1].
class Piece {
public:
    Piece(const NurbsSurface& surface, int u_span, int v_span)
        : p_(surface.u_degree()), q_(surface.v_degree()), rational_(surface.rational()) {
        const auto bu = power_basis(surface.u_knots(), u_span), bv = power_basis(surface.v_knots(), v_span);
        const Vector3 origin = surface.pole(u_span - p_ / 2, v_span - q_ / 2);
        for (auto& component : exact_) component.assign((p_ + 1) * (q_ + 1), 0);
        for (int a = 0; a <= p_; ++a)
            for (int b = 0; b <= q_; ++b) {
                const int i = u_span - p_ + a, j = v_span - q_ + b;
                const Real w = surface.weight(i, j);
                for (int k = 0; k < 4; ++k) {
                    const Real value = k == 3 ? w : w * (Real(surface.pole(i, j)[k]) - origin[k]);
                    for (int m = 0; m <= p_; ++m)
                        for (int n = 0; n <= q_; ++n) exact_[k][m * (q_ + 1) + n] += value * bu[a][m] * bv[b][n];
                }
            }
        for (int k = 0; k < 4; ++k) rounded_[k].assign(exact_[k].begin(), exact_[k].end());
        const std::vector<double>&x = surface.u_knots().knots(), &y = surface.v_knots().knots();
        domain_ = {{x[u_span], x[u_span + 1]}, {y[v_span], y[v_span + 1]}};
    }

    const ParameterBox& domain() const { return domain_; }

    Vector2 local(const Vector2& at) const {
        return {(at.x() - domain_.u.middle()) / (domain_.u.length() / 2),
                (at.y() - domain_.v.middle()) / (domain_.v.length() / 2)};
    }

    /// Traceless shape operator and, if asked for, r_s and r_t in the same orthonormal frame.
    template <typename T>
    Eigen::Matrix<T, 2, 1> traceless(T s, T t, Eigen::Matrix<T, 2, 2>* frame = nullptr) const {
        using Vector = Eigen::Matrix<T, 3, 1>;
        const std::array<std::vector<T>, 4>& c = coefficients<T>();
        // Horner's scheme for value, first and second derivatives: d[k] = value, s, t, ss, st, tt.
        std::array<Eigen::Matrix<T, 4, 1>, 6> d;
        for (int k = 0; k < (rational_ ? 4 : 3); ++k) {
            T f = 0, f_s = 0, f_ss = 0, g = 0, g_s = 0, h = 0;
            for (int m = p_; m >= 0; --m) {
                const T* row = c[k].data() + m * (q_ + 1);
                T r = 0, r_t = 0, r_tt = 0;
                for (int n = q_; n >= 0; --n) {
                    r_tt = r_tt * t + 2 * r_t;
                    r_t = r_t * t + r;
                    r = r * t + row[n];
                }
                f_ss = f_ss * s + 2 * f_s;
                f_s = f_s * s + f;
                f = f * s + r;
                g_s = g_s * s + g;
                g = g * s + r_t;
                h = h * s + r_tt;
            }
            d[0][k] = f;
            d[1][k] = f_s;
            d[2][k] = g;
            d[3][k] = f_ss;
            d[4][k] = g_s;
            d[5][k] = h;
        }
        std::array<Vector, 6> r;
        for (int k = 0; k < 6; ++k) r[k] = d[k].template head<3>();
        if (rational_) {
            const T w = d[0][3];
            r[0] /= w;
            r[1] = (r[1] - d[1][3] * r[0]) / w;
            r[2] = (r[2] - d[2][3] * r[0]) / w;
            r[3] = (r[3] - 2 * d[1][3] * r[1] - d[3][3] * r[0]) / w;
            r[4] = (r[4] - d[1][3] * r[2] - d[2][3] * r[1] - d[4][3] * r[0]) / w;
            r[5] = (r[5] - 2 * d[2][3] * r[2] - d[5][3] * r[0]) / w;
        }
        // Tangent frame x = r_s / |r_s|, y = n x x: r_s = a x, r_t = b x + c y.
        const T a = r[1].norm();
        const Vector x = r[1] / a;
        const T b = r[2].dot(x);
        const Vector rest = r[2] - b * x;
        const T along = rest.norm();
        const Vector y = rest / along;
        const Vector n = x.cross(y);
        const T L = n.dot(r[3]), M = n.dot(r[4]), N = n.dot(r[5]);
        const T xx = L / (a * a), xy = (M - b / a * L) / (a * along);
        const T yy = (N - 2 * b / a * M + b * b / (a * a) * L) / (along * along);
        if (frame) *frame << a, b, 0, along;
        return {(xx - yy) / 2, xy};
    }

    /// Newton's method in extended precision with central differences; none if it leaves `reach` around the start.
    std::optional<Eigen::Matrix<Real, 2, 1>> newton(const Vector2& start, double reach, double accuracy,
                                                    Matrix2* slope) const {
        Eigen::Matrix<Real, 2, 1> at = start.cast<Real>();
        Eigen::Matrix<Real, 2, 2> jacobian;
        const Real h = 1e-5L;
        Real last = 1;
        for (int step = 0; step < 60; ++step) {
            jacobian.col(0) = (traceless<Real>(at[0] + h, at[1]) - traceless<Real>(at[0] - h, at[1])) / (2 * h);
            jacobian.col(1) = (traceless<Real>(at[0], at[1] + h) - traceless<Real>(at[0], at[1] - h)) / (2 * h);
            const Real determinant = jacobian.determinant();
            if (determinant == 0 || !std::isfinite(determinant)) return std::nullopt;
            const Eigen::Matrix<Real, 2, 1> change = -jacobian.inverse() * traceless<Real>(at[0], at[1]);
            at += change;
            if ((at.cast<double>() - start).cwiseAbs().maxCoeff() > reach) return std::nullopt;
            last = change.norm();
            if (last < 1e-16L) break;
        }
        if (last > accuracy) return std::nullopt;
        if (slope) *slope = jacobian.cast<double>();
        return at;
    }

private:
    template <typename T>
    const std::array<std::vector<T>, 4>& coefficients() const {
        if constexpr (std::is_same_v<T, double>)
            return rounded_;
        else
            return exact_;
    }

    int p_, q_;
    bool rational_;
    ParameterBox domain_;
    std::array<std::vector<Real>, 4> exact_;
    std::array<std::vector<double>, 4> rounded_;
};

class PieceSearch {
public:
    PieceSearch(const Piece& piece, const ParameterBox& whole, SampledUmbilics& result)
        : piece_(piece), whole_(whole), result_(result) {}

    void run() {
        const double side = 2.0 / first_cells;
        for (int i = 0; i < first_cells; ++i)
            for (int j = 0; j < first_cells; ++j)
                cell(-1 + (i + 0.5) * side, -1 + (j + 0.5) * side, side / 2, side / 2, 0);
    }

private:
    void cell(double s, double t, double hs, double ht, int depth) {
        ++result_.cells;
        Vector2 q[3][3];
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) q[i][j] = piece_.traceless<double>(s + (i - 1) * hs, t + (j - 1) * ht);
        const Vector2& middle = q[1][1];
        Matrix2 jacobian;
        jacobian << (q[2][1] - q[0][1]) / 2, (q[1][2] - q[1][0]) / 2;
        const Vector2 remainder = safety * (0.5 * (q[2][1] + q[0][1] - 2 * middle).cwiseAbs() +
                                            0.5 * (q[1][2] + q[1][0] - 2 * middle).cwiseAbs() +
                                            0.25 * (q[2][2] - q[2][0] - q[0][2] + q[0][0]).cwiseAbs());
        const double size = middle.norm();
        if (size > 0.0) {
            const Vector2 towards = middle / size;
            const double least = size - (towards.transpose() * jacobian).cwiseAbs().sum();
            if (least > towards.cwiseAbs().dot(remainder)) return;
        }
        const double determinant = jacobian.determinant();
        if (std::abs(determinant) > 1e-9 * jacobian.squaredNorm()) {
            const Matrix2 inverse = jacobian.inverse();
            const Vector2 step = -inverse * middle, spread = inverse.cwiseAbs() * remainder;
            if ((step.array().abs() > 1 + spread.array()).any()) return;
            if (spread.maxCoeff() < single && accept(Vector2(s, t), Vector2(hs, ht), 2.0)) return;
        }
        if (depth == deepest) {
            if (!accept(Vector2(s, t), Vector2(hs, ht), 4.0)) ++result_.unresolved;
            return;
        }
        for (const int i : {-1, 1})
            for (const int j : {-1, 1}) cell(s + i * hs / 2, t + j * ht / 2, hs / 2, ht / 2, depth + 1);
    }

    /// Follows Newton's method from the middle of a cell, at most `cells` half sides far.
    bool accept(const Vector2& middle, const Vector2& half, double cells) {
        Matrix2 slope;
        const auto found = piece_.newton(middle, cells * half.maxCoeff(), polished_accuracy, &slope);
        if (!found) return false;
        const Vector2 local = found->cast<double>();
        if (local.cwiseAbs().maxCoeff() > 1 + outside) return true;  // the neighbouring piece's
        const ParameterBox& domain = piece_.domain();
        SampledUmbilic umbilic;
        umbilic.at = {domain.u.middle() + local.x() * domain.u.length() / 2,
                      domain.v.middle() + local.y() * domain.v.length() / 2};
        for (const SampledUmbilic& other : result_.umbilics)
            if (std::abs(other.at.x() - umbilic.at.x()) < sampled_distance * whole_.u.length() &&
                std::abs(other.at.y() - umbilic.at.y()) < sampled_distance * whole_.v.length())
                return true;
        umbilic.index = slope.determinant() > 0 ? 0.5 : -0.5;
        Matrix2 frame;
        piece_.traceless<double>(local.x(), local.y(), &frame);
        const Vector2 singular = (slope * frame.inverse()).jacobiSvd().singularValues();
        umbilic.condition = singular[1] / singular[0];
        result_.umbilics.push_back(umbilic);
        return true;
    }

    const Piece& piece_;
    const ParameterBox& whole_;
    SampledUmbilics& result_;
};

}  // namespace

SampledUmbilics sample_umbilics(const NurbsSurface& surface) {
    SampledUmbilics result;
    const ParameterBox whole = surface.domain();
    const std::vector<double>&u = surface.u_knots().knots(), &v = surface.v_knots().knots();
    for (int i = surface.u_degree(); i < surface.u_pole_count(); ++i)
        for (int j = surface.v_degree(); j < surface.v_pole_count(); ++j)
            if (u[i] < u[i + 1] && v[j] < v[j + 1]) PieceSearch(Piece(surface, i, j), whole, result).run();
    return result;
}

std::optional<Vector2> polished_umbilic(const NurbsSurface& surface, const Vector2& at, double accuracy) {
    const Piece piece(surface, surface.u_knots().span(at.x()), surface.v_knots().span(at.y()));
    const ParameterBox whole = surface.domain(), part = piece.domain();
    const double reach = 1e-3 * std::min(whole.u.length() / part.u.length(), whole.v.length() / part.v.length());
    const auto found = piece.newton(piece.local(at), reach, accuracy, nullptr);
    if (!found) return std::nullopt;
    return Vector2(part.u.middle() + static_cast<double>((*found)[0]) * part.u.length() / 2,
                   part.v.middle() + static_cast<double>((*found)[1]) * part.v.length() / 2);
}

}  // namespace umbilic::support
