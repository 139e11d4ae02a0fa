// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <support/surfaces.h>
#include <umbilic/core/similarity_transform.h>

namespace umbilic {
namespace {

TEST(SimilarityTransform, InverseUndoesIt) {
    for (unsigned seed = 0; seed < 50; ++seed) {
        const SimilarityTransform t = support::random_similarity(seed, 0.1 + seed, seed % 2 == 1);
        const Vector3 p(1.0, -2.0, 3.0);
        EXPECT_LT((t.inverse().apply(t.apply(p)) - p).norm(), 1e-12);
        EXPECT_EQ(t.inverse().mirrored, t.mirrored);
        EXPECT_NEAR(t.inverse().rotation.determinant(), 1.0, 1e-14);
    }
}

TEST(SimilarityTransform, ComposeAppliesInnerFirst) {
    for (unsigned seed = 0; seed < 50; ++seed) {
        const SimilarityTransform a = support::random_similarity(seed, 2.0, seed % 2 == 0);
        const SimilarityTransform b = support::random_similarity(seed + 100, 0.3, seed % 3 == 0);
        const Vector3 p(0.5, 4.0, -1.0);
        EXPECT_LT((compose(a, b).apply(p) - a.apply(b.apply(p))).norm(), 1e-12);
        EXPECT_EQ(compose(a, b).mirrored, a.mirrored != b.mirrored);
    }
}

TEST(SimilarityTransform, MirrorActsOnXBeforeTheRotation) {
    SimilarityTransform t;
    t.mirrored = true;
    EXPECT_EQ(t.apply(Vector3(1, 2, 3)), Vector3(-1, 2, 3));
}

}  // namespace
}  // namespace umbilic
