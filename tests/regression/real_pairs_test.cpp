// SPDX-License-Identifier: LGPL-2.1-or-later
// Pairs of real supplier files whose relation is known by measurement (INDEX.md beside the files).
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include <occ_adapter/read_file.h>
#include <umbilic/similarity/compare.h>

namespace umbilic {
namespace {

struct Pair {
    Model original;
    Model suspect;
    Comparison comparison;

    /// Largest distance between the images of the suspect's box corners under the pose found and under the truth,
    /// relative to the original's diagonal.
    double error(const SimilarityTransform& truth) const {
        double worst = 0.0;
        for (int k = 0; k < 8; ++k) {
            const BoundingBox& box = suspect.box;
            const Vector3 corner(k & 1 ? box.low.x() : box.high.x(), k & 2 ? box.low.y() : box.high.y(),
                                 k & 4 ? box.low.z() : box.high.z());
            worst = std::max(worst, (comparison.alignment.original_suspect.apply(corner) - truth.apply(corner)).norm());
        }
        return worst / original.box.diagonal();
    }
    const Alignment& alignment() const { return comparison.alignment; }
};

class RealPairs : public testing::Test {
protected:
    Pair compare_files(const std::string& original, const std::string& suspect) {
        const std::filesystem::path folder = std::filesystem::path(UMBILIC_SHARED_CAD_DIR) / "pairs";
        Pair pair{read_file((folder / original).string()).model, read_file((folder / suspect).string()).model, {}};
        const PreparedModel a = prepare(pair.original), b = prepare(pair.suspect);
        pair.comparison = compare(a, b);
        return pair;
    }
    void SetUp() override {
        if (!std::filesystem::exists(UMBILIC_SHARED_CAD_DIR))
            GTEST_SKIP() << "no real CAD files in " << UMBILIC_SHARED_CAD_DIR;
    }
};

SimilarityTransform moved_by(const Vector3& translation, double scale = 1.0) {
    SimilarityTransform result;
    result.scale = scale;
    result.translation = translation;
    return result;
}

TEST_F(RealPairs, HullWithSinkageAndTrim) {
    const Pair pair = compare_files("dtmb5415_hull.iges", "dtmb5415_hull_moved.iges");
    ASSERT_TRUE(pair.alignment().found()) << pair.alignment().why;
    const double angle = 0.421 * std::numbers::pi / 180;
    EXPECT_NEAR(pair.alignment().original_suspect.scale, 1.0, 1e-7);
    EXPECT_NEAR(rotation_angle_between(pair.alignment().original_suspect.rotation, Matrix3::Identity()), angle, 1e-5);
    EXPECT_NEAR(pair.alignment().original_suspect.inverse().translation.z(), -95.644440, 0.01);
    EXPECT_GE(pair.comparison.verdict.level, Level::intermediate);
}

TEST_F(RealPairs, BladeInMetresIsScaledByAThousand) {
    const Pair pair = compare_files("iea15_blade_2023_mm.stp", "iea15_blade_2023_metres.igs");
    ASSERT_TRUE(pair.alignment().found()) << pair.alignment().why;
    EXPECT_LT(pair.error(moved_by(Vector3::Zero(), 1e-3)), 1e-7);
    EXPECT_EQ(pair.comparison.answer.kind, AnswerClass::scaled) << pair.comparison.answer.text;
    EXPECT_NE(pair.comparison.answer.text.find("unit"), std::string::npos) << pair.comparison.answer.text;
}

TEST_F(RealPairs, PropellerIsMirrored) {
    const Pair pair = compare_files("propeller_1045.step", "propeller_1045_mirrored_edited.step");
    ASSERT_TRUE(pair.alignment().found()) << pair.alignment().why;
    EXPECT_TRUE(pair.alignment().original_suspect.mirrored);
    EXPECT_NEAR(pair.alignment().original_suspect.scale, 1.0, 1e-5);
    EXPECT_TRUE(pair.comparison.verdict.derived);
    EXPECT_NE(pair.comparison.answer.kind, AnswerClass::different) << pair.comparison.answer.text;
}

TEST_F(RealPairs, BladeLoftedAgain) {
    const Pair pair = compare_files("iea15_blade_2022_mm.stp", "iea15_blade_2023_mm.stp");
    ASSERT_TRUE(pair.alignment().found()) << pair.alignment().why;
    EXPECT_LT(pair.error(SimilarityTransform()), 5e-4);
    EXPECT_EQ(pair.comparison.answer.kind, AnswerClass::reapproximated) << pair.comparison.answer.text;
}

TEST_F(RealPairs, SculptedSurfaceFromTwoExporters) {
    const Pair pair = compare_files("sculpted_surface_iges128_inch.igs", "sculpted_surface_iges114_inch.igs");
    ASSERT_TRUE(pair.alignment().found()) << pair.alignment().why;
    EXPECT_LT(pair.error(SimilarityTransform()), 3e-4);
    EXPECT_GE(pair.comparison.verdict.level, Level::weak);
}

TEST_F(RealPairs, BulbousBowIsAPieceOfTheHull) {
    const Pair pair = compare_files("dtmb5415_hull.iges", "dtmb5415_bulbous_bow.iges");
    ASSERT_TRUE(pair.alignment().found()) << pair.alignment().why;
    EXPECT_LT(pair.error(moved_by(Vector3(0, 0, 97.0))), 1e-3);
    EXPECT_EQ(pair.alignment().scope, MatchScope::partial);
}

TEST_F(RealPairs, AirlinerFromTwoSystems) {
    const Pair pair = compare_files("b777_openvsp.stp", "b777_onshape.step");
    ASSERT_TRUE(pair.alignment().found()) << pair.alignment().why;
    EXPECT_LT(pair.error(SimilarityTransform()), 1e-5);
}

TEST_F(RealPairs, UnrelatedModelsAreNotDerived) {
    const Pair pair = compare_files("propeller_1045.step", "sculpted_surface_iges128_inch.igs");
    EXPECT_FALSE(pair.comparison.verdict.derived) << pair.comparison.answer.text;
    const Pair other = compare_files("iea15_blade_2023_mm.stp", "dtmb5415_bulbous_bow.iges");
    EXPECT_FALSE(other.comparison.verdict.derived) << other.comparison.answer.text;
}

TEST_F(RealPairs, PlanesOfTwoShipsAreNoEvidence) {
    // Flat sides, bottoms and decks: at scales of their own a third of the areas coincides.
    const Pair pair = compare_files("../freeform/kvlcc2m_tanker_hull.iges", "../freeform/kcs_container_ship_hull.iges");
    EXPECT_NE(pair.alignment().status, AlignmentStatus::found) << pair.alignment().why;
    EXPECT_FALSE(pair.comparison.verdict.derived) << pair.comparison.answer.text;
}

}  // namespace
}  // namespace umbilic
