// SPDX-License-Identifier: LGPL-2.1-or-later
// A real part of 597 faces, none of them free-form, against itself and a few of its faces.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include <occ_adapter/read_file.h>
#include <support/invariance.h>
#include <umbilic/matching/match.h>

namespace umbilic {
namespace {

class MechanicalPart : public testing::Test {
protected:
    static void SetUpTestSuite() {
        const std::filesystem::path file =
            std::filesystem::path(UMBILIC_SHARED_CAD_DIR) / "mechanical" / "nist_mbe_pmi_2.stp";
        if (std::filesystem::exists(file)) model_ = read_file(file.string()).model;
    }
    void SetUp() override {
        if (model_.faces.empty()) GTEST_SKIP() << "no real CAD files in " << UMBILIC_SHARED_CAD_DIR;
    }
    static PreparedModel prepared(const Model& model) {
        FeatureOptions options;
        options.umbilics.certificate = false;
        options.samples.count = 2000;
        return prepare(model, options);
    }
    /// Largest distance between the images of the suspect's box corners, relative to the original's diagonal.
    static double error(const SimilarityTransform& found, const SimilarityTransform& truth, const Model& suspect) {
        double worst = 0.0;
        for (int k = 0; k < 8; ++k) {
            const Vector3 corner(k & 1 ? suspect.box.low.x() : suspect.box.high.x(),
                                 k & 2 ? suspect.box.low.y() : suspect.box.high.y(),
                                 k & 4 ? suspect.box.low.z() : suspect.box.high.z());
            worst = std::max(worst, (found.apply(corner) - truth.apply(corner)).norm());
        }
        return worst / model_.box.diagonal();
    }

    static Model model_;
};

Model MechanicalPart::model_;

TEST_F(MechanicalPart, IsFoundMirrored) {
    const support::ModelCopy copy = support::similarities(3).back().copy(model_);
    const Alignment alignment = match(prepared(model_), prepared(copy.model));
    SCOPED_TRACE(alignment.why);
    ASSERT_EQ(alignment.status, AlignmentStatus::found);
    EXPECT_EQ(alignment.method, MatchMethod::analytic);
    EXPECT_TRUE(alignment.original_suspect.mirrored);
    EXPECT_LT(error(alignment.original_suspect, copy.space.inverse(), copy.model), 1e-7);
    EXPECT_TRUE(alignment.free_motions.empty());
}

TEST_F(MechanicalPart, IsFoundByAFewOfItsFaces) {
    const support::ModelCopy copy = support::similarities(4)[1].copy(model_);
    // Every face within an eighth of the diagonal of one of them, as a shell.
    Model piece = copy.model;
    piece.solids.clear();
    const Vector3 middle = piece.faces[100].surface.pole_box().center();
    const double reach = piece.box.diagonal() / 8.0;
    std::erase_if(piece.faces, [&](const Face& face) {
        const BoundingBox box = face.surface.pole_box();
        return (box.low - middle).norm() > reach || (box.high - middle).norm() > reach;
    });
    piece.box = {};
    piece.area = 0.0;
    for (Face& face : piece.faces) {
        face.solid = -1;
        piece.area += face.area;
        piece.box.add(face.surface.pole_box());
    }
    ASSERT_GT(piece.faces.size(), 5u);
    ASSERT_LT(piece.faces.size(), model_.faces.size() / 4);
    const Alignment alignment = match(prepared(model_), prepared(piece));
    SCOPED_TRACE(alignment.why);
    ASSERT_EQ(alignment.status, AlignmentStatus::found);
    double least = error(alignment.original_suspect, copy.space.inverse(), piece);
    for (const SimilarityTransform& pose : alignment.symmetries)
        least = std::min(least, error(pose, copy.space.inverse(), piece));
    EXPECT_LT(least, 1e-7);
}

}  // namespace
}  // namespace umbilic
