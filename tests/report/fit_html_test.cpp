// SPDX-License-Identifier: LGPL-2.1-or-later
#include <filesystem>
#include <numeric>

#include <gtest/gtest.h>
#include <unistd.h>

#include <report/fit_html.h>
#include <report/histogram.h>
#include <report/json_fit.h>
#include <report/output.h>
#include <support/clouds.h>

namespace umbilic {
namespace {

TEST(Histogram, CountsEveryValueOnceSymmetrically) {
    const std::vector<double> values = {-1.0, -0.99, 0.0, 0.3, 1.0};
    const Histogram bins = histogram(values, 5);
    EXPECT_EQ(bins.range, 1.0);
    EXPECT_EQ(bins.counts, (std::vector<int>{2, 0, 1, 1, 1}));
    const Histogram nothing = histogram(std::vector<double>(3, 0.0), 5);
    EXPECT_EQ(nothing.counts, (std::vector<int>{0, 0, 3, 0, 0}));
    EXPECT_EQ(histogram_svg(nothing, 0.1).find("nan"), std::string::npos);
    EXPECT_EQ(histogram_svg(histogram({}, 5), 0.0).find("nan"), std::string::npos);
}

class FitReport : public testing::Test {
protected:
    FitReport() {
        cloud.source = {.path = "a <b>.xyz", .sha256 = "00", .format = "points", .unit = "mm (assumed)"};
        options.poles = {6, 7};
        fit = fit_points(cloud, options);
    }
    PointCloud cloud = support::graph_cloud(
        600, [](double x, double y) { return 0.2 * x * x - 0.1 * y * x; }, 0.002, 5);
    FitOptions options;
    FitResult fit = fit_points(cloud);
    Timing timing = {{"fit", 0.5}};
};

TEST_F(FitReport, JsonHoldsSurfaceAndResiduals) {
    const Json json = fit_json(cloud, options, 1000, fit, "out.step", timing);
    EXPECT_EQ(json.at("schema"), "umbilic.fit/1");
    EXPECT_EQ(json.at("output"), "out.step");
    EXPECT_EQ(json.at("surface").at("poles"), (Json{6, 7}));
    EXPECT_EQ(json.at("surface").at("control_points").size(), 6u);
    EXPECT_EQ(json.at("surface").at("control_points")[0].size(), 7u);
    EXPECT_EQ(json.at("surface").at("u_knots").size(), 10u);
    EXPECT_EQ(json.at("residuals").at("count"), 600);
    const auto counts = json.at("residuals").at("histogram").at("counts").get<std::vector<int>>();
    EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), 0), 600);
    EXPECT_EQ(json.at("parameters").at("net").at("origin"), "user");
    EXPECT_EQ(json.at("parameters").at("degree").at("origin"), "default");
    EXPECT_TRUE(json.at("filter").is_null());
    EXPECT_TRUE(json.at("within_tolerance").is_null());
    EXPECT_EQ(json.at("input").at("format"), "points");
}

TEST_F(FitReport, PageIsCompleteAndEscaped) {
    const FitReportInput input{cloud, options, 1000, fit, timing, "umbilic fit 'a <b>.xyz'"};
    const std::string page = fit_html(input);
    EXPECT_EQ(page.find("a <b>"), std::string::npos);
    EXPECT_NE(page.find("a &lt;b&gt;"), std::string::npos);
    EXPECT_EQ(page.find("{{"), std::string::npos);
    EXPECT_EQ(page.find("http://"), std::string::npos);
    std::size_t pictures = 0;
    for (auto at = page.find("data:image/png"); at != std::string::npos; at = page.find("data:image/png", at + 1))
        ++pictures;
    EXPECT_EQ(pictures, 4u);
}

TEST_F(FitReport, FolderHoldsPageAndJson) {
    const auto folder = std::filesystem::path(testing::TempDir()) / ("umbilic_fit_" + std::to_string(getpid()));
    write_fit_report(folder.string(), {cloud, options, 1000, fit, timing, "umbilic fit"},
                     fit_json(cloud, options, 1000, fit, "", timing));
    EXPECT_TRUE(std::filesystem::exists(folder / "report.html"));
    EXPECT_TRUE(std::filesystem::exists(folder / "fit.json"));
    std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace umbilic
