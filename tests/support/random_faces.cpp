// SPDX-License-Identifier: LGPL-2.1-or-later
#include <support/random_faces.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include <Eigen/QR>

#include <support/surfaces.h>

namespace umbilic::support {

namespace {

enum class Layout { even, uneven, double_knots, full_multiplicity, unclamped };
constexpr std::array<const char*, 5> layout_names = {"even", "uneven", "double", "full", "unclamped"};

KnotVector random_knots(int degree, int spans, Layout layout, std::mt19937& random) {
    std::uniform_real_distribution<double> step(0.15, 1.5);
    std::vector<double> breaks = {0.0};
    for (int i = 0; i < spans; ++i) breaks.push_back(breaks.back() + (layout == Layout::even ? 1.0 : step(random)));
    std::vector<double> knots;
    if (layout == Layout::unclamped) {
        for (int i = degree; i > 0; --i) knots.push_back(-0.8 * i);
        knots.insert(knots.end(), breaks.begin(), breaks.end());
        for (int i = 1; i <= degree; ++i) knots.push_back(breaks.back() + 1.1 * i);
        return KnotVector(degree, std::move(knots));
    }
    const int multiplicity = layout == Layout::double_knots        ? std::min(2, degree)
                             : layout == Layout::full_multiplicity ? degree
                                                                   : 1;
    knots.assign(degree + 1, breaks.front());
    for (int i = 1; i < spans; ++i) knots.insert(knots.end(), multiplicity, breaks[i]);
    knots.insert(knots.end(), degree + 1, breaks.back());
    return KnotVector(degree, std::move(knots));
}

/// k-th derivative of x^i.
double power(double x, int i, int k) {
    double factor = 1.0;
    for (int j = 0; j < k; ++j) factor *= i - j;
    return i < k ? 0.0 : factor * std::pow(x, i - k);
}

}  // namespace

RandomFace random_face(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const auto pick = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
    const int p = pick(2, 7), q = pick(2, 7);
    const auto layout = static_cast<Layout>(pick(0, 4));
    const KnotVector u = random_knots(p, pick(1, 4), layout, random), v = random_knots(q, pick(1, 4), layout, random);
    const bool rational = pick(0, 1) == 1, smooth = pick(0, 2) == 0;
    const double ratio = std::pow(10.0, 0.5 + 0.5 * uniform(random));
    const double height = 0.1 * std::pow(5.0, uniform(random)), jitter = 0.2;
    std::array<double, 6> wave;
    for (double& x : wave) x = 3 * uniform(random);

    const int nu = u.pole_count(), nv = v.pole_count();
    std::vector<Vector3> poles;
    std::vector<double> weights;
    for (int i = 0; i < nu; ++i)
        for (int j = 0; j < nv; ++j) {
            const double x = i / (nu - 1.0), y = j / (nv - 1.0);
            const double z =
                smooth ? std::sin(wave[0] * x + wave[1] * y + wave[2]) + std::cos(wave[3] * x + wave[4] * y + wave[5])
                       : 2 * uniform(random);
            poles.emplace_back(x + jitter / nu * uniform(random), y + jitter / nv * uniform(random),
                               height * z + 0.02 * height * uniform(random));
            if (rational) weights.push_back(std::pow(ratio, 0.5 + 0.5 * uniform(random)));
        }
    const double scale = std::pow(10.0, 0.5 + 2.5 * uniform(random));
    const NurbsSurface surface(u, v, std::move(poles), std::move(weights));
    RandomFace face{transformed(surface, random_similarity(seed, scale, false, 10 * scale))};
    face.description = "degrees " + std::to_string(p) + " " + std::to_string(q) + ", poles " + std::to_string(nu) +
                       " " + std::to_string(nv) + ", " + layout_names[static_cast<int>(layout)] + " knots" +
                       (rational ? ", weight ratio " + std::to_string(ratio) : ", polynomial") +
                       (smooth ? ", smooth" : ", rough");
    return face;
}

NurbsSurface with_planted_umbilics(const std::vector<Vector2>& places, unsigned seed) {
    constexpr int n = 8;
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    Eigen::VectorXd c(n * n);
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) c[i * n + j] = 0.5 * normal(random) / std::pow(1.0 + i + j, 1.5);
    // Rows: f_x, f_y, f_xx - f_yy and f_xy at the places; the random polynomial is projected to where they vanish.
    Eigen::MatrixXd rows(4 * places.size(), n * n);
    for (std::size_t k = 0; k < places.size(); ++k)
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                const double x = places[k].x(), y = places[k].y();
                const int at = i * n + j, row = 4 * static_cast<int>(k);
                rows(row, at) = power(x, i, 1) * power(y, j, 0);
                rows(row + 1, at) = power(x, i, 0) * power(y, j, 1);
                rows(row + 2, at) = power(x, i, 2) * power(y, j, 0) - power(x, i, 0) * power(y, j, 2);
                rows(row + 3, at) = power(x, i, 1) * power(y, j, 1);
            }
    const Eigen::VectorXd projected = c - rows.completeOrthogonalDecomposition().solve(rows * c);
    return graph_patch(n - 1, n - 1, [&](double x, double y) {
        double sum = 0.0;
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) sum += projected[i * n + j] * power(x, i, 0) * power(y, j, 0);
        return sum;
    });
}

}  // namespace umbilic::support
