// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/wireframe/face_frame.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace umbilic {

namespace {

constexpr std::array<double, 3> gauss_node = {-0.7745966692414834, 0.0, 0.7745966692414834};
constexpr std::array<double, 3> gauss_weight = {0.5555555555555556, 0.8888888888888888, 0.5555555555555556};
/// Parts of the domain along each parameter at least, on each of which the quadrature is used: for the centroid of a
/// surface without border, and for the third moments of one with a border.
constexpr int parts_for_centroid = 24, parts_for_moments = 12;
/// Lengths that differ by less than this share are equal.
constexpr double tie = 1e-6;
/// Shares of what makes up the direction, beside the third moments. None is small: what they decide shall be clear
/// of rounding, and of the lengths that the net takes for equal.
constexpr double model_share = 0.37;
/// Lengths that rank the principal axes, the shortest first.
constexpr std::array<double, 3> axis_length = {0.8, 0.9, 1.0};
constexpr std::array<double, 3> corner_share = {0.5, 0.3, 0.2};

WeightedPoints area_points(const NurbsSurface& surface, int fewest_parts) {
    WeightedPoints result;
    const auto ends = [&](const std::vector<double>& breaks) {
        const int parts = (fewest_parts - 1) / static_cast<int>(breaks.size() - 1) + 1;
        std::vector<double> all;
        for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
            for (int k = 0; k < parts; ++k) all.push_back(breaks[i] + (breaks[i + 1] - breaks[i]) * k / parts);
        all.push_back(breaks.back());
        return all;
    };
    const std::vector<double> u = ends(surface.u_knots().breaks()), v = ends(surface.v_knots().breaks());
    for (std::size_t i = 0; i + 1 < u.size(); ++i)
        for (std::size_t j = 0; j + 1 < v.size(); ++j)
            for (int g = 0; g < 3; ++g)
                for (int h = 0; h < 3; ++h) {
                    const double du = u[i + 1] - u[i], dv = v[j + 1] - v[j];
                    const SurfaceDerivatives d = surface.derivatives(u[i] + 0.5 * du * (1 + gauss_node[g]),
                                                                     v[j] + 0.5 * dv * (1 + gauss_node[h]), 1);
                    result.points.push_back(d.r());
                    result.weights.push_back(gauss_weight[g] * gauss_weight[h] * du * dv *
                                             d.r_u().cross(d.r_v()).norm());
                }
    return result;
}

/// The vector of third moments, relative to the radius: zero for point clouds that are symmetric in three planes.
Vector3 third_moment(const WeightedPoints& cloud, const Vector3& centroid, double radius) {
    Vector3 sum = Vector3::Zero();
    double weight = 0.0;
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
        const Vector3 d = (cloud.points[i] - centroid) / radius;
        sum += cloud.weights[i] * d.squaredNorm() * d;
        weight += cloud.weights[i] * d.squaredNorm();
    }
    return weight > 0.0 ? Vector3(sum / weight) : sum;
}

/// Unit vectors from the centroid to the poles of the parametrisation.
std::vector<Vector3> pole_directions(const FaceBorder& border, const Vector3& centroid) {
    std::vector<Vector3> result;
    for (const std::vector<BorderNode>& loop : border.loops)
        for (const BorderNode& node : loop)
            if (node.kind == BorderKind::pole) result.push_back((node.point - centroid).normalized());
    return result;
}

/// Of the vectors with the greatest `size`, all but `tie` alike, the one farthest along `direction`; zero if no size
/// exceeds `tie`.
template <class Size>
Vector3 greatest(const std::vector<Vector3>& vectors, const Vector3& direction, const Size& size) {
    double most = 0.0;
    for (const Vector3& v : vectors) most = std::max(most, size(v));
    Vector3 best = Vector3::Zero();
    if (!(most > tie)) return best;
    double farthest = -std::numeric_limits<double>::infinity();
    for (const Vector3& v : vectors)
        if (size(v) >= (1 - tie) * most && v.dot(direction) > farthest) {
            farthest = v.dot(direction);
            best = v;
        }
    return best;
}

}  // namespace

Vector3 WeightedPoints::centroid() const {
    Vector3 sum = Vector3::Zero();
    double weight = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        sum += weights[i] * points[i];
        weight += weights[i];
    }
    return weight > 0.0 ? Vector3(sum / weight) : sum;
}

WeightedPoints border_points(const FaceBorder& border) {
    WeightedPoints result;
    for (const std::vector<BorderNode>& loop : border.loops)
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const BorderNode& node = loop[i];
            if (node.kind != BorderKind::border) continue;
            // Trapezoidal rule on the equal parts of the stretch.
            const double part = node.length / (between_count + 1);
            result.points.push_back(node.point);
            result.weights.push_back(0.5 * part);
            for (const Vector3& p : node.between) {
                result.points.push_back(p);
                result.weights.push_back(part);
            }
            result.points.push_back(loop[(i + 1) % loop.size()].point);
            result.weights.push_back(0.5 * part);
        }
    return result;
}

FaceFrame face_frame(const Face& face, const FaceBorder& border, const std::optional<Vector3>& model_centroid,
                     double model_size) {
    FaceFrame frame;
    frame.points = border_points(border);
    const bool bordered = !frame.points.points.empty();
    if (!bordered) frame.points = area_points(face.surface, parts_for_centroid);
    frame.centroid = frame.points.centroid();
    for (const Vector3& p : frame.points.points) frame.radius = std::max(frame.radius, (p - frame.centroid).norm());
    if (!(frame.radius > 0.0)) return frame;
    frame.lean = third_moment(frame.points, frame.centroid, frame.radius);
    // Borders may be more symmetric than what lies between them.
    if (bordered && face.region.whole_domain()) {
        const WeightedPoints area = area_points(face.surface, parts_for_moments);
        frame.area_centroid = area.centroid();
        frame.lean += third_moment(area, frame.centroid, frame.radius);
    }
    if (model_centroid && model_size > 0.0) frame.lean += model_share / model_size * (*model_centroid - frame.centroid);

    // Three vectors that leave no symmetry: to the farthest node, to that farthest from the line of the first, to that
    // farthest from the plane of both; without border the principal axes.
    std::vector<Vector3> vectors;
    if (bordered) {
        for (const std::vector<BorderNode>& loop : border.loops)
            for (const BorderNode& node : loop)
                if (border.on_border[node.identity]) vectors.push_back((node.point - frame.centroid) / frame.radius);
    } else {
        Matrix3 covariance = Matrix3::Zero();
        for (std::size_t i = 0; i < frame.points.points.size(); ++i) {
            const Vector3 d = (frame.points.points[i] - frame.centroid) / frame.radius;
            covariance += frame.points.weights[i] * d * d.transpose();
        }
        const Eigen::SelfAdjointEigenSolver<Matrix3> solver(covariance);
        for (const int k : {2, 1, 0})
            for (const double sense : {1.0, -1.0})
                vectors.push_back(sense * axis_length[k] * solver.eigenvectors().col(k));
        // On a sphere any direction is as good as another: so the poles of its parametrisation, next to which lines
        // cannot be traced, shall be no special places of the net.
        const std::vector<Vector3> poles = pole_directions(border, frame.centroid);
        if (!poles.empty() && solver.eigenvalues()[2] < (1 + tie) * solver.eigenvalues()[0]) {
            const Vector3 z = poles.front(), x = z.unitOrthogonal(), y = z.cross(x);
            frame.corner = frame.radius * (0.5 * z + 0.8 * x).normalized();
            frame.lean = (y + 0.37 * x + 0.21 * z).normalized();
            return frame;
        }
    }
    const Vector3 first = greatest(vectors, frame.lean, [](const Vector3& v) { return v.norm(); });
    frame.lean += corner_share[0] * first;
    const Vector3 second = greatest(vectors, frame.lean, [&](const Vector3& v) { return v.cross(first).norm(); });
    frame.lean += corner_share[1] * second;
    const Vector3 normal = first.cross(second);
    frame.lean +=
        corner_share[2] * greatest(vectors, frame.lean, [&](const Vector3& v) { return std::abs(v.dot(normal)); });
    frame.lean.normalize();
    frame.corner = bordered ? Vector3(frame.radius * first) : frame.lean;
    return frame;
}

}  // namespace umbilic
