// SPDX-License-Identifier: LGPL-2.1-or-later
#include "command_fixture.h"

#include <algorithm>
#include <fstream>
#include <sstream>

#include <unistd.h>

namespace umbilic {

namespace fs = std::filesystem;

void CommandTest::SetUp() {
    const auto* const test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(testing::TempDir()) / ("umbilic_" + std::string(test->name()) + std::to_string(getpid()));
    fs::remove_all(folder_);
    fs::create_directory(folder_);
}

void CommandTest::TearDown() {
    fs::remove_all(folder_);
}

std::string CommandTest::make_file(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return path(name);
}

std::string CommandTest::read(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(folder_ / name, std::ios::binary).rdbuf();
    return text.str();
}

std::vector<std::string> CommandTest::entries() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder_))
        names.push_back(fs::relative(entry.path(), folder_).string());
    std::sort(names.begin(), names.end());
    return names;
}

testing::AssertionResult is_one_line(const CommandResult& result, const std::string& about) {
    const bool good = result.error.rfind("umbilic: ", 0) == 0 && result.error.back() == '\n' &&
                      std::count(result.error.begin(), result.error.end(), '\n') == 1 &&
                      result.error.find(about) != std::string::npos;
    if (good) return testing::AssertionSuccess();
    return testing::AssertionFailure() << "standard error is: " << result.error;
}

}  // namespace umbilic
