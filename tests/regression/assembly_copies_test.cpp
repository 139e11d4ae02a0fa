// SPDX-License-Identifier: LGPL-2.1-or-later
// Parts of a real assembly of 18 solids are looked for in the assembly: they stand in it several times, and touch.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>
#include <vector>

#include <occ_adapter/read_file.h>
#include <umbilic/matching/match.h>

namespace umbilic {
namespace {

class Assembly : public testing::Test {
protected:
    static void SetUpTestSuite() {
        const std::filesystem::path file =
            std::filesystem::path(UMBILIC_SHARED_CAD_DIR) / "mechanical" / "as1_assembly_inch_ap203.stp";
        if (std::filesystem::exists(file)) model_ = read_file(file.string()).model;
    }
    void SetUp() override {
        if (model_.faces.empty()) GTEST_SKIP() << "no real CAD files in " << UMBILIC_SHARED_CAD_DIR;
    }

    static std::vector<int> solids_of(int face_count) {
        std::vector<int> result;
        for (int k = 0; k < static_cast<int>(model_.solids.size()); ++k)
            if (std::count_if(model_.faces.begin(), model_.faces.end(),
                              [&](const Face& face) { return face.solid == k; }) == face_count)
                result.push_back(k);
        return result;
    }

    static Model part(int solid) {
        Model result = model_;
        std::erase_if(result.faces, [&](const Face& face) { return face.solid != solid; });
        result.solids = {model_.solids[solid]};
        result.box = {};
        result.area = 0.0;
        for (Face& face : result.faces) {
            face.solid = 0;
            result.area += face.area;
            result.box.add(face.surface.pole_box());
        }
        return result;
    }

    static Alignment found_in_assembly(int solid) {
        const Model one = part(solid);
        return match(prepare(one), prepare(model_));
    }

    static Model model_;
};

Model Assembly::model_;

TEST_F(Assembly, EveryNutAndEveryAngleIsListed) {
    for (const auto& [face_count, copies] : {std::pair<int, std::size_t>{8, 8}, {16, 2}}) {
        const std::vector<int> solids = solids_of(face_count);
        ASSERT_EQ(solids.size(), copies);
        const Alignment alignment = found_in_assembly(solids.front());
        SCOPED_TRACE(alignment.why);
        ASSERT_EQ(alignment.status, AlignmentStatus::found);
        // Parts touch on whole faces: these count, too.
        EXPECT_GT(alignment.original_coverage, 0.999);
        ASSERT_EQ(alignment.copies.size(), copies);
        for (const int solid : solids) {
            const Vector3 here = model_.solids[solids.front()].centroid, there = model_.solids[solid].centroid;
            const double reach = std::sqrt(model_.solids[solid].area);
            EXPECT_EQ(std::count_if(alignment.copies.begin(), alignment.copies.end(),
                                    [&](const SimilarityTransform& pose) {
                                        return (pose.apply(there) - here).norm() < 1e-6 * reach;
                                    }),
                      1);
        }
    }
}

TEST_F(Assembly, ABoltTurnsAboutItsAxisAndIsNoEvidence) {
    const std::vector<int> bolts = solids_of(7);
    ASSERT_EQ(bolts.size(), 6u);
    const Alignment alignment = found_in_assembly(bolts.front());
    SCOPED_TRACE(alignment.why);
    ASSERT_EQ(alignment.status, AlignmentStatus::compatible);
    EXPECT_GT(alignment.original_coverage, 0.999);
    ASSERT_EQ(alignment.free_motions.size(), 1u);
    EXPECT_EQ(alignment.free_motions.front().kind, FreeMotionKind::turn);
}

}  // namespace
}  // namespace umbilic
