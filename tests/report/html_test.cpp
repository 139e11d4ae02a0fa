// SPDX-License-Identifier: LGPL-2.1-or-later
#include <string>

#include <gtest/gtest.h>

#include <umbilic/core/errors.h>

#include <report/html.h>

#include "made_comparison.h"
#include "page_text.h"

namespace umbilic {
namespace {

TEST(Html, NeedsNoOtherFileAndNoNetwork) {
    const auto made = made_comparison();
    const std::string page = report_html(made->input());
    const std::string elements = markup(page);
    EXPECT_EQ(elements.find("<link"), std::string::npos);
    EXPECT_EQ(elements.find("<iframe"), std::string::npos);
    EXPECT_EQ(elements.find("href="), std::string::npos);
    int pictures = 0;
    for (auto at = elements.find("src="); at != std::string::npos; at = elements.find("src=", at + 1)) {
        const std::string expected = "src=\"data:image/png;base64,iVBORw0KGgo";
        EXPECT_EQ(elements.substr(at, expected.size()), expected);
        ++pictures;
    }
    EXPECT_EQ(pictures, 12);  // two models, four sides, four tests, two sides of the wireframe
    const auto style = page.find("<style>");
    const std::string css = page.substr(style, page.find("</style>") - style);
    EXPECT_EQ(css.find("url("), std::string::npos);
    EXPECT_EQ(css.find("@import"), std::string::npos);
    // A browser refuses whatever would be fetched all the same.
    EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
}

TEST(Html, EscapesEveryStringThatComesFromAFile) {
    const std::string hostile = "<img src=x onerror=alert(1)>\"'&</script><script>alert(2)</script>";
    const auto plain = made_comparison();
    const auto made = made_comparison(hostile);
    const std::string page = report_html(made->input());
    EXPECT_EQ(page.find("<img src=x"), std::string::npos);
    EXPECT_EQ(page.find("alert(2)</script>"), std::string::npos);
    EXPECT_EQ(count(page, "<script"), count(report_html(plain->input()), "<script"));
    EXPECT_NE(page.find("&lt;img src=x onerror=alert(1)&gt;"), std::string::npos);
}

TEST(Html, TellsWhatTheComparisonHolds) {
    const auto made = made_comparison("teapot");
    const std::string page = report_html(made->input());
    for (const char* const expected :
         {"answer teapot", "Explanation of teapot", "Is teapot near?", "Do the means of teapot agree?",
          "teapot_original.step", "/files/teapot_suspect.step", "1\u202f234\u202f567", "umbilic compare a b", "87.5 %",
          "91.2 %", "O1", "S2", "derived", "distance ≤ distance of teapot"}) {
        EXPECT_NE(page.find(expected), std::string::npos) << expected;
    }
    EXPECT_EQ(page.find("{{"), std::string::npos);
}

TEST(Html, ShowsTheWireframeOfTheOriginal) {
    const auto made = made_comparison();
    const std::string page = report_html(made->input());
    EXPECT_NE(page.find("The wireframe of the original"), std::string::npos);
    EXPECT_NE(page.find("name=\"wires\""), std::string::npos);
    // The page's viewer draws the same.
    EXPECT_NE(page.find("\"kind\":\"maximum\",\"color\":\"#"), std::string::npos);
}

TEST(Html, WithoutAPoseShowsNeitherDeviationNorStatistics) {
    const auto made = made_comparison_without_pose();
    const std::string page = report_html(made->input());
    EXPECT_EQ(page.find("<h2>Statistics</h2>"), std::string::npos);
    EXPECT_NE(page.find("No pose was found"), std::string::npos);
}

TEST(Html, StopsWhenAsked) {
    const auto made = made_comparison();
    const Progress progress;
    progress.cancel();
    EXPECT_THROW(report_html(made->input(), progress), Cancelled);
}

}  // namespace
}  // namespace umbilic
