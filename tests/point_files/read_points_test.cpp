// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

#include <point_files/read_points.h>
#include <umbilic/core/errors.h>

namespace umbilic {
namespace {

/// A file that goes away again.
class MadeFile {
public:
    MadeFile(const std::string& name, const std::string& contents)
        : path_(std::filesystem::temp_directory_path() /
                (std::to_string(::testing::UnitTest::GetInstance()->random_seed()) + "_" +
                 ::testing::UnitTest::GetInstance()->current_test_info()->name() + "_" + name)) {
        std::ofstream(path_, std::ios::binary) << contents;
    }
    ~MadeFile() { std::filesystem::remove(path_); }
    std::string path() const { return path_.string(); }

private:
    std::filesystem::path path_;
};

PointCloud read(const std::string& name, const std::string& contents) {
    return read_points(MadeFile(name, contents).path());
}

std::string refusal(const std::string& name, const std::string& contents) {
    try {
        read(name, contents);
    } catch (const InvalidInput& error) {
        return error.what();
    }
    return "accepted";
}

template <class Number>
std::string raw(Number number, std::endian order) {
    std::string bytes(sizeof(Number), '\0');
    std::memcpy(bytes.data(), &number, sizeof(Number));
    if (order != std::endian::native) std::reverse(bytes.begin(), bytes.end());
    return bytes;
}

std::string ply_header(const std::string& format, const std::string& vertices, const std::string& faces) {
    return "ply\nformat " + format + " 1.0\ncomment made\nelement vertex " + vertices +
           "\nproperty float x\nproperty float y\nproperty double z\nproperty uchar red\nelement face " + faces +
           "\nproperty list uchar int vertex_indices\nend_header\n";
}

/// A unit square as one polygon of four corners.
std::string binary_square(std::endian order) {
    std::string text =
        ply_header(order == std::endian::little ? "binary_little_endian" : "binary_big_endian", "4", "1");
    for (const auto& [x, y] : {std::pair(0.0f, 0.0f), {1.0f, 0.0f}, {1.0f, 1.0f}, {0.0f, 1.0f}})
        text += raw(x, order) + raw(y, order) + raw(0.5, order) + raw(std::uint8_t(200), order);
    text += raw(std::uint8_t(4), order);
    for (std::int32_t i = 0; i < 4; ++i) text += raw(i, order);
    return text;
}

std::string binary_stl(std::uint32_t promised, std::uint32_t written) {
    std::string text = "solid in name only" + std::string(62, ' ') + raw(promised, std::endian::little);
    for (std::uint32_t i = 0; i < written; ++i) {
        for (int k = 0; k < 3; ++k) text += raw(0.0f, std::endian::little);
        for (const float x : {0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, static_cast<float>(i)})
            text += raw(x, std::endian::little);
        text += std::string(2, '\0');
    }
    return text;
}

TEST(ReadPoints, TablesInTheirManyForms) {
    const std::vector<Vector3> expected = {{1.5, -2, 3e2}, {0, 0.25, 7}};
    for (const char* const text : {"1.5 -2 3e2\n0 .25 7\n", "1.5,-2,300\r\n0,0.25,7\r\n", "1.5;-2;300\n0;0.25;7",
                                   "x,y,z\n1.5,-2,300\n0,0.25,7\n", "\"z\";\"x\";\"y\"\n300;1.5;-2\n7;0;0.25\n",
                                   "1,5;-2,0;300\n0;0,25;7\n", "# scanned\n// by hand\n1.5\t-2\t300\n\n0 +0.25 7\n",
                                   "\xef\xbb\xbf"
                                   "1.5 -2 300 255 0 0\n0 0.25 7 0 255 0\n",
                                   "2\n1.5 -2 300\n0 0.25 7\n"}) {
        const PointCloud cloud = read("table.dat", text);
        ASSERT_EQ(cloud.points.size(), 2u) << text;
        for (int i = 0; i < 2; ++i) EXPECT_EQ(cloud.points[i], expected[i]) << text;
        EXPECT_TRUE(cloud.normals.empty()) << text;
        EXPECT_EQ(cloud.source.format, "points");
        EXPECT_EQ(cloud.source.sha256.size(), 64u);
        EXPECT_FALSE(cloud.is_mesh());
    }
}

TEST(ReadPoints, NormalsInTables) {
    for (const char* const text :
         {"1 2 3 0 0 1\n4 5 6 0 0.6 0.8\n", "x y z nx ny nz i\n1 2 3 0 0 1 9\n4 5 6 0 3 4 9\n"}) {
        const PointCloud cloud = read("normals.xyz", text);
        ASSERT_EQ(cloud.normals.size(), 2u);
        EXPECT_NEAR((cloud.normals[1] - Vector3(0, 0.6, 0.8)).norm(), 0.0, 1e-15);
    }
}

TEST(ReadPoints, PlyInThreeEncodings) {
    const std::string text = ply_header("ascii", "4", "1") + "0 0 0.5 9\n1 0 0.5 9\n1 1 0.5 9\n0 1 0.5 9\n4 0 1 2 3\n";
    for (const std::string& contents : {text, binary_square(std::endian::little), binary_square(std::endian::big)}) {
        const PointCloud cloud = read("square.ply", contents);
        ASSERT_EQ(cloud.points.size(), 4u);
        EXPECT_EQ(cloud.points[2], Vector3(1, 1, 0.5));
        ASSERT_EQ(cloud.triangles.size(), 2u);
        EXPECT_EQ(triangle_area(cloud, cloud.triangles[0]) + triangle_area(cloud, cloud.triangles[1]), 1.0);
    }
}

TEST(ReadPoints, StlAndObj) {
    const PointCloud binary = read("a.stl", binary_stl(2, 2));
    EXPECT_EQ(binary.triangles.size(), 2u);
    EXPECT_EQ(binary.points.size(), 4u);  // the corners that both share are one
    EXPECT_EQ(binary.merged, 2u);
    EXPECT_TRUE(binary.warnings.empty());
    const PointCloud text = read("b.stl",
                                 "solid a\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n"
                                 "   vertex 0 1 0\n  endloop\n endfacet\nendsolid a\n");
    EXPECT_EQ(text.triangles.size(), 1u);
    const PointCloud obj =
        read("c.obj", "# made\nmtllib x.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1 -1//1\n");
    EXPECT_EQ(obj.points.size(), 4u);
    EXPECT_EQ(obj.triangles.size(), 2u);
    EXPECT_EQ(obj.triangles[1], (std::array<int, 3>{0, 2, 3}));
}

TEST(ReadPoints, ContentDecidesNotTheEnding) {
    EXPECT_EQ(read("points.stl", "1 2 3\n4 5 6\n").layout, "table");
    EXPECT_EQ(read("mesh.xyz", binary_stl(1, 1)).layout, "STL binary");
    // FreeCAD's header has an S where IGES has the letter of its start section.
    std::string freecad = binary_stl(1, 1);
    for (std::size_t i = 0; i < 80; ++i) freecad[i] = "MESH-"[i % 5];
    EXPECT_EQ(read("freecad.stl", freecad).layout, "STL binary");
    const MadeFile step("fake.xyz", "ISO-10303-21;\nHEADER;\n");
    EXPECT_FALSE(holds_points(step.path()));
    EXPECT_FALSE(holds_points(std::string(UMBILIC_MODELS_DIR) + "/bottle.step"));
    EXPECT_FALSE(holds_points(std::string(UMBILIC_MODELS_DIR) + "/mask.igs"));
}

TEST(ReadPoints, NotFiniteAndRepeatedPointsAreCounted) {
    const PointCloud cloud = read("bad.xyz", "0 0 0\nnan 1 2\n1 1 1\n0 0 0\n1 inf 2\n-0 0 0\n1e999 0 0\n");
    EXPECT_EQ(cloud.points.size(), 2u);
    EXPECT_EQ(cloud.not_finite, 3u);
    EXPECT_EQ(cloud.merged, 2u);
    EXPECT_EQ(cloud.warnings.size(), 2u);
    const PointCloud mesh =
        read("bad.obj", "v 0 0 0\nv 1 0 0\nv nan 0 0\nv 0 1 0\nv 0 0 0\nf 1 2 3\nf 1 2 4\nf 1 5 2\n");
    EXPECT_EQ(mesh.triangles.size(), 1u);
    EXPECT_EQ(mesh.degenerate_triangles, 2u);
}

TEST(ReadPoints, DamagedFilesAreRefusedByFileAndPlace) {
    const auto refused = [](const std::string& name, const std::string& contents, const std::string& part) {
        const std::string message = refusal(name, contents);
        EXPECT_NE(message.find(part), std::string::npos) << message;
        EXPECT_NE(message.find(name), std::string::npos) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    };
    refused("empty.xyz", "", "is empty");
    refused("prose.xyz", "Dear Sir,\nplease find 3 points.\n", "holds no points");
    refused("broken.xyz", "1 2 3\n4 5\n", "line 2");
    refused("word.xyz", "1 2 3\n4 five 6\n", "line 2");
    refused("nan.xyz", "nan nan nan\n", "no finite point");
    refused("cut.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n", "cut off");
    refused("four.stl", "solid a\nfacet\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nvertex 0 1 1\n", "line 6");
    refused("short.stl", binary_stl(1000000000, 1), "no points");
    refused("far.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", "line 4");
    refused("two.obj", "v 0 0 0\nv 1 0 0\nf 1 2\n", "line 3");
    refused("lie.ply", ply_header("ascii", "99999999999", "0") + "0 0 0 9\n", "promises 99999999999");
    refused("lie2.ply", ply_header("binary_little_endian", "99999999999", "0"), "promises");
    refused("negative.ply", ply_header("ascii", "-4", "0"), "no count");
    refused("endless.ply", "ply\nformat ascii 1.0\nelement vertex 3\n", "does not end");
    refused("type.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty quad x\nend_header\n0\n", "line 4");
    refused("flat.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n", "no x, y and z");
    refused("none.ply", "ply\nformat ascii 1.0\nelement ghost 1000000000000\nend_header\n", "promises");
    refused(
        "list.ply",
        "ply\nformat binary_little_endian 1.0\nelement face 1\nproperty list uint int vertex_indices\nend_header\n" +
            raw(std::uint32_t(4000000000u), std::endian::little),
        "longer than the file");
    refused("corner.ply", ply_header("ascii", "3", "1") + "0 0 0 9 1 0 0 9 0 1 0 9\n3 0 1 7\n", "refers to point 7");
    refused("minus.ply", ply_header("ascii", "3", "1") + "0 0 0 9 1 0 0 9 0 1 0 9\n3 0 1 -1\n", "line");
    refused("word.ply", ply_header("ascii", "1", "0") + "0 zero 0 9\n", "'zero'");
    EXPECT_THROW(read_points("/nowhere/at/all.xyz"), InvalidInput);
    EXPECT_THROW(read_points("/"), InvalidInput);
}

/// Whatever single byte is damaged or wherever the file ends: points or InvalidInput, nothing else.
TEST(ReadPoints, NoDamageEndsInAnythingButAnError) {
    std::mt19937 random(7);
    const std::string text_stl =
        "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
        "0\nendloop\nendfacet\nendsolid\n";
    const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    for (const std::string& whole : {binary_square(std::endian::little), binary_square(std::endian::big),
                                     binary_stl(3, 3), text_stl, obj, std::string("x,y,z\n1,2,3\n4,5,6\n")})
        for (int trial = 0; trial < 200; ++trial) {
            std::string damaged = whole;
            if (trial % 2 == 0)
                damaged.resize(random() % (whole.size() + 1));
            else
                for (int k = 0; k < 3; ++k) damaged[random() % whole.size()] = static_cast<char>(random() % 256);
            try {
                EXPECT_FALSE(read("damaged.dat", damaged).points.empty());
            } catch (const InvalidInput& error) {
                EXPECT_NE(std::string(error.what()).find("damaged.dat"), std::string::npos);
            }
        }
}

}  // namespace
}  // namespace umbilic
