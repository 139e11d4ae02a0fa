// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <occ_adapter/read_file.h>
#include <umbilic/core/errors.h>

#include "cad_files.h"

namespace umbilic {
namespace {

using support::cad;

TEST(TransformedStep, PointsMoveAsTheTransformSays) {
    UMBILIC_NEEDS_CAD_FILES();
    const support::TemporaryFolder folder;
    for (const bool mirrored : {false, true}) {
        SimilarityTransform transform;
        transform.scale = 2.5;
        transform.rotation = Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()).toRotationMatrix();
        transform.translation = Vector3(10, -20, 30);
        transform.mirrored = mirrored;
        const std::string file = cad("pairs/sculpted_surface_iges128_inch.igs"), out = folder.file("moved.step");
        write_transformed_step(file, transform, out);
        const Model before = read_file(file).model, after = read_file(out).model;
        EXPECT_EQ(after.source.format, "STEP");
        EXPECT_NEAR(after.area / before.area, 2.5 * 2.5, 1e-4);
        ASSERT_EQ(after.faces.size(), before.faces.size());
        for (std::size_t i = 0; i < before.faces.size(); ++i)
            for (const double s : {0.1, 0.5, 0.8}) {
                const ParameterBox domain = before.faces[i].surface.domain();
                const double u = domain.u.low + s * domain.u.length(), v = domain.v.low + 0.3 * domain.v.length();
                const Vector3 expected = transform.apply(before.faces[i].surface.value(u, v));
                EXPECT_LE((after.faces[i].surface.value(u, v) - expected).norm(), 1e-9 * after.size());
            }
    }
    // Nothing but the result remains.
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(TransformedStep, FailureLeavesNothingBehind) {
    UMBILIC_NEEDS_CAD_FILES();
    const support::TemporaryFolder folder;
    const std::string crash = cad("broken/step_part21_scope_aborts_occt.stp");
    EXPECT_THROW(write_transformed_step(crash, {}, folder.file("a.step")), InvalidInput);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
    const std::string good = cad("pairs/sculpted_surface_iges128_inch.igs");
    EXPECT_THROW(write_transformed_step(good, {}, folder.file("absent/a.step")), InvalidInput);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace umbilic
