// SPDX-License-Identifier: LGPL-2.1-or-later
#include "point_trials.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include <Eigen/Geometry>

#include <umbilic/core/errors.h>

namespace umbilic::bench {

namespace {

constexpr int stock_points = 30000;
constexpr double smallest_scale = 0.3, largest_scale = 3.0;

SimilarityTransform random_pose(double scale, double reach, std::mt19937_64& random) {
    std::normal_distribution<double> normal(0.0, 1.0);
    std::uniform_real_distribution<double> uniform(-reach, reach);
    SimilarityTransform pose;
    pose.scale = scale;
    pose.rotation = Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
                        .normalized()
                        .toRotationMatrix();
    pose.translation = Vector3(uniform(random), uniform(random), uniform(random));
    return pose;
}

}  // namespace

std::unique_ptr<PointOriginal> point_original(const std::string& name, Model model) {
    auto original = std::make_unique<PointOriginal>();
    original->name = name;
    original->model = std::move(model);
    original->prepared = std::unique_ptr<PreparedModel>(new PreparedModel(prepare(original->model)));
    for (const AreaSample& sample : area_samples(original->model, {.count = stock_points, .seed = 77}))
        original->stock.push_back(sample.curvature.point);
    return original;
}

PointTrial point_trial(const PointOriginal& original, const TrialKind& kind, std::mt19937_64& random) {
    std::vector<Vector3> points = original.stock;
    std::shuffle(points.begin(), points.end(), random);
    points.resize(kind.points);
    const Vector3 centre = points.front();
    const auto count = static_cast<std::ptrdiff_t>(std::lround(kind.coverage * kind.points));
    if (count < kind.points) {
        std::nth_element(points.begin(), points.begin() + count, points.end(), [&](const Vector3& a, const Vector3& b) {
            return (a - centre).squaredNorm() < (b - centre).squaredNorm();
        });
        points.resize(count);
    }
    const double size = original.model.size();
    std::uniform_real_distribution<double> log_scale(std::log(smallest_scale), std::log(largest_scale));
    PointTrial trial;
    trial.truth = random_pose(kind.unknown_scale ? std::exp(log_scale(random)) : 1.0, 2.0 * size, random);
    const SimilarityTransform suspect_original = trial.truth.inverse();
    std::normal_distribution<double> normal(0.0, kind.noise * size * suspect_original.scale);
    for (const Vector3& p : points) {
        trial.exact.push_back(suspect_original.apply(p));
        trial.suspect.points.push_back(trial.exact.back() + Vector3(normal(random), normal(random), normal(random)));
    }
    trial.suspect.source.path = "trial";
    clean(trial.suspect);
    return trial;
}

TrialError trial_error(const PointOriginal& original, const PointTrial& trial, const SimilarityTransform& found) {
    TrialError error;
    error.scale = std::abs(found.scale / trial.truth.scale - 1.0);
    for (const Vector3& p : trial.exact) {
        const auto foot = original.prepared->tree.closest(found.apply(p));
        error.distance = std::max(error.distance, foot->distance / original.model.size());
    }
    return error;
}

void write_ply(const std::string& path, const std::vector<Vector3>& points) {
    std::ofstream out(path);
    out.precision(12);
    out << "ply\nformat ascii 1.0\nelement vertex " << points.size()
        << "\nproperty double x\nproperty double y\nproperty double z\nend_header\n";
    for (const Vector3& p : points) out << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
    if (!out.flush()) throw NumericFailure(path + ": cannot be written");
}

}  // namespace umbilic::bench
