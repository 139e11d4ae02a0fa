// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "run_command.h"

namespace umbilic {

/// Tests of the command that write files: each has an empty folder of its own, which is removed after it.
class CommandTest : public testing::Test {
protected:
    void SetUp() override;
    void TearDown() override;

    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    std::string make_file(const std::string& name, const std::string& text) const;
    std::string read(const std::string& name) const;
    /// Names of everything in the folder, hidden files included, in order.
    std::vector<std::string> entries() const;

    std::filesystem::path folder_;
};

/// One line on standard error that starts with "umbilic: " and names what it is about.
testing::AssertionResult is_one_line(const CommandResult& result, const std::string& about);

}  // namespace umbilic
