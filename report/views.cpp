// SPDX-License-Identifier: LGPL-2.1-or-later
#include <report/views.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include <tbb/parallel_for.h>

#include <report/picture.h>
#include <report/readable.h>

namespace umbilic {

const Color color_within = {0.13f, 0.40f, 0.67f};
const Color color_beyond = {0.90f, 0.38f, 0.0f};

namespace {

constexpr int width = 640;
constexpr int height = 420;
constexpr Color grey = {0.80f, 0.82f, 0.84f};
constexpr Color pale = {0.93f, 0.94f, 0.95f};
constexpr Color dark_edge = {0.22f, 0.24f, 0.27f};
constexpr Color light_edge = {0.62f, 0.60f, 0.66f};
/// Below this brightness (sum of red, green and blue) a surface gets light edges.
constexpr float dark_surface = 0.9f;
constexpr double edge_width = 1.1;
constexpr double glyph_radius = 5.0;
/// How far an umbilic's disc stands before its white ring, relative to the diagonal.
constexpr double ring_depth = 1e-4;
constexpr double node_radius = 2.6;
constexpr double wire_width = 1.0, wire_node_radius = 1.5;
/// Of a line of umbilics, and of the strokes along lines of curvature relative to the diagonal.
constexpr Color line_color = {0.80f, 0.47f, 0.65f};
constexpr double line_width = 2.6, stroke_share = 0.03;

/// Triangles along a side of a fitted surface.
constexpr int surface_pieces = 80;

BoundingBox box_of(const std::vector<Vector3>& points) {
    BoundingBox box;
    for (const Vector3& point : points) box.add(point);
    return box;
}

/// Radius in pixels of the points of a cloud: dense clouds close up to a surface, sparse ones stay visible.
double point_radius(std::size_t count) {
    constexpr double closing = 0.5, least = 0.8, greatest = 3.0;
    return std::clamp(closing * std::sqrt(static_cast<double>(width) * height / static_cast<double>(count)), least,
                      greatest);
}

void draw(Picture& picture, const SceneMesh& mesh, const std::vector<Color>& colors) {
    if (mesh.triangles.empty()) {
        const double radius = point_radius(mesh.points.size());
        for (std::size_t i = 0; i < mesh.points.size(); ++i) picture.add_disc(mesh.points[i], colors[i], radius);
        return;
    }
    picture.add_surface(mesh.points, mesh.normals, mesh.triangles, colors);
    for (const auto& [a, b] : mesh.edges) {
        const bool on_dark = colors[a][0] + colors[a][1] + colors[a][2] < dark_surface;
        picture.add_line(mesh.points[a], mesh.points[b], on_dark ? light_edge : dark_edge, edge_width);
    }
}

/// The pictures, drawn in parallel, in order.
std::vector<View> drawn(std::size_t count, const std::function<View(std::size_t)>& draw_one) {
    std::vector<View> views(count);
    tbb::parallel_for(std::size_t(0), count, [&](std::size_t i) { views[i] = draw_one(i); });
    return views;
}

std::array<std::pair<const char*, ViewAxes>, 4> four_sides() {
    return {{{"Isometric", isometric_view()}, {"Front", front_view()}, {"Side", side_view()}, {"Top", top_view()}}};
}

/// A disc with a white ring around it.
void draw_umbilic(Picture& picture, const Vector3& point, UmbilicType type, const Vector3& toward, double diagonal) {
    picture.add_disc(point, {1.0f, 1.0f, 1.0f}, glyph_radius + 1.5);
    picture.add_disc(point + ring_depth * diagonal * toward, color_of(type), glyph_radius);
}

std::vector<Color> grey_for(const SceneMesh& mesh) {
    return std::vector<Color>(mesh.points.size(), grey);
}

}  // namespace

std::vector<View> deviation_views(const Scene& scene) {
    if (!scene.posed) return {};
    std::vector<Color> colors;
    for (const double deviation : scene.suspect.deviation) colors.push_back(scene.scale.of_size(deviation));
    const BoundingBox box = box_of(scene.suspect.points);
    const auto sides = four_sides();
    return drawn(sides.size(), [&](std::size_t i) {
        Picture picture(sides[i].second, box, width, height);
        draw(picture, scene.suspect, colors);
        for (const SceneUmbilic& umbilic : scene.umbilics) {
            if (!umbilic.of_suspect) continue;
            draw_umbilic(picture, umbilic.point, umbilic.type, sides[i].second.row(2), box.diagonal());
        }
        return View{sides[i].first, picture.png()};
    });
}

std::vector<View> model_views(const Scene& scene, const SimilarityTransform& suspect_original) {
    SceneMesh suspect = scene.suspect;
    for (Vector3& point : suspect.points) point = suspect_original.apply(point);
    for (Vector3& normal : suspect.normals) normal = suspect_original.apply_direction(normal);
    return drawn(2, [&](std::size_t i) {
        const SceneMesh& mesh = i == 0 ? scene.original : suspect;
        const BoundingBox box = box_of(mesh.points);
        Picture picture(isometric_view(), box, width, height);
        draw(picture, mesh, grey_for(mesh));
        const Vector3 size = box.empty() ? Vector3(Vector3::Zero()) : Vector3(box.high - box.low);
        return View{std::string(i == 0 ? "Original" : "Suspect") + ", " + readable(size.x(), 4) + " × " +
                        readable(size.y(), 4) + " × " + readable(size.z(), 4) + " mm",
                    picture.png()};
    });
}

std::vector<View> test_views(const Scene& scene, const Assessment& assessment) {
    struct Test {
        const char* name;
        const LocalSimilarity* similarity;
        const char* unit;
        std::function<std::optional<double>(const NodeComparison&)> value;
    };
    const std::array<Test, 4> tests = {{
        {"Distance", &assessment.distance, "mm", [](const NodeComparison& node) { return node.distance; }},
        {"Greater principal curvature", &assessment.kappa_max, "1/mm",
         [](const NodeComparison& node) { return node.kappa_max; }},
        {"Smaller principal curvature", &assessment.kappa_min, "1/mm",
         [](const NodeComparison& node) { return node.kappa_min; }},
        {"Principal direction", &assessment.direction, "rad",
         [](const NodeComparison& node) { return node.direction; }},
    }};
    const auto& nodes = assessment.suspect_on_original.nodes;
    if (!scene.posed || nodes.empty()) return {};
    const BoundingBox box = box_of(scene.suspect.points);
    return drawn(tests.size(), [&](std::size_t i) {
        const Test& test = tests[i];
        Picture picture(isometric_view(), box, width, height);
        draw(picture, scene.suspect, grey_for(scene.suspect));
        int beyond = 0, count = 0;
        for (const NodeComparison& node : nodes) {
            const std::optional<double> value = test.value(node);
            if (!value) continue;
            const bool within = *value <= test.similarity->tolerance;
            ++count;
            beyond += within ? 0 : 1;
            picture.add_disc(node.point, within ? color_within : color_beyond, node_radius * (within ? 0.5 : 1.0));
        }
        return View{std::string(test.name) + ": " + readable_count(beyond) + " of " + readable_count(count) +
                        " nodes beyond " + readable(test.similarity->tolerance, test.unit),
                    picture.png()};
    });
}

std::vector<View> wireframe_views(const Scene& scene) {
    if (scene.wires.nodes.empty()) return {};
    const Matrix3 half_turn = Vector3(-1.0, -1.0, 1.0).asDiagonal();
    const std::array<std::pair<const char*, ViewAxes>, 2> sides = {
        {{"Isometric", isometric_view()}, {"Isometric, from behind", isometric_view() * half_turn}}};
    const BoundingBox box = box_of(scene.original.points);
    const std::vector<Color> colors(scene.original.points.size(), pale);
    return drawn(sides.size(), [&](std::size_t i) {
        Picture picture(sides[i].second, box, width, height);
        picture.add_surface(scene.original.points, scene.original.normals, scene.original.triangles, colors);
        for (const SceneWires::Line& line : scene.wires.lines)
            for (std::size_t k = 1; k < line.points.size(); ++k)
                picture.add_line(line.points[k - 1], line.points[k], color_of(line.kind), wire_width);
        for (const Vector3& node : scene.wires.nodes) picture.add_disc(node, dark_edge, wire_node_radius);
        return View{sides[i].first, picture.png()};
    });
}

std::vector<View> umbilics_views(const SceneMesh& mesh, const std::vector<FaceUmbilics>& umbilics) {
    const auto sides = four_sides();
    const BoundingBox box = box_of(mesh.points);
    const std::vector<Color> colors = grey_for(mesh);
    const double reach = stroke_share * box.diagonal();
    return drawn(sides.size(), [&](std::size_t i) {
        Picture picture(sides[i].second, box, width, height);
        draw(picture, mesh, colors);
        for (const FaceUmbilics& found : umbilics) {
            for (const UmbilicLine& line : found.lines)
                for (std::size_t k = 1; k < line.points.size(); ++k)
                    picture.add_line(line.points[k - 1], line.points[k], line_color, line_width);
            for (const Umbilic& umbilic : found.umbilics) {
                if (umbilic.containment == Containment::outside) continue;
                for (const Vector3& direction : umbilic.directions)
                    picture.add_line(umbilic.point - reach * direction, umbilic.point + reach * direction,
                                     color_of(umbilic.kind.type), edge_width);
                draw_umbilic(picture, umbilic.point, umbilic.kind.type, sides[i].second.row(2), box.diagonal());
            }
        }
        return View{sides[i].first, picture.png()};
    });
}

std::vector<View> residual_views(const NurbsSurface& surface, const std::vector<ParametrisedPoint>& points,
                                 const std::vector<double>& distances, const ColorScale& scale) {
    SceneMesh mesh;
    const ParameterBox domain = surface.domain();
    for (int i = 0; i <= surface_pieces; ++i)
        for (int j = 0; j <= surface_pieces; ++j)
            mesh.points.push_back(surface.value(domain.u.low + domain.u.length() * i / surface_pieces,
                                                domain.v.low + domain.v.length() * j / surface_pieces));
    for (int i = 0; i < surface_pieces; ++i)
        for (int j = 0; j < surface_pieces; ++j) {
            const int a = i * (surface_pieces + 1) + j, b = a + surface_pieces + 1;
            mesh.triangles.insert(mesh.triangles.end(), {{a, b, b + 1}, {a, b + 1, a + 1}});
        }
    compute_normals(mesh);
    BoundingBox box = box_of(mesh.points);
    for (const ParametrisedPoint& p : points) box.add(p.point);
    const double radius = point_radius(points.size());
    const auto sides = four_sides();
    return drawn(sides.size(), [&](std::size_t k) {
        Picture picture(sides[k].second, box, width, height);
        draw(picture, mesh, grey_for(mesh));
        for (std::size_t i = 0; i < points.size(); ++i)
            picture.add_disc(points[i].point, scale.of_signed(distances[i]), radius);
        return View{sides[k].first, picture.png()};
    });
}

}  // namespace umbilic
