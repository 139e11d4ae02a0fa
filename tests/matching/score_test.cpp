// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/score.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <support/surfaces.h>

#include "mechanical_shapes.h"

namespace umbilic {
namespace {

using support::model_of;
using support::rectangle;

TEST(SampleDistances, WherePartsTouchTheFaceOnTheSamplesSideCounts) {
    // Two faces in one place that look at each other; the first and the second of them in turn is the sample's own.
    const NurbsSurface up = rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
                       down = rectangle({0, 0, 0}, {0, 1, 0}, {1, 0, 0});
    const Model both = model_of({up, down});
    const PreparedModel prepared = prepare(both);
    const Ground ground(prepared);
    for (const NurbsSurface& own : {up, down}) {
        const Model one = model_of({own});
        const PreparedModel sampled = prepare(one);
        const std::vector<double> distances =
            sample_distances(ground, true, sampled.features.samples, SimilarityTransform(), 0.1);
        EXPECT_LT(*std::max_element(distances.begin(), distances.end()), 1e-12);
    }
}

TEST(SampleDistances, AFaceThatLooksTheOtherWayDoesNotCount) {
    const Model up = model_of({rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0})});
    const Model down = model_of({rectangle({0, 0, 0}, {0, 0.9, 0}, {0.9, 0, 0})});
    const PreparedModel ground = prepare(up), sampled = prepare(down);
    const std::vector<double> distances =
        sample_distances(Ground(ground), true, sampled.features.samples, SimilarityTransform(), 0.1);
    EXPECT_EQ(std::count_if(distances.begin(), distances.end(), [](double d) { return std::isfinite(d); }), 0);
}

}  // namespace
}  // namespace umbilic
