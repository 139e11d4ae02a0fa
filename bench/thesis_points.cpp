// SPDX-License-Identifier: LGPL-2.1-or-later
// The thesis's examples of matching measured points (6.1.3, Figures 6-10 to 6-15, Tables 6.10 and 6.11), rebuilt on
// designs of our own brought to the boxes of the thesis's: points with its noise (6.4), every one of which moves by
// exactly xi, of a piece of the surface in an unknown place and scale. Each is matched as measured points, as the
// thesis does it (a surface fitted to the points, points of equal Gaussian and mean curvature, golden section over the
// scale from 0.3 to 1), and by ICP from where the points lie. thesis_points [--cases N]   pieces and places a setting
// (default 7)
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <tbb/global_control.h>

#include <occ_adapter/read_file.h>
#include <support/reparametrisation.h>
#include <support/surfaces.h>
#include <umbilic/core/errors.h>
#include <umbilic/matching/match.h>
#include <umbilic/matching/match_points.h>
#include <umbilic/matching/score.h>
#include <umbilic/points/fit_points.h>

#include "iterative_closest_points.h"

using namespace umbilic;
using namespace umbilic::bench;

namespace {

constexpr int point_count = 2500;
/// Bracket of the scale in all examples of the thesis.
constexpr double low_scale = 0.3, high_scale = 1.0;

struct Setting {
    const char* name;
    NurbsSurface surface;
    double coverage;              ///< share of the parameter domain that the points come from
    double xi;                    ///< mm of the suspect
    std::optional<double> scale;  ///< suspect to original; none: 1 and known
    int poles;                    ///< of the surface fitted to the points, along u and v
    const char* thesis_error;     ///< relative maximum error
    const char* thesis_seconds;   ///< without the fit
};

/// The largest B-spline face of a model's file.
NurbsSurface largest_face(const char* file) {
    const Model model = read_file(std::string(UMBILIC_MODELS_DIR) + "/" + file).model;
    const auto largest = std::max_element(model.faces.begin(), model.faces.end(),
                                          [](const Face& a, const Face& b) { return a.area < b.area; });
    if (largest == model.faces.end()) throw InvalidInput(std::string(file) + " has no face");
    return largest->surface;
}

/// The surface stretched so that the box of its points is the given one (mm; its longest side along the longest).
NurbsSurface in_box(const NurbsSurface& surface, std::array<double, 3> sides) {
    BoundingBox box;
    for (const AreaSample& sample : area_samples(support::model_of({surface}), {.count = 5000}))
        box.add(sample.curvature.point);
    const Vector3 size = box.high - box.low;
    std::array<int, 3> order = {0, 1, 2};
    std::sort(order.begin(), order.end(), [&](int a, int b) { return size[a] > size[b]; });
    std::sort(sides.begin(), sides.end(), std::greater<>());
    Vector3 factor;
    for (int i = 0; i < 3; ++i) factor[order[i]] = sides[i] / size[order[i]];
    std::vector<Vector3> poles;
    for (const Vector3& pole : surface.poles()) poles.push_back((pole - box.low).cwiseProduct(factor));
    return NurbsSurface(surface.u_knots(), surface.v_knots(), std::move(poles), surface.weights());
}

NurbsSurface half_of(const NurbsSurface& surface) {
    const ParameterBox domain = surface.domain();
    return support::restricted(surface, {{domain.u.low, domain.u.low + 0.5 * domain.u.length()}, domain.v});
}

struct Trial {
    PointCloud cloud;
    std::vector<Vector3> exact;  ///< without the noise
    SimilarityTransform truth;
};

Trial trial_of(const Setting& setting, double size, int number) {
    std::mt19937_64 random(1000 + number);
    std::uniform_real_distribution<double> unit(0.0, 1.0), cube(-1.0, 1.0);
    const ParameterBox domain = setting.surface.domain();
    const double side = std::sqrt(setting.coverage), u = unit(random) * (1 - side), v = unit(random) * (1 - side);
    const NurbsSurface piece = support::restricted(
        setting.surface, {{domain.u.low + u * domain.u.length(), domain.u.low + (u + side) * domain.u.length()},
                          {domain.v.low + v * domain.v.length(), domain.v.low + (v + side) * domain.v.length()}});
    Trial trial;
    trial.truth = support::random_similarity(2000 + number, setting.scale.value_or(1.0), false, size);
    const SimilarityTransform suspect_original = trial.truth.inverse();
    for (const AreaSample& sample :
         area_samples(support::model_of({piece}), {.count = point_count, .seed = static_cast<std::uint64_t>(number)})) {
        trial.exact.push_back(suspect_original.apply(sample.curvature.point));
        Vector3 e(cube(random), cube(random), cube(random));
        trial.cloud.points.push_back(trial.exact.back() + setting.xi * e.normalized());
    }
    trial.cloud.source.path = setting.name;
    clean(trial.cloud);
    return trial;
}

struct Answer {
    SimilarityTransform pose;
    bool found = false;
    double fit_seconds = 0.0, seconds = 0.0;
};

double seconds_since(std::clock_t start) {
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

/// The pose that is shown, whatever its status.
SimilarityTransform shown(const Alignment& alignment) {
    if (alignment.status != AlignmentStatus::not_found) return alignment.original_suspect;
    return alignment.runners_up.empty() ? SimilarityTransform() : alignment.runners_up.front().original_suspect;
}

Answer as_points(const PreparedModel& original, const Setting& setting, const Trial& trial) {
    MatchOptions options;
    if (!setting.scale) options.scale.kind = ScaleChoice::Kind::fixed;
    const auto start = std::clock();
    const PreparedPoints suspect = prepare(trial.cloud);
    const Alignment alignment = match(original, suspect, options);
    return {shown(alignment), alignment.found(), 0.0, seconds_since(start)};
}

Answer as_the_thesis(const PreparedModel& original, const Setting& setting, const Trial& trial) {
    MatchOptions options{.method = MethodChoice::kh};
    options.scale = setting.scale ? ScaleChoice{ScaleChoice::Kind::range, low_scale, high_scale}
                                  : ScaleChoice{ScaleChoice::Kind::fixed};
    Answer answer;
    auto start = std::clock();
    const FitResult fit = fit_points(trial.cloud, {.poles = std::pair(setting.poles, setting.poles)});
    answer.fit_seconds = seconds_since(start);
    const Model model = support::model_of({fit.surface});
    start = std::clock();
    const PreparedModel suspect = prepare(model);
    const Alignment alignment = match(original, suspect, options);
    answer.pose = shown(alignment);
    answer.found = alignment.found();
    answer.seconds = seconds_since(start);
    return answer;
}

Answer by_closest_points(const PreparedModel& original, const Setting& setting, const Trial& trial) {
    const auto start = std::clock();
    const SimilarityTransform pose =
        iterative_closest_points(Ground(original), trial.cloud.points, {}, {.free_scale = setting.scale.has_value()});
    return {pose, false, 0.0, seconds_since(start)};
}

/// Largest distance of the moved points from the original / sqrt(area).
double greatest_distance(const PreparedModel& original, const std::vector<Vector3>& points,
                         const SimilarityTransform& pose) {
    double greatest = 0.0;
    for (const Vector3& p : points)
        greatest = std::max(greatest, original.tree.closest(pose.apply(p))->distance / original.model.size());
    return greatest;
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

void run(int cases) {
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    const NurbsSurface bottle = largest_face("bottle.step"), half_hood = half_of(largest_face("hood.step"));
    const std::vector<Setting> settings = {
        {"hood, scale known (F93, Fig. 6-10)", in_box(half_hood, {10, 12, 6}), 0.4, 0.01, {}, 16, "0.0174", "-"},
        {"bottle (Fig. 6-13, Table 6.10)", in_box(bottle, {25, 23.48, 11}), 0.4, 0.0, 0.364, 18, "0.0068", "3449"},
        {"20 x 20 surface (Fig. 6-14)", in_box(support::smooth_bicubic(20, 7), {10, 10, 2.5}), 1.0, 0.0, 0.652, 20,
         "0.002", "1567"},
        {"hood (Fig. 6-15)", in_box(half_hood, {13, 12, 6}), 0.4, 0.01, 0.708, 16, "0.0005", "907"}};
    const struct {
        const char* name;
        Answer (*answer)(const PreparedModel&, const Setting&, const Trial&);
    } ways[] = {{"measured points, no bracket", as_points},
                {"fit, KH, golden section", as_the_thesis},
                {"ICP (Besl, McKay)", by_closest_points}};
    std::printf(
        "%d cases a setting, one thread, processor time. Relative maximum error: largest distance from the "
        "original / sqrt(area), of the points without noise\n(median, worst) and of the points as measured "
        "(median). Thesis: relative maximum error, and seconds without the fit (Table 6.11).\n",
        cases);
    std::printf("%-36s %-28s %6s %6s %10s %9s %9s %11s %7s %9s | %8s %8s\n", "setting", "way", "right", "found",
                "scale err", "median", "worst", "as measured", "fit s", "match s", "thesis", "thesis s");
    for (const Setting& setting : settings) {
        const Model model = support::model_of({setting.surface});
        const PreparedModel original = prepare(model);
        for (const auto& way : ways) {
            int right = 0, found = 0;
            std::vector<double> scales, errors, measured, fit_seconds, seconds;
            for (int k = 0; k < cases; ++k) {
                const Trial trial = trial_of(setting, model.size(), k);
                const Answer answer = way.answer(original, setting, trial);
                scales.push_back(std::abs(answer.pose.scale / trial.truth.scale - 1.0));
                errors.push_back(greatest_distance(original, trial.exact, answer.pose));
                measured.push_back(greatest_distance(original, trial.cloud.points, answer.pose));
                fit_seconds.push_back(answer.fit_seconds);
                seconds.push_back(answer.seconds);
                right += errors.back() < 0.01 && scales.back() < 0.02;
                found += answer.found;
            }
            std::printf("%-36s %-28s %3d/%-2d %3d/%-2d %10.1e %9.1e %9.1e %11.1e %7.2f %9.2f | %8s %8s\n", setting.name,
                        way.name, right, cases, found, cases, median(scales), median(errors),
                        *std::max_element(errors.begin(), errors.end()), median(measured), median(fit_seconds),
                        median(seconds), setting.thesis_error, setting.thesis_seconds);
            std::fflush(stdout);
        }
    }
}

}  // namespace

int main(int count, char** words) {
    try {
        run(count == 3 && std::strcmp(words[1], "--cases") == 0 ? std::max(1, std::atoi(words[2])) : 7);
    } catch (const Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
