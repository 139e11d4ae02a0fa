// SPDX-License-Identifier: LGPL-2.1-or-later
// What models/ground_truth.json says of the project's own models, file by file and pair by pair.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include <nlohmann/json.hpp>
#include <occ_adapter/read_file.h>
#include <umbilic/core/errors.h>
#include <umbilic/similarity/compare.h>

namespace umbilic {
namespace {

const std::filesystem::path models_folder = UMBILIC_MODELS_DIR;

const nlohmann::json& truth() {
    static const nlohmann::json result = nlohmann::json::parse(std::ifstream(models_folder / "ground_truth.json"));
    return result;
}

Model model(const std::string& file) {
    return read_file((models_folder / file).string()).model;
}

std::string test_name(std::string text) {
    for (char& c : text)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
    return text;
}

Vector3 vector(const nlohmann::json& numbers) {
    return {numbers.at(0).get<double>(), numbers.at(1).get<double>(), numbers.at(2).get<double>()};
}

class ModelFacts : public testing::TestWithParam<int> {};

TEST_P(ModelFacts, AreWhatTheGroundTruthSays) {
    const nlohmann::json& facts = truth().at("models").at(GetParam());
    const Model read = model(facts.at("file"));
    ASSERT_EQ(read.faces.size(), facts.at("face_list").size());
    EXPECT_NEAR(read.area, facts.at("area").get<double>(), 1e-5 * read.area);
    if (facts.at("volume").is_number()) {
        EXPECT_NEAR(read.volume, facts.at("volume").get<double>(), 1e-5 * read.volume);
    }
    EXPECT_TRUE(read.skipped.empty());
    const std::vector<FaceUmbilics> found = find_umbilics(read);
    for (std::size_t i = 0; i < read.faces.size(); ++i) {
        const nlohmann::json& face = facts.at("face_list").at(i);
        if (face.value("all_umbilic", false)) {
            EXPECT_EQ(found[i].regions.size(), 1u) << "face " << i + 1;
            continue;
        }
        if (!face.contains("umbilics")) continue;
        std::vector<const Umbilic*> inside;
        for (const Umbilic& umbilic : found[i].umbilics)
            if (umbilic.containment == Containment::inside) inside.push_back(&umbilic);
        EXPECT_EQ(inside.size(), face.at("umbilics").size()) << "face " << i + 1;
        for (const nlohmann::json& known : face.at("umbilics")) {
            const Umbilic* nearest = nullptr;
            const Vector3 point = vector(known.at("point"));
            for (const Umbilic* umbilic : inside)
                if (!nearest || (umbilic->point - point).norm() < (nearest->point - point).norm()) nearest = umbilic;
            ASSERT_NE(nearest, nullptr);
            EXPECT_LT((nearest->point - point).norm(), 1e-6 * read.size());
            EXPECT_NEAR(nearest->kappa * read.size(), known.at("kappa").get<double>() * read.size(), 1e-5);
            // Close to a dividing curve rounding decides.
            const nlohmann::json& margin = known.at("type_margin");
            if (margin.is_null() || margin.get<double>() > 1e-3) {
                EXPECT_EQ(name(nearest->kind.type), known.at("type").get<std::string>());
            }
            EXPECT_TRUE(nearest->certified);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Models, ModelFacts, testing::Range(0, static_cast<int>(truth().at("models").size())),
                         [](const testing::TestParamInfo<int>& info) {
                             return test_name(truth().at("models").at(info.param).at("file").get<std::string>());
                         });

class ModelPairs : public testing::TestWithParam<int> {};

TEST_P(ModelPairs, AnswerLevelAndPose) {
    const nlohmann::json& facts = truth().at("pairs").at(GetParam());
    const Model original = model(facts.at("original")), suspect = model(facts.at("suspect"));
    const PreparedModel a = prepare(original), b = prepare(suspect);
    const Comparison comparison = compare(a, b);
    EXPECT_EQ(name(comparison.answer.kind), facts.at("answer").get<std::string>()) << comparison.answer.text;
    EXPECT_EQ(name(comparison.verdict.level), facts.at("level").get<std::string>());
    if (!facts.contains("transform") || facts.at("transform").is_null()) return;
    ASSERT_TRUE(comparison.alignment.found()) << comparison.alignment.why;
    const nlohmann::json& t = facts.at("transform");
    SimilarityTransform expected;
    expected.scale = t.at("scale");
    expected.mirrored = t.at("mirrored");
    for (int row = 0; row < 3; ++row) expected.rotation.row(row) = vector(t.at("rotation").at(row)).transpose();
    expected.translation = vector(t.at("translation"));
    // Exact copies to the digits of the files; re-approximated ones to a part of their deviation.
    const bool exact = comparison.answer.kind != AnswerClass::reapproximated;
    const double tolerance = (exact ? 1e-8 : 1e-4) * original.box.diagonal();
    for (const Vector3& corner : {suspect.box.low, suspect.box.high, suspect.box.center()})
        EXPECT_LT((comparison.alignment.original_suspect.apply(corner) - expected.apply(corner)).norm(), tolerance);
}

INSTANTIATE_TEST_SUITE_P(Models, ModelPairs, testing::Range(0, static_cast<int>(truth().at("pairs").size())),
                         [](const testing::TestParamInfo<int>& info) {
                             const nlohmann::json& pair = truth().at("pairs").at(info.param);
                             return test_name(pair.at("original").get<std::string>() + "_and_" +
                                              pair.at("suspect").get<std::string>());
                         });

TEST(ModelTolerances, ALooserToleranceLosesNoFinding) {
    const Model original = model("bottle.step"), suspect = model("bottle_redesigned.igs");
    const PreparedModel a = prepare(original), b = prepare(suspect);
    double coverage = 0.0;
    for (const double distance : {0.01, 0.05, 0.1, 0.25, 0.5}) {
        CompareOptions options;
        options.tolerances.distance = distance;
        const Comparison comparison = compare(a, b, options);
        EXPECT_TRUE(comparison.alignment.found()) << distance << ' ' << comparison.alignment.why;
        EXPECT_GE(comparison.alignment.suspect_coverage, coverage) << distance;
        coverage = comparison.alignment.suspect_coverage;
    }
}

TEST(MalformedModels, AreErrorsOrWarnedOf) {
    for (const nlohmann::json& entry : truth().at("malformed")) {
        const std::string file = entry.at("file");
        try {
            const Model read = model(file);
            EXPECT_EQ(entry.at("expected").get<std::string>(), "error or warning") << file;
            EXPECT_FALSE(read.warnings.empty()) << file;
        } catch (const InvalidInput& error) {
            EXPECT_NE(std::string(error.what()).find(file), std::string::npos) << error.what();
        }
    }
}

}  // namespace
}  // namespace umbilic
