// SPDX-License-Identifier: LGPL-2.1-or-later
// One test for each cell of Table 4.1 of the thesis: correspondences given (C), an initial pose given (I) or nothing
// (N); the suspect is the whole original (G) or a piece of it (P); without (WOS) or with (WS) scaling.
#include <umbilic/matching/match.h>

#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <support/reparametrisation.h>
#include <support/surfaces.h>

namespace umbilic {
namespace {

using support::model_of;
using support::random_similarity;
using support::transformed;

/// A free-form original and a moved copy of it, or of 40 % of its area.
class Table41 : public testing::Test {
protected:
    void make(bool whole, double scale) {
        const NurbsSurface surface = support::smooth_bicubic(10, 3);
        truth_ = random_similarity(whole ? 31 : 32, scale, false);
        original_model_ = model_of({surface});
        suspect_model_ = model_of(
            {transformed(whole ? surface : support::restricted(surface, {{0.2, 0.8}, {0.1, 0.8}}), truth_.inverse())});
        options_.scale.kind = scale == 1.0 ? ScaleChoice::Kind::fixed : ScaleChoice::Kind::automatic;
        options_.scope = whole ? ScopeChoice::global : ScopeChoice::partial;
    }
    /// Five corresponding points read off to a thousandth of the size, and one that was mistaken for another.
    void give_pairs() {
        const NurbsSurface& surface = suspect_model_.faces.front().surface;
        const double slip = 1e-3 * original_model_.size();
        int k = 0;
        const ParameterBox box = surface.domain();
        for (const auto& [u, v] : {std::pair(0.1, 0.1), std::pair(0.9, 0.2), std::pair(0.15, 0.85), std::pair(0.8, 0.9),
                                   std::pair(0.5, 0.4), std::pair(0.3, 0.6)}) {
            const Vector3 p = surface.value(box.u.low + u * box.u.length(), box.v.low + v * box.v.length());
            options_.pairs.emplace_back(truth_.apply(p) + slip * Vector3::Unit(k % 3), p);
            ++k;
        }
        options_.pairs[4].first = options_.pairs[1].first;
    }
    /// Turned by 12 degrees, displaced by a tenth of the size, a tenth too large.
    void give_initial_pose() {
        const Vector3 centre = original_model_.box.center();
        SimilarityTransform off;
        off.rotation = Eigen::AngleAxisd(0.2, Vector3(1, 2, -1).normalized()).toRotationMatrix();
        off.scale = options_.scale.kind == ScaleChoice::Kind::fixed ? 1.0 : 1.1;
        off.translation = centre - off.scale * (off.rotation * centre) +
                          0.1 * original_model_.size() * Vector3(1, -1, 1).normalized();
        options_.initial = compose(off, truth_);
    }
    void expect_found(bool given) {
        FeatureOptions features;
        features.samples.count = 1500;
        features.umbilics.certificate = false;
        const PreparedModel original = prepare(original_model_, features), suspect = prepare(suspect_model_, features);
        const Alignment alignment = match(original, suspect, options_);
        SCOPED_TRACE(alignment.why);
        ASSERT_TRUE(alignment.found());
        EXPECT_EQ(alignment.method == MatchMethod::given, given) << name(alignment.method);
        EXPECT_EQ(alignment.scope, options_.scope == ScopeChoice::global ? MatchScope::global : MatchScope::partial);
        EXPECT_FALSE(alignment.original_suspect.mirrored);
        if (options_.scale.kind == ScaleChoice::Kind::fixed) {
            EXPECT_EQ(alignment.original_suspect.scale, 1.0);
        } else {
            EXPECT_NEAR(alignment.original_suspect.scale / truth_.scale, 1.0, 1e-9);
        }
        double greatest = 0.0;
        for (const AreaSample& sample : suspect.features.samples)
            greatest = std::max(greatest, (alignment.original_suspect.apply(sample.curvature.point) -
                                           truth_.apply(sample.curvature.point))
                                              .norm());
        EXPECT_LT(greatest, 1e-9 * original_model_.size());
        ASSERT_EQ(alignment.given_pairs.size(), options_.pairs.size());
        for (std::size_t k = 0; k < alignment.given_pairs.size(); ++k)
            EXPECT_EQ(alignment.given_pairs[k].outlier, k == 4) << k;
    }

    Model original_model_, suspect_model_;
    SimilarityTransform truth_;
    MatchOptions options_;
};

TEST_F(Table41, CGWOS) {
    make(true, 1.0);
    give_pairs();
    expect_found(true);
}

TEST_F(Table41, CGWS) {
    make(true, 2.4);
    give_pairs();
    expect_found(true);
}

TEST_F(Table41, CPWOS) {
    make(false, 1.0);
    give_pairs();
    expect_found(true);
}

TEST_F(Table41, CPWS) {
    make(false, 0.3);
    give_pairs();
    expect_found(true);
}

TEST_F(Table41, IGWOS) {
    make(true, 1.0);
    give_initial_pose();
    expect_found(true);
}

TEST_F(Table41, IGWS) {
    make(true, 25.4);
    give_initial_pose();
    expect_found(true);
}

TEST_F(Table41, IPWOS) {
    make(false, 1.0);
    give_initial_pose();
    expect_found(true);
}

TEST_F(Table41, IPWS) {
    make(false, 0.6);
    give_initial_pose();
    expect_found(true);
}

TEST_F(Table41, NGWOS) {
    make(true, 1.0);
    expect_found(false);
}

TEST_F(Table41, NGWS) {
    make(true, 0.1);
    expect_found(false);
}

TEST_F(Table41, NPWOS) {
    make(false, 1.0);
    expect_found(false);
}

TEST_F(Table41, NPWS) {
    make(false, 7.0);
    expect_found(false);
}

}  // namespace
}  // namespace umbilic
