// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>

#include <support/surfaces.h>
#include <umbilic/core/errors.h>
#include <umbilic/curves/line_of_curvature.h>
#include <umbilic/curves/line_tracer.h>
#include <umbilic/differential/curvature.h>
#include <umbilic/umbilics/find.h>

namespace umbilic {
namespace {

constexpr double pi = std::numbers::pi;

Face face_of(NurbsSurface surface) {
    return support::model_of({std::move(surface)}).faces.front();
}

/// Torus about the z axis, closed in both parameters, as one rational biquadratic surface.
Face full_torus(double major, double minor) {
    const double w = std::numbers::sqrt2 / 2;
    const std::array<Vector2, 9> circle = {Vector2(1, 0),  Vector2(1, 1),  Vector2(0, 1),
                                           Vector2(-1, 1), Vector2(-1, 0), Vector2(-1, -1),
                                           Vector2(0, -1), Vector2(1, -1), Vector2(1, 0)};
    const std::vector<double> knots = {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4};
    std::vector<Vector3> poles;
    std::vector<double> weights;
    for (int i = 0; i < 9; ++i)
        for (int j = 0; j < 9; ++j) {
            const double radius = major + minor * circle[j].x();
            poles.emplace_back(radius * circle[i].x(), radius * circle[i].y(), minor * circle[j].y());
            weights.push_back((i % 2 ? w : 1.0) * (j % 2 ? w : 1.0));
        }
    Face face = face_of(NurbsSurface(KnotVector(2, knots), KnotVector(2, knots), poles, weights));
    face.u_closed = face.v_closed = true;
    return face;
}

/// A quarter by quarter of a ring cyclide with the parameters a > c > 0, b^2 = a^2 - c^2 and d: its lines of curvature
/// are circles, here the parameter lines. Rational biquadratic in the tangents of the half angles.
Face dupin_cyclide(double a, double c, double d) {
    const double b = std::sqrt(a * a - c * c);
    const auto homogeneous = [&](double s, double t) -> Vector4 {
        const double ps = 1 + s * s, ms = 1 - s * s, pt = 1 + t * t, mt = 1 - t * t;
        return {d * (c * ps * pt - a * ms * mt) + b * b * ms * pt, b * 2 * s * (a * pt - d * mt),
                b * 2 * t * (c * ms - d * ps), a * ps * pt - c * ms * mt};
    };
    // Bernstein coefficients of a quadratic from its values at 0, 1/2, 1.
    const auto bernstein = [](const std::array<Vector4, 3>& f) -> std::array<Vector4, 3> {
        return {f[0], Vector4(2 * f[1] - 0.5 * (f[0] + f[2])), f[2]};
    };
    std::array<std::array<Vector4, 3>, 3> net;
    for (int i = 0; i < 3; ++i)
        net[i] = bernstein({homogeneous(0.5 * i, 0), homogeneous(0.5 * i, 0.5), homogeneous(0.5 * i, 1)});
    std::vector<Vector3> poles(9);
    std::vector<double> weights(9);
    for (int j = 0; j < 3; ++j) {
        const std::array<Vector4, 3> column = bernstein({net[0][j], net[1][j], net[2][j]});
        for (int i = 0; i < 3; ++i) {
            poles[3 * i + j] = column[i].head<3>() / column[i][3];
            weights[3 * i + j] = column[i][3];
        }
    }
    return face_of(NurbsSurface(KnotVector::bezier(2), KnotVector::bezier(2), poles, weights));
}

/// The two non-zero parameters of the quadrics x^2 / (a^2 - m) + ... = 1 confocal to an ellipsoid through a point of
/// it. On a line of curvature one of them is constant.
std::array<double, 2> confocal(const Vector3& p, const Vector3& axes) {
    const Vector3 q = axes.array().square();
    // The cubic m^3 - ... divided by m: m^2 + B m + C.
    const Vector3 s = p.array().square();
    const double B = s.sum() - q.sum();
    const double C = q.x() * q.y() + q.y() * q.z() + q.z() * q.x() - s.x() * (q.y() + q.z()) - s.y() * (q.x() + q.z()) -
                     s.z() * (q.x() + q.y());
    const double root = std::sqrt(std::max(0.0, B * B - 4 * C));
    return {(-B - root) / 2, (-B + root) / 2};
}

/// Greatest change of the confocal parameter that the family keeps, as a distance in space.
double confocal_error(const SurfaceCurve& curve, const Vector3& axes, int which) {
    const double reference = confocal(curve.points.front().point, axes)[which];
    double worst = 0.0;
    for (const SurfaceCurvePoint& point : curve.points) {
        // |grad m| = 2 / sqrt(sum x^2 / (a^2 - m)^2).
        double sum = 0.0;
        for (int k = 0; k < 3; ++k) sum += std::pow(point.point[k] / (axes[k] * axes[k] - reference), 2);
        worst = std::max(worst, std::abs(confocal(point.point, axes)[which] - reference) * std::sqrt(sum) / 2);
    }
    return worst;
}

const Vector3 axes(3, 2, 1);

SurfaceCurve on_ellipsoid(CurvatureFamily family, double tolerance, const Vector2& start = {0.5, 0.4}) {
    static const Face face = face_of(support::ellipsoid_octant(axes.x(), axes.y(), axes.z()));
    return line_of_curvature(face, start, family, {.tolerance = tolerance});
}

int kept_parameter(const SurfaceCurve& curve) {
    const auto first = confocal(curve.points.front().point, axes), last = confocal(curve.points.back().point, axes);
    return std::abs(first[0] - last[0]) < std::abs(first[1] - last[1]) ? 0 : 1;
}

TEST(LineOfCurvature, FollowsTheConfocalQuadricsOfAnEllipsoid) {
    for (const CurvatureFamily family : {CurvatureFamily::maximum, CurvatureFamily::minimum})
        for (const Vector2& start : {Vector2(0.5, 0.4), Vector2(0.9, 0.1), Vector2(0.2, 0.7)}) {
            const SurfaceCurve curve = on_ellipsoid(family, 1e-9, start);
            const double error = confocal_error(curve, axes, kept_parameter(curve));
            EXPECT_LE(error, curve.error + 1e-13) << name(family) << start.transpose();
            EXPECT_LE(curve.error, 1e-6);
            EXPECT_EQ(curve.ended, CurveEnd::boundary);
            EXPECT_EQ(curve.started, CurveEnd::boundary);
            double chords = 0.0;
            for (std::size_t i = 1; i < curve.points.size(); ++i)
                chords += (curve.points[i].point - curve.points[i - 1].point).norm();
            EXPECT_LT(chords, curve.length);
            EXPECT_GT(chords, 0.99 * curve.length);
        }
}

TEST(LineOfCurvature, ConvergesWithTheFifthPowerOfTheStep) {
    const Face face = face_of(support::ellipsoid_octant(axes.x(), axes.y(), axes.z()));
    const LineTracer tracer(face);
    const Vector2 start(0.5, 0.4);
    const Vector3 direction = tracer.value(start, CurvatureFamily::maximum).tangent;
    const double length = 0.7;
    const auto end = [&](int steps) {
        // The step is ruled by its longest length alone.
        const TracedLine line = tracer.trace(start, CurvatureFamily::maximum, direction,
                                             {.length = length, .tolerance = 1.0, .longest_step = length / steps});
        EXPECT_NEAR(static_cast<int>(line.steps.size()), steps, 1);  // a last one of the length of rounding
        const Vector2 p = line.steps.back().end;
        return face.surface.value(p.x(), p.y());
    };
    const Vector3 exact = end(512);
    const double coarse = (end(8) - exact).norm(), middle = (end(16) - exact).norm(), fine = (end(32) - exact).norm();
    EXPECT_GT(std::log2(coarse / middle), 4.5);
    EXPECT_GT(std::log2(middle / fine), 4.5);
}

TEST(LineOfCurvature, KeepsItsOrderAcrossKnotLines) {
    // A cubic B-spline has jumps of the third derivative at its knots: the direction has kinks there.
    const Face face = face_of(support::smooth_bicubic(12, 5));
    const auto end = [&](double tolerance) {
        LineOfCurvatureOptions options{.length = 0.3, .tolerance = tolerance};
        options.direction = Vector3(1, 0.3, 0);
        return line_of_curvature(face, {0.4, 0.45}, CurvatureFamily::maximum, options);
    };
    const SurfaceCurve exact = end(1e-13), coarse = end(1e-7);
    ASSERT_EQ(exact.ended, CurveEnd::length);
    EXPECT_LE((exact.points.back().point - coarse.points.back().point).norm(), 10 * coarse.error);
    EXPECT_LT(coarse.points.size(), 60u);
}

TEST(LineOfCurvature, RunsAlongMeridiansAndParallelsOfATorus) {
    const double major = 3, minor = 1;
    const Face face = face_of(support::torus_quarter(major, minor));
    const Vector2 start(0.3, 0.6);
    const Vector3 p = face.surface.value(start.x(), start.y());
    const SurfaceCurve meridian = line_of_curvature(face, start, CurvatureFamily::maximum);
    EXPECT_NEAR(meridian.length, minor * pi / 2, 1e-8);
    for (const SurfaceCurvePoint& q : meridian.points)
        EXPECT_NEAR(std::atan2(q.point.y(), q.point.x()), std::atan2(p.y(), p.x()), 1e-9);
    const SurfaceCurve parallel = line_of_curvature(face, start, CurvatureFamily::minimum);
    EXPECT_NEAR(parallel.length, std::hypot(p.x(), p.y()) * pi / 2, 1e-8);
    for (const SurfaceCurvePoint& q : parallel.points) EXPECT_NEAR(q.point.z(), p.z(), 1e-9);
}

TEST(LineOfCurvature, ClosesAcrossTheSeam) {
    const Face face = full_torus(3, 1);
    for (const Vector2& start : {Vector2(0.3, 0.6), Vector2(0.0, 0.0), Vector2(4.0, 1.0)}) {
        const Vector3 p = face.surface.value(start.x(), start.y());
        const SurfaceCurve meridian = line_of_curvature(face, start, CurvatureFamily::maximum);
        EXPECT_TRUE(meridian.closed);
        EXPECT_EQ(meridian.ended, CurveEnd::closed);
        EXPECT_NEAR(meridian.length, 2 * pi, 1e-7);
        const SurfaceCurve parallel = line_of_curvature(face, start, CurvatureFamily::minimum);
        EXPECT_TRUE(parallel.closed);
        EXPECT_NEAR(parallel.length, 2 * pi * std::hypot(p.x(), p.y()), 1e-7);
    }
}

TEST(LineOfCurvature, NeverTurnsBack) {
    const Face face = full_torus(3, 1);
    const LineTracer tracer(face);
    const Vector2 start(0.3, 0.6);
    const double step = 0.01;
    const int steps = 10000;
    for (const CurvatureFamily family : {CurvatureFamily::maximum, CurvatureFamily::minimum}) {
        const Vector3 direction = tracer.value(start, family).tangent;
        const TracedLine line =
            tracer.trace(start, family, direction,
                         {.length = steps * step, .tolerance = 1e-6, .longest_step = step, .close = false});
        EXPECT_GE(static_cast<int>(line.steps.size()), steps);
        EXPECT_NEAR(line.length, steps * step, 1e-9);
        Vector3 before = direction;
        for (const TracedStep& at : line.steps) {
            const FieldValue value = tracer.value(tracer.wrapped(at.at(0.5)), family);
            const Vector2 rate = at.rate(0.5);
            const Vector3 tangent = value.r_u * rate.x() + value.r_v * rate.y();
            ASSERT_NEAR(tangent.norm(), 1.0, 1e-6);
            ASSERT_GT(tangent.dot(before), 0.99);
            before = tangent;
        }
    }
}

TEST(LineOfCurvature, RunsAlongTheCirclesOfADupinCyclide) {
    const Face face = dupin_cyclide(5, 2, 3);
    const Vector2 start(0.4, 0.3);
    for (const CurvatureFamily family : {CurvatureFamily::maximum, CurvatureFamily::minimum}) {
        const SurfaceCurve curve = line_of_curvature(face, start, family, {.spacing = 0.1});
        ASSERT_GE(curve.points.size(), 10u);
        // The circle through three of its points.
        const Vector3 a = curve.points.front().point, b = curve.points[curve.points.size() / 2].point,
                      c = curve.points.back().point;
        const Vector3 normal = (b - a).cross(c - a);
        const Vector3 centre =
            a + ((c - a).squaredNorm() * normal.cross(b - a) + (b - a).squaredNorm() * (c - a).cross(normal)) /
                    (2 * normal.squaredNorm());
        const double radius = (a - centre).norm();
        ASSERT_NEAR((b - centre).norm(), radius, 1e-9 * radius);
        ASSERT_NEAR((c - centre).norm(), radius, 1e-9 * radius);
        for (const SurfaceCurvePoint& p : curve.points) {
            EXPECT_NEAR((p.point - centre).norm(), radius, 1e-7);
            EXPECT_NEAR((p.point - centre).dot(normal.normalized()), 0.0, 1e-7);
        }
    }
}

TEST(LineOfCurvature, MeetsTheOtherFamilyAtARightAngle) {
    const Face face = face_of(support::smooth_bicubic(8, 2));
    const FieldValue one = LineTracer(face).value({0.3, 0.4}, CurvatureFamily::maximum);
    const FieldValue other = LineTracer(face).value({0.3, 0.4}, CurvatureFamily::minimum);
    EXPECT_NEAR(one.tangent.dot(other.tangent), 0.0, 1e-14);
}

TEST(LineOfCurvature, ExchangesTheFamiliesOfAReversedFace) {
    Face face = face_of(support::torus_quarter(3, 1));
    const SurfaceCurve before = line_of_curvature(face, {0.3, 0.6}, CurvatureFamily::maximum);
    face.reversed = true;
    const SurfaceCurve after = line_of_curvature(face, {0.3, 0.6}, CurvatureFamily::minimum);
    EXPECT_NEAR(before.length, after.length, 1e-12);
}

TEST(LineOfCurvature, StopsAtTrimmingLoops) {
    Face face = face_of(support::torus_quarter(3, 1));
    const auto line = [](const Vector2& a, const Vector2& b) {
        return TrimmingCurve{.curve = NurbsCurve2(KnotVector::bezier(1), {a, b})};
    };
    face.region = TrimmingRegion(
        face.surface.domain(),
        {{line({0.2, 0.3}, {0.8, 0.2}), line({0.8, 0.2}, {0.7, 0.9}), line({0.7, 0.9}, {0.2, 0.3})}}, {}, {});
    const SurfaceCurve curve = line_of_curvature(face, {0.55, 0.5}, CurvatureFamily::minimum);
    EXPECT_EQ(curve.ended, CurveEnd::trim);
    EXPECT_EQ(curve.started, CurveEnd::trim);
    for (const SurfaceCurvePoint& end : {curve.points.front(), curve.points.back()})
        EXPECT_EQ(face.region.classify(end.at.u, end.at.v, 1e-5), Containment::boundary);
    EXPECT_THROW(line_of_curvature(face, {0.1, 0.9}, CurvatureFamily::minimum), InvalidInput);
}

/// Graph over [-1, 1]^2 of left u^2 for u < 0, right u^2 for u > 0, and bend |u| v, in two pieces.
NurbsSurface two_pieces(double left, double right, double bend) {
    const std::array<double, 5> u = {-1, -0.5, 0, 0.5, 1}, distance = {1, 0.5, 0, 0.5, 1};
    const std::array<double, 5> square = {left, 0, 0, 0, right};
    std::vector<Vector3> poles;
    for (int i = 0; i < 5; ++i)
        for (const double v : {-1.0, 1.0}) poles.emplace_back(u[i], v, square[i] + bend * distance[i] * v);
    return NurbsSurface(KnotVector(2, {-1, -1, -1, 0, 0, 1, 1, 1}), KnotVector(1, {-1, -1, 1, 1}), poles);
}

TEST(LineOfCurvature, EndsWhereBothPiecesLeadToTheirKnotLine) {
    // The surface bends by 2 bend v along u = 0. With x the angle of a line of the steep family against the knot line,
    // tan 2 x = bend / 0.05 on the right, where lines run away from it upwards, and the reverse on the left.
    const double bend = 0.02;
    const Face face = face_of(two_pieces(0.05, 0.05, bend));
    const LineTracer tracer(face);
    for (const double u : {-0.05, 0.05})
        for (const CurvatureFamily family : {CurvatureFamily::maximum, CurvatureFamily::minimum}) {
            const Vector2 start(u, 0.5);
            const FieldValue value = tracer.value(start, family);
            if (std::abs(value.tangent.y()) < 0.7) continue;
            const double sense = value.tangent.y() > 0.0 ? 1.0 : -1.0;
            const Vector3 to_knot = (u * value.tangent.x() > 0.0 ? -1.0 : 1.0) * value.tangent;
            EXPECT_NEAR(std::abs(std::atan(value.tangent.x() / value.tangent.y())), 0.5 * std::atan(bend / 0.05), 0.01)
                << sense;
            const TracedLine line =
                tracer.trace(start, family, to_knot, {.length = 3.0, .tolerance = 1e-9, .longest_step = 0.1});
            EXPECT_EQ(line.ended, CurveEnd::umbilic);
            EXPECT_LT(line.steps.size(), 20u);
            EXPECT_EQ(line.steps.back().end.x(), 0.0);
            const TracedLine away =
                tracer.trace(start, family, -to_knot, {.length = 3.0, .tolerance = 1e-9, .longest_step = 0.1});
            EXPECT_EQ(away.ended, CurveEnd::boundary);
        }
}

TEST(LineOfCurvature, RunsAlongAKnotLineWhereCurvatureJumps) {
    for (unsigned seed = 0; seed < 20; ++seed) {
        const Face face = face_of(support::transformed(two_pieces(0.5, 1.0, 0.0),
                                                       support::random_similarity(seed, 1.0, seed % 2 == 1)));
        const LineTracer tracer(face);
        for (const double offset : {0.0, 1e-17, -1e-17, 1e-15, -1e-13}) {
            const Vector2 start(offset, -0.9);
            for (const CurvatureFamily family : {CurvatureFamily::maximum, CurvatureFamily::minimum}) {
                const FieldValue value = tracer.value(start, family);
                const Vector3 along = value.r_v.normalized();
                if (std::abs(value.tangent.dot(along)) < 0.7) continue;
                const TracedLine line =
                    tracer.trace(start, family, along, {.length = 3.0, .tolerance = 1e-9, .longest_step = 0.1});
                EXPECT_EQ(line.ended, CurveEnd::boundary);
                EXPECT_NEAR(line.length, 1.9, 1e-9);
                EXPECT_LT(line.steps.size(), 60u);
            }
        }
    }
}

TEST(LineOfCurvature, RefusesWhatHasNoLine) {
    const Face face = face_of(support::torus_quarter(3, 1));
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
    const auto trace = [&](const Vector2& start, LineOfCurvatureOptions options = {}) {
        line_of_curvature(face, start, CurvatureFamily::maximum, options);
    };
    EXPECT_THROW(trace({1.1, 0.5}), InvalidInput);
    EXPECT_THROW(trace({nan, 0.5}), InvalidInput);
    EXPECT_THROW(trace({0.5, 0.5}, {.length = nan}), InvalidInput);
    EXPECT_THROW(trace({0.5, 0.5}, {.length = infinity}), InvalidInput);
    EXPECT_THROW(trace({0.5, 0.5}, {.length = -1.0}), InvalidInput);
    EXPECT_THROW(trace({0.5, 0.5}, {.tolerance = 0.0}), InvalidInput);
    EXPECT_THROW(trace({0.5, 0.5}, {.spacing = -1.0}), InvalidInput);
    EXPECT_THROW(trace({0.5, 0.5}, {.direction = Vector3(0, 0, 0)}), InvalidInput);
    const Face plane = face_of(support::smooth_bicubic(6, 1, 0.0));
    EXPECT_THROW(line_of_curvature(plane, {0.5, 0.5}, CurvatureFamily::maximum), InvalidInput);
    const Face sphere = face_of(support::ellipsoid_octant(2, 2, 2));
    EXPECT_THROW(line_of_curvature(sphere, {0.5, 0.5}, CurvatureFamily::maximum), InvalidInput);
    const Face umbilic = face_of(support::monge_patch(0.5, 1, 0, -1, 0));
    EXPECT_THROW(line_of_curvature(umbilic, {0.5, 0.5}, CurvatureFamily::maximum), InvalidInput);
}

TEST(LineOfCurvature, IsCancelled) {
    const Face face = face_of(support::torus_quarter(3, 1));
    const Progress progress;
    progress.cancel();
    EXPECT_THROW(line_of_curvature(face, {0.5, 0.5}, CurvatureFamily::maximum, {}, progress), Cancelled);
}

/// The umbilic in the middle of a graph.
Umbilic middle_umbilic(const Face& face) {
    for (const Umbilic& umbilic : find_umbilics(face).umbilics)
        if ((umbilic.point - Vector3(0, 0, umbilic.point.z())).norm() < 1e-6) return umbilic;
    ADD_FAILURE() << "no umbilic in the middle";
    return {};
}

TEST(Separatrices, AreAsManyAsThePatternOfTheUmbilicHas) {
    struct Case {
        double a, b, c, d;
        UmbilicType type;
        std::size_t half_lines;
    };
    // Star: harmonic cubic. Lemon and monstar: thesis V3's omega beyond the unit circle, outside and inside of Gamma_2.
    for (const Case& example : {Case{1, 0, -1, 0, UmbilicType::star, 6}, Case{1, 0, 0.2, 0.1, UmbilicType::lemon, 2},
                                Case{1, 0, 0.7, 0.02, UmbilicType::monstar, 6}}) {
        const Face face = face_of(support::monge_patch(0.3, example.a, example.b, example.c, example.d));
        const Umbilic umbilic = middle_umbilic(face);
        if (umbilic.kind.type != example.type)
            ADD_FAILURE() << name(umbilic.kind.type) << " for " << name(example.type);
        const std::vector<Separatrix> lines = separatrices(face, umbilic);
        ASSERT_EQ(lines.size(), 2 * umbilic.directions.size());
        EXPECT_EQ(lines.size(), example.half_lines);
        for (const Separatrix& line : lines) {
            EXPECT_EQ(line.curve.started, CurveEnd::umbilic);
            EXPECT_GT(line.curve.length, 0.1);
            const Vector3 chord = line.curve.points[1].point - line.curve.points[0].point;
            EXPECT_GT(chord.normalized().dot(line.direction), 1 - 1e-4);
            // Along the line the tangent follows the family from the start.
            const SurfaceCurvePoint& last = line.curve.points.back();
            EXPECT_TRUE(last.at.u >= 0 && last.at.u <= 1);
        }
        // The two halves of one direction belong to opposite families.
        for (std::size_t i = 0; i + 1 < lines.size(); i += 2) EXPECT_NE(lines[i].family, lines[i + 1].family);
    }
}

TEST(Separatrices, StayOnAPlaneOfSymmetry) {
    const Face face = face_of(support::graph_patch(
        3, 3, [](double x, double y) { return -0.13 * x * x - 0.1 * y * y + 0.1 * x * x * x + 0.03 * x * y * y; }));
    int on_plane = 0;
    for (const Umbilic& umbilic : find_umbilics(face).umbilics) {
        if (std::abs(umbilic.point.y()) > 1e-9 || umbilic.kind.type == UmbilicType::non_generic) continue;
        for (const Separatrix& line : separatrices(face, umbilic, {.length = 0.3})) {
            if (std::abs(line.direction.y()) > 1e-6) continue;
            ++on_plane;
            for (const SurfaceCurvePoint& point : line.curve.points) EXPECT_NEAR(point.point.y(), 0.0, 1e-6);
        }
    }
    EXPECT_GE(on_plane, 2);
}

}  // namespace
}  // namespace umbilic
