// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/points/multilevel_spline.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <umbilic/core/errors.h>

namespace umbilic {

namespace {

constexpr int most_levels = 12;

/// Control lattice of a uniform bicubic spline over pieces (u) x pieces (v) of [0, 1]^2.
struct Lattice {
    int u_pieces = 1, v_pieces = 1;
    std::vector<Vector3> controls;  ///< (u_pieces + 3) x (v_pieces + 3)

    Lattice(int u, int v)
        : u_pieces(u), v_pieces(v), controls(static_cast<std::size_t>(rows()) * columns(), Vector3::Zero()) {}
    int rows() const { return u_pieces + 3; }
    int columns() const { return v_pieces + 3; }
    Vector3& at(int i, int j) { return controls[i * columns() + j]; }
    const Vector3& at(int i, int j) const { return controls[i * columns() + j]; }
};

/// Uniform cubic basis at the part t in [0, 1] of a piece.
std::array<double, 4> cubic_basis(double t) {
    const double s = 1.0 - t;
    return {s * s * s / 6.0, (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0,
            (-3.0 * t * t * t + 3.0 * t * t + 3.0 * t + 1.0) / 6.0, t * t * t / 6.0};
}

struct Place {
    int piece = 0;
    std::array<double, 4> basis;
};

Place place_of(double parameter, int pieces) {
    const double x = parameter * pieces;
    const int piece = std::min(static_cast<int>(x), pieces - 1);
    return {piece, cubic_basis(x - piece)};
}

Vector3 value(const Lattice& lattice, double u, double v) {
    const Place a = place_of(u, lattice.u_pieces), b = place_of(v, lattice.v_pieces);
    Vector3 sum = Vector3::Zero();
    for (int k = 0; k < 4; ++k)
        for (int l = 0; l < 4; ++l) sum += a.basis[k] * b.basis[l] * lattice.at(a.piece + k, b.piece + l);
    return sum;
}

/// One level: each point asks its 16 controls for the least change that meets it; a control takes the mean of what it
/// is asked for, weighted by its squared basis function (BA algorithm).
Lattice approximated(const std::vector<Vector3>& wanted, std::span<const ParametrisedPoint> points, int u, int v) {
    Lattice lattice(u, v);
    std::vector<double> weights(lattice.controls.size(), 0.0);
    for (std::size_t c = 0; c < points.size(); ++c) {
        const Place a = place_of(points[c].u, u), b = place_of(points[c].v, v);
        double squares = 0.0;
        for (const double x : a.basis)
            for (const double y : b.basis) squares += x * x * y * y;
        for (int k = 0; k < 4; ++k)
            for (int l = 0; l < 4; ++l) {
                const double w = a.basis[k] * b.basis[l];
                const int at = (a.piece + k) * lattice.columns() + b.piece + l;
                lattice.controls[at] += w * w * (w / squares) * wanted[c];
                weights[at] += w * w;
            }
    }
    for (std::size_t i = 0; i < weights.size(); ++i)
        if (weights[i] > 0.0) lattice.controls[i] /= weights[i];
    return lattice;
}

/// Controls of the same curve on pieces of half the length.
std::vector<Vector3> halved(const std::vector<Vector3>& controls) {
    const int pieces = static_cast<int>(controls.size()) - 3;
    std::vector<Vector3> fine(2 * pieces + 3);
    for (int i = 0; i < static_cast<int>(fine.size()); ++i) {
        const int k = i / 2;
        fine[i] = i % 2 == 0 ? Vector3(0.5 * (controls[k] + controls[k + 1]))
                             : Vector3((controls[k] + 6.0 * controls[k + 1] + controls[k + 2]) / 8.0);
    }
    return fine;
}

Lattice halved(const Lattice& lattice) {
    Lattice by_columns(lattice.u_pieces, 2 * lattice.v_pieces);
    for (int i = 0; i < lattice.rows(); ++i) {
        std::vector<Vector3> line;
        for (int j = 0; j < lattice.columns(); ++j) line.push_back(lattice.at(i, j));
        line = halved(line);
        for (int j = 0; j < by_columns.columns(); ++j) by_columns.at(i, j) = line[j];
    }
    Lattice result(2 * lattice.u_pieces, 2 * lattice.v_pieces);
    for (int j = 0; j < result.columns(); ++j) {
        std::vector<Vector3> line;
        for (int i = 0; i < by_columns.rows(); ++i) line.push_back(by_columns.at(i, j));
        line = halved(line);
        for (int i = 0; i < result.rows(); ++i) result.at(i, j) = line[i];
    }
    return result;
}

/// Averages of three successive knots: as many places as poles, at which a cubic spline is determined.
std::vector<double> greville_abscissae(const KnotVector& knots) {
    std::vector<double> places;
    for (int i = 0; i < knots.pole_count(); ++i)
        places.push_back((knots.knots()[i + 1] + knots.knots()[i + 2] + knots.knots()[i + 3]) / 3.0);
    return places;
}

/// The spline over the same pieces with clamped knots, as files and kernels expect them.
NurbsSurface clamped(const Lattice& lattice) {
    const KnotVector u_knots = uniform_knots(3, lattice.rows()), v_knots = uniform_knots(3, lattice.columns());
    const std::vector<double> u = greville_abscissae(u_knots), v = greville_abscissae(v_knots);
    PointGrid grid{lattice.rows(), lattice.columns(), {}};
    for (const double a : u)
        for (const double b : v) grid.points.push_back(value(lattice, a, b));
    return fit_grid(grid, u, v, u_knots, v_knots);
}

void check(std::span<const ParametrisedPoint> points, const MultilevelOptions& options) {
    if (points.empty()) throw InvalidInput("multilevel spline: there is no point");
    if (options.u_start < 1 || options.v_start < 1 || options.levels < 1 || options.levels > most_levels)
        throw InvalidInput("multilevel spline: pieces and levels must be at least 1, levels at most " +
                           std::to_string(most_levels));
    for (const ParametrisedPoint& p : points)
        if (!(p.u >= 0.0 && p.u <= 1.0 && p.v >= 0.0 && p.v <= 1.0))
            throw InvalidInput("multilevel spline: a parameter lies outside [0, 1]");
}

}  // namespace

MultilevelSpline multilevel_spline(std::span<const ParametrisedPoint> points, const MultilevelOptions& options,
                                   const Progress& progress) {
    check(points, options);
    // Controls without points near them stay 0: that must be in the middle of the points.
    Vector3 centre = Vector3::Zero();
    for (const ParametrisedPoint& p : points) centre += p.point / static_cast<double>(points.size());
    std::vector<Vector3> left;
    for (const ParametrisedPoint& p : points) left.push_back(p.point - centre);

    std::vector<double> rms, maximum;
    Lattice sum(options.u_start, options.v_start);
    for (int level = 0; level < options.levels; ++level) {
        progress.report(static_cast<double>(level) / options.levels, "multilevel spline");
        if (level > 0) sum = halved(sum);
        const Lattice step = approximated(left, points, sum.u_pieces, sum.v_pieces);
        for (std::size_t i = 0; i < sum.controls.size(); ++i) sum.controls[i] += step.controls[i];
        double square = 0.0, greatest = 0.0;
        for (std::size_t c = 0; c < points.size(); ++c) {
            left[c] -= value(step, points[c].u, points[c].v);
            square += left[c].squaredNorm();
            greatest = std::max(greatest, left[c].norm());
        }
        rms.push_back(std::sqrt(square / static_cast<double>(points.size())));
        maximum.push_back(greatest);
        if (greatest <= options.tolerance) break;
    }
    for (Vector3& control : sum.controls) control += centre;
    return {clamped(sum), std::move(rms), std::move(maximum)};
}

}  // namespace umbilic
