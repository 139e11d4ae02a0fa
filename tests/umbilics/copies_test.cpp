// SPDX-License-Identifier: LGPL-2.1-or-later
// Umbilics of copies of generated models.
#include <gtest/gtest.h>

#include <support/invariance.h>
#include <support/surfaces.h>

#include "same_umbilics.h"

namespace umbilic {
namespace {

Model generated(int which) {
    switch (which) {
        case 1:
            return support::model_of({support::smooth_bicubic(8, 3), support::rough_bicubic(7, 4),
                                      support::random_surface(5, 4, 8, 7, 2, 0.1)});
        default:
            return support::model_of({support::random_surface(3, 3, 6, 6, 1, 0.1, 3.0),
                                      support::random_surface(2, 3, 5, 6, 5, 0.1, 8.0), support::table_3_1_patch()});
    }
}

class GeneratedModel : public testing::TestWithParam<int> {};

TEST_P(GeneratedModel, UmbilicsStayUnderEveryInvariance) {
    const Model model = generated(GetParam());
    const FoundUmbilics base = search_umbilics(model, model.faces.size());
    EXPECT_GE(base.inside.size(), 6u);
    EXPECT_EQ(base.undecided + base.lines + base.regions, 0);
    for (const support::Invariance& invariance : support::invariances(GetParam() + 1)) {
        SCOPED_TRACE(invariance.name);
        EXPECT_EQ(expect_same_umbilics(model, base, invariance.copy(model)), 0) << "left open, though generic";
    }
}

INSTANTIATE_TEST_SUITE_P(Umbilics, GeneratedModel, testing::Range(1, 3));

}  // namespace
}  // namespace umbilic
