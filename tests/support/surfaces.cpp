// SPDX-License-Identifier: LGPL-2.1-or-later
#include <support/surfaces.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <umbilic/nurbs/area.h>

namespace umbilic::support {

namespace {

double binomial(int n, int k) {
    double result = 1.0;
    for (int i = 1; i <= k; ++i) result = result * (n - k + i) / i;
    return result;
}

/// Rows: Bernstein polynomials of degree n at n + 1 equidistant parameters.
Eigen::MatrixXd bernstein_matrix(int n) {
    Eigen::MatrixXd result(n + 1, n + 1);
    for (int i = 0; i <= n; ++i) {
        const double t = static_cast<double>(i) / n;
        for (int k = 0; k <= n; ++k) result(i, k) = binomial(n, k) * std::pow(t, k) * std::pow(1 - t, n - k);
    }
    return result;
}

std::vector<double> uniform_knots(int degree, int poles) {
    std::vector<double> knots(degree + 1, 0.0);
    const int spans = poles - degree;
    for (int i = 1; i < spans; ++i) knots.push_back(static_cast<double>(i) / spans);
    knots.insert(knots.end(), degree + 1, 1.0);
    return knots;
}

/// Abscissae at which the identity has control points: averages of `degree` consecutive knots.
std::vector<double> greville(const KnotVector& knots) {
    std::vector<double> result;
    for (int i = 0; i < knots.pole_count(); ++i) {
        double sum = 0.0;
        for (int j = 1; j <= knots.degree(); ++j) sum += knots.knots()[i + j];
        result.push_back(sum / knots.degree());
    }
    return result;
}

NurbsSurface graph_net(int p, int q, int nu, int nv, const std::function<double(double, double)>& height,
                       const std::function<double()>& weight) {
    KnotVector u(p, uniform_knots(p, nu)), v(q, uniform_knots(q, nv));
    const std::vector<double> x = greville(u), y = greville(v);
    std::vector<Vector3> poles;
    std::vector<double> weights;
    for (int i = 0; i < nu; ++i)
        for (int j = 0; j < nv; ++j) {
            poles.emplace_back(x[i], y[j], height(x[i], y[j]));
            weights.push_back(weight());
        }
    return NurbsSurface(std::move(u), std::move(v), std::move(poles), std::move(weights));
}

constexpr std::array<double, 3> quarter_weight = {1.0, std::numbers::sqrt2 / 2, 1.0};
const std::array<Vector2, 3> quarter_pole = {Vector2(1, 0), Vector2(1, 1), Vector2(0, 1)};

}  // namespace

NurbsSurface table_3_1_patch() {
    std::vector<Vector3> poles;
    for (int i = 0; i <= 3; ++i)
        for (int j = 0; j <= 3; ++j) {
            double z = 0.0;
            if (j == 1 || j == 2) z = (i == 1 ? 1.0 : i == 2 ? -1.0 : 0.0) * (j == 1 ? 1.0 : 0.6);
            poles.emplace_back(i / 3.0, j / 3.0, z);
        }
    return NurbsSurface(KnotVector::bezier(3), KnotVector::bezier(3), std::move(poles));
}

NurbsSurface graph_patch(int m, int n, const std::function<double(double, double)>& f) {
    Eigen::MatrixXd values(m + 1, n + 1);
    for (int i = 0; i <= m; ++i)
        for (int j = 0; j <= n; ++j) values(i, j) = f(2.0 * i / m - 1.0, 2.0 * j / n - 1.0);
    const Eigen::MatrixXd heights =
        bernstein_matrix(m).fullPivLu().solve(values) * bernstein_matrix(n).fullPivLu().inverse().transpose();
    std::vector<Vector3> poles;
    for (int i = 0; i <= m; ++i)
        for (int j = 0; j <= n; ++j) poles.emplace_back(2.0 * i / m - 1.0, 2.0 * j / n - 1.0, heights(i, j));
    return NurbsSurface(KnotVector::bezier(m), KnotVector::bezier(n), std::move(poles));
}

NurbsSurface monge_patch(double kappa, double a, double b, double c, double d) {
    return graph_patch(3, 3, [=](double x, double y) {
        return -0.5 * kappa * (x * x + y * y) +
               (a * x * x * x + 3 * b * x * x * y + 3 * c * x * y * y + d * y * y * y) / 6;
    });
}

NurbsSurface ellipsoid_octant(double a, double b, double c) {
    std::vector<Vector3> poles;
    std::vector<double> weights;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            const Vector2& around = quarter_pole[i];
            const Vector2& up = quarter_pole[j];
            poles.emplace_back(a * around.x() * up.x(), b * around.y() * up.x(), c * up.y());
            weights.push_back(quarter_weight[i] * quarter_weight[j]);
        }
    return NurbsSurface(KnotVector::bezier(2), KnotVector::bezier(2), std::move(poles), std::move(weights));
}

NurbsSurface torus_quarter(double major, double minor) {
    std::vector<Vector3> poles;
    std::vector<double> weights;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            const Vector2& around = quarter_pole[i];
            const double radius = major + minor * quarter_pole[j].x();
            poles.emplace_back(radius * around.x(), radius * around.y(), minor * quarter_pole[j].y());
            weights.push_back(quarter_weight[i] * quarter_weight[j]);
        }
    return NurbsSurface(KnotVector::bezier(2), KnotVector::bezier(2), std::move(poles), std::move(weights));
}

NurbsSurface smooth_bicubic(int n, unsigned seed, double height) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    std::array<std::array<double, 5>, 4> waves;
    for (auto& wave : waves)
        for (double& x : wave) x = uniform(random);
    return graph_net(
        3, 3, n, n,
        [&](double x, double y) {
            double z = 0.0;
            for (const auto& [a, fx, fy, px, py] : waves)
                z += a * std::sin(4 * fx * x + 3 * px) * std::sin(4 * fy * y + 3 * py);
            return height * z;
        },
        [] { return 1.0; });
}

NurbsSurface revolved(const KnotVector& knots, const std::vector<Vector2>& points, const std::vector<double>& weights) {
    const double w = std::sqrt(0.5);
    const std::vector<Vector2> circle = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {1, 0}};
    std::vector<Vector3> poles;
    std::vector<double> all;
    for (std::size_t i = 0; i < circle.size(); ++i)
        for (std::size_t j = 0; j < points.size(); ++j) {
            poles.emplace_back(points[j].x() * circle[i].x(), points[j].x() * circle[i].y(), points[j].y());
            all.push_back(weights[j] * (i % 2 == 1 ? w : 1.0));
        }
    return NurbsSurface(KnotVector(2, {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}), knots, std::move(poles), std::move(all));
}

NurbsSurface full_sphere(double radius) {
    const double r = radius, w = std::sqrt(0.5);
    return revolved(KnotVector(2, {0, 0, 0, 1, 1, 2, 2, 2}), {{0, -r}, {r, -r}, {r, 0}, {r, r}, {0, r}},
                    {1, w, 1, w, 1});
}

NurbsSurface full_torus(double major, double minor) {
    const double R = major, r = minor, w = std::sqrt(0.5);
    return revolved(
        KnotVector(2, {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}),
        {{R + r, 0}, {R + r, r}, {R, r}, {R - r, r}, {R - r, 0}, {R - r, -r}, {R, -r}, {R + r, -r}, {R + r, 0}},
        {1, w, 1, w, 1, w, 1, w, 1});
}

NurbsSurface full_cone(double r0, double r1, double height) {
    return revolved(KnotVector::bezier(1), {{r0, 0}, {r1, height}}, {1, 1});
}

NurbsSurface rough_bicubic(int n, unsigned seed, double height) {
    return random_surface(3, 3, n, n, seed, height);
}

NurbsSurface random_surface(int p, int q, int nu, int nv, unsigned seed, double height, double weight_ratio) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    std::uniform_real_distribution<double> weight(1.0, std::max(weight_ratio, 1.0 + 1e-300));
    return graph_net(
        p, q, nu, nv, [&](double, double) { return height * uniform(random); },
        [&] { return weight_ratio > 1.0 ? weight(random) : 1.0; });
}

NurbsSurface transformed(const NurbsSurface& surface, const SimilarityTransform& transform) {
    std::vector<Vector3> poles;
    for (const Vector3& pole : surface.poles()) poles.push_back(transform.apply(pole));
    return NurbsSurface(surface.u_knots(), surface.v_knots(), std::move(poles), surface.weights());
}

SimilarityTransform random_similarity(unsigned seed, double scale, bool mirrored, double reach) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform(-reach, reach);
    Eigen::Quaterniond q(normal(random), normal(random), normal(random), normal(random));
    q.normalize();
    SimilarityTransform result;
    result.scale = scale;
    result.rotation = q.toRotationMatrix();
    result.translation = Vector3(uniform(random), uniform(random), uniform(random));
    result.mirrored = mirrored;
    return result;
}

Model model_of(std::vector<NurbsSurface> surfaces) {
    Model model;
    model.source.path = "(generated)";
    model.source.format = "shape";
    model.source.unit = "mm";
    model.shells = 1;
    for (NurbsSurface& surface : surfaces) {
        const ParameterBox domain = surface.domain();
        const double area = surface_area(surface);
        model.box.add(surface.pole_box());
        model.area += area;
        Face face{.number = static_cast<int>(model.faces.size()) + 1,
                  .surface = std::move(surface),
                  .region = TrimmingRegion(domain)};
        face.area = area;
        model.faces.push_back(std::move(face));
    }
    model.declared_faces = static_cast<int>(model.faces.size());
    return model;
}

}  // namespace umbilic::support
