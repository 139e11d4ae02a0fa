// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include <gtest/gtest.h>

#include <report/json.h>

#include "../support/surfaces.h"
#include "../support/swept_surfaces.h"
#include "made_comparison.h"

namespace umbilic {
namespace {

using support::ellipsoid_octant;
using support::model_of;

/// What a value must be; a question mark allows null, too.
bool has_type(const Json& value, std::string type) {
    const bool may_be_null = type.back() == '?';
    if (may_be_null) type.pop_back();
    if (value.is_null()) return may_be_null;
    if (type == "number") return value.is_number();
    if (type == "integer") return value.is_number_integer();
    if (type == "string") return value.is_string();
    if (type == "boolean") return value.is_boolean();
    if (type == "array") return value.is_array();
    if (type == "object") return value.is_object();
    return false;
}

void expect_keys(const Json& json, const std::map<std::string, std::string>& keys) {
    for (const auto& [pointer, type] : keys) {
        const Json::json_pointer at("/" + pointer);
        ASSERT_TRUE(json.contains(at)) << "missing: " << pointer;
        EXPECT_TRUE(has_type(json.at(at), type)) << pointer << " is no " << type << ": " << json.at(at).dump();
    }
}

void expect_finite(const Json& json, const std::string& where = "") {
    if (json.is_number_float()) {
        EXPECT_TRUE(std::isfinite(json.get<double>())) << where;
    } else if (json.is_structured()) {
        for (const auto& [key, value] : json.items()) expect_finite(value, where + "/" + key);
    }
}

const std::map<std::string, std::string> input_keys = {
    {"path", "string"},    {"sha256", "string"},           {"bytes", "integer"},          {"format", "string"},
    {"unit", "string"},    {"solids", "integer"},          {"faces", "integer"},          {"nurbs_faces", "integer"},
    {"area", "number"},    {"volume", "number"},           {"skipped", "array"},          {"repaired", "array"},
    {"warnings", "array"}, {"skipped/0/entity", "string"}, {"skipped/1/face", "integer"}, {"skipped/1/why", "string"}};

TEST(Json, NumbersThatAreNotFiniteAreNull) {
    EXPECT_TRUE(number_json(std::numeric_limits<double>::quiet_NaN()).is_null());
    EXPECT_TRUE(number_json(std::numeric_limits<double>::infinity()).is_null());
    EXPECT_EQ(number_json(0.1).get<double>(), 0.1);
}

TEST(Json, TextSurvivesBytesThatAreNotUtf8) {
    const Json parsed = Json::parse(text(Json{{"name",
                                               "a\xff"
                                               "b"}}));
    EXPECT_EQ(parsed.at("name").get<std::string>(),
              "a\xef\xbf\xbd"
              "b");
}

TEST(Json, Info) {
    const auto made = made_comparison();
    const Json json = info_json(made->original_model, recognise(made->original_model));
    EXPECT_EQ(json.at("schema"), "umbilic.info/1");
    expect_keys(json.at("input"), input_keys);
    expect_keys(json.at("faces").at(0), {{"face", "integer"},
                                         {"surface", "string"},
                                         {"degree", "array"},
                                         {"poles", "array"},
                                         {"rational", "boolean"},
                                         {"periodic", "array"},
                                         {"closed", "array"},
                                         {"trimmed", "boolean"},
                                         {"area", "number"},
                                         {"orientation", "string"}});
    EXPECT_EQ(json.at("faces").at(0).at("degree"), Json::parse("[3, 3]"));
    EXPECT_TRUE(json.at("faces").at(0).at("recognised").is_null());
    expect_finite(json);
}

TEST(Json, InfoTellsWhatSurfacesAreBesides) {
    const Model model = model_of({ellipsoid_octant(2.0, 2.0, 2.0)});
    const Json recognised = info_json(model, recognise(model)).at("faces").at(0).at("recognised");
    EXPECT_EQ(recognised.at("kind"), "sphere");
    EXPECT_EQ(recognised.at("exact"), true);
    EXPECT_NEAR(recognised.at("parameters").at("radius").get<double>(), 2.0, 1e-12);
    EXPECT_FALSE(recognised.at("parameters").contains("semi_angle"));
    expect_keys(recognised, {{"deviation", "number"},
                             {"parameter_error", "number"},
                             {"parameters/location/2", "number"},
                             {"parameters/axis/2", "number"}});
}

TEST(Json, Umbilics) {
    const auto made = made_comparison();
    const Json json = umbilics_json(made->original_model, made->original->features.umbilics);
    EXPECT_EQ(json.at("schema"), "umbilic.umbilics/1");
    EXPECT_TRUE(json.at("shells").empty());
    const std::vector<ShellCertificate> shells =
        shell_certificates(made->original_model, made->original->features.umbilics);
    const Json with_shells = umbilics_json(made->original_model, made->original->features.umbilics, shells);
    ASSERT_EQ(with_shells.at("shells").size(), 1u);
    expect_keys(with_shells.at("shells").at(0), {{"faces/0", "integer"},
                                                 {"closed", "boolean"},
                                                 {"euler_characteristic", "integer?"},
                                                 {"genus", "integer?"},
                                                 {"index_sum", "number?"},
                                                 {"complete", "boolean?"},
                                                 {"why", "string"}});
    const Json& face = json.at("faces").at(0);
    expect_keys(face, {{"face", "integer"},
                       {"surface", "string"},
                       {"degree", "array"},
                       {"poles", "array"},
                       {"rational", "boolean"},
                       {"umbilics", "array"},
                       {"lines", "array"},
                       {"regions", "array"},
                       {"searched", "array"},
                       {"certificate/index_sum", "number"},
                       {"certificate/boundary_winding", "number?"},
                       {"certificate/complete", "boolean?"},
                       {"certificate/why", "string"}});
    ASSERT_EQ(face.at("umbilics").size(), 5u);
    for (const Json& umbilic : face.at("umbilics")) {
        expect_keys(umbilic, {{"u", "number"},
                              {"v", "number"},
                              {"point/2", "number"},
                              {"normal/2", "number"},
                              {"kappa", "number"},
                              {"cubic/3", "number"},
                              {"omega", "array?"},
                              {"delta", "number"},
                              {"zeta/1", "number"},
                              {"radius", "number"},
                              {"type", "string"},
                              {"star", "string?"},
                              {"flat", "boolean"},
                              {"index", "number"},
                              {"directions", "array"},
                              {"box/0/1", "number"},
                              {"box/1/0", "number"},
                              {"certified", "boolean"},
                              {"inside", "boolean"}});
        EXPECT_LE(umbilic.at("box").at(0).at(0), umbilic.at("u"));
        EXPECT_GE(umbilic.at("box").at(0).at(1), umbilic.at("u"));
    }
    expect_finite(json);
}

TEST(Json, LinesAndRegionsOfUmbilics) {
    // A flat plate with a ridge on one side, and a developable with an inflection.
    const NurbsSurface flat = support::smooth_bicubic(12, 1, 0.0);
    std::vector<Vector3> poles = flat.poles();
    for (std::size_t k = 0; k < 24; ++k) poles[k].z() = 0.1;
    const auto wave = support::spline(3, {{0, 0}, {1, 1}, {2, -1}, {3, 0}});
    const Model model = model_of({NurbsSurface(flat.u_knots(), flat.v_knots(), poles), support::extruded(wave, 2.0)});
    const Json json = umbilics_json(model, find_umbilics(model));
    const Json& region = json.at("faces").at(0).at("regions").at(0);
    EXPECT_EQ(region.at("kind"), "planar");
    expect_keys(region, {{"boxes/0/0/1", "number"},
                         {"border", "array"},
                         {"area", "number"},
                         {"deviation", "number"},
                         {"parameters/axis/2", "number"},
                         {"boundary/0/points/0/2", "number"},
                         {"boundary/0/parameters/0/1", "number"}});
    const Json& line = json.at("faces").at(1).at("lines").at(0);
    expect_keys(line, {{"boxes/0/0/1", "number"},
                       {"points/0/2", "number"},
                       {"parameters/0/1", "number"},
                       {"closed", "boolean"},
                       {"length", "number"},
                       {"accuracy", "number"},
                       {"containment", "string"}});
    EXPECT_EQ(line.at("ends"), Json::parse(R"(["border", "border"])"));
    EXPECT_NEAR(line.at("length").get<double>(), 2.0, 1e-12);
    expect_finite(json);
}

TEST(Json, ParametersAreThoseOfTheFilesSurface) {
    const double quarter = 0.5 * std::numbers::pi;
    Model model = model_of({ellipsoid_octant(3.0, 2.0, 1.0)});
    Face& face = model.faces.front();
    const ParameterBox domain = face.surface.domain();
    ASSERT_EQ(domain.u.low, 0.0);
    // The octant's u is declared to be an angle from 0 to a quarter turn, over the same span.
    const ParameterMap angular = ParameterMap::angular({0.0, quarter});
    face.region = TrimmingRegion({{0.0, quarter}, domain.v}, {}, angular, {});
    FaceUmbilics found;
    found.face = face.number;
    Umbilic umbilic;
    umbilic.at = {face.number, 0.3 * quarter, domain.v.middle()};
    found.umbilics = {umbilic};
    const Json json = umbilics_json(model, {found});
    const double u = json.at("faces").at(0).at("umbilics").at(0).at("u").get<double>();
    EXPECT_DOUBLE_EQ(u, angular.native(0.3 * quarter));
    EXPECT_NE(u, 0.3 * quarter);
}

TEST(Json, Compare) {
    const auto made = made_comparison();
    const Json json = compare_json(*made->original, *made->suspect, made->options, made->comparison, made->timing);
    EXPECT_EQ(json.at("schema"), "umbilic.compare/1");
    expect_keys(json.at("inputs").at("original"), input_keys);
    expect_keys(json.at("inputs").at("suspect"), input_keys);
    std::map<std::string, std::string> keys = {{"tool/name", "string"},
                                               {"tool/version", "string"},
                                               {"tool/commit", "string"},
                                               {"tool/opencascade", "string"},
                                               {"alignment/found", "boolean"},
                                               {"alignment/status", "string"},
                                               {"alignment/why", "string"},
                                               {"alignment/method", "string"},
                                               {"alignment/scope", "string"},
                                               {"alignment/mirrored", "boolean"},
                                               {"alignment/scale", "number"},
                                               {"alignment/rotation/2/2", "number"},
                                               {"alignment/translation/2", "number"},
                                               {"alignment/rms", "number"},
                                               {"alignment/max", "number"},
                                               {"alignment/relative_max", "number"},
                                               {"alignment/candidates/0/score", "number"},
                                               {"alignment/free_motions/0/kind", "string"},
                                               {"alignment/free_motions/0/point/2", "number"},
                                               {"alignment/free_motions/0/direction/2", "number"},
                                               {"tests/weak/passed", "boolean"},
                                               {"tests/weak/tolerance", "number"},
                                               {"tests/intermediate/passed", "boolean"},
                                               {"tests/strong/passed", "boolean"},
                                               {"tests/strong/pairs/0/original", "integer"},
                                               {"tests/strong/pairs/0/suspect", "integer"},
                                               {"tests/strong/pairs/0/type", "string"},
                                               {"tests/strong/pairs/0/distance", "number"},
                                               {"tests/strong/unmatched", "object"},
                                               {"similarity/cell", "number"},
                                               {"coverage/suspect_area", "number"},
                                               {"coverage/original_area", "number"},
                                               {"coverage/faces/0/suspect_face", "integer"},
                                               {"coverage/faces/0/original_face", "integer"},
                                               {"coverage/faces/0/fraction", "number"},
                                               {"coverage/faces/0/level", "string"},
                                               {"coverage/faces/1/original_face", "integer?"},
                                               {"answer/class", "string"},
                                               {"answer/text", "string"},
                                               {"verdict/level", "string"},
                                               {"verdict/derived", "boolean"},
                                               {"verdict/algorithm_1", "string"},
                                               {"verdict/algorithm_2", "string"},
                                               {"verdict/explanation", "string"},
                                               {"timing/read", "number"},
                                               {"timing/match", "number"}};
    for (const char* const quantity :
         {"weak/distance", "intermediate/kappa_max", "intermediate/kappa_min", "intermediate/direction"}) {
        for (const char* const statistic : {"max", "mean", "std"}) {
            keys[std::string("tests/") + quantity + "/" + statistic] = "number";
        }
        keys[std::string("tests/") + quantity + "/count"] = "integer";
    }
    for (const char* const quantity : {"distance", "kappa_max", "kappa_min", "direction"}) {
        keys[std::string("similarity/") + quantity + "/tolerance"] = "number";
        keys[std::string("similarity/") + quantity + "/percent"] = "number";
    }
    expect_keys(json, keys);
    expect_finite(json);
    for (const auto& [name, parameter] : json.at("parameters").items()) {
        ASSERT_TRUE(parameter.contains("value") && parameter.contains("unit") && parameter.contains("origin")) << name;
        const std::string origin = parameter.at("origin");
        EXPECT_TRUE(origin == "default" || origin == "derived" || origin == "user") << name;
    }
    EXPECT_EQ(json.at("parameters").at("kappa").at("origin"), "user");
    EXPECT_EQ(json.at("parameters").at("samples").at("origin"), "user");  // 120 instead of the default
    EXPECT_EQ(json.at("parameters").at("seed").at("origin"), "default");
}

TEST(Json, TransformMapsTheSuspectOntoTheOriginal) {
    const auto made = made_comparison();
    const Json json = compare_json(*made->original, *made->suspect, made->options, made->comparison, made->timing);
    const Json& pose = json.at("alignment");
    ASSERT_TRUE(pose.at("mirrored").get<bool>());
    const Vector3 suspect = made->suspect_model.faces.front().surface.value(0.3, 0.6);
    const Vector3 reflected(-suspect.x(), suspect.y(), suspect.z());
    const Vector3 expected = made->original_model.faces.front().surface.value(0.3, 0.6);
    for (int i = 0; i < 3; ++i) {
        double sum = 0.0;
        for (int j = 0; j < 3; ++j) sum += pose.at("rotation").at(i).at(j).get<double>() * reflected(j);
        EXPECT_NEAR(pose.at("scale").get<double>() * sum + pose.at("translation").at(i).get<double>(), expected(i),
                    1e-12 * 10.0);
    }
}

TEST(Json, WithoutAPoseItsNumbersAreNull) {
    const auto made = made_comparison_without_pose();
    const Json json = compare_json(*made->original, *made->suspect, made->options, made->comparison, made->timing);
    EXPECT_FALSE(json.at("alignment").at("found").get<bool>());
    for (const char* const key : {"scale", "rotation", "translation", "rms", "max", "relative_max"}) {
        EXPECT_TRUE(json.at("alignment").at(key).is_null()) << key;
    }
    EXPECT_EQ(json.at("alignment").at("status"), "not found");
    EXPECT_TRUE(json.at("tests").at("weak").at("distance").at("max").is_null());
    EXPECT_TRUE(json.at("tests").at("strong").at("passed").is_null());
    EXPECT_TRUE(json.at("similarity").at("distance").at("percent").is_null());
    expect_finite(json);
}

TEST(Json, Match) {
    const auto made = made_comparison();
    const Json json =
        match_json(*made->original, *made->suspect, made->options, made->comparison.alignment, made->timing);
    EXPECT_EQ(json.at("schema"), "umbilic.match/1");
    expect_keys(json, {{"inputs/original", "object"},
                       {"inputs/suspect", "object"},
                       {"parameters/match_tolerance/value", "number"},
                       {"alignment/rotation", "array"},
                       {"timing/features", "number"}});
    expect_finite(json);
}

}  // namespace
}  // namespace umbilic
