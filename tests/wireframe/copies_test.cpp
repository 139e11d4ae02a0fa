// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include <occ_adapter/read_file.h>
#include <support/invariance.h>
#include <wireframe/agreement.h>

namespace umbilic {
namespace {

/// Compares the wireframes of a model's copies with its own and prints a line for each. All must be whole and, where
/// `same_nodes` says so, every node of each face have its counterpart, on symmetric faces up to one of their
/// symmetries.
void compare_copies(const Model& model, const std::vector<support::Invariance>& ways, bool same_nodes) {
    const Wireframe original = wireframe(model);
    for (const support::Invariance& way : ways) {
        SCOPED_TRACE(way.name);
        const support::ModelCopy copy = way.copy(model);
        const Wireframe result = wireframe(copy.model, {.step = original.step * copy.space.scale});
        ASSERT_EQ(result.faces.size(), original.faces.size());
        test::Agreement all;
        int symmetric = 0;
        std::string differing;
        for (std::size_t f = 0; f < original.faces.size(); ++f) {
            EXPECT_EQ(result.faces[f].why, "");
            EXPECT_EQ(result.faces[f].coverage, 1.0);
            const FaceWireframe moved_back = test::moved(result.faces[f], copy.space.inverse());
            test::Agreement own = test::agreement(original.faces[f], moved_back, original.step);
            if (own.unmatched > 0) {
                const test::Agreement turned =
                    test::agreement_up_to_symmetry(model.faces[f], original.faces[f], moved_back, original.step);
                if (turned.unmatched < own.unmatched) {
                    own = turned;
                    ++symmetric;
                }
            }
            if (own.unmatched > 0) differing += " " + std::to_string(original.faces[f].face);
            all.nodes += own.nodes;
            all.unmatched += own.unmatched;
            all.farthest = std::max(all.farthest, own.farthest);
        }
        std::printf("  %-24s %5d nodes, %4d without counterpart, the others within %.1e of the step%s\n",
                    way.name.c_str(), all.nodes, all.unmatched, all.farthest,
                    symmetric > 0 ? (", " + std::to_string(symmetric) + " faces up to a symmetry").c_str() : "");
        if (same_nodes) {
            EXPECT_EQ(all.unmatched, 0) << "on the faces" << differing;
        }
    }
}

/// Those ways that are named.
std::vector<support::Invariance> named(std::vector<support::Invariance> ways, const std::vector<std::string>& names) {
    std::erase_if(ways, [&](const support::Invariance& way) {
        return std::find(names.begin(), names.end(), way.name) == names.end();
    });
    return ways;
}

std::string generated(const std::string& name) {
    return std::string(UMBILIC_MODELS_DIR) + "/" + name;
}
const auto stem = [](const auto& info) {
    std::string name = std::filesystem::path(info.param).stem().string();
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
    return name;
};

class GeneratedCopies : public testing::TestWithParam<const char*> {};

TEST_P(GeneratedCopies, HaveTheSameNodes) {
    const Model model = read_file(generated(GetParam())).model;
    compare_copies(model, support::similarities(), true);
    compare_copies(model, support::reparametrisations(), true);
}

INSTANTIATE_TEST_SUITE_P(Models, GeneratedCopies,
                         testing::Values("blade.step", "blade_moved.igs", "bottle.step", "bottle_cut.step",
                                         "bottle_mirrored.step", "bottle_other.step", "bottle_reapproximated.step",
                                         "bottle_redesigned.igs", "bottle_suspect.igs", "bracket.step",
                                         "bracket_moved.igs", "dome_plate.step", "ellipsoid.step", "hood.step",
                                         "mask.igs", "monge_umbilics.step", "planar_block.step", "sphere.igs",
                                         "torus.step"),
                         stem);

Model shared_model(const std::string& name) {
    const std::string path = std::string(UMBILIC_SHARED_CAD_DIR) + "/" + name;
    return std::filesystem::exists(path) ? read_file(path).model : Model();
}

class RealCopies : public testing::TestWithParam<const char*> {};

TEST_P(RealCopies, HaveTheSameNodes) {
    const Model model = shared_model(GetParam());
    if (model.faces.empty()) GTEST_SKIP() << GetParam() << " is not there";
    compare_copies(model, support::similarities(), true);
    compare_copies(model, support::reparametrisations(), true);
}

INSTANTIATE_TEST_SUITE_P(Files, RealCopies,
                         testing::Values("freeform/kcs_container_ship_hull.iges", "freeform/kvlcc2m_tanker_hull.iges",
                                         "freeform/nacelle_quintic.stp", "freeform/sphere_rational_periodic_poles.igs",
                                         "freeform/sunglasses_lens_inch.igs",
                                         "freeform/ucrm9_wing_metres_flagged_inch.igs", "pairs/iea15_blade_2023_mm.stp",
                                         "pairs/dtmb5415_hull.iges", "pairs/dtmb5415_bulbous_bow.iges",
                                         "pairs/propeller_1045.step"),
                         stem);

/// Rejoined at unequal speed, one node lies 0.16 steps from its counterpart.
TEST(PartlyEqualCopies, HaveTheSameNodes) {
    const Model model = shared_model("pairs/iea15_blade_2022_mm.stp");
    if (model.faces.empty()) GTEST_SKIP() << "the blade is not there";
    std::vector<support::Invariance> ways = support::reparametrisations();
    std::vector<support::Invariance> rejoined = named(ways, {"rejoined"});
    std::erase_if(ways, [](const support::Invariance& way) { return way.name == "rejoined"; });
    compare_copies(model, support::similarities(), true);
    compare_copies(model, ways, true);
    compare_copies(model, rejoined, false);
}

/// Surfaces that fold within less than the step: on one face of each up to 480 of 794 nodes have no counterpart.
class RoughRealCopies : public testing::TestWithParam<const char*> {};

TEST_P(RoughRealCopies, AreCovered) {
    const Model model = shared_model(GetParam());
    if (model.faces.empty()) GTEST_SKIP() << GetParam() << " is not there";
    compare_copies(model, named(support::similarities(), {"moved"}), false);
}

INSTANTIATE_TEST_SUITE_P(Files, RoughRealCopies,
                         testing::Values("pairs/sculpted_surface_iges114_inch.igs",
                                         "pairs/sculpted_surface_iges128_inch.igs"),
                         stem);

}  // namespace
}  // namespace umbilic
