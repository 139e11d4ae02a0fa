// SPDX-License-Identifier: LGPL-2.1-or-later
// Measured points through the command, from files to exit status.
#include <cmath>
#include <fstream>
#include <limits>
#include <random>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <occ_adapter/read_file.h>
#include <point_files/write_ply.h>
#include <support/clouds.h>
#include <support/invariance.h>
#include <support/surfaces.h>

#include "command_fixture.h"

namespace umbilic {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class PointsCommand : public CommandTest {
protected:
    static const Model& bottle() {
        static const Model model = read_file(model_path("bottle.step")).model;
        return model;
    }
    /// Noise relative to sqrt(area).
    std::string make_scan(const std::string& name, const Model& model, support::ScanKind kind,
                          const SimilarityTransform& truth, unsigned seed) const {
        kind.noise *= model.size();
        return make_file(name, ply_text(support::scan_of(model, kind, truth, seed)));
    }
    static json result_of(const CommandResult& run) {
        EXPECT_EQ(run.status, 0) << run.error;
        return json::parse(run.output);
    }
};

/// xi = 0.01 of the thesis on a model 33 mm in size, and 1e-3.
TEST_F(PointsCommand, ScansOfTheBottleAreFoundAsWhatTheyAre) {
    struct Case {
        double coverage, noise;
        bool global;
    };
    for (const Case& c : {Case{1.0, 3e-4, true}, Case{0.6, 3e-4, false}, Case{0.3, 3e-4, false}, Case{1.0, 1e-3, true},
                          Case{0.6, 1e-3, false}}) {
        const SimilarityTransform truth =
            support::random_similarity(static_cast<unsigned>(100 * c.coverage), 0.7, false);
        const std::string scan =
            make_scan("scan.ply", bottle(), {.points = 3000, .coverage = c.coverage, .noise = c.noise}, truth, 21);
        const json result =
            result_of(run_umbilic({"compare", model_path("bottle.step"), scan, "--quiet", "--json", "-"}));
        const json& alignment = result.at("alignment");
        EXPECT_EQ(alignment.at("method"), "points");
        // The bottle has a mirror plane: a piece that reaches over it fits both hands, which is said.
        EXPECT_TRUE(alignment.at("status") == "found" || alignment.at("status") == "ambiguous")
            << c.coverage << ' ' << c.noise << ' ' << alignment.at("why");
        EXPECT_NEAR(alignment.at("scale").get<double>(), 0.7, 0.02 * 0.7) << c.coverage << ' ' << c.noise;
        EXPECT_LT(alignment.at("rms").get<double>() / bottle().size(), 1.5 * c.noise);
        EXPECT_EQ(result.at("answer").at("class"), c.global ? "scaled" : "piece") << result.at("answer").at("text");
        EXPECT_NE(result.at("verdict").at("level"), "none");
        EXPECT_EQ(result.at("inputs").at("suspect").at("format"), "points");
        EXPECT_GT(result.at("coverage").at("suspect_area").get<double>(), 0.95);
    }
}

TEST_F(PointsCommand, SmallPiecesGetAPoseOrAnHonestDoubt) {
    const SimilarityTransform truth = support::random_similarity(10, 1.3, false);
    const std::string scan =
        make_scan("scan.ply", bottle(), {.points = 3000, .coverage = 0.1, .noise = 3e-4}, truth, 22);
    const json result = result_of(run_umbilic({"match", model_path("bottle.step"), scan, "--quiet", "--json", "-"}));
    EXPECT_NE(result.at("alignment").at("status"), "not found");
    EXPECT_FALSE(result.at("alignment").at("why").get<std::string>().empty());
}

TEST_F(PointsCommand, ScansOfOtherShapesAreNotFound) {
    const Model hood = read_file(model_path("hood.step")).model, mask = read_file(model_path("mask.igs")).model;
    for (const double coverage : {1.0, 0.3}) {
        const std::string scan = make_scan("mask.ply", mask, {.points = 3000, .coverage = coverage, .noise = 3e-4},
                                           support::random_similarity(4, 1.0, false), 23);
        const json result =
            result_of(run_umbilic({"compare", model_path("hood.step"), scan, "--quiet", "--json", "-"}));
        EXPECT_FALSE(result.at("alignment").at("found")) << result.at("answer").at("text");
        EXPECT_FALSE(result.at("verdict").at("derived")) << result.at("answer").at("text");
    }
}

TEST_F(PointsCommand, ReportOfAScanIsWholeAndTheSameForAnyNumberOfThreads) {
    const SimilarityTransform truth = support::random_similarity(6, 2.0, false);
    const std::string scan = make_scan("scan.ply", bottle(), {.points = 1500, .noise = 3e-4}, truth, 24);
    json results[2];
    for (const int threads : {1, 2}) {
        const CommandResult run =
            run_umbilic({"compare", model_path("bottle.step"), scan, "--quiet", "--threads", std::to_string(threads),
                         "--report", path("report"), "--json", path("result.json")});
        ASSERT_EQ(run.status, 0) << run.error;
        results[threads - 1] = json::parse(std::ifstream(path("result.json")));
        results[threads - 1].erase("timing");
    }
    EXPECT_EQ(results[0], results[1]);
    for (const char* name : {"report.html", "result.json", "deviation.csv", "aligned.ply"})
        EXPECT_TRUE(fs::exists(folder_ / "report" / name)) << name;
    EXPECT_FALSE(fs::exists(folder_ / "report" / "aligned.step"));
    // The aligned points need no further move.
    const json again = result_of(run_umbilic({"match", model_path("bottle.step"), path("report/aligned.ply"), "--quiet",
                                              "--json", "-", "--scale", "fixed", "--mirror", "never"}));
    EXPECT_LT(again.at("alignment").at("rms").get<double>(), 1.5 * 3e-4 * bottle().size());
}

TEST_F(PointsCommand, PointsAgainstPointsAndNotAModelAgainstPoints) {
    const std::string original = make_scan("a.ply", bottle(), {.points = 3000, .noise = 1e-4}, {}, 25);
    const std::string suspect =
        make_scan("b.ply", bottle(), {.points = 2500, .noise = 1e-4}, support::random_similarity(8, 1.4, false), 26);
    const json result = result_of(run_umbilic({"compare", original, suspect, "--quiet", "--json", "-"}));
    EXPECT_NE(result.at("alignment").at("status"), "not found") << result.at("alignment").at("why");
    const CommandResult wrong = run_umbilic({"compare", original, model_path("bottle.step")});
    EXPECT_EQ(wrong.status, 3);
    EXPECT_TRUE(is_one_line(wrong, "exchange"));
}

TEST_F(PointsCommand, MethodsThatSayNothingOfTheSuspectAreWrongUse) {
    const std::string scan = make_scan("scan.ply", bottle(), {.points = 1500, .noise = 3e-4}, {}, 28);
    for (const char* const command : {"match", "compare"})
        for (const char* const method : {"umbilics", "umbilics-lines", "umbilics-kh", "moments", "analytic", "kh"}) {
            const CommandResult run = run_umbilic({command, model_path("bottle.step"), scan, "--method", method});
            EXPECT_EQ(run.status, 2) << method << ": " << run.error;
            EXPECT_TRUE(is_one_line(run, "scan.ply")) << run.error;
            EXPECT_NE(run.error.find("method " + std::string(method)), std::string::npos) << run.error;
        }
    const std::string model = model_path("bottle.step");
    const CommandResult points = run_umbilic({"match", model, model, "--method", "points"});
    EXPECT_EQ(points.status, 2);
    EXPECT_TRUE(is_one_line(points, "measured points")) << points.error;
    // Principal frames of single points are what both words mean there.
    const json by_points =
        result_of(run_umbilic({"match", model, scan, "--quiet", "--json", "-", "--method", "points"}));
    const json by_curvature =
        result_of(run_umbilic({"match", model, scan, "--quiet", "--json", "-", "--method", "curvature"}));
    EXPECT_EQ(by_points.at("alignment"), by_curvature.at("alignment"));
    EXPECT_EQ(by_points.at("alignment").at("method"), "points");
}

TEST_F(PointsCommand, LargeCloudsAreThinnedOutAndItIsSaid) {
    const std::string scan =
        make_scan("scan.ply", bottle(), {.points = 5000, .noise = 3e-4}, support::random_similarity(9, 1.0, false), 27);
    const CommandResult run =
        run_umbilic({"match", model_path("bottle.step"), scan, "--most_points", "2000", "--json", path("r.json")});
    ASSERT_EQ(run.status, 0);
    EXPECT_NE(run.error.find("of its 5000 points 2000"), std::string::npos) << run.error;
    const json result = json::parse(std::ifstream(path("r.json")));
    EXPECT_EQ(result.at("inputs").at("suspect").at("points"), 2000);
    EXPECT_EQ(result.at("inputs").at("suspect").at("thinned_out"), 3000);
    EXPECT_EQ(result.at("parameters").at("most_points").at("origin"), "user");
}

TEST_F(PointsCommand, BadPointsEndInOneLine) {
    std::ostringstream equal, collinear, undefined;
    for (int i = 0; i < 200; ++i) {
        equal << "1 2 3\n";
        collinear << i << ' ' << 2 * i << ' ' << 3 * i << '\n';
        undefined << "nan nan nan\n";
    }
    std::mt19937 random(1);
    std::string garbage;
    for (int i = 0; i < 5000; ++i) garbage += static_cast<char>(random() & 0xff);
    const std::vector<std::string> bad = {make_file("empty.xyz", ""),
                                          make_file("two.xyz", "1 2 3\n4 5 6\n"),
                                          make_file("equal.xyz", equal.str()),
                                          make_file("collinear.xyz", collinear.str()),
                                          make_file("undefined.xyz", undefined.str()),
                                          make_file("garbage.ply", garbage),
                                          make_file("cut.ply", "ply\nformat ascii 1.0\nelement vertex 900000000\n"),
                                          path("missing.xyz")};
    for (const std::string& input : bad) {
        const std::string name = fs::path(input).filename().string();
        const CommandResult compared = run_umbilic({"compare", model_path("hood.step"), input, "--quiet"});
        EXPECT_EQ(compared.status, 3) << name << ": " << compared.error;
        EXPECT_TRUE(is_one_line(compared, name));
        const CommandResult fitted = run_umbilic({"fit", input, "-o", path("out.step"), "--quiet"});
        EXPECT_EQ(fitted.status, 3) << name << ": " << fitted.error;
        EXPECT_EQ(std::count(fitted.error.begin(), fitted.error.end(), '\n'), 1) << fitted.error;
        EXPECT_FALSE(fs::exists(path("out.step")));
    }
}

TEST_F(PointsCommand, DegenerateTrianglesAndPointsThatAreNotFiniteAreLeftOut) {
    PointCloud mesh = support::mesh_of(support::smooth_bicubic(8, 41, 0.3), 30);
    mesh.points.emplace_back(std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0);
    const int last = static_cast<int>(mesh.points.size()) - 1;
    mesh.triangles.push_back({0, 0, 1});
    mesh.triangles.push_back({0, 1, last});
    const std::string file = make_file("mesh.ply", ply_text(mesh));
    const json result = result_of(run_umbilic({"compare", file, file, "--quiet", "--json", "-"}));
    EXPECT_EQ(result.at("inputs").at("suspect").at("not_finite"), 1);
    EXPECT_EQ(result.at("inputs").at("suspect").at("degenerate_triangles"), 2);
    EXPECT_NE(result.at("alignment").at("status"), "not found");
}

/// Meshes of CAD systems have vertices where the curvature asks for them, and none inside strips and planes.
TEST_F(PointsCommand, CoarseAndFineMeshesOfAModelAreInTheSameRelationToIt) {
    struct Case {
        double deflection, part;
        const char* answer;
    };
    for (const Case& c : {Case{5e-3, 1.0, "same"}, Case{1e-3, 1.0, "same"}, Case{2e-4, 1.0, "same"},
                          Case{5e-3, 0.5, "piece"}, Case{2e-4, 0.5, "piece"}}) {
        PointCloud mesh;
        const ReadResult file =
            read_file(model_path("bottle.step"), {.display_meshes = true, .display_deflection = c.deflection});
        const double top = file.model.box.low.z() + c.part * (file.model.box.high.z() - file.model.box.low.z());
        double area = 0.0;
        for (const DisplayMesh& face : file.meshes) {
            const int first = static_cast<int>(mesh.points.size());
            mesh.points.insert(mesh.points.end(), face.points.begin(), face.points.end());
            for (const auto& [a, b, d] : face.triangles)
                if (std::max({face.points[a].z(), face.points[b].z(), face.points[d].z()}) <= top + 1e-6) {
                    mesh.triangles.push_back({first + a, first + b, first + d});
                    area += triangle_area(mesh, mesh.triangles.back());
                }
        }
        std::vector<char> used(mesh.points.size(), 0);
        for (const auto& triangle : mesh.triangles)
            for (const int corner : triangle) used[corner] = 1;
        for (std::size_t i = 0; i < used.size(); ++i)
            if (!used[i]) mesh.points[i].setConstant(std::numeric_limits<double>::quiet_NaN());
        const std::string path = make_file("mesh.ply", ply_text(mesh));
        const json result =
            result_of(run_umbilic({"compare", model_path("bottle.step"), path, "--quiet", "--json", "-"}));
        EXPECT_EQ(result.at("answer").at("class"), c.answer) << c.deflection << ' ' << result.at("answer").at("text");
        EXPECT_EQ(result.at("alignment").at("status"), "found") << result.at("alignment").at("why");
        EXPECT_GT(result.at("coverage").at("suspect_area").get<double>(), 0.999);
        EXPECT_NEAR(result.at("coverage").at("original_area").get<double>(), area / file.model.area, 0.01)
            << c.deflection;
        // What is left out of account is said, and is no more than what the mesh was made with.
        const double chord = result.at("parameters").at("chord").at("value");
        EXPECT_GT(chord, 0.02 * c.deflection * file.model.box.diagonal());
        EXPECT_LT(chord, 3.0 * c.deflection * file.model.box.diagonal());
    }
}

TEST_F(PointsCommand, FitWritesSurfaceResidualsAndReport) {
    const auto height = [](double x, double y) { return 0.3 * std::sin(2.0 * x) * std::cos(1.5 * y); };
    const double noise = 1e-3;
    const std::string points = make_file("points.ply", ply_text(support::graph_cloud(4000, height, noise, 5)));
    const json result = result_of(
        run_umbilic({"fit", points, "-o", path("out.step"), "--quiet", "--json", "-", "--report", path("report")}));
    EXPECT_EQ(result.at("schema"), "umbilic.fit/1");
    EXPECT_TRUE(result.at("reached_noise"));
    EXPECT_NEAR(result.at("residuals").at("rms").get<double>(), noise, 0.15 * noise);
    EXPECT_NEAR(result.at("noise").get<double>(), noise, 0.2 * noise);
    EXPECT_TRUE(fs::exists(path("report/report.html")));
    // What was written is the surface: the points lie on it within their noise.
    const json back =
        result_of(run_umbilic({"compare", path("out.step"), points, "--quiet", "--json", "-", "--scale", "fixed"}));
    EXPECT_NE(back.at("alignment").at("status"), "not found");
    EXPECT_LT(back.at("alignment").at("rms").get<double>(), 1.2 * noise);
}

TEST_F(PointsCommand, FitObeysItsOptions) {
    const auto height = [](double x, double y) { return 0.3 * x * x - 0.2 * x * y; };
    const std::string points = make_file("points.ply", ply_text(support::graph_cloud(900, height, 0.0, 5)));
    const auto fitted = [&](std::vector<std::string> words) {
        words.insert(words.begin(), {"fit", points, "-o", path("out.step"), "--quiet", "--json", "-"});
        return result_of(run_umbilic(words));
    };
    const json net = fitted({"--net", "7x5", "--degree", "4"});
    EXPECT_EQ(net.at("surface").at("poles"), (json{7, 5}));
    EXPECT_EQ(net.at("surface").at("degree"), (json{4, 4}));
    const json tolerance = fitted({"--tolerance", "1e-4"});
    EXPECT_TRUE(tolerance.at("within_tolerance"));
    EXPECT_LE(tolerance.at("residuals").at("max").get<double>(), 1e-4);
    const json smooth = fitted({"--smooth", "0.1"});
    EXPECT_GT(smooth.at("filter").at("rms_change").get<double>(), 0.0);
    const json multilevel = fitted({"--method", "multilevel"});
    EXPECT_EQ(multilevel.at("method"), "multilevel");

    std::string grid;
    for (int i = 0; i < 20; ++i)
        for (int j = 0; j < 15; ++j)
            grid += std::to_string(0.1 * i) + " " + std::to_string(0.1 * j) + " " + std::to_string(0.01 * i * j) + "\n";
    const std::string grid_file = make_file("grid.xyz", grid);
    const json by_grid = result_of(
        run_umbilic({"fit", grid_file, "-o", path("grid.step"), "--grid", "20x15", "--quiet", "--json", "-"}));
    EXPECT_EQ(by_grid.at("method"), "grid");
    EXPECT_LT(by_grid.at("residuals").at("rms").get<double>(), 1e-5);  // six decimals in the file
    EXPECT_EQ(run_umbilic({"fit", grid_file, "-o", path("x.step"), "--grid", "20x16", "--quiet"}).status, 3);
    EXPECT_FALSE(fs::exists(path("x.step")));
    EXPECT_EQ(run_umbilic({"fit", grid_file, "--quiet"}).status, 2);
    EXPECT_EQ(run_umbilic({"fit", grid_file, "-o", path("x.step"), "--net", "7"}).status, 2);
    EXPECT_EQ(run_umbilic({"fit", grid_file, "-o", path("no/such/x.step"), "--quiet"}).status, 3);
}

}  // namespace
}  // namespace umbilic
