// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include <occ_adapter/read_file.h>
#include <support/invariance.h>
#include <umbilic/wireframe/wireframe.h>

namespace umbilic {
namespace {

/// Greatest distance, as a share of the step, at which nodes of a copy are the nodes of the original. The integration
/// of each line is accurate to 1e-7 of the step at each of its steps; crossings of lines in turn start new lines.
constexpr double same_node = 1e-2;

/// What the nodes of one wireframe, moved by `space`, are to those of another.
struct Agreement {
    int unmatched = 0;      ///< without a node of the other within `same_node`
    double farthest = 0.0;  ///< greatest distance of the others from their node, relative to the step
};

void compare(Agreement& agreement, const FaceWireframe& one, const FaceWireframe& other,
             const SimilarityTransform& space, double step) {
    for (const WireNode& node : one.nodes) {
        const Vector3 p = space.apply(node.curvature.point);
        double nearest = std::numeric_limits<double>::infinity();
        for (const WireNode& there : other.nodes) nearest = std::min(nearest, (there.curvature.point - p).norm());
        nearest /= step;
        if (nearest > same_node)
            ++agreement.unmatched;
        else
            agreement.farthest = std::max(agreement.farthest, nearest);
    }
}

/// Compares the wireframes of a model's copies with its own and prints a line for each; all must be whole. Where
/// `strict` says so, every node must have its counterpart.
void compare_copies(const Model& model, const std::vector<support::Invariance>& ways, bool strict) {
    const Wireframe original = wireframe(model);
    for (const support::Invariance& way : ways) {
        SCOPED_TRACE(way.name);
        const support::ModelCopy copy = way.copy(model);
        const Wireframe result = wireframe(copy.model, {.step = original.step * copy.space.scale});
        ASSERT_EQ(result.faces.size(), original.faces.size());
        Agreement agreement;
        std::size_t nodes = 0;
        for (std::size_t f = 0; f < original.faces.size(); ++f) {
            compare(agreement, original.faces[f], result.faces[f], copy.space, result.step);
            compare(agreement, result.faces[f], original.faces[f], copy.space.inverse(), original.step);
            nodes += original.faces[f].nodes.size() + result.faces[f].nodes.size();
            EXPECT_EQ(result.faces[f].why, "");
            EXPECT_EQ(result.faces[f].coverage, 1.0);
        }
        std::printf("  %-24s %5zu nodes, %4d without counterpart, the others within %.1e of the step\n",
                    way.name.c_str(), nodes, agreement.unmatched, agreement.farthest);
        if (strict) {
            EXPECT_EQ(agreement.unmatched, 0);
        }
    }
}

std::string generated(const std::string& name) {
    return std::string(UMBILIC_MODELS_DIR) + "/" + name;
}

class Copies : public testing::TestWithParam<const char*> {};
const auto stem = [](const auto& info) { return std::filesystem::path(info.param).stem().string(); };

/// Shapes without symmetry.
class FreeFormCopies : public Copies {};

TEST_P(FreeFormCopies, HaveTheSameNodes) {
    const Model model = read_file(generated(GetParam())).model;
    compare_copies(model, support::similarities(), true);
    compare_copies(model, support::reparametrisations(), true);
}

INSTANTIATE_TEST_SUITE_P(Generated, FreeFormCopies,
                         testing::Values("bottle.step", "bottle_other.step", "blade.step", "hood.step",
                                         "monge_umbilics.step"),
                         stem);

/// Shapes whose symmetry leaves the start of the net, or the centres of equal circles, to rounding: many sets of nodes
/// are as good as one another.
class SymmetricCopies : public Copies {};

TEST_P(SymmetricCopies, AreCovered) {
    const Model model = read_file(generated(GetParam())).model;
    compare_copies(model, support::similarities(), false);
    compare_copies(model, support::reparametrisations(), false);
}

INSTANTIATE_TEST_SUITE_P(Generated, SymmetricCopies,
                         testing::Values("bracket.step", "dome_plate.step", "ellipsoid.step", "planar_block.step",
                                         "torus.step"),
                         stem);

std::string shared(const std::string& name) {
    return std::string(UMBILIC_SHARED_CAD_DIR) + "/" + name;
}

class MovedRealCopies : public Copies {};

TEST_P(MovedRealCopies, HaveTheSameNodes) {
    const std::string path = shared(GetParam());
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
    compare_copies(read_file(path).model, support::similarities(), true);
}

INSTANTIATE_TEST_SUITE_P(Shared, MovedRealCopies,
                         testing::Values("pairs/dtmb5415_hull.iges", "freeform/kvlcc2m_tanker_hull.iges",
                                         "freeform/sunglasses_lens_inch.igs"),
                         stem);

/// Where knots differ, a line that ends near the limit to its neighbour may end a sample sooner or later, and few nodes
/// with it.
TEST(RealCopies, AreCoveredWhenReparametrised) {
    const std::string path = shared("pairs/dtmb5415_hull.iges");
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
    compare_copies(read_file(path).model, support::reparametrisations(), false);
}

}  // namespace
}  // namespace umbilic
