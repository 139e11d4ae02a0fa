// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <occ_adapter/file_format.h>
#include <umbilic/core/errors.h>

#include "cad_files.h"

namespace umbilic {
namespace {

std::string message(const std::string& path) {
    try {
        describe_file(path);
    } catch (const InvalidInput& error) {
        return error.what();
    }
    return "";
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST(FileFormat, WhatIsNoCadFileIsAnError) {
    const support::TemporaryFolder folder;
    EXPECT_TRUE(contains(message(folder.file("absent.step")), "absent.step: there is no such file"));
    EXPECT_TRUE(contains(message(folder.path().string()), "is a folder"));
    EXPECT_TRUE(contains(message(folder.write("empty.step", "")), "is empty"));
    EXPECT_TRUE(contains(message(folder.write("letter.step", "Dear Sir or Madam,\n")), "neither STEP nor IGES"));
    EXPECT_TRUE(contains(message(folder.write("zero.igs", std::string(4096, '\0'))), "neither STEP nor IGES"));
    EXPECT_TRUE(contains(message("/dev/null"), "not a regular file"));
    const std::string locked = folder.write("locked.step", "ISO-10303-21;");
    std::filesystem::permissions(locked, std::filesystem::perms::none);
    // The superuser may read anything.
    if (::geteuid() != 0) {
        EXPECT_TRUE(contains(message(locked), "check its permissions"));
    }
}

TEST(FileFormat, IsToldByContentAndAWrongEndingIsAWarning) {
    const support::TemporaryFolder folder;
    const std::string step = "\xef\xbb\xbfISO-10303-21;\nHEADER;ENDSEC;DATA;\nENDSEC;\nEND-ISO-10303-21;\n";
    EXPECT_EQ(describe_file(folder.write("a.STP", step)).format, FileFormat::step);
    EXPECT_TRUE(describe_file(folder.file("a.STP")).warnings.empty());
    const FileDescription wrong = describe_file(folder.write("a.igs", step));
    EXPECT_EQ(wrong.format, FileFormat::step);
    ASSERT_EQ(wrong.warnings.size(), 1u);
    EXPECT_TRUE(contains(wrong.warnings[0], "content is STEP, but the ending says IGES"));
    EXPECT_EQ(describe_file(folder.write("b", "\nCASCADE Topology V1, (c)")).format, FileFormat::brep_text);
    EXPECT_EQ(describe_file(folder.write("c", "DBRep_DrawableShape\n")).format, FileFormat::brep_text);
    EXPECT_EQ(describe_file(folder.write("d", "\nOpen CASCADE Topology V3 (c)\n")).format, FileFormat::brep_binary);
}

TEST(FileFormat, StepFacesAreCountedOutsideOfStringsAndComments) {
    const support::TemporaryFolder folder;
    const std::string body =
        "#1=ADVANCED_FACE('it''s ADVANCED_FACE',(#2),#3,.T.);\n/* #9=ADVANCED_FACE( */\n#4 = ADVANCED_FACE ( "
        "'',(),#3,.F.);\n"
        "#5=MY_ADVANCED_FACE();#6=FACE_SURFACE('',(),#3,.T.);\n";
    const std::string step = "ISO-10303-21;HEADER;ENDSEC;DATA;\n" + body + "ENDSEC;END-ISO-10303-21;";
    EXPECT_EQ(describe_file(folder.write("a.step", step)).declared_faces, 3);
    EXPECT_TRUE(contains(message(folder.write("b.step", "ISO-10303-21;HEADER;ENDSEC;DATA;\n" + body)), "cut off"));
}

TEST(FileFormat, Sha256OfKnownWords) {
    const support::TemporaryFolder folder;
    EXPECT_EQ(sha256_of_file(folder.write("abc", "abc")),
              "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_THROW(sha256_of_file(folder.file("absent")), InvalidInput);
}

}  // namespace
}  // namespace umbilic
