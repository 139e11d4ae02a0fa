// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <unistd.h>

namespace umbilic::support {

inline std::string cad(const std::string& name) {
    return std::string(UMBILIC_SHARED_CAD_DIR) + "/" + name;
}

inline bool cad_present() {
    return std::filesystem::is_directory(UMBILIC_SHARED_CAD_DIR);
}

inline std::string contents(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// Folder that vanishes with the test.
class TemporaryFolder {
public:
    TemporaryFolder() {
        std::string pattern = (std::filesystem::temp_directory_path() / "umbilic_test_XXXXXX").string();
        path_ = ::mkdtemp(pattern.data());
    }
    ~TemporaryFolder() { std::filesystem::remove_all(path_); }
    std::string file(const std::string& name) const { return (path_ / name).string(); }
    std::string write(const std::string& name, const std::string& bytes) const {
        std::ofstream(file(name), std::ios::binary) << bytes;
        return file(name);
    }
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

}  // namespace umbilic::support

#define UMBILIC_NEEDS_CAD_FILES() \
    if (!::umbilic::support::cad_present()) GTEST_SKIP() << "no CAD files in " << UMBILIC_SHARED_CAD_DIR
