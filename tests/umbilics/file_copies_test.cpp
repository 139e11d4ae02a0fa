// SPDX-License-Identifier: LGPL-2.1-or-later
// Umbilics of copies of real faces, and of copies that went through files.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include <occ_adapter/read_file.h>
#include <support/exchange.h>
#include <support/surfaces.h>

#include "same_umbilics.h"

namespace umbilic {
namespace {

class RealFaces : public testing::TestWithParam<const char*> {
protected:
    void SetUp() override {
        path_ = std::string(UMBILIC_SHARED_CAD_DIR) + "/" + GetParam();
        if (!std::filesystem::exists(path_)) GTEST_SKIP() << "no file " << path_;
    }
    std::string path_;
};

TEST_P(RealFaces, UmbilicsStayUnderEveryInvariance) {
    const Model model = read_file(path_).model;
    const FoundUmbilics base = search_umbilics(model, model.faces.size());
    EXPECT_FALSE(base.inside.empty());
    std::vector<support::Invariance> all = support::invariances(3);
    for (support::Invariance& exchange : support::exchanges()) all.push_back(std::move(exchange));
    for (const support::Invariance& invariance : all) {
        SCOPED_TRACE(invariance.name);
        const int open = expect_same_umbilics(model, base, invariance.copy(model));
        // Where nothing was left open, nothing may be: open boxes are for what is not isolated.
        if (base.open.empty()) {
            EXPECT_EQ(open, 0);
        }
        RecordProperty(invariance.name + "_left_open", open);
    }
}

INSTANTIATE_TEST_SUITE_P(Umbilics, RealFaces,
                         testing::Values("freeform/sunglasses_lens_inch.igs", "freeform/nacelle_quintic.stp",
                                         "pairs/dtmb5415_hull.iges"),
                         [](const auto& info) { return std::filesystem::path(info.param).stem().string(); });

TEST(Exchange, UmbilicsComeBackThroughFiles) {
    const Model model =
        support::model_of({support::smooth_bicubic(8, 3), support::rough_bicubic(7, 4),
                           support::random_surface(3, 3, 6, 6, 1, 0.1, 3.0), support::table_3_1_patch()});
    const FoundUmbilics base = search_umbilics(model, model.faces.size());
    EXPECT_GE(base.inside.size(), 10u);
    for (const support::Invariance& exchange : support::exchanges()) {
        SCOPED_TRACE(exchange.name);
        EXPECT_EQ(expect_same_umbilics(model, base, exchange.copy(model)), 0) << "left open, though generic";
    }
}

}  // namespace
}  // namespace umbilic
