// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <umbilic/umbilics/find.h>

namespace umbilic {
namespace {

/// A 3 x 1 developable like that of figure 3-5 of the thesis: (u, v, z(u)) with z'' = 0 at u = 0.5754, so that both
/// principal curvatures vanish along that line.
NurbsSurface developable() {
    const double z[4] = {0.0, 1.0, -0.3770311209, 0.0};
    std::vector<Vector3> poles;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 2; ++j) poles.emplace_back(i / 3.0, j, z[i]);
    return NurbsSurface(KnotVector::bezier(3), KnotVector::bezier(1), std::move(poles));
}

TEST(Developable, LineOfUmbilicsAtItsInflection) {
    const FaceUmbilics found = find_umbilics(developable());
    EXPECT_TRUE(found.umbilics.empty());
    EXPECT_TRUE(found.undecided.empty());
    EXPECT_TRUE(found.regions.empty());
    ASSERT_EQ(found.lines.size(), 1u);
    double covered = 0.0;
    for (const ParameterBox& box : found.lines[0].boxes) {
        EXPECT_TRUE(box.u.contains(0.5754)) << box.u.low << ' ' << box.u.high;
        EXPECT_LE(box.u.length(), 1e-3);
        covered += box.v.length();
    }
    EXPECT_NEAR(covered, 1.0, 1e-12);
    EXPECT_TRUE(found.certificate.complete.value_or(false)) << found.certificate.why;
}

TEST(Developable, DepthEightIsTheColumnOfTheThesis) {
    UmbilicOptions options;
    options.resolution = 1.0 / 256;
    const FaceUmbilics found = find_umbilics(developable(), options);
    ASSERT_EQ(found.lines.size(), 1u);
    for (const ParameterBox& box : found.lines[0].boxes) {
        EXPECT_EQ(box.u.low, 147.0 / 256);
        EXPECT_EQ(box.u.high, 148.0 / 256);
    }
}

}  // namespace
}  // namespace umbilic
