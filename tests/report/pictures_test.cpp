// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cmath>
#include <limits>
#include <regex>
#include <set>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <report/base64.h>
#include <report/color_scale.h>
#include <report/omega_plane.h>
#include <report/picture.h>
#include <report/readable.h>
#include <report/scene.h>
#include <report/views.h>

#include "made_comparison.h"

namespace umbilic {
namespace {

double luminance(const Color& color) {
    return 0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2];
}

TEST(Base64, TestVectorsOfRfc4648) {
    EXPECT_EQ(base64(""), "");
    EXPECT_EQ(base64("f"), "Zg==");
    EXPECT_EQ(base64("fo"), "Zm8=");
    EXPECT_EQ(base64("foo"), "Zm9v");
    EXPECT_EQ(base64("foob"), "Zm9vYg==");
    EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
    EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
    EXPECT_EQ(base64(std::string("\xff\xfe\x00", 3)), "//4A");
}

TEST(ColorScale, OfSizeGrowsBrighterAllTheWay) {
    const ColorScale scale = color_scale(1.0, 0.5);
    double last = -1.0;
    for (int i = 0; i <= 100; ++i) {
        const double now = luminance(scale.of_size(scale.range * i / 100));
        EXPECT_GT(now, last) << i;
        last = now;
    }
    EXPECT_EQ(scale.of_size(-0.3), scale.of_size(0.3));
    EXPECT_EQ(scale.of_size(100.0), scale.of_size(scale.range));
}

TEST(ColorScale, OfSignedIsBrightestAtZero) {
    const ColorScale scale = color_scale(1.0, 0.5);
    const double middle = luminance(scale.of_signed(0.0));
    for (int i = 1; i <= 50; ++i) {
        EXPECT_LT(luminance(scale.of_signed(scale.range * i / 50)), middle);
        EXPECT_LT(luminance(scale.of_signed(-scale.range * i / 50)), middle);
    }
}

TEST(ColorScale, RangeIsARoundNumberAroundTheTolerance) {
    EXPECT_NEAR(color_scale(0.0, 0.01).range, 0.001, 1e-15);    // noise stays dark
    EXPECT_NEAR(color_scale(0.013, 0.01).range, 0.02, 1e-15);   // all of it shows
    EXPECT_NEAR(color_scale(1000.0, 0.01).range, 0.05, 1e-15);  // what is foreign is cut off
    EXPECT_GT(color_scale(0.0, 0.0).range, 0.0);
    EXPECT_NE(legend_svg(color_scale(1000.0, 0.01), false, "id").find("≥ 0.05 mm"), std::string::npos);
}

TEST(Readable, Numbers) {
    EXPECT_EQ(readable(0.0), "0");
    EXPECT_EQ(readable(-12.5), "−12.5");
    EXPECT_EQ(readable(1.25e-7), "1.25 × 10⁻⁷");
    EXPECT_EQ(readable(std::numeric_limits<double>::quiet_NaN(), "mm"), "–");
    EXPECT_EQ(readable(2.5, "1"), "2.5");
    EXPECT_EQ(readable_percent(0.9999), "> 99.9 %");
    EXPECT_EQ(readable_percent(1.0), "100 %");
    EXPECT_EQ(readable_percent(1e-9), "< 0.1 %");
    EXPECT_EQ(readable_count(1234567), "1\u202f234\u202f567");
    EXPECT_EQ(readable_count(999), "999");
    EXPECT_EQ(base_name("/a/b.step"), "b.step");
}

TEST(Picture, IsAPngFile) {
    BoundingBox box;
    box.add(Vector3::Zero());
    box.add(Vector3::Ones());
    Picture picture(front_view(), box, 40, 30);
    picture.add_surface({{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}, std::vector<Vector3>(3, -Vector3::UnitY()), {{0, 1, 2}},
                        std::vector<Color>(3, Color{1.0f, 0.0f, 0.0f}));
    picture.add_line({0, 0, 0}, {1, 1, 1}, {0.0f, 0.0f, 0.0f}, 1.0);
    const std::string png = picture.png();
    EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
    EXPECT_EQ(static_cast<unsigned char>(png[19]), 40);
    EXPECT_EQ(static_cast<unsigned char>(png[23]), 30);
}

TEST(Picture, ViewsAreRightHandedFrames) {
    for (const ViewAxes& axes : {isometric_view(), front_view(), side_view(), top_view()}) {
        EXPECT_NEAR((axes * axes.transpose() - Matrix3::Identity()).norm(), 0.0, 1e-14);
        EXPECT_NEAR(axes.row(0).cross(axes.row(1)).dot(axes.row(2)), 1.0, 1e-14);
    }
}

TEST(Picture, StandsThingsWithoutExtent) {
    BoundingBox box;
    box.add(Vector3::Zero());
    Picture picture(top_view(), box, 8, 8);
    picture.add_disc(Vector3::Zero(), {0.0f, 0.0f, 0.0f}, 2.0);
    picture.add_line(Vector3::Constant(std::nan("")), Vector3::Zero(), {0.0f, 0.0f, 0.0f}, 1.0);
    EXPECT_FALSE(picture.png().empty());
}

TEST(Scene, AlignedCopyDeviatesByRoundingOnly) {
    const auto made = made_comparison();
    const Scene scene =
        make_scene(*made->original, made->original_meshes, *made->suspect, made->suspect_meshes, made->comparison);
    ASSERT_TRUE(scene.posed);
    ASSERT_EQ(scene.suspect.deviation.size(), scene.suspect.points.size());
    for (const double deviation : scene.suspect.deviation) EXPECT_LT(std::abs(deviation), 1e-9);
    EXPECT_EQ(scene.umbilics.size(), 10u);
    // Triangles keep facing outward although the pose is a mirror image.
    double agreement = 0.0;
    for (const auto& [a, b, c] : scene.suspect.triangles) {
        const auto& p = scene.suspect.points;
        agreement += (p[b] - p[a]).cross(p[c] - p[a]).dot(scene.suspect.normals[a]);
    }
    EXPECT_GT(agreement, 0.0);
}

TEST(Scene, DeviationIsPositiveOnTheOutwardSide) {
    auto made = made_comparison();
    const Face& face = made->original_model.faces.front();
    const Vector3 normal = curvature(face.surface, 0.5, 0.5).normal;
    made->comparison.alignment.original_suspect.translation += 0.01 * normal;
    const Scene scene =
        make_scene(*made->original, made->original_meshes, *made->suspect, made->suspect_meshes, made->comparison);
    double nearest = std::numeric_limits<double>::infinity(), value = 0.0;
    for (std::size_t i = 0; i < scene.suspect.points.size(); ++i) {
        const double distance = (scene.suspect.points[i] - face.surface.value(0.5, 0.5)).norm();
        if (distance < nearest) {
            nearest = distance;
            value = scene.suspect.deviation[i];
        }
    }
    EXPECT_NEAR(value, 0.01, 1e-6);
}

TEST(Scene, WiresLieOnTheOriginal) {
    const auto made = made_comparison();
    const SceneWires wires = original_wires(*made->original);
    EXPECT_GT(wires.step, 0.0);
    EXPECT_GT(wires.nodes.size(), 100u);
    EXPECT_GT(wires.lines.size(), wires.nodes.size());
    std::set<WireKind> kinds;
    for (const SceneWires::Line& line : wires.lines) {
        kinds.insert(line.kind);
        EXPECT_GE(line.points.size(), 2u);
        for (const Vector3& point : line.points)
            EXPECT_LT(made->original->tree.closest(point)->distance, 1e-6 * wires.step);
    }
    EXPECT_EQ(kinds.size(), 4u);
    Scene scene =
        make_scene(*made->original, made->original_meshes, *made->suspect, made->suspect_meshes, made->comparison);
    EXPECT_TRUE(wireframe_views(scene).empty());
    scene.wires = wires;
    EXPECT_EQ(wireframe_views(scene).size(), 2u);
}

TEST(Scene, LongEdgesAreSplitOnTheSurface) {
    auto made = made_comparison();
    const Face& face = made->original_model.faces.front();
    DisplayMesh coarse;
    coarse.face = face.number;
    coarse.parameters = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (const Vector2& at : coarse.parameters) coarse.points.push_back(face.surface.value(at.x(), at.y()));
    coarse.triangles = {{0, 1, 2}, {0, 2, 3}};
    const Scene scene = make_scene(*made->original, {coarse}, *made->suspect, made->suspect_meshes, made->comparison);
    EXPECT_GT(scene.original.triangles.size(), 500u);
    for (const Vector3& point : scene.original.points) {
        EXPECT_LT(made->original->tree.closest(point)->distance, 1e-9);
    }
    // Split the same way from both sides: inner edges have two triangles, so the border is the square's.
    double border = 0.0;
    for (const auto& [a, b] : scene.original.edges) {
        const Vector3 middle = 0.5 * (scene.original.points[a] + scene.original.points[b]);
        const double inner = std::min({middle.x(), middle.y(), 1.0 - middle.x(), 1.0 - middle.y()});
        EXPECT_LT(std::abs(inner), 1e-6);
        border += (scene.original.points[a] - scene.original.points[b]).norm();
    }
    EXPECT_GE(border, 4.0 - 1e-6);
}

TEST(OmegaPlane, ShowsEveryUmbilicInThreePlaces) {
    const auto made = made_comparison();
    const std::string svg = omega_plane_svg(*made->original, *made->suspect, true);
    const auto count = [&](const char* pattern) {
        const std::regex regex(pattern);
        return std::distance(std::sregex_iterator(svg.begin(), svg.end(), regex), std::sregex_iterator());
    };
    EXPECT_EQ(count("class=\"original"), 15);
    EXPECT_EQ(count("class=\"suspect"), 15);
}

TEST(OmegaPlane, CorrespondingUmbilicsOfAMirrorImageCoincide) {
    const auto made = made_comparison();
    const std::string svg = omega_plane_svg(*made->original, *made->suspect, true);
    std::vector<std::pair<double, double>> originals, suspects;
    const std::regex cross("class=\"original[^\"]*\" d=\"M([0-9.-]+) ([0-9.-]+)m");
    const std::regex circle("class=\"suspect[^\"]*\" cx=\"([0-9.-]+)\" cy=\"([0-9.-]+)\"");
    for (auto it = std::sregex_iterator(svg.begin(), svg.end(), cross); it != std::sregex_iterator(); ++it) {
        originals.emplace_back(std::stod((*it)[1]), std::stod((*it)[2]));
    }
    for (auto it = std::sregex_iterator(svg.begin(), svg.end(), circle); it != std::sregex_iterator(); ++it) {
        suspects.emplace_back(std::stod((*it)[1]), std::stod((*it)[2]));
    }
    ASSERT_EQ(originals.size(), 15u);
    for (const auto& [x, y] : originals) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const auto& [sx, sy] : suspects) nearest = std::min(nearest, std::hypot(x - sx, y - sy));
        EXPECT_LT(nearest, 0.3);  // printed to a tenth
    }
}

}  // namespace
}  // namespace umbilic
