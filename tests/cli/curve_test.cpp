// SPDX-License-Identifier: LGPL-2.1-or-later
// `umbilic curve` as its users see it.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "run_command.h"

namespace umbilic {
namespace {

using nlohmann::json;

json curve(std::vector<std::string> words) {
    words.insert(words.begin(), "curve");
    words.insert(words.end(), {"--json", "-"});
    const CommandResult result = run_umbilic(words);
    EXPECT_EQ(result.status, 0) << result.error;
    return json::parse(result.output, nullptr, false);
}

void expect_error(std::vector<std::string> words, int status, const std::string& about) {
    words.insert(words.begin(), "curve");
    const CommandResult result = run_umbilic(words);
    EXPECT_EQ(result.status, status) << result.error;
    EXPECT_EQ(std::count(result.error.begin(), result.error.end(), '\n'), 1) << result.error;
    EXPECT_NE(result.error.find(about), std::string::npos) << result.error;
}

std::string temporary(const std::string& name) {
    return (std::filesystem::path(testing::TempDir()) / (std::to_string(getpid()) + name)).string();
}

TEST(CurveCommand, TracesLinesOfCurvature) {
    const json result = curve(
        {"lines-of-curvature", model_path("torus.step"), "--face", "1", "--start", "0.5,0.7", "--family", "maximum"});
    EXPECT_EQ(result["schema"], "umbilic.curve/1");
    EXPECT_EQ(result["kind"], "lines-of-curvature");
    ASSERT_EQ(result["curves"].size(), 1u);
    const json& line = result["curves"][0];
    EXPECT_EQ(line["family"], "maximum");
    EXPECT_TRUE(line["closed"].get<bool>());
    EXPECT_EQ(line["ended"], "closed");
    EXPECT_NEAR(line["length"].get<double>(), 2 * std::numbers::pi * 12, 1e-4);
    EXPECT_EQ(line["points"][0]["face"], 1);
    EXPECT_EQ(line["points"][0]["point"].size(), 3u);
}

TEST(CurveCommand, FindsGeodesicsAndWritesThemAsWires) {
    const std::string step = temporary("geodesics.step");
    const std::vector<std::string> words = {
        "curve", "geodesic", model_path("sphere.igs"), "--from", "0.3,0.2", "--to", "1.4,-0.5", "-o", step};
    const CommandResult result = run_umbilic(words);
    EXPECT_EQ(result.status, 0) << result.error;
    EXPECT_NE(result.output.find("the shortest of 2 found"), std::string::npos) << result.output;
    std::ifstream in(step, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    EXPECT_NE(text.find("B_SPLINE_CURVE"), std::string::npos);
    EXPECT_EQ(text.rfind("ISO-10303-21", 0), 0u);
    std::filesystem::remove(step);

    const json shot = curve({"geodesic", model_path("sphere.igs"), "--from", "0.3,0.2", "--direction=0,0,-1",
                             "--length", "10", "--spacing", "1"});
    EXPECT_NEAR(shot["curves"][0]["length"].get<double>(), 10, 1e-9);
    EXPECT_EQ(shot["curves"][0]["points"].size(), 11u);
}

TEST(CurveCommand, TakesSpacingsLargerThanTheFace) {
    const json result = curve({"lines-of-curvature", model_path("torus.step"), "--start", "0.5,0.7", "--family",
                               "maximum", "--length", "10", "--spacing", "1e6"});
    // Start and both ends.
    ASSERT_EQ(result["curves"].size(), 1u);
    EXPECT_EQ(result["curves"][0]["points"].size(), 3u);
    EXPECT_NEAR(result["curves"][0]["length"].get<double>(), 20, 1e-6);
}

TEST(CurveCommand, SaysThatThereIsNoGeodesic) {
    const json none = curve({"geodesic", model_path("blade.step"), "--face", "1", "--from", "0.5,0.5", "--to",
                             "0.5,0.5", "--to-face", "2"});
    EXPECT_TRUE(none["curves"].empty());
    EXPECT_NE(none["why"].get<std::string>().find("no geodesic"), std::string::npos);
}

TEST(CurveCommand, ProjectsItsOwnResultsTablesAndStartedCurves) {
    const std::string file = temporary("line.json");
    const std::string source = model_path("monge_umbilics.step");
    EXPECT_EQ(run_umbilic({"curve", "geodesic", source, "--from", "0.3,0.3", "--direction=1,1,0", "--length", "0.3",
                           "--json", file})
                  .status,
              0);
    const json again = curve({"project", file, source});
    EXPECT_EQ(again["kind"], "project");
    EXPECT_NEAR(again["curves"][0]["length"].get<double>(), 0.3, 1e-5);
    EXPECT_FALSE(again["curves"][0]["left_target"].get<bool>());
    std::filesystem::remove(file);

    const std::string table = temporary("points.xyz");
    std::ofstream(table) << "0.2 0.2 1\n0.4 0.3 1\n0.7 0.6 1\n";
    EXPECT_EQ(curve({"project", table, source})["curves"].size(), 1u);
    std::filesystem::remove(table);

    const json between = curve({"project", source, source, "--start", "0.2,0.3", "--to", "0.4,0.5"});
    ASSERT_EQ(between["curves"].size(), 1u);
    EXPECT_NEAR(between["curves"][0]["length"].get<double>(), between["curves"][0]["original"]["length"].get<double>(),
                1e-5);
}

TEST(WireframeCommand, RefusesBadWordsAndInput) {
    const auto expect_wrong = [](std::vector<std::string> words, int status, const std::string& part) {
        words.insert(words.begin(), "wireframe");
        const CommandResult result = run_umbilic(words);
        EXPECT_EQ(result.status, status) << result.error;
        EXPECT_NE(result.error.find(part), std::string::npos) << result.error;
        EXPECT_EQ(std::count(result.error.begin(), result.error.end(), '\n'), 1) << result.error;
        EXPECT_LT(result.error.size(), 300u);
    };
    const std::string bottle = model_path("bottle.step");
    for (const std::string step : {"0", "-1", "nan", "inf", "much"}) {
        expect_wrong({bottle, "--step", step}, 2, "--step");
        expect_wrong({bottle, "--relative_step", step}, 2, "--relative_step");
    }
    expect_wrong({bottle, "--step", "1e-9"}, 2, "choose at least");
    expect_wrong({bottle, "--step", "1", "--relative_step", "1"}, 2, "excludes");
    expect_wrong({bottle, "--face", "9"}, 2, "no face 9");
    expect_wrong({bottle, "--face", "0"}, 2, "--face");
    expect_wrong({"/nowhere.step"}, 3, "/nowhere.step");
}

TEST(WireframeCommand, MeshesFacesSmallerThanTheStep) {
    const CommandResult result =
        run_umbilic({"wireframe", model_path("bottle.step"), "--step", "1e9", "--quiet", "--json", "-"});
    ASSERT_EQ(result.status, 0) << result.error;
    const json found = json::parse(result.output);
    EXPECT_EQ(found["schema"], "umbilic.wireframe/1");
    for (const json& face : found["faces"]) {
        EXPECT_EQ(face["coverage"], 1.0);
        EXPECT_GE(face["cells"].size(), 1u);
    }
}

TEST(CurveCommand, RefusesBadWordsAndInput) {
    const std::string torus = model_path("torus.step"), bottle = model_path("bottle.step");
    expect_error({"lines-of-curvature", torus, "--start", "0.5"}, 2, "--start");
    expect_error({"lines-of-curvature", torus, "--start", "nan,0"}, 2, "--start");
    expect_error({"lines-of-curvature", torus, "--start", "99,0"}, 2, "outside of face 1");
    expect_error({"lines-of-curvature", bottle, "--start", "0.5,0.5"}, 2, "--face");
    expect_error({"lines-of-curvature", bottle, "--face", "9", "--start", "0.5,0.5"}, 2, "no face 9");
    for (const std::string number : {"-1", "0", "nan", "inf"})
        expect_error({"lines-of-curvature", torus, "--start", "0.5,0.5", "--length", number}, 2, "--length");
    expect_error({"lines-of-curvature", torus, "--start", "0.5,0.5", "--spacing", "-1"}, 2, "--spacing");
    expect_error({"lines-of-curvature", torus, "--start", "0.5,0.5", "--spacing", "nan"}, 2, "--spacing");
    expect_error({"lines-of-curvature", torus, "--start", "0.5,0.5", "--tolerance", "0"}, 2, "--tolerance");
    // The files are good: what cannot be is what the words ask for.
    const std::string block = model_path("planar_block.step"), cut = model_path("bottle_cut.step");
    expect_error({"lines-of-curvature", block, "--start", "0.1,0.1"}, 2, "the start is umbilic");
    expect_error({"lines-of-curvature", block, "--start", "0.1,0.1"}, 2, "planar_block.step");
    expect_error({"lines-of-curvature", model_path("sphere.igs"), "--start", "0.5,0.5"}, 2, "umbilic");
    expect_error(
        {"project", block, block, "--start", "0.1,0.1", "--direction=1,0,0", "--length", "1", "--family", "maximum"}, 2,
        "planar_block.step: projection of a line of curvature: the start is umbilic");
    expect_error({"lines-of-curvature", cut, "--start", "0.01,0.01"}, 2, "cut away by a trimming loop");
    expect_error({"geodesic", cut, "--from", "0.01,0.01", "--to", "0.4,0.6"}, 2,
                 "--from 0.01,0.01 is outside of face 1");
    expect_error({"geodesic", cut, "--from", "0.4,0.6", "--to", "0.01,0.01"}, 2, "--to 0.01,0.01 is outside of face 1");
    expect_error({"geodesic", cut, "--from", "0.4,0.6", "--to", "nan,0.5"}, 2, "--to");
    expect_error({"geodesic", bottle, "--face", "1", "--from", "0.5,0.5", "--to", "0.5,0.5", "--to-face", "9"}, 2,
                 "no face 9");
    expect_error({"lines-of-curvature", torus, "--start", "0.5,0.5", "--spacing", "1e-9"}, 2, "choose at least");
    expect_error({"geodesic", torus, "--from", "0.5,0.5", "--direction=1,0,0", "--length", "10", "--spacing", "1e-12"},
                 2, "choose at least");
    expect_error({"geodesic", torus, "--from", "0.5,0.5"}, 2, "--to");
    expect_error({"geodesic", torus, "--from", "0.5,0.5", "--to", "0.5,0.5"}, 2, "the same");
    expect_error({"geodesic", torus, "--from", "0.5,0.5", "--direction=1,0,0"}, 2, "--length");
    expect_error({"geodesic", torus, "--from", "0.5,0.5", "--direction=0,0,0", "--length", "1"}, 2, "direction");
    expect_error({"geodesic", torus, "--from", "0.5,0.5", "--direction=nan,0,0", "--length", "1"}, 2, "--direction");
    expect_error({"project", torus, torus, "--start", "0.5,0.5"}, 2, "--direction");
    expect_error({"project", model_path("ground_truth.json"), torus}, 3, "no result of umbilic curve");
    expect_error({"project", "/nowhere.xyz", torus}, 3, "/nowhere.xyz");
}

}  // namespace
}  // namespace umbilic
