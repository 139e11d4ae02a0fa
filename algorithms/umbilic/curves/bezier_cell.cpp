// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/curves/bezier_cell.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include <umbilic/bernstein/binomials.h>

namespace umbilic {

namespace {

constexpr int largest_size = maximum_degree + 1;

/// Bernstein polynomials of one degree and their first and second derivatives at t.
template <int Size>
struct Basis {
    std::array<double, Size> value, first, second;

    Basis(int n, double t) {
        const double r = 1.0 - t;
        value[0] = 1.0;
        for (int j = 1; j <= n; ++j) {
            // Here `value` holds degree j - 1.
            if (j == n - 1)
                for (int i = 0; i <= n; ++i)
                    second[i] = n * (n - 1) *
                                ((i >= 2 ? value[i - 2] : 0.0) - 2 * (i >= 1 && i <= n - 1 ? value[i - 1] : 0.0) +
                                 (i <= n - 2 ? value[i] : 0.0));
            if (j == n)
                for (int i = 0; i <= n; ++i)
                    first[i] = n * ((i >= 1 ? value[i - 1] : 0.0) - (i <= n - 1 ? value[i] : 0.0));
            value[j] = t * value[j - 1];
            for (int i = j - 1; i >= 1; --i) value[i] = t * value[i - 1] + r * value[i];
            value[0] *= r;
        }
        if (n == 0) first[0] = 0.0;
        if (n <= 1) second[0] = second[n] = 0.0;
    }
};

/// P, Q: degrees fixed at compile time, or -1.
template <int P, int Q>
LocalDerivatives evaluate_degrees(const LocalPatch& patch, double u, double v) {
    const int p = P >= 0 ? P : patch.u_degree;
    const int q = Q >= 0 ? Q : patch.v_degree;
    const Basis<P >= 0 ? P + 1 : largest_size> bu(p, u);
    const Basis<Q >= 0 ? Q + 1 : largest_size> bv(q, v);
    Vector4 h = Vector4::Zero(), h_u = h, h_v = h, h_uu = h, h_uv = h, h_vv = h;
    const Vector4* row = patch.poles.data();
    for (int i = 0; i <= p; ++i, row += q + 1) {
        Vector4 r = bv.value[0] * row[0], r_v = bv.first[0] * row[0], r_vv = bv.second[0] * row[0];
        for (int j = 1; j <= q; ++j) {
            r += bv.value[j] * row[j];
            r_v += bv.first[j] * row[j];
            r_vv += bv.second[j] * row[j];
        }
        h += bu.value[i] * r;
        h_u += bu.first[i] * r;
        h_uu += bu.second[i] * r;
        h_v += bu.value[i] * r_v;
        h_uv += bu.first[i] * r_v;
        h_vv += bu.value[i] * r_vv;
    }
    LocalDerivatives d;
    if (!patch.rational) {
        d.r = h.head<3>();
        d.r_u = h_u.head<3>();
        d.r_v = h_v.head<3>();
        d.r_uu = h_uu.head<3>();
        d.r_uv = h_uv.head<3>();
        d.r_vv = h_vv.head<3>();
        return d;
    }
    const double w = 1.0 / h[3];
    d.r = w * h.head<3>();
    d.r_u = w * (h_u.head<3>() - h_u[3] * d.r);
    d.r_v = w * (h_v.head<3>() - h_v[3] * d.r);
    d.r_uu = w * (h_uu.head<3>() - 2 * h_u[3] * d.r_u - h_uu[3] * d.r);
    d.r_uv = w * (h_uv.head<3>() - h_u[3] * d.r_v - h_v[3] * d.r_u - h_uv[3] * d.r);
    d.r_vv = w * (h_vv.head<3>() - 2 * h_v[3] * d.r_v - h_vv[3] * d.r);
    return d;
}

/// Replaces the control points at `points[0], points[stride] ...` of a curve by those of its part over [low, high].
void restrict_curve(Vector4* points, int degree, int stride, double low, double high) {
    if (high < 1.0)
        for (int level = 1; level <= degree; ++level)
            for (int i = degree; i >= level; --i)
                points[i * stride] = (1.0 - high) * points[(i - 1) * stride] + high * points[i * stride];
    if (low <= 0.0) return;
    const double ratio = high > 0.0 ? std::min(low / high, 1.0) : 1.0;
    for (int level = 1; level <= degree; ++level)
        for (int i = 0; i <= degree - level; ++i)
            points[i * stride] = (1.0 - ratio) * points[i * stride] + ratio * points[(i + 1) * stride];
}

/// All vectors (numbers) within `radius` of `center`.
struct Ball {
    Vector3 center = Vector3::Zero();
    double radius = 0.0;

    double largest() const { return center.norm() + radius; }
};

struct NumberBall {
    double center = 0.0;
    double radius = 0.0;

    double largest() const { return std::abs(center) + radius; }
};

Ball operator-(const Ball& a, const Ball& b) {
    return {a.center - b.center, a.radius + b.radius};
}

Ball operator*(const NumberBall& a, const Ball& b) {
    return {a.center * b.center, std::abs(a.center) * b.radius + a.radius * b.largest()};
}

/// Balls about the mean of the homogeneous vectors given by `at(k)`, k = 0 ... count - 1.
template <typename At>
std::pair<Ball, NumberBall> ball_of(int count, const At& at) {
    if (count <= 0) return {};
    Vector4 mean = Vector4::Zero();
    for (int k = 0; k < count; ++k) mean += at(k);
    mean /= count;
    Ball ball{mean.head<3>(), 0.0};
    NumberBall number{mean[3], 0.0};
    double farthest = 0.0;
    for (int k = 0; k < count; ++k) {
        const Vector4 off = at(k) - mean;
        farthest = std::max(farthest, off.head<3>().squaredNorm());
        number.radius = std::max(number.radius, std::abs(off[3]));
    }
    ball.radius = std::sqrt(farthest);
    return {ball, number};
}

/// Completes a model from balls that hold the second derivatives over the cell.
void finish(CellModel& m, const Ball& uu, const Ball& uv, const Ball& vv) {
    m.r_uu = uu.center;
    m.r_uv = uv.center;
    m.r_vv = vv.center;
    const double a_u = m.r_u.norm(), a_v = m.r_v.norm();
    const double b_uu = uu.largest(), b_uv = uv.largest(), b_vv = vv.largest();
    // Bounds of |S_x - r_u| and |S_y - r_v|, of |S - c - r_u x - r_v y|, and of |r_u x + r_v y|.
    const double turn_u = 0.5 * (b_uu + b_uv), turn_v = 0.5 * (b_uv + b_vv);
    const double second = 0.125 * b_uu + 0.25 * b_uv + 0.125 * b_vv;
    const double first = 0.5 * (a_u + a_v);
    m.radius = std::min(m.radius, first + second);
    m.speed = {a_u + turn_u, a_v + turn_v};
    m.slope_far = {0.5 * (uu.radius + uv.radius), 0.5 * (uv.radius + vv.radius)};
    m.slope_near = {first * turn_u + second * m.speed[0], first * turn_v + second * m.speed[1]};
    m.bend_far = {uu.radius, uv.radius, vv.radius};
    m.bend_near = {2 * a_u * turn_u + turn_u * turn_u + m.radius * b_uu,
                   a_u * turn_v + a_v * turn_u + turn_u * turn_v + m.radius * b_uv,
                   2 * a_v * turn_v + turn_v * turn_v + m.radius * b_vv};
}

}  // namespace

LocalDerivatives evaluate(const LocalPatch& patch, double u, double v) {
    if (patch.u_degree == 3 && patch.v_degree == 3) return evaluate_degrees<3, 3>(patch, u, v);
    if (patch.u_degree == 2 && patch.v_degree == 2) return evaluate_degrees<2, 2>(patch, u, v);
    if (patch.u_degree == 1 && patch.v_degree == 1) return evaluate_degrees<1, 1>(patch, u, v);
    return evaluate_degrees<-1, -1>(patch, u, v);
}

void restrict_net(const LocalPatch& patch, const LocalBox& box, std::vector<Vector4>& net) {
    const int p = patch.u_degree, q = patch.v_degree;
    net = patch.poles;
    for (int j = 0; j <= q; ++j) restrict_curve(net.data() + j, p, q + 1, box.low[0], box.high[0]);
    for (int i = 0; i <= p; ++i) restrict_curve(net.data() + i * (q + 1), q, 1, box.low[1], box.high[1]);
}

CellModel curve_model(const Vector3& c, const Vector3& tangent, const Vector3& second, double second_error) {
    CellModel m;
    m.c = c;
    m.r_u = tangent;
    m.r_v.setZero();
    m.radius = std::numeric_limits<double>::infinity();
    finish(m, {second, second_error}, {}, {});
    return m;
}

CellModel cell_model(const LocalPatch& patch, const LocalBox& box, const std::vector<Vector4>& net) {
    const int p = patch.u_degree, q = patch.v_degree;
    const double du = box.high[0] - box.low[0], dv = box.high[1] - box.low[1];
    const LocalDerivatives d = evaluate(patch, 0.5 * (box.low[0] + box.high[0]), 0.5 * (box.low[1] + box.high[1]));
    CellModel m;
    m.c = d.r;
    m.r_u = du * d.r_u;
    m.r_v = dv * d.r_v;

    // Homogeneous control points of S - c.
    const auto pole = [&](int i, int j) -> Vector4 {
        Vector4 h = net[i * (q + 1) + j];
        h.head<3>() -= h[3] * d.r;
        return h;
    };
    auto [uu, w_uu] = ball_of((p - 1) * (q + 1), [&](int k) -> Vector4 {
        const int i = k / (q + 1), j = k % (q + 1);
        return p * (p - 1) * (pole(i + 2, j) - 2 * pole(i + 1, j) + pole(i, j));
    });
    auto [uv, w_uv] = ball_of(p * q, [&](int k) -> Vector4 {
        const int i = k / q, j = k % q;
        return p * q * (pole(i + 1, j + 1) - pole(i + 1, j) - pole(i, j + 1) + pole(i, j));
    });
    auto [vv, w_vv] = ball_of((p + 1) * (q - 1), [&](int k) -> Vector4 {
        const int i = k / (q - 1), j = k % (q - 1);
        return q * (q - 1) * (pole(i, j + 2) - 2 * pole(i, j + 1) + pole(i, j));
    });
    double lightest = std::numeric_limits<double>::infinity(), heaviest = 0.0;
    for (const Vector4& h : net) {
        m.radius = std::max(m.radius, (h.head<3>() / h[3] - d.r).norm());
        lightest = std::min(lightest, h[3]);
        heaviest = std::max(heaviest, h[3]);
    }
    if (patch.rational) {
        // The quotient rule on balls: A = w (S - c), S_u = (A_u - w_u (S - c)) / w and so on.
        const auto [u, w_u] = ball_of(p * (q + 1), [&](int k) -> Vector4 {
            return p * (pole(k / (q + 1) + 1, k % (q + 1)) - pole(k / (q + 1), k % (q + 1)));
        });
        const auto [v, w_v] =
            ball_of((p + 1) * q, [&](int k) -> Vector4 { return q * (pole(k / q, k % q + 1) - pole(k / q, k % q)); });
        const NumberBall inverse{0.5 * (1 / lightest + 1 / heaviest), 0.5 * (1 / lightest - 1 / heaviest)};
        const Ball s{Vector3::Zero(), m.radius};
        const NumberBall two{2.0, 0.0};
        const Ball s_u = inverse * (u - w_u * s);
        const Ball s_v = inverse * (v - w_v * s);
        uu = inverse * (uu - two * (w_u * s_u) - w_uu * s);
        uv = inverse * (uv - w_u * s_v - w_v * s_u - w_uv * s);
        vv = inverse * (vv - two * (w_v * s_v) - w_vv * s);
    }
    finish(m, uu, uv, vv);
    return m;
}

double squared_distance_bound(int u_degree, int v_degree, const std::vector<Vector4>& net, const Vector3& p, double d) {
    const int m = u_degree, n = v_degree;
    // Control points relative to p, times binomials: a product of Bernstein forms is then a plain convolution.
    std::vector<Vector4> scaled(net.size());
    const double *u_binomials = binomials(m), *v_binomials = binomials(n);
    double heaviest = 0.0;
    for (int i = 0; i <= m; ++i)
        for (int j = 0; j <= n; ++j) {
            const Vector4& h = net[i * (n + 1) + j];
            Vector4& s = scaled[i * (n + 1) + j];
            s.head<3>() = h.head<3>() - h[3] * p;
            s[3] = h[3] * d;
            s *= u_binomials[i] * v_binomials[j];
            heaviest = std::max(heaviest, h[3]);
        }
    const double *u_inverse = inverse_binomials(2 * m), *v_inverse = inverse_binomials(2 * n);
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= 2 * m; ++i)
        for (int j = 0; j <= 2 * n; ++j) {
            Vector4 sum = Vector4::Zero();
            for (int k = std::max(0, i - m); k <= std::min(i, m); ++k)
                for (int l = std::max(0, j - n); l <= std::min(j, n); ++l)
                    sum += scaled[k * (n + 1) + l].cwiseProduct(scaled[(i - k) * (n + 1) + j - l]);
            least = std::min(least, (sum[0] + sum[1] + sum[2] - sum[3]) * u_inverse[i] * v_inverse[j]);
        }
    return least / (heaviest * heaviest);
}

}  // namespace umbilic
