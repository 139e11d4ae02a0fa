// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <vector>

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

}  // namespace
}  // namespace umbilic
