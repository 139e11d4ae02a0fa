// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <support/surfaces.h>
#include <support/swept_surfaces.h>
#include <umbilic/core/errors.h>
#include <umbilic/umbilics/find.h>
#include <umbilic/umbilics/shell_certificate.h>

namespace umbilic {
namespace {

/// The surface with every pole multiplied by x, y, z.
NurbsSurface stretched(const NurbsSurface& surface, const Vector3& by, const Vector3& moved = Vector3::Zero()) {
    std::vector<Vector3> poles;
    for (const Vector3& pole : surface.poles()) poles.push_back(pole.cwiseProduct(by) + moved);
    return NurbsSurface(surface.u_knots(), surface.v_knots(), std::move(poles), surface.weights());
}

std::vector<NurbsSurface> eight_octants(const Vector3& axes) {
    std::vector<NurbsSurface> result;
    for (const double x : {1.0, -1.0})
        for (const double y : {1.0, -1.0})
            for (const double z : {1.0, -1.0})
                result.push_back(stretched(support::ellipsoid_octant(axes.x(), axes.y(), axes.z()), {x, y, z}));
    return result;
}

/// A shape like an egg: a surface of revolution with a cubic profile that meets the axis at right angles, stretched.
NurbsSurface egg(const Vector3& by) {
    const support::Profile profile =
        support::spline(3, {{0, -1}, {0.5, -1}, {1.1, -0.6}, {1.2, 0.3}, {0.8, 1.2}, {0.5, 1.6}, {0, 1.6}});
    return stretched(support::revolved(profile, 2 * std::numbers::pi), by);
}

struct Shells {
    Model model;
    std::vector<FaceUmbilics> found;
    std::vector<ShellCertificate> shells;

    explicit Shells(std::vector<NurbsSurface> surfaces)
        : model(support::model_of(std::move(surfaces))),
          found(find_umbilics(model)),
          shells(shell_certificates(model, found)) {}

    const ShellCertificate& only() const {
        EXPECT_EQ(shells.size(), 1u);
        return shells.front();
    }
};

void expect_complete(const ShellCertificate& shell, int euler_characteristic) {
    EXPECT_TRUE(shell.closed);
    ASSERT_TRUE(shell.complete) << shell.why;
    EXPECT_TRUE(*shell.complete) << shell.why << ", sum " << shell.index_sum;
    EXPECT_EQ(shell.euler_characteristic, euler_characteristic);
    EXPECT_EQ(shell.genus(), (2 - euler_characteristic) / 2);
    EXPECT_EQ(shell.index_sum, euler_characteristic);
}

void expect_no_verdict(const ShellCertificate& shell, const std::string& word) {
    EXPECT_FALSE(shell.complete);
    EXPECT_NE(shell.why.find(word), std::string::npos) << shell.why;
}

TEST(ShellCertificate, EllipsoidOfEightFacesHasTheSumTwo) {
    // Its four umbilics lie on edges of the octants: each is seen by two faces or four.
    for (const Vector3& axes : {Vector3(3, 2, 1), Vector3(1, 3, 2), Vector3(2, 1, 3)}) {
        const Shells ellipsoid(eight_octants(axes));
        expect_complete(ellipsoid.only(), 2);
        std::size_t seen = 0;
        for (const FaceUmbilics& on : ellipsoid.found) seen += on.umbilics.size();
        EXPECT_GE(seen, 8u);
    }
}

TEST(ShellCertificate, EllipsoidOfOneFaceHasTheSumTwo) {
    for (const Vector3& axes : {Vector3(3, 2, 1), Vector3(1, 2, 3), Vector3(1, 3, 2)})
        expect_complete(Shells({stretched(support::full_sphere(1.0), axes)}).only(), 2);
}

TEST(ShellCertificate, EllipsoidOfRevolutionHasItsPoles) {
    const Shells ellipsoid({stretched(support::full_sphere(1.0), {1, 1, 2})});
    expect_complete(ellipsoid.only(), 2);
    expect_complete(Shells(eight_octants({1, 1, 2})).only(), 2);
}

TEST(ShellCertificate, TorusHasTheSumZero) {
    expect_complete(Shells({support::full_torus(3, 1)}).only(), 0);
    // Not a torus any more, and with umbilics of both signs or with none.
    expect_complete(Shells({stretched(support::full_torus(3, 1), {1, 1.5, 1.2})}).only(), 0);
}

TEST(ShellCertificate, EggHasTheSumTwo) {
    const Shells shell({egg({1.0, 1.2, 1.0})});
    EXPECT_GE(shell.found[0].umbilics.size(), 4u);
    expect_complete(shell.only(), 2);
}

TEST(ShellCertificate, ShellsAreCertifiedForThemselves) {
    std::vector<NurbsSurface> surfaces = eight_octants({3, 2, 1});
    surfaces.push_back(stretched(support::full_torus(3, 1), {1, 1.5, 1}, {20, 0, 0}));
    surfaces.push_back(stretched(support::rough_bicubic(6, 1), {1, 1, 1}, {0, 40, 0}));
    const Shells three(std::move(surfaces));
    ASSERT_EQ(three.shells.size(), 3u);
    expect_complete(three.shells[0], 2);
    EXPECT_EQ(three.shells[0].faces.size(), 8u);
    expect_complete(three.shells[1], 0);
    EXPECT_EQ(three.shells[1].faces, std::vector<int>{9});
    expect_no_verdict(three.shells[2], "open");
}

TEST(ShellCertificate, CatchesAMissingUmbilic) {
    for (std::vector<NurbsSurface> surfaces : {eight_octants({3, 2, 1}), std::vector{egg({1.0, 1.2, 1.0})},
                                               std::vector{stretched(support::full_sphere(1.0), {3, 2, 1})}}) {
        Shells shell(std::move(surfaces));
        ASSERT_TRUE(shell.only().complete.value_or(false)) << shell.only().why;
        for (const FaceUmbilics& on : std::vector<FaceUmbilics>(shell.found))
            for (const Umbilic& taken : on.umbilics) {
                std::vector<FaceUmbilics> lacking = shell.found;
                // Wherever it was seen.
                for (FaceUmbilics& from : lacking)
                    std::erase_if(from.umbilics,
                                  [&](const Umbilic& other) { return (other.point - taken.point).norm() < 1e-6; });
                const ShellCertificate certificate = shell_certificates(shell.model, lacking).front();
                ASSERT_TRUE(certificate.complete) << certificate.why;
                EXPECT_FALSE(*certificate.complete);
                EXPECT_EQ(certificate.index_sum, 2 - taken.index);
            }
    }
}

TEST(ShellCertificate, SaysWhyThereIsNoVerdict) {
    expect_no_verdict(Shells({support::ellipsoid_octant(3, 2, 1)}).only(), "open, with 3 free edges");
    expect_no_verdict(Shells({support::full_sphere(2.0)}).only(), "umbilic regions");

    // A box: six squares.
    const auto square = [](const Vector3& corner, const Vector3& a, const Vector3& b) {
        return NurbsSurface(KnotVector::bezier(1), KnotVector::bezier(1),
                            {corner, corner + b, corner + a, corner + a + b});
    };
    const Vector3 o = Vector3::Zero(), x = Vector3::UnitX(), y = Vector3::UnitY(), z = Vector3::UnitZ();
    const Shells box(
        {square(o, x, y), square(o, y, z), square(o, z, x), square(z, x, y), square(x, y, z), square(y, z, x)});
    EXPECT_EQ(box.only().genus(), 0);
    expect_no_verdict(box.only(), "12 of 12 edges are sharp");
    expect_no_verdict(box.only(), "6 faces have umbilic regions");

    // The egg with a point instead of its blunt end.
    const NurbsSurface whole = egg({1, 1.3, 1});
    std::vector<Vector3> poles = whole.poles();
    for (int i = 0; i < whole.u_pole_count(); ++i) poles[i * whole.v_pole_count() + 1].z() -= 0.4;
    expect_no_verdict(Shells({NurbsSurface(whole.u_knots(), whole.v_knots(), poles, whole.weights())}).only(), "tip");

    // A flat lens of a quadratic profile, whose curvature jumps towards its rim.
    const NurbsSurface lens =
        support::revolved(support::spline(2, {{0, -0.3}, {1, -0.3}, {1.5, -0.05}, {1.5, 0.05}, {1, 0.3}, {0, 0.3}}),
                          2 * std::numbers::pi);
    expect_no_verdict(Shells({stretched(lens, {1, 1.3, 1})}).only(), "jumps within 1 face");
}

TEST(ShellCertificate, RefusesResultsOfOtherFaces) {
    const Model model = support::model_of({support::full_torus(3, 1)});
    EXPECT_THROW(shell_certificates(model, {}), InvalidInput);
    std::vector<FaceUmbilics> found = find_umbilics(model);
    found[0].face = 7;
    EXPECT_THROW(shell_certificates(model, found), InvalidInput);
}

}  // namespace
}  // namespace umbilic
