// SPDX-License-Identifier: LGPL-2.1-or-later
#include <report/fit_html.h>

#include <report/histogram.h>
#include <report/json_fit.h>
#include <report/page.h>
#include <report/page_data.h>
#include <report/readable.h>
#include <report/views.h>

namespace umbilic {

namespace {

std::string net(int u, int v) {
    return std::to_string(u) + " × " + std::to_string(v);
}

}  // namespace

std::string fit_headline(const FitResult& fit) {
    return readable_count(fit.points.size()) + " points fitted by a surface of " +
           net(fit.surface.u_pole_count(), fit.surface.v_pole_count()) + " control points: rms " +
           readable(fit.rms, "mm", 3) + ", largest residual " + readable(fit.maximum, "mm", 3);
}

std::string fit_explanation(const FitOptions& options, const FitResult& fit) {
    std::string text = "The points' own noise, seen by polynomials over small neighbourhoods, is " +
                       readable(fit.noise, "mm", 3) + "; ";
    text += fit.reached_noise ? "what the surface leaves is of that size: more control points would fit noise."
                              : "the surface leaves more than that: there is shape it does not follow, or the points "
                                "have outliers.";
    if (options.tolerance)
        text += std::string(" The tolerance of ") + readable(*options.tolerance, "mm", 3) +
                (fit.within_tolerance ? " is kept at every point." : " is not reached.");
    if (options.smooth)
        text += " Before the fit a low-pass filter of width " + readable(*options.smooth, "mm", 3) +
                " moved the points by " + readable(fit.filter_rms_change, "mm", 3) + " (rms), at most " +
                readable(fit.filter_max_change, "mm", 3) + ".";
    return text;
}

std::string fit_html(const FitReportInput& input, const Progress& progress) {
    progress.report(0.0, "drawing the residuals");
    const FitResult& fit = input.fit;
    const ColorScale scale = color_scale(fit.maximum, 0.0);
    PageData page;
    page.set("name", base_name(input.cloud.source.path));
    page.set("headline", fit_headline(fit));
    page.set("explanation", fit_explanation(input.options, fit));
    page.set("views", pictures(residual_views(fit.surface, fit.points, fit.distances, scale)));
    page.set("legend", legend_svg(scale, true, "scale-residual"));
    page.set("histogram", histogram_svg(histogram(fit.distances, residual_bins), fit.noise));
    PageData steps{PageData::type::list};
    for (const FitStep& step : fit.steps)
        steps.push_back(entry({{"net", net(step.u_poles, step.v_poles)},
                               {"rms", readable(step.rms, "mm", 3)},
                               {"max", readable(step.maximum, "mm", 3)}}));
    page.set("steps", steps);
    PageData facts{PageData::type::list};
    const auto fact = [&](const char* what, std::string value) {
        facts.push_back(entry({{"what", what}, {"value", std::move(value)}}));
    };
    fact("Path", input.cloud.source.path);
    fact("SHA-256", input.cloud.source.sha256);
    fact("Layout", input.cloud.layout);
    fact("Unit", input.cloud.source.unit);
    fact("Points", readable_count(input.cloud.points.size()));
    fact("Method", name(fit.method));
    fact("Degree", net(fit.surface.u_degree(), fit.surface.v_degree()));
    fact("Control points", net(fit.surface.u_pole_count(), fit.surface.v_pole_count()));
    fact("Residuals", "rms " + readable(fit.rms, "mm", 3) + ", mean size " + readable(fit.mean, "mm", 3) +
                          ", largest " + readable(fit.maximum, "mm", 3));
    for (const std::string& warning : input.cloud.warnings) fact("Warning", warning);
    page.set("facts", facts);
    set_parameters(fit_parameters(input.options, input.most_points), page);
    set_repetition(input.command_line, page);
    progress.report(0.9, "writing the page");
    return rendered(page_fit(), "Surface fitted to " + base_name(input.cloud.source.path), page);
}

}  // namespace umbilic
