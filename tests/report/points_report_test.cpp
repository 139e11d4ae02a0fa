// SPDX-License-Identifier: LGPL-2.1-or-later
// What a comparison with measured points shows.
#include <algorithm>
#include <sstream>

#include <gtest/gtest.h>

#include <report/deviation_csv.h>
#include <report/html.h>
#include <report/scene.h>
#include <support/clouds.h>
#include <support/surfaces.h>

namespace umbilic {
namespace {

class PointsReport : public testing::Test {
protected:
    PointsReport() {
        cloud.source = {.path = "scan <1>.xyz", .sha256 = "00", .format = "points", .unit = "mm (assumed)"};
        cloud.layout = "table";
    }
    ReportInput input() const {
        return {original, suspect, no_meshes, no_meshes, options, comparison, timing, "umbilic compare a b"};
    }

    const Model model = support::model_of({support::smooth_bicubic(8, 41, 0.3)});
    const SimilarityTransform truth = support::random_similarity(5, 1.5, false);
    PointCloud cloud = support::scan_of(model, {.points = 1200, .noise = 1e-4}, truth, 3);
    const PreparedModel original = prepare(model);
    const PreparedPoints suspect = prepare(cloud);
    const CompareOptions options{.match = {.mirror = MirrorChoice::never}};
    const Comparison comparison = compare(original, suspect, options);
    const std::vector<DisplayMesh> no_meshes;
    const Timing timing;
};

TEST_F(PointsReport, JsonDescribesThePoints) {
    const Json json = compare_json(original, suspect, options, comparison, timing);
    const Json& about = json.at("inputs").at("suspect");
    EXPECT_EQ(about.at("format"), "points");
    EXPECT_EQ(about.at("points"), 1200);
    EXPECT_EQ(about.at("triangles"), 0);
    EXPECT_GT(about.at("noise").get<double>(), 0.0);
    EXPECT_EQ(json.at("alignment").at("method"), "points");
    EXPECT_TRUE(json.at("tests").at("strong").at("passed").is_null());
    EXPECT_EQ(json.at("tests").at("weak").at("passed"), true);
    EXPECT_EQ(json.at("tests").at("intermediate").at("passed"), true);
    EXPECT_EQ(json.at("parameters").at("noise").at("origin"), "derived");
    EXPECT_TRUE(json.at("parameters").contains("most_points"));
    EXPECT_GT(json.at("alignment").at("scale_deviation").get<double>(), 0.0);
    EXPECT_EQ(text(json).find("nan"), std::string::npos);
    const Json match = match_json(original, suspect, options, comparison.alignment, timing);
    EXPECT_EQ(match.at("inputs").at("suspect").at("points"), 1200);
    EXPECT_TRUE(match.at("parameters").contains("most_points"));
}

TEST_F(PointsReport, DeviationsAreThoseOfThePoints) {
    const Scene scene = make_scene(original, no_meshes, suspect, no_meshes, comparison);
    EXPECT_EQ(scene.suspect.points.size(), 1200u);
    EXPECT_TRUE(scene.suspect.triangles.empty());
    ASSERT_EQ(scene.suspect.deviation.size(), 1200u);
    for (const double deviation : scene.suspect.deviation) EXPECT_LT(std::abs(deviation), 1e-3);
}

TEST_F(PointsReport, PageAndTableLeaveOutWhatPointsHaveNot) {
    const std::string page = report_html(input());
    EXPECT_EQ(page.find("scan <1>"), std::string::npos);
    EXPECT_NE(page.find("noise of the points"), std::string::npos);
    EXPECT_NE(page.find("points (table)"), std::string::npos);
    std::istringstream table(deviation_csv(original, suspect, comparison.assessment));
    std::string line;
    std::getline(table, line);
    const auto columns = std::count(line.begin(), line.end(), ',');
    std::size_t rows = 0;
    while (std::getline(table, line)) {
        EXPECT_EQ(std::count(line.begin(), line.end(), ','), columns);
        if (line.starts_with("suspect")) {
            EXPECT_TRUE(line.starts_with("suspect,,,,")) << line;
            ++rows;
        }
    }
    EXPECT_EQ(rows, comparison.assessment.suspect_on_original.nodes.size());
}

}  // namespace
}  // namespace umbilic
