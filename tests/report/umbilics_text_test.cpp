// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <support/surfaces.h>
#include <umbilic/umbilics/find.h>

#include <report/readable.h>
#include <report/umbilics_text.h>

namespace umbilic {
namespace {

UmbilicCounts counts_of(const std::vector<NurbsSurface>& surfaces, SurfaceKind first = SurfaceKind::bspline) {
    Model model = support::model_of(surfaces);
    model.faces.front().kind = first;
    return count_umbilics(model, find_umbilics(model));
}

TEST(UmbilicsText, CountsAndTellsInWords) {
    const UmbilicCounts wave = counts_of({support::table_3_1_patch()});
    EXPECT_EQ(wave.isolated, 5u);
    EXPECT_EQ(umbilics_headline(wave), "5 isolated umbilics: 4 stars and 1 monstar");
    EXPECT_EQ(umbilics_explanation(wave), "The list is proved to be complete on the face.");

    const UmbilicCounts plane =
        counts_of({support::graph_patch(1, 1, [](double, double) { return 0.0; })}, SurfaceKind::plane);
    EXPECT_EQ(umbilics_headline(plane), "no isolated umbilic");
    EXPECT_EQ(umbilics_explanation(plane), "1 face is a plane or a sphere: every point is an umbilic.");

    const UmbilicCounts torus = counts_of({support::torus_quarter(3.0, 1.0), support::torus_quarter(5.0, 1.0)});
    EXPECT_EQ(umbilics_explanation(torus), "It is proved that there is none on all of the 2 faces.");
}

TEST(UmbilicsText, WhatIsNotProvedIsSaid) {
    UmbilicCounts counts;
    counts.faces = 3;
    counts.complete = 1;
    counts.incomplete = 1;
    counts.undecided = 1;
    const std::string text = umbilics_explanation(counts);
    EXPECT_NE(text.find("proved to be complete on 1 of 3 faces"), std::string::npos) << text;
    EXPECT_NE(text.find("On 1 that could not be proved"), std::string::npos) << text;
    EXPECT_NE(text.find("On 1 face the list is known not to be complete"), std::string::npos) << text;
    EXPECT_NE(text.find("There is 1 place that could not be decided"), std::string::npos) << text;

    FaceUmbilics found;
    found.certificate = {1.0, 0.5, false, "an umbilic is missing"};
    EXPECT_EQ(certificate_words(found), "not complete: an umbilic is missing");
    found.certificate.complete = true;
    found.lines.resize(2);
    EXPECT_EQ(certificate_words(found), "complete: besides the lines there is no umbilic; proved");
    found.regions.emplace_back();
    found.umbilics.emplace_back();
    EXPECT_EQ(certificate_words(found),
              "complete: besides the lines and the region every umbilic of this face is listed; proved");
    found.undecided.push_back({});
    EXPECT_NE(certificate_words(found).find("but for the undecided places"), std::string::npos);
}

TEST(UmbilicsText, ShellsOfOneKindAreGathered) {
    std::vector<ShellCertificate> shells;
    shells.push_back({{1, 2}, true, 2, 2.0, true, "the indices sum"});
    shells.push_back({{4}, false, std::nullopt, 0.0, std::nullopt, "not evaluated: the shell is open"});
    shells.push_back({{3}, true, 2, 2.0, true, "the indices sum"});
    shells.push_back({{5}, true, -2, -1.5, false, "an umbilic is missing"});
    const std::vector<ShellGroup> groups = shell_groups(shells);
    ASSERT_EQ(groups.size(), 3u);
    EXPECT_EQ(groups[0].words,
              "closed, genus 0; complete: the indices of its umbilics sum to 2, Euler's characteristic");
    EXPECT_EQ(groups[0].shells, 2u);
    EXPECT_EQ(groups[0].faces, (std::vector{1, 2, 3}));
    EXPECT_EQ(groups[1].words, "open; completeness not evaluated: the shell is open");
    EXPECT_EQ(groups[2].words, "closed, genus 2; not complete: the indices of its umbilics sum to −1.5 instead of −2");
}

TEST(UmbilicsText, TypesAndTheirNeighbours) {
    EXPECT_EQ(class_words(classify(cubic_of_omega(0.1), 0.0)), "elliptic star");
    EXPECT_EQ(class_words(classify(cubic_of_omega(std::polar(1.0, 0.5)), 1e-6)),
              "non-generic: hyperbolic star or monstar");
    EXPECT_EQ(class_words(classify({}, 1e-6)), "non-generic: any type");
    EXPECT_EQ(omega_words(classify({3.0, 0.0, 1.0, 0.0}, 1e-6)), "∞");
}

TEST(UmbilicsText, FacesWithNothingOfTheirOwnAreGathered) {
    Model model = support::model_of({support::torus_quarter(3.0, 1.0), support::table_3_1_patch(),
                                     support::torus_quarter(4.0, 1.0), support::torus_quarter(5.0, 1.0)});
    const std::vector<FaceGroup> groups = plain_faces(model, find_umbilics(model));
    ASSERT_EQ(groups.size(), 1u);
    EXPECT_EQ(groups.front().words, "complete: there is no umbilic; proved");
    EXPECT_EQ(groups.front().faces, (std::vector{1, 3, 4}));
}

TEST(UmbilicsText, NumbersInRanges) {
    EXPECT_EQ(number_ranges({}), "");
    EXPECT_EQ(number_ranges({7}), "7");
    EXPECT_EQ(number_ranges({1, 2, 4, 5, 6, 9}), "1, 2, 4–6, 9");
}

TEST(Readable, CoordinatesEndWithTheSizeOfTheModel) {
    EXPECT_EQ(readable_coordinate(-1.28e-12, 100.0), "0");
    EXPECT_EQ(readable_coordinate(-12.5, 100.0), "−12.5");
    EXPECT_EQ(readable_coordinate(1.0 / 3.0, 100.0), "0.33333");
    EXPECT_EQ(readable_coordinate(123456.789, 1e9), "123457");
    EXPECT_EQ(readable_coordinate(1e-9, 1e-8), "0.000000001");
}

}  // namespace
}  // namespace umbilic
