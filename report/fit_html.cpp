// SPDX-License-Identifier: LGPL-2.1-or-later
#include <report/fit_html.h>

#include <cassert>
#include <ctime>

#include <boost/algorithm/string/replace.hpp>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <kainjow/mustache.hpp>

#include <report/base64.h>
#include <report/histogram.h>
#include <report/json_fit.h>
#include <report/page.h>
#include <report/readable.h>
#include <report/versions.h>
#include <report/views.h>

namespace umbilic {

namespace {

using PageData = kainjow::mustache::data;

PageData entry(std::initializer_list<std::pair<const char*, std::string>> fields) {
    PageData data;
    for (const auto& [key, value] : fields) data.set(key, value);
    return data;
}

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
    page.set("style", page_style());
    page.set("name", base_name(input.cloud.source.path));
    page.set("headline", fit_headline(fit));
    page.set("explanation", fit_explanation(input.options, fit));
    PageData views{PageData::type::list};
    for (const View& view : residual_views(fit.surface, fit.points, fit.distances, scale))
        views.push_back(entry({{"caption", view.caption}, {"source", "data:image/png;base64," + base64(view.png)}}));
    page.set("views", views);
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
    PageData parameters{PageData::type::list};
    for (const Parameter& parameter : fit_parameters(input.options, input.most_points))
        parameters.push_back(
            entry({{"name", parameter.name},
                   {"value", parameter.value.is_string() ? parameter.value.get<std::string>() : parameter.value.dump()},
                   {"unit", parameter.unit == "1" ? "" : parameter.unit},
                   {"origin", name(parameter.origin)},
                   {"meaning", boost::replace_all_copy(parameter.meaning, "<=", "≤")}}));
    page.set("parameters", parameters);
    page.set("command_line", input.command_line);
    const Versions used = versions();
    page.set("version", used.umbilic);
    page.set("commit", used.commit);
    page.set("made", fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(std::time(nullptr))));
    progress.report(0.9, "writing the page");
    kainjow::mustache::mustache page_template(page_fit());
    assert(page_template.is_valid());
    return page_template.render(page);
}

}  // namespace umbilic
