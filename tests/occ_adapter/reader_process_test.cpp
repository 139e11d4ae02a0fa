// SPDX-License-Identifier: LGPL-2.1-or-later
// Nothing a file contains, and no limit it runs into, harms the caller; each error is one line that helps.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>

#include <fcntl.h>

#include <occ_adapter/read_file.h>
#include <occ_adapter/reader_process.h>
#include <umbilic/core/errors.h>

#include "cad_files.h"

namespace umbilic {
namespace {

using support::cad;

/// The message of the error of type E that reading the file gives.
template <class E>
std::string message(const std::string& path, const ReadOptions& options = {}, const Progress& progress = {}) {
    try {
        read_file(path, options, progress);
    } catch (const E& error) {
        const std::string text = error.what();
        EXPECT_EQ(text.find('\n'), std::string::npos) << text;
        return text;
    }
    ADD_FAILURE() << path << " was read without the error expected";
    return "";
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST(ReaderProcess, FilesThatCrashTheKernelAreAnError) {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "the sanitizer ends a kernel that crashes with an exit status of its own";
#endif
    UMBILIC_NEEDS_CAD_FILES();
    for (const auto& [file, signal] : {std::pair("broken/step_line_with_direction_segfaults_occt.stp", SIGSEGV),
                                       std::pair("broken/step_part21_scope_aborts_occt.stp", SIGABRT)}) {
        const std::string text = message<InvalidInput>(cad(file));
        EXPECT_TRUE(text.starts_with(cad(file) + ": OpenCASCADE crashed while reading it (signal " +
                                     std::to_string(signal) + "); the file is malformed"))
            << text;
        EXPECT_TRUE(contains(text, "export again")) << text;
    }
}

TEST(ReaderProcess, FilesTheKernelEmptiesAreAnErrorWithNumbers) {
    UMBILIC_NEEDS_CAD_FILES();
    std::string text = message<InvalidInput>(cad("broken/iges_data_overflows_column_64_c172_wing.igs"));
    EXPECT_TRUE(contains(text, "declares 6") && contains(text, "columns 65 to 72")) << text;
    text = message<InvalidInput>(cad("broken/step_negative_weight.stp"));
    EXPECT_TRUE(contains(text, "declares 1")) << text;
    text = message<InvalidInput>(cad("broken/iges_truncated_in_directory.iges"));
    EXPECT_TRUE(contains(text, "cut off in its directory")) << text;
}

TEST(ReaderProcess, WordsThatOnlyLookLikeStepAreAnError) {
    const support::TemporaryFolder folder;
    const std::string text = message<InvalidInput>(
        folder.write("text.step", "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\nnonsense\nENDSEC;\nEND-ISO-10303-21;\n"));
    EXPECT_TRUE(contains(text, "text.step: ")) << text;
}

TEST(ReaderProcess, DamagedBrepIsAnError) {
    const support::TemporaryFolder folder;
    message<InvalidInput>(folder.write("a.brep", "\nCASCADE Topology V1, (c) Matra-Datavision\nLocations 7\n"));
    message<InvalidInput>(folder.write("b.brep", "DBRep_DrawableShape\n\nCASCADE Topology V1"));
    message<InvalidInput>(folder.write("c.bin", "\nOpen CASCADE Topology V3 (c)\nLocations 99999"));
}

TEST(ReaderProcess, FilesCutOffAnywhereAreAnError) {
    UMBILIC_NEEDS_CAD_FILES();
    const support::TemporaryFolder folder;
    for (const char* file : {"pairs/sculpted_surface_iges128_inch.igs", "freeform/nacelle_quintic.stp"}) {
        const std::string whole = support::contents(cad(file));
        for (const double part : {0.01, 0.1, 0.5, 0.9})
            message<InvalidInput>(folder.write("part", whole.substr(0, static_cast<std::size_t>(part * whole.size()))));
    }
}

TEST(ReaderProcess, TimeLimitEndsIt) {
    UMBILIC_NEEDS_CAD_FILES();
    ReadOptions options;
    options.seconds = 0.05;
    const std::string text = message<NumericFailure>(cad("mechanical/nist_mbe_pmi_2.stp"), options);
    EXPECT_TRUE(contains(text, "time limit of 0.05 s")) << text;
}

TEST(ReaderProcess, MemoryLimitEndsIt) {
#if defined(__SANITIZE_ADDRESS__)
    GTEST_SKIP() << "the sanitizer's shadow memory excludes limits";
#endif
    UMBILIC_NEEDS_CAD_FILES();
    ReadOptions options;
    options.memory = std::uint64_t(64) << 20;
    const std::string text = message<NumericFailure>(cad("mechanical/nist_mbe_pmi_2.stp"), options);
    EXPECT_TRUE(contains(text, "memory limit of 64 MiB")) << text;
}

TEST(ReaderProcess, CancelIsObeyedWithinASecond) {
    UMBILIC_NEEDS_CAD_FILES();
    using Clock = std::chrono::steady_clock;
    Clock::time_point asked;
    const Progress progress([&](double, std::string_view) {
        asked = Clock::now();
        return false;
    });
    message<Cancelled>(cad("mechanical/nist_mbe_pmi_2.stp"), {}, progress);
    EXPECT_LT(std::chrono::duration<double>(Clock::now() - asked).count(), 1.0);
}

TEST(ReaderProcess, ProgressNeverRunsBackwards) {
    UMBILIC_NEEDS_CAD_FILES();
    double last = -1.0;
    int reports = 0;
    const Progress progress([&](double fraction, std::string_view stage) {
        EXPECT_GE(fraction, last) << stage;
        EXPECT_LE(fraction, 1.0);
        last = fraction;
        ++reports;
        return true;
    });
    read_file(cad("pairs/propeller_1045.step"), {}, progress);
    EXPECT_GT(reports, 5);
}

/// Puts a program in the reader's place.
class ChosenReader {
public:
    explicit ChosenReader(const std::string& program) { ::setenv("UMBILIC_READER", program.c_str(), 1); }
    ~ChosenReader() { ::unsetenv("UMBILIC_READER"); }
};

TEST(ReaderProcess, ReaderThatSendsNonsenseIsAnError) {
    const support::TemporaryFolder folder;
    const std::string file = folder.write("a.step", "ISO-10303-21;\nENDSEC;\nENDSEC;\nEND-ISO-10303-21;\n");
    for (const char* words : {"exit 7", "kill -SEGV $$", "printf 'R\\377\\377\\377\\377\\377\\377\\377\\177abc' >&3",
                              "printf 'R\\3\\0\\0\\0\\0\\0\\0\\0abc' >&3", "printf 'Z\\0\\0\\0\\0\\0\\0\\0\\0' >&3"}) {
        const std::string script = folder.write("reader.sh", std::string("#!/bin/sh\n") + words + "\n");
        std::filesystem::permissions(script, std::filesystem::perms::owner_all);
        const ChosenReader chosen(script);
        EXPECT_THROW(read_file(file), InvalidInput) << words;
    }
    const ChosenReader missing(folder.file("nothing"));
    EXPECT_THROW(read_file(file), NumericFailure);
}

TEST(ReaderProcess, OptionsAreChecked) {
    ReadOptions options;
    options.seconds = 0.0;
    EXPECT_THROW(read_file("any.step", options), InvalidInput);
    options = {};
    options.display_deflection = -1.0;
    EXPECT_THROW(read_file("any.step", options), InvalidInput);
}

TEST(ReaderProcess, FileBehindAnOpenDescriptorIsFound) {
    UMBILIC_NEEDS_CAD_FILES();
    const int descriptor = ::open(cad("pairs/sculpted_surface_iges128_inch.igs").c_str(), O_RDONLY | O_CLOEXEC);
    ASSERT_GE(descriptor, 0);
    const std::string path = "/proc/self/fd/" + std::to_string(descriptor);
    EXPECT_EQ(read_file(path).model.faces.size(), 4u);
    ::close(descriptor);
}

}  // namespace
}  // namespace umbilic
