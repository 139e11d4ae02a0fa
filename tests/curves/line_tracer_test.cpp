// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <array>
#include <vector>

#include <support/reparametrisation.h>
#include <support/surfaces.h>
#include <umbilic/curves/line_tracer.h>

namespace umbilic {
namespace {

constexpr double spacing = 0.25;

/// Where a line over a quarter of a torus is asked whether to stop, which it does at the call of that number.
std::vector<Vector3> asked(double longest_step, std::size_t stop_at, TracedLine& line) {
    const Model model = support::model_of({support::torus_quarter(3, 1)});
    const LineTracer tracer(model.faces.front());
    std::vector<Vector3> places;
    const Vector2 start(0.1, 0.6);
    const FieldValue value = tracer.value(start, CurvatureFamily::minimum);
    const Vector3 forward = value.tangent.dot(value.r_u) < 0.0 ? Vector3(-value.tangent) : value.tangent;
    line = tracer.trace(start, CurvatureFamily::minimum, forward,
                        {.length = 100.0,
                         .tolerance = 1e-10,
                         .longest_step = longest_step,
                         .stop_spacing = spacing,
                         .stop = [&](const FieldValue& at) {
                             places.push_back(at.point);
                             return places.size() == stop_at;
                         }});
    return places;
}

TEST(LineTracer, AsksWhetherToStopAtEqualDistancesWhateverItsSteps) {
    TracedLine coarse, fine;
    const std::vector<Vector3> one = asked(0.9, 0, coarse), other = asked(0.07, 0, fine);
    EXPECT_GT(fine.steps.size(), 3 * coarse.steps.size());
    EXPECT_FALSE(coarse.stopped || fine.stopped);
    ASSERT_EQ(one.size(), static_cast<std::size_t>(coarse.length / spacing));
    ASSERT_EQ(other.size(), one.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
        EXPECT_LT((one[i] - other[i]).norm(), 1e-7);
        if (i > 0) {
            EXPECT_NEAR((one[i] - one[i - 1]).norm(), spacing, 0.01 * spacing);
        }
    }
}

TEST(LineTracer, SaysWhereItWasStopped) {
    TracedLine line;
    EXPECT_EQ(asked(0.9, 3, line).size(), 3u);
    ASSERT_TRUE(line.stopped);
    EXPECT_DOUBLE_EQ(*line.stopped, 3 * spacing);
    EXPECT_GE(line.length, *line.stopped);
    EXPECT_LT(line.length, *line.stopped + 0.9);
}

/// On a piece of 1e-10 of the domain rounded control points leave no second derivative.
TEST(LineTracer, PassesOverPiecesThatRoundingDecides) {
    const NurbsSurface surface = support::smooth_bicubic(6, 3);
    const ParameterBox domain = surface.domain();
    const auto knots = [](const ParameterInterval& range) {
        std::vector<double> result;
        for (const double share : {1e-11, 0.5, 0.5 + 1e-10, 1.0 - 1e-10})
            result.insert(result.end(), 3, range.low + share * range.length());
        return result;
    };
    const NurbsSurface cut = support::with_knots(surface, knots(domain.u), knots(domain.v)).surface;
    const Model model = support::model_of({surface}), copy = support::model_of({cut});
    const LineTracer tracer(model.faces.front()), other(copy.faces.front());
    int crossed = 0;
    for (const double share : {0.31, 0.5 + 5e-11, 0.68})
        for (const CurvatureFamily family : {CurvatureFamily::maximum, CurvatureFamily::minimum})
            for (const double sense : {1.0, -1.0}) {
                const Vector2 start(domain.u.low + share * domain.u.length(), domain.v.low + 0.37 * domain.v.length());
                const Vector3 way = sense * tracer.value(start, family).tangent;
                const TraceOptions options{.length = 10.0, .tolerance = 1e-10, .longest_step = 0.05};
                const TracedLine whole = tracer.trace(start, family, way, options);
                const TracedLine pieces = other.trace(start, family, way, options);
                ASSERT_FALSE(whole.steps.empty() || pieces.steps.empty());
                EXPECT_EQ(pieces.ended, whole.ended);
                EXPECT_NEAR(pieces.length, whole.length, 1e-7);
                EXPECT_LT((pieces.steps.back().end - whole.steps.back().end).norm(), 1e-7);
                const Vector2 end = whole.steps.back().end, middle(domain.u.middle(), domain.v.middle());
                for (const int k : {0, 1}) crossed += (start[k] < middle[k]) != (end[k] < middle[k]);
            }
    EXPECT_GE(crossed, 4);
}

}  // namespace
}  // namespace umbilic
