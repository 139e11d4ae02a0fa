// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/points/least_squares_surface.h>

#include <array>
#include <functional>

#include <Eigen/SVD>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <umbilic/core/errors.h>

namespace umbilic {

namespace {

using Coordinates = Eigen::Matrix<double, Eigen::Dynamic, 3>;

void check_net(int degree, int poles) {
    if (degree < 1 || degree > maximum_degree || poles <= degree)
        throw InvalidInput("fit: a direction of degree " + std::to_string(degree) + " needs at least " +
                           std::to_string(degree + 1) + " poles, not " + std::to_string(poles));
}

void check_grid(const PointGrid& grid) {
    if (grid.rows < 2 || grid.columns < 2 ||
        grid.points.size() != static_cast<std::size_t>(grid.rows) * static_cast<std::size_t>(grid.columns))
        throw InvalidInput("fit: " + std::to_string(grid.points.size()) + " points are no grid of " +
                           std::to_string(grid.rows) + " x " + std::to_string(grid.columns));
}

/// Rows of basis functions, one for each parameter.
Eigen::MatrixXd collocation(const KnotVector& knots, std::span<const double> parameters) {
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(parameters.size()), knots.pole_count());
    std::vector<double> values(knots.degree() + 1);
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        const int span = knots.span(parameters[i]);
        knots.basis(span, parameters[i], 0, values.data());
        for (int k = 0; k <= knots.degree(); ++k)
            matrix(static_cast<Eigen::Index>(i), span - knots.degree() + k) = values[k];
    }
    return matrix;
}

/// Averages over the lines of a grid the chord lengths along them, each from 0 to 1.
std::vector<double> averaged_chords(int count, int lines, const std::function<const Vector3&(int, int)>& at,
                                    const char* direction) {
    std::vector<double> sum(count, 0.0);
    int used = 0;
    for (int line = 0; line < lines; ++line) {
        std::vector<double> until(count, 0.0);
        for (int i = 1; i < count; ++i) until[i] = until[i - 1] + (at(line, i) - at(line, i - 1)).norm();
        if (!(until.back() > 0.0)) continue;  // a line that is one point (a pole) has no lengths
        for (int i = 0; i < count; ++i) sum[i] += until[i] / until.back();
        ++used;
    }
    if (used == 0) throw InvalidInput(std::string("fit: the points of the grid coincide along ") + direction);
    for (double& u : sum) u /= used;
    sum.back() = 1.0;
    return sum;
}

/// Coefficients of the difference P_(i-1) - 2 P_i + P_(i+1) along both directions, for every inner pole.
template <class Visit>
void for_each_second_difference(int m, int n, const Visit& visit) {
    for (int i = 0; i < m; ++i)
        for (int j = 0; j < n; ++j) {
            if (i > 0 && i + 1 < m) visit((i - 1) * n + j, i * n + j, (i + 1) * n + j);
            if (j > 0 && j + 1 < n) visit(i * n + j - 1, i * n + j, i * n + j + 1);
        }
}

}  // namespace

KnotVector fitting_knots(int degree, int poles, std::span<const double> parameters) {
    check_net(degree, poles);
    const int count = static_cast<int>(parameters.size());
    if (poles > count)
        throw InvalidInput("fit: " + std::to_string(poles) + " poles are more than the " + std::to_string(count) +
                           " points along that direction determine");
    std::vector<double> knots(degree + 1, 0.0);
    const double step = static_cast<double>(count) / (poles - degree);
    for (int j = 1; j < poles - degree; ++j) {
        const int i = static_cast<int>(j * step);
        const double part = j * step - i;
        knots.push_back((1.0 - part) * parameters[i - 1] + part * parameters[i]);
    }
    knots.insert(knots.end(), degree + 1, 1.0);
    return {degree, std::move(knots)};
}

KnotVector uniform_knots(int degree, int poles) {
    check_net(degree, poles);
    std::vector<double> knots(degree + 1, 0.0);
    for (int j = 1; j < poles - degree; ++j) knots.push_back(static_cast<double>(j) / (poles - degree));
    knots.insert(knots.end(), degree + 1, 1.0);
    return {degree, std::move(knots)};
}

std::vector<double> chord_length_u(const PointGrid& grid) {
    check_grid(grid);
    return averaged_chords(
        grid.rows, grid.columns, [&](int j, int i) -> const Vector3& { return grid.points[i * grid.columns + j]; },
        "its rows");
}

std::vector<double> chord_length_v(const PointGrid& grid) {
    check_grid(grid);
    return averaged_chords(
        grid.columns, grid.rows, [&](int i, int j) -> const Vector3& { return grid.points[i * grid.columns + j]; },
        "its columns");
}

NurbsSurface fit_grid(const PointGrid& grid, std::span<const double> u, std::span<const double> v,
                      const KnotVector& u_knots, const KnotVector& v_knots) {
    check_grid(grid);
    if (static_cast<int>(u.size()) != grid.rows || static_cast<int>(v.size()) != grid.columns)
        throw InvalidInput("fit: the numbers of parameters do not fit the grid");
    const Eigen::MatrixXd along_u = collocation(u_knots, u), along_v = collocation(v_knots, v);
    constexpr int thin = Eigen::ComputeThinU | Eigen::ComputeThinV;
    const Eigen::BDCSVD<Eigen::MatrixXd> u_solver(along_u, thin), v_solver(along_v, thin);
    std::vector<Vector3> poles(static_cast<std::size_t>(u_knots.pole_count()) * v_knots.pole_count());
    for (int axis = 0; axis < 3; ++axis) {
        Eigen::MatrixXd values(grid.rows, grid.columns);
        for (int i = 0; i < grid.rows; ++i)
            for (int j = 0; j < grid.columns; ++j) values(i, j) = grid.points[i * grid.columns + j][axis];
        const Eigen::MatrixXd by_rows = u_solver.solve(values);
        const Eigen::MatrixXd net = v_solver.solve(by_rows.transpose()).transpose();
        for (int i = 0; i < net.rows(); ++i)
            for (int j = 0; j < net.cols(); ++j) poles[i * net.cols() + j][axis] = net(i, j);
    }
    return {u_knots, v_knots, std::move(poles)};
}

NurbsSurface fit_scattered(std::span<const ParametrisedPoint> points, const KnotVector& u_knots,
                           const KnotVector& v_knots, double fairness) {
    if (points.empty()) throw InvalidInput("fit: there is no point");
    const int p = u_knots.degree(), q = v_knots.degree(), m = u_knots.pole_count(), n = v_knots.pole_count();
    const int count = m * n;
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(points.size() * (p + 1) * (q + 1));
    std::vector<double> along_u(p + 1), along_v(q + 1);
    Coordinates values(static_cast<Eigen::Index>(points.size()), 3);
    for (std::size_t k = 0; k < points.size(); ++k) {
        const auto& [u, v, point] = points[k];
        if (!(u_knots.domain().contains(u) && v_knots.domain().contains(v)))
            throw InvalidInput("fit: a parameter lies outside the knots' domain");
        const int i = u_knots.span(u), j = v_knots.span(v);
        u_knots.basis(i, u, 0, along_u.data());
        v_knots.basis(j, v, 0, along_v.data());
        for (int a = 0; a <= p; ++a)
            for (int b = 0; b <= q; ++b)
                entries.emplace_back(static_cast<int>(k), (i - p + a) * n + j - q + b, along_u[a] * along_v[b]);
        values.row(static_cast<Eigen::Index>(k)) = point.transpose();
    }
    Eigen::SparseMatrix<double> matrix(static_cast<Eigen::Index>(points.size()), count);
    matrix.setFromTriplets(entries.begin(), entries.end());
    Eigen::SparseMatrix<double> normal = matrix.transpose() * matrix;
    const double weight = fairness * normal.diagonal().sum() / count;
    if (weight > 0.0) {
        entries.clear();
        for_each_second_difference(m, n, [&](int a, int b, int c) {
            const std::array<std::pair<int, double>, 3> row = {{{a, 1.0}, {b, -2.0}, {c, 1.0}}};
            for (const auto& [x, x_factor] : row)
                for (const auto& [y, y_factor] : row) entries.emplace_back(x, y, weight * x_factor * y_factor);
        });
        Eigen::SparseMatrix<double> smooth(count, count);
        smooth.setFromTriplets(entries.begin(), entries.end());
        normal += smooth;
    }
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(normal);
    if (solver.info() != Eigen::Success || !(solver.vectorD().minCoeff() > 0.0))
        throw NumericFailure("fit: the points do not determine a net of " + std::to_string(m) + " x " +
                             std::to_string(n) + " poles; ask for fewer");
    const Coordinates net = solver.solve(Coordinates(matrix.transpose() * values));
    std::vector<Vector3> poles(count);
    for (int k = 0; k < count; ++k) poles[k] = net.row(k).transpose();
    return {u_knots, v_knots, std::move(poles)};
}

}  // namespace umbilic
