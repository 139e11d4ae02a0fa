// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cmath>
#include <regex>
#include <string>

#include <gtest/gtest.h>

#include <support/surfaces.h>
#include <umbilic/core/errors.h>

#include <report/omega_plane.h>
#include <report/parameter_picture.h>
#include <report/pattern.h>
#include <report/umbilics_html.h>

#include "made_comparison.h"
#include "page_text.h"

namespace umbilic {
namespace {

/// The patch of thesis Table 3.1, four stars and a monstar.
struct Made {
    explicit Made(const std::string& name = "part") : comparison(made_comparison(name)) {}
    UmbilicsReportInput input() const {
        return {comparison->original_model, comparison->original_meshes, umbilics, {}, "umbilic umbilics a"};
    }

    std::unique_ptr<MadeComparison> comparison;
    std::vector<FaceUmbilics> umbilics = find_umbilics(comparison->original_model);
};

std::vector<std::smatch> matches(const std::string& text, const std::regex& pattern) {
    return {std::sregex_iterator(text.begin(), text.end(), pattern), std::sregex_iterator()};
}

TEST(UmbilicsHtml, NeedsNoOtherFileAndNoNetwork) {
    const Made made;
    const std::string page = umbilics_html(made.input()), elements = markup(page);
    for (const char* const other : {"<link", "<iframe", "href="}) EXPECT_EQ(elements.find(other), std::string::npos);
    EXPECT_EQ(count(elements, "src="), 4u);
    EXPECT_EQ(count(elements, "src=\"data:image/png;base64,iVBORw0KGgo"), 4u);
    const auto style = page.find("<style>");
    const std::string css = page.substr(style, page.find("</style>") - style);
    EXPECT_EQ(css.find("url("), std::string::npos);
    EXPECT_EQ(css.find("@import"), std::string::npos);
    EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
    EXPECT_EQ(page.find("{{"), std::string::npos);
}

TEST(UmbilicsHtml, EscapesEveryStringThatComesFromAFile) {
    const Made plain, made("<img src=x onerror=alert(1)>\"'&</script><script>alert(2)</script>");
    const std::string page = umbilics_html(made.input());
    EXPECT_EQ(page.find("<img src=x"), std::string::npos);
    EXPECT_EQ(page.find("alert(2)</script>"), std::string::npos);
    EXPECT_EQ(count(page, "<script"), count(umbilics_html(plain.input()), "<script"));
}

TEST(UmbilicsHtml, TellsWhatWasFoundAndProvedFirst) {
    const Made made;
    const std::string page = umbilics_html(made.input());
    const auto headline = page.find("5 isolated umbilics: 4 stars and 1 monstar");
    ASSERT_NE(headline, std::string::npos);
    EXPECT_LT(headline, page.find("<h2>"));
    EXPECT_LT(page.find("proved to be complete on the face"), page.find("<h2>"));
    EXPECT_NE(page.find("complete: every umbilic of this face is listed; proved"), std::string::npos);
    EXPECT_EQ(page.find("Whole shells"), std::string::npos);
    UmbilicsReportInput with_shells = made.input();
    with_shells.shells = shell_certificates(with_shells.model, with_shells.umbilics);
    const std::string wider = umbilics_html(with_shells);
    EXPECT_NE(wider.find("Whole shells"), std::string::npos);
    EXPECT_NE(wider.find("the shell is open, with 4 free edges"), std::string::npos);
    EXPECT_NE(page.find("monstar</span><span>flat"), std::string::npos);
    EXPECT_EQ(count(page, "<svg class=\"pattern\""), 5u);
    EXPECT_NE(page.find("umbilic umbilics a"), std::string::npos);
    EXPECT_NE(page.find("why part"), std::string::npos) << "what was skipped";
}

TEST(UmbilicsHtml, AModelWithoutUmbilicsHasAPage) {
    Made made;
    made.umbilics.front() = {};
    made.umbilics.front().face = 1;
    made.umbilics.front().certificate.complete = true;
    const std::string page = umbilics_html(made.input());
    EXPECT_NE(page.find("no isolated umbilic"), std::string::npos);
    EXPECT_EQ(page.find("class=\"omega\""), std::string::npos);
    EXPECT_EQ(count(page, "<details"), 0u);
    made.umbilics.clear();
    EXPECT_NE(umbilics_html(made.input()).find("</html>"), std::string::npos);
}

TEST(UmbilicsHtml, ManyFacesStayWithinBounds) {
    const Model model = support::model_of(std::vector<NurbsSurface>(260, support::monge_patch(0.3, 2, 0.3, -2, 0.4)));
    const std::vector<FaceUmbilics> found = find_umbilics(model);
    const std::string page = umbilics_html({model, {}, found, {}, ""});
    EXPECT_EQ(count(page, "<details"), 200u);
    EXPECT_EQ(count(page, " open>"), 3u);
    EXPECT_NE(page.find("60 more faces in umbilics.json"), std::string::npos);
}

TEST(UmbilicsHtml, StopsWhenAsked) {
    const Made made;
    const Progress progress;
    progress.cancel();
    EXPECT_THROW(umbilics_html(made.input(), progress), Cancelled);
}

TEST(ParameterPicture, PutsEveryUmbilicWhereItIs) {
    const Made made;
    const Face& face = made.comparison->original_model.faces.front();
    const std::string svg = parameter_picture_svg(face, made.umbilics.front(), 1, true);
    const auto marks = matches(svg, std::regex("class=\"umbilic\"[^>]*translate\\(([0-9.]+) ([0-9.]+)\\)"));
    const auto ground = matches(
        svg, std::regex("class=\"ground\" x=\"([0-9.]+)\" y=\"([0-9.]+)\" width=\"([0-9.]+)\" height=\"([0-9.]+)\""));
    ASSERT_EQ(marks.size(), 5u);
    ASSERT_EQ(ground.size(), 1u);
    const auto number = [](const std::smatch& match, int i) { return std::stod(match[i]); };
    for (std::size_t i = 0; i < marks.size(); ++i) {
        const SurfacePoint& at = made.umbilics.front().umbilics[i].at;
        EXPECT_NEAR((number(marks[i], 1) - number(ground[0], 1)) / number(ground[0], 3), at.u, 1e-3);
        EXPECT_NEAR(1.0 - (number(marks[i], 2) - number(ground[0], 2)) / number(ground[0], 4), at.v, 1e-3);
    }
    for (const auto& stroke : matches(svg, std::regex("class=\"direction\" d=\"([^\"]*)\"")))
        EXPECT_EQ(count(stroke[1], "M"), 3u) << "three lines of curvature run into stars and monstars";
    EXPECT_EQ(count(svg, "class=\"outside\""), 0u);
}

TEST(ParameterPicture, ShowsWhatIsNotIsolatedAndWhatIsOutside) {
    Made made;
    const Face& face = made.comparison->original_model.faces.front();
    FaceUmbilics& found = made.umbilics.front();
    found.umbilics.front().containment = Containment::outside;
    found.undecided.push_back({{{{0.1, 0.2}, {0.1, 0.2}}}, 0.5});
    found.undecided.push_back({{}, std::nullopt});
    UmbilicLine line;
    line.boxes = {{{0.5, 0.6}, {0.0, 0.5}}, {{0.5, 0.6}, {0.5, 1.0}}};
    line.parameters = {{0.55, 0.0}, {0.55, 0.5}, {0.55, 1.0}};
    found.lines.push_back(line);
    UmbilicRegion region;
    region.kind = UmbilicRegionKind::planar;
    region.boxes = {{{0.7, 0.9}, {0.7, 0.9}}};
    found.regions.push_back(region);
    const std::string svg = parameter_picture_svg(face, found, 1, true);
    EXPECT_EQ(count(svg, "class=\"outside\""), 1u);
    EXPECT_EQ(count(svg, "class=\"undecided\""), 1u);
    EXPECT_EQ(count(svg, "class=\"umbilic-line\""), 1u);
    EXPECT_EQ(count(svg, "class=\"line-boxes\""), 1u);
    EXPECT_EQ(count(svg, "class=\"region planar\""), 1u);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(Pattern, AsManyLinesRunInAsTheTypeSays) {
    const struct {
        double omega;
        UmbilicType type;
        std::size_t half_lines;
    } kinds[] = {{0.3, UmbilicType::star, 6}, {-1.7, UmbilicType::monstar, 6}, {1.7, UmbilicType::lemon, 2}};
    for (const auto& kind : kinds) {
        const Cubic c = cubic_of_omega(kind.omega);
        const Model model = support::model_of({support::monge_patch(0.5, c.a, c.b, c.c, c.d)});
        const std::vector<Umbilic> all = find_umbilics(model).front().umbilics;
        const auto umbilic =
            std::ranges::find_if(all, [](const Umbilic& candidate) { return candidate.point.norm() < 1e-9; });
        ASSERT_NE(umbilic, all.end());
        ASSERT_EQ(umbilic->kind.type, kind.type);
        const UmbilicPattern pattern = trace_pattern(model.faces.front(), *umbilic, all);
        EXPECT_GT(pattern.radius, 0.0);
        std::size_t half_lines = 0;
        for (const UmbilicPattern::Line& line : pattern.lines) {
            if (!line.separatrix) continue;
            ++half_lines;
            EXPECT_LT(line.points.front().norm(), 1e-9);
            // It leaves along one of the directions that the cubic form gives.
            const Vector2 way = line.points[1].normalized();
            double sine = 1.0;
            for (const double angle : umbilic->kind.angles)
                sine = std::min(sine, std::abs(way.x() * std::sin(angle) - way.y() * std::cos(angle)));
            EXPECT_LT(sine, 0.1);
        }
        EXPECT_EQ(half_lines, kind.half_lines);
        EXPECT_GT(pattern.lines.size(), 2 * kind.half_lines);
        EXPECT_EQ(count(pattern_svg(*umbilic, pattern), "separatrix"), kind.half_lines);
    }
}

TEST(Pattern, WithoutLinesTheDirectionsAreShown) {
    const Made made;
    const Face& face = made.comparison->original_model.faces.front();
    Umbilic umbilic = made.umbilics.front().umbilics.front();
    umbilic.kind.type = UmbilicType::non_generic;
    const UmbilicPattern pattern = trace_pattern(face, umbilic, made.umbilics.front().umbilics);
    EXPECT_TRUE(pattern.lines.empty());
    EXPECT_EQ(count(pattern_svg(umbilic, pattern), "class=\"direction\""), 3u);
}

TEST(OmegaPlaneOfOneModel, MarksArrowsAndUncertainty) {
    const std::vector<OmegaMark> marks = {{{0.5, 0.2}, 0.0, UmbilicType::star, "1"},
                                          {{1.0, 0.9}, 0.5, UmbilicType::non_generic, "2"},
                                          {{20.0, 5.0}, 0.0, UmbilicType::lemon, "3"}};
    const std::string svg = omega_plane_svg(marks);
    EXPECT_EQ(count(svg, "<path class=\"umbilic"), 6u) << "two in range, each at its three values";
    EXPECT_EQ(count(svg, "class=\"arrow"), 3u);
    EXPECT_EQ(count(svg, "class=\"uncertain\""), 1u);
    EXPECT_EQ(count(svg, "class=\"number\""), 3u);
    // 400 units show 6.8 of the plane.
    const auto star = matches(svg, std::regex("class=\"umbilic\"[^>]*translate\\(([0-9.]+) ([0-9.]+)\\)"));
    ASSERT_EQ(star.size(), 2u);
    EXPECT_NEAR(std::stod(star[0][1]), 200.0 + 0.5 * 200.0 / 3.4, 0.06);
    EXPECT_NEAR(std::stod(star[0][2]), 200.0 - 0.2 * 200.0 / 3.4, 0.06);
}

}  // namespace
}  // namespace umbilic
