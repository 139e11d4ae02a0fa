// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>

#include <occ_adapter/read_file.h>
#include <support/invariance.h>
#include <umbilic/wireframe/wireframe.h>

namespace umbilic {
namespace {

/// Greatest distance, as a share of the step, at which nodes of a copy are the nodes of the original. The integration
/// of each line is accurate to 1e-7 of the step at each of its steps; crossings of lines in turn start new lines.
constexpr double same_node = 1e-2;

/// Nodes of `one`, moved by `space`, without a node of `other`.
int unmatched(const FaceWireframe& one, const FaceWireframe& other, const SimilarityTransform& space, double step) {
    int count = 0;
    for (const WireNode& node : one.nodes) {
        const Vector3 p = space.apply(node.curvature.point);
        double nearest = std::numeric_limits<double>::infinity();
        for (const WireNode& there : other.nodes) nearest = std::min(nearest, (there.curvature.point - p).norm());
        count += nearest > same_node * step;
    }
    return count;
}

void expect_same_nodes(const Model& model) {
    const Wireframe original = wireframe(model);
    std::vector<support::Invariance> ways = support::similarities();
    for (support::Invariance& way : support::reparametrisations()) ways.push_back(std::move(way));
    for (const support::Invariance& way : ways) {
        SCOPED_TRACE(way.name);
        const support::ModelCopy copy = way.copy(model);
        const Wireframe result = wireframe(copy.model, {.step = original.step * copy.space.scale});
        ASSERT_EQ(result.faces.size(), original.faces.size());
        for (std::size_t f = 0; f < original.faces.size(); ++f) {
            EXPECT_EQ(unmatched(original.faces[f], result.faces[f], copy.space, result.step), 0);
            EXPECT_EQ(unmatched(result.faces[f], original.faces[f], copy.space.inverse(), original.step), 0);
            EXPECT_EQ(result.faces[f].coverage, 1.0);
        }
    }
}

class Copies : public testing::TestWithParam<const char*> {};

TEST_P(Copies, HaveTheSameNodes) {
    expect_same_nodes(read_file(std::string(UMBILIC_MODELS_DIR) + "/" + GetParam()).model);
}

INSTANTIATE_TEST_SUITE_P(FreeForm, Copies,
                         testing::Values("bottle.step", "bottle_other.step", "blade.step", "hood.step",
                                         "monge_umbilics.step"),
                         [](const auto& info) {
                             std::string name = info.param;
                             return name.substr(0, name.find('.'));
                         });

}  // namespace
}  // namespace umbilic
