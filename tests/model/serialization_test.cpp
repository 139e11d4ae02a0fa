// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>

#include <umbilic/core/errors.h>
#include <umbilic/model/serialization.h>

namespace umbilic {
namespace {

TrimmingCurve segment(Vector2 from, Vector2 to) {
    return {.curve = NurbsCurve2(KnotVector::bezier(1), {from, to})};
}

/// Model that fills every field: a rational face with trimming loop and angular map, one plain face, one skipped.
Model full_model() {
    Model model;
    model.source = {"part.step", "00ff", 1234, "STEP", "inch", 25.4};
    model.solids = {{2.5, 3.5, {1, 2, 3}, Matrix3::Identity(), "body"}};
    const std::vector<Vector3> poles = {{1, 0, 0}, {1, 0, 1}, {1, 1, 0}, {1, 1, 1}, {0, 1, 0}, {0, 1, 1}};
    const double w = std::sqrt(0.5);
    NurbsSurface quarter(KnotVector(2, {0, 0, 0, 1.5, 1.5, 1.5}), KnotVector::bezier(1), poles, {1, 1, w, w, 1, 1});
    TrimmingLoop loop = {segment({0.1, 0.1}, {1.2, 0.1}), segment({0.6, 0.9}, {1.2, 0.1}),
                         segment({0.6, 0.9}, {0.1, 0.1})};
    loop[1].reversed = true;
    loop[1].edge = 7;
    loop[2].degenerate = true;
    loop[2].tolerance = 1e-3;
    TrimmingRegion region(quarter.domain(), {loop}, ParameterMap::angular({0.0, 1.5}), {});
    Face trimmed{1, SurfaceKind::cylinder, ElementarySurface{{1, 2, 3}, {0, 0, 1}, {1, 0, 0}, 1.0, 0.5, 0.25},
                 std::move(quarter), std::move(region)};
    trimmed.reversed = trimmed.u_closed = trimmed.v_periodic = true;
    trimmed.area = 4.5;
    trimmed.conversion_error = 1e-9;
    trimmed.tolerance = 1e-4;
    trimmed.name = "Mantel \xc3\xa4";
    trimmed.color = {0.1, 0.2, 0.3};
    trimmed.solid = 0;
    NurbsSurface flat(KnotVector::bezier(1), KnotVector::bezier(1), {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}});
    TrimmingRegion whole(flat.domain());
    model.faces = {std::move(trimmed), Face{3, SurfaceKind::bspline, std::nullopt, std::move(flat), std::move(whole)}};
    model.shells = 2;
    model.declared_faces = 3;
    model.valid = false;
    model.skipped = {{2, "", "collapsed"}, {0, "BLOB", "unknown"}};
    model.repaired = {"wire"};
    model.warnings = {"ending", "count"};
    model.box.add(Vector3(0, 0, 0));
    model.box.add(Vector3(1, 2, 3));
    model.area = 5.5;
    model.volume = 2.5;
    return model;
}

std::string bytes_of(const Model& model) {
    std::ostringstream out;
    write_model(model, out);
    return out.str();
}

Model model_of(const std::string& bytes) {
    std::istringstream in(bytes);
    return read_model(in);
}

TEST(Serialization, ModelComesBackTheSame) {
    const Model model = full_model();
    const std::string bytes = bytes_of(model);
    const Model back = model_of(bytes);
    // Equal bytes mean equal fields, as far as they are written; some are looked at besides.
    EXPECT_EQ(bytes_of(back), bytes);
    ASSERT_EQ(back.faces.size(), 2u);
    const Face &before = model.faces[0], &after = back.faces[0];
    EXPECT_EQ(after.name, before.name);
    EXPECT_EQ(after.color, before.color);
    EXPECT_EQ(after.kind, SurfaceKind::cylinder);
    EXPECT_EQ(after.elementary->semi_angle, 0.25);
    EXPECT_TRUE(after.reversed && after.u_closed && !after.v_closed && !after.u_periodic && after.v_periodic);
    EXPECT_EQ(after.surface.poles(), before.surface.poles());
    EXPECT_EQ(after.surface.weights(), before.surface.weights());
    EXPECT_EQ(after.region.polyline(0), before.region.polyline(0));
    EXPECT_EQ(after.region.u_map().breaks(), before.region.u_map().breaks());
    EXPECT_EQ(after.region.loops()[0][1].edge, 7);
    EXPECT_TRUE(after.region.loops()[0][1].reversed && after.region.loops()[0][2].degenerate);
    EXPECT_TRUE(back.faces[1].region.whole_domain());
    EXPECT_EQ(back.source.unit_in_mm, 25.4);
    EXPECT_EQ(back.solids[0].inertia, model.solids[0].inertia);
    EXPECT_EQ(back.skipped[1].entity, "BLOB");
    EXPECT_EQ(back.box.high, Vector3(1, 2, 3));
    EXPECT_FALSE(back.valid);
}

TEST(Serialization, EmptyModelKeepsItsEmptyBox) {
    EXPECT_TRUE(model_of(bytes_of(Model())).box.empty());
}

TEST(Serialization, EveryTruncationIsRejected) {
    const std::string bytes = bytes_of(full_model());
    for (std::size_t size = 0; size < bytes.size(); ++size)
        EXPECT_THROW(model_of(bytes.substr(0, size)), InvalidInput) << size;
}

TEST(Serialization, EveryFlippedBitIsRejected) {
    const std::string bytes = bytes_of(full_model());
    for (std::size_t i = 0; i < 8 * bytes.size(); ++i) {
        std::string damaged = bytes;
        damaged[i / 8] = static_cast<char>(damaged[i / 8] ^ (1 << i % 8));
        EXPECT_THROW(model_of(damaged), InvalidInput) << "bit " << i;
    }
}

TEST(Serialization, BytesThatAreSomethingElseAreRejected) {
    EXPECT_THROW(model_of(""), InvalidInput);
    EXPECT_THROW(model_of("ISO-10303-21;\nHEADER;\nENDSEC;\n"), InvalidInput);
    std::ostringstream meshes;
    write_display_meshes({}, meshes);
    EXPECT_THROW(model_of(meshes.str()), InvalidInput);
}

TEST(Serialization, ValuesThatAreNotAllowedAreRejectedThoughTheChecksumFits) {
    Model model = full_model();
    model.area = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(model_of(bytes_of(model)), InvalidInput);
    model = full_model();
    model.faces[1].number = 1;
    EXPECT_THROW(model_of(bytes_of(model)), InvalidInput);
    model = full_model();
    model.faces[0].solid = 1;
    EXPECT_THROW(model_of(bytes_of(model)), InvalidInput);
    model = full_model();
    model.faces[0].kind = static_cast<SurfaceKind>(99);
    EXPECT_THROW(model_of(bytes_of(model)), InvalidInput);
    model = full_model();
    std::swap(model.box.low, model.box.high);
    model.box.low.z() = model.box.high.z();
    EXPECT_NO_THROW(model_of(bytes_of(model)));  // an empty box is written as such
}

TEST(Serialization, MeshesComeBackAndTheirIndicesAreChecked) {
    DisplayMesh mesh{4, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 0}, {1, 0}, {0, 1}}, {{0, 1, 2}}};
    const auto round_trip = [](const std::vector<DisplayMesh>& meshes) {
        std::ostringstream out;
        write_display_meshes(meshes, out);
        std::istringstream in(out.str());
        return read_display_meshes(in);
    };
    const std::vector<DisplayMesh> back = round_trip({mesh, mesh});
    ASSERT_EQ(back.size(), 2u);
    EXPECT_EQ(back[1].face, 4);
    EXPECT_EQ(back[1].points, mesh.points);
    EXPECT_EQ(back[1].parameters, mesh.parameters);
    EXPECT_EQ(back[1].triangles, mesh.triangles);
    mesh.triangles[0][2] = 3;
    EXPECT_THROW(round_trip({mesh}), InvalidInput);
    mesh.triangles.clear();
    mesh.parameters.pop_back();
    EXPECT_THROW(round_trip({mesh}), InvalidInput);
}

}  // namespace
}  // namespace umbilic
