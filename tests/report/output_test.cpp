// SPDX-License-Identifier: LGPL-2.1-or-later
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include <umbilic/core/errors.h>

#include <report/output.h>

#include "made_comparison.h"

namespace umbilic {
namespace {

namespace fs = std::filesystem;

class Output : public testing::Test {
protected:
    void SetUp() override {
        const auto* const test = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = fs::path(testing::TempDir()) / ("umbilic_" + std::string(test->name()) + std::to_string(getpid()));
        fs::remove_all(folder_);
        fs::create_directory(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    std::string read(const fs::path& path) const {
        std::ostringstream text;
        text << std::ifstream(path, std::ios::binary).rdbuf();
        return text.str();
    }
    std::size_t entries() const {
        return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
    }

    fs::path folder_;
};

TEST_F(Output, ReplacesAFileAndLeavesNothingBeside) {
    const fs::path path = folder_ / "result.json";
    write_file(path, "first");
    write_file(path, "second");
    EXPECT_EQ(read(path), "second");
    EXPECT_EQ(entries(), 1u);
}

TEST_F(Output, WritesThroughASymbolicLink) {
    write_file(folder_ / "target", "first");
    fs::create_symlink(folder_ / "target", folder_ / "link");
    write_file(folder_ / "link", "second");
    EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
    EXPECT_EQ(read(folder_ / "target"), "second");
}

TEST_F(Output, FullDiskIsAnErrorThatNamesTheFile) {
    if (!fs::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
    try {
        write_file("/dev/full", "text");
        FAIL() << "no error";
    } catch (const NumericFailure& error) {
        EXPECT_NE(std::string(error.what()).find("/dev/full: cannot be written"), std::string::npos) << error.what();
    }
    EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST_F(Output, FoldersAndMissingFoldersAreErrors) {
    EXPECT_THROW(write_file(folder_, "text"), NumericFailure);
    EXPECT_THROW(write_file(folder_ / "missing" / "file", "text"), NumericFailure);
    EXPECT_EQ(entries(), 0u);
}

TEST_F(Output, ReportOfAnExistingFolderKeepsWhatElseIsThere) {
    const auto made = made_comparison_without_pose();  // no aligned.step: the model has no file
    const fs::path report = folder_ / "report";
    fs::create_directory(report);
    write_file(report / "notes.txt", "mine");
    write_file(report / "aligned.step", "of an older run");
    write_report(report, made->input(), Json{{"schema", "test"}});
    EXPECT_EQ(read(report / "notes.txt"), "mine");
    EXPECT_FALSE(fs::exists(report / "aligned.step"));
    EXPECT_NE(read(report / "report.html").find("</html>"), std::string::npos);
    EXPECT_EQ(Json::parse(read(report / "result.json")).at("schema"), "test");
    EXPECT_EQ(entries(), 1u);
}

TEST_F(Output, CancelledReportLeavesNothing) {
    const auto made = made_comparison_without_pose();
    const Progress progress;
    progress.cancel();
    EXPECT_THROW(write_report(folder_ / "report", made->input(), Json::object(), progress), Cancelled);
    EXPECT_EQ(entries(), 0u);
}

TEST_F(Output, UmbilicsReportAppearsWholeOrNotAtAll) {
    const auto made = made_comparison();
    const std::vector<FaceUmbilics> found = find_umbilics(made->original_model);
    const UmbilicsReportInput input{made->original_model, made->original_meshes, found, {}, "umbilic umbilics a"};
    write_umbilics_report(folder_ / "report", input, Json{{"schema", "test"}});
    EXPECT_NE(read(folder_ / "report" / "report.html").find("</html>"), std::string::npos);
    EXPECT_EQ(Json::parse(read(folder_ / "report" / "umbilics.json")).at("schema"), "test");
    EXPECT_EQ(entries(), 1u);
    const Progress progress;
    progress.cancel();
    EXPECT_THROW(write_umbilics_report(folder_ / "other", input, Json::object(), progress), Cancelled);
    EXPECT_EQ(entries(), 1u);
    write_file(folder_ / "file", "text");
    EXPECT_THROW(write_umbilics_report(folder_ / "file", input, Json::object()), NumericFailure);
}

TEST_F(Output, FailedReportLeavesNothing) {
    const auto made = made_comparison();  // its suspect has no file, so aligned.step cannot be written
    EXPECT_THROW(write_report(folder_ / "report", made->input(), Json::object()), Error);
    EXPECT_EQ(entries(), 0u);
}

}  // namespace
}  // namespace umbilic
