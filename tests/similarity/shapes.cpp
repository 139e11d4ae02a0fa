// SPDX-License-Identifier: LGPL-2.1-or-later
#include <similarity/shapes.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <support/surfaces.h>
#include <umbilic/nurbs/bezier_patch.h>

namespace umbilic::test {

namespace {

KnotVector uniform(int degree, int poles) {
    std::vector<double> knots(degree + 1, 0.0);
    for (int i = 1; i < poles - degree; ++i) knots.push_back(static_cast<double>(i) / (poles - degree));
    knots.insert(knots.end(), degree + 1, 1.0);
    return KnotVector(degree, knots);
}

/// Rows: the basis functions at the Greville abscissae.
struct Collocation {
    std::vector<double> abscissae;
    Eigen::MatrixXd matrix;
};

Collocation collocation(const KnotVector& knots) {
    const int n = knots.pole_count(), p = knots.degree();
    Collocation result{{}, Eigen::MatrixXd::Zero(n, n)};
    for (int i = 0; i < n; ++i) {
        double u = 0.0;
        for (int k = 1; k <= p; ++k) u += knots.knots()[i + k] / p;
        const int span = knots.span(u);
        std::vector<double> basis(p + 1);
        knots.basis(span, u, 0, basis.data());
        for (int k = 0; k <= p; ++k) result.matrix(i, span - p + k) = basis[k];
        result.abscissae.push_back(u);
    }
    return result;
}

}  // namespace

NurbsSurface design() {
    return support::smooth_bicubic(9, 4);
}

NurbsSurface reapproximated(const NurbsSurface& surface, int degree, int poles) {
    const KnotVector knots = uniform(degree, poles);
    const Collocation c = collocation(knots);
    const ParameterBox domain = surface.domain();
    const Eigen::MatrixXd inverse = c.matrix.fullPivLu().inverse();
    std::vector<Vector3> net(poles * poles);
    for (int k = 0; k < 3; ++k) {
        Eigen::MatrixXd values(poles, poles);
        for (int i = 0; i < poles; ++i)
            for (int j = 0; j < poles; ++j)
                values(i, j) = surface.value(domain.u.low + c.abscissae[i] * domain.u.length(),
                                             domain.v.low + c.abscissae[j] * domain.v.length())[k];
        const Eigen::MatrixXd solved = inverse * values * inverse.transpose();
        for (int i = 0; i < poles; ++i)
            for (int j = 0; j < poles; ++j) net[i * poles + j][k] = solved(i, j);
    }
    return NurbsSurface(knots, knots, net);
}

NurbsSurface with_bump(const NurbsSurface& surface, int i, int j, double height) {
    std::vector<Vector3> poles = surface.poles();
    for (int di = -1; di <= 1; ++di)
        for (int dj = -1; dj <= 1; ++dj) poles[(i + di) * surface.v_pole_count() + j + dj].z() += height;
    return NurbsSurface(surface.u_knots(), surface.v_knots(), poles, surface.weights());
}

std::vector<NurbsSurface> pieces(const NurbsSurface& surface, int u_pieces, int v_pieces) {
    const BezierPatches all = bezier_patches(surface);
    std::vector<NurbsSurface> result;
    for (int i = 0; i < u_pieces; ++i)
        for (int j = 0; j < v_pieces; ++j) {
            const BezierPatch& patch = all.patches[i * all.v_count + j];
            std::vector<Vector3> poles;
            std::vector<double> weights;
            for (const Vector4& pole : patch.poles) {
                poles.push_back(pole.head<3>() / pole.w() + patch.origin);
                weights.push_back(pole.w());
            }
            result.emplace_back(KnotVector::bezier(patch.u_degree), KnotVector::bezier(patch.v_degree), poles, weights);
        }
    return result;
}

NurbsSurface half_flat() {
    // Control points of the two pieces share the pole at x = 0 by C1 continuity.
    KnotVector u(2, {-1, -1, -1, 0, 1, 1, 1}), v(1, {0, 0, 1, 1});
    std::vector<Vector3> poles;
    const double x[] = {-1.0, -0.5, 0.5, 1.0}, z[] = {-1.0, 0.0, 0.0, 0.0};
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 2; ++j) poles.emplace_back(x[i], j, z[i]);
    return NurbsSurface(u, v, poles);
}

PreparedModel prepared_on_grid(const Model& model, int n) {
    Features features;
    for (const Face& face : model.faces) {
        const ParameterBox domain = face.surface.domain();
        const double du = domain.u.length() / n, dv = domain.v.length() / n;
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                const double u = domain.u.low + (i + 0.5) * du, v = domain.v.low + (j + 0.5) * dv;
                const SurfaceDerivatives d = face.surface.derivatives(u, v, 2);
                const Curvature c = curvature(d);
                if (!c.regular) continue;
                features.samples.push_back(
                    {{face.number, u, v}, face.reversed ? flipped(c) : c, d.r_u().cross(d.r_v()).norm() * du * dv});
            }
        FaceUmbilics none;
        none.face = face.number;
        features.umbilics.push_back(none);
    }
    return {model, std::move(features), ClosestPointTree(model), PrincipalFrameTable(model, n * n)};
}

Umbilic star_at(const Face& face, double u, double v) {
    Umbilic result;
    result.at = {face.number, u, v};
    result.point = face.surface.value(u, v);
    result.cubic = {1.0, 0.0, -1.0, 0.0};
    result.kind.type = UmbilicType::star;
    result.index = -0.5;
    result.certified = true;
    return result;
}

}  // namespace umbilic::test
