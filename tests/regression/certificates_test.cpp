// SPDX-License-Identifier: LGPL-2.1-or-later
// Completeness certificates of real supplier files: on how many faces they have no verdict.
#include <gtest/gtest.h>

#include <filesystem>
#include <ostream>
#include <string>

#include <occ_adapter/read_file.h>
#include <umbilic/umbilics/find.h>
#include <umbilic/umbilics/shell_certificate.h>

namespace umbilic {
namespace {

struct File {
    const char* name;
    std::size_t without;  ///< faces on which nothing can be said: an undecided place there has no index

    friend std::ostream& operator<<(std::ostream& out, const File& file) { return out << file.name; }
};

class Certificates : public testing::TestWithParam<File> {};

TEST_P(Certificates, HoldOnNearlyEveryFace) {
    const std::string path = std::string(UMBILIC_SHARED_CAD_DIR) + "/" + GetParam().name;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no file " << path;
    const Model model = read_file(path).model;
    const std::vector<FaceUmbilics> found = find_umbilics(model);
    std::size_t without = 0;
    for (const FaceUmbilics& on : found) {
        const Certificate& certificate = on.certificate;
        EXPECT_NE(certificate.complete, std::optional(false)) << "face " << on.face << ": " << certificate.why;
        EXPECT_FALSE(certificate.why.empty());
        without += !certificate.complete;
    }
    EXPECT_LE(without, GetParam().without);
    std::size_t faces = 0;
    for (const ShellCertificate& shell : shell_certificates(model, found)) {
        EXPECT_NE(shell.complete, std::optional(false)) << shell.why;
        EXPECT_FALSE(shell.why.empty());
        faces += shell.faces.size();
    }
    EXPECT_EQ(faces, model.faces.size());
}

INSTANTIATE_TEST_SUITE_P(RealFiles, Certificates,
                         testing::Values(File{"freeform/nacelle_quintic.stp", 0},
                                         File{"freeform/kvlcc2m_tanker_hull.iges", 0},
                                         File{"pairs/b777_openvsp.stp", 0}, File{"pairs/b777_onshape.step", 4},
                                         File{"pairs/propeller_1045.step", 0}));

}  // namespace
}  // namespace umbilic
