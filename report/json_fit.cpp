// SPDX-License-Identifier: LGPL-2.1-or-later
#include <report/json_fit.h>

#include <umbilic/matching/prepared_points.h>

#include <report/histogram.h>
#include <report/json_geometry.h>

namespace umbilic {

namespace {

Json surface_json(const NurbsSurface& surface) {
    Json poles = Json::array();
    for (int i = 0; i < surface.u_pole_count(); ++i) {
        Json row = Json::array();
        for (int j = 0; j < surface.v_pole_count(); ++j) row.push_back(vector_json(surface.pole(i, j)));
        poles.push_back(std::move(row));
    }
    return {{"degree", {surface.u_degree(), surface.v_degree()}},
            {"poles", {surface.u_pole_count(), surface.v_pole_count()}},
            {"u_knots", surface.u_knots().knots()},
            {"v_knots", surface.v_knots().knots()},
            {"control_points", std::move(poles)}};
}

std::string size_word(const std::optional<std::pair<int, int>>& size) {
    return size ? std::to_string(size->first) + "x" + std::to_string(size->second) : "auto";
}

}  // namespace

std::vector<Parameter> fit_parameters(const FitOptions& options, std::size_t most_points) {
    const auto chosen = [](bool by_user) { return by_user ? ToleranceOrigin::user : ToleranceOrigin::fixed_default; };
    const auto length = [](const std::optional<double>& value) { return value ? number_json(*value) : Json("none"); };
    const FitOptions defaults;
    const PointFeatureOptions point_defaults;
    return {{"method", name(options.method), "", chosen(options.method != defaults.method),
             "how points get their parameters and poles"},
            {"grid", options.grid ? size_word(options.grid) : "none", "", chosen(options.grid.has_value()),
             "rows and columns in which the points stand"},
            {"degree", options.degree, "1", chosen(options.degree != defaults.degree), "of the surface in u and v"},
            {"net", size_word(options.poles), "", chosen(options.poles.has_value()),
             "control points along u and v; auto: grown until the residual is noise or within the tolerance"},
            {"tolerance", length(options.tolerance), options.tolerance ? "mm" : "",
             chosen(options.tolerance.has_value()), "a net is large enough if the greatest residual <= tolerance"},
            {"smooth", length(options.smooth), options.smooth ? "mm" : "", chosen(options.smooth.has_value()),
             "standard deviation of the Gaussian low-pass filter before the fit"},
            {"most_poles", options.most_poles, "1", chosen(options.most_poles != defaults.most_poles),
             "control points along either direction <= most_poles"},
            {"most_points", most_points, "1", chosen(most_points != point_defaults.most_points),
             "points of a larger cloud that are used, chosen at random"}};
}

Json fit_json(const PointCloud& cloud, const FitOptions& options, std::size_t most_points, const FitResult& fit,
              const std::string& output, const Timing& timing) {
    const Histogram bins = histogram(fit.distances, residual_bins);
    Json steps = Json::array();
    for (const FitStep& step : fit.steps)
        steps.push_back({{"poles", {step.u_poles, step.v_poles}},
                         {"rms", number_json(step.rms)},
                         {"max", number_json(step.maximum)}});
    const Json filter = options.smooth ? Json{{"width", number_json(*options.smooth)},
                                              {"rms_change", number_json(fit.filter_rms_change)},
                                              {"max_change", number_json(fit.filter_max_change)}}
                                       : Json(nullptr);
    return {{"schema", "umbilic.fit/1"},
            {"tool", tool_json()},
            {"input", input_json(cloud)},
            {"parameters", parameters_json(fit_parameters(options, most_points))},
            {"method", name(fit.method)},
            {"surface", surface_json(fit.surface)},
            {"output", output.empty() ? Json(nullptr) : Json(output)},
            {"residuals",
             {{"count", fit.distances.size()},
              {"rms", number_json(fit.rms)},
              {"mean", number_json(fit.mean)},
              {"max", number_json(fit.maximum)},
              {"histogram", {{"range", number_json(bins.range)}, {"counts", bins.counts}}}}},
            {"noise", number_json(fit.noise)},
            {"reached_noise", fit.reached_noise},
            {"within_tolerance", options.tolerance ? Json(fit.within_tolerance) : Json(nullptr)},
            {"steps", std::move(steps)},
            {"filter", filter},
            {"timing", timing_json(timing)}};
}

}  // namespace umbilic
