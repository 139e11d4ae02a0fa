// SPDX-License-Identifier: LGPL-2.1-or-later
// The Point Cloud Library on the trials of points_success, as its own tutorial aligns templates: FPFH features, sample
// consensus initial alignment (R. B. Rusu, N. Blodow, M. Beetz, Fast Point Feature Histograms for 3D registration,
// 2009), ICP.
//
// points_success --cases 30 --export DIR
// points_peer_pcl DIR [ROW ...]     ROW e.g. noise0.0003_free
//
// Success as there, with distances from 30 000 points of the original. With an unknown scale 12 scales from 0.3 to 3
// are tried, each refined with a free scale, and the one with the smallest residual wins. One thread, processor time.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <optional>
#include <queue>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include <Eigen/Dense>
#include <pcl/features/fpfh.h>
#include <pcl/features/normal_3d.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/registration/ia_ransac.h>
#include <pcl/registration/icp.h>
#include <pcl/registration/transformation_estimation_svd_scale.h>
#include <pcl/search/kdtree.h>

#include "measurements.h"

namespace {

namespace fs = std::filesystem;

using Point = pcl::PointXYZ;
using Points = pcl::PointCloud<Point>;
using Normals = pcl::PointCloud<pcl::Normal>;
using Features = pcl::PointCloud<pcl::FPFHSignature33>;

constexpr int scale_count = 12;
constexpr double lowest_scale = 0.3, highest_scale = 3.0;
/// Distance of points after thinning out, of sqrt(area), and radii of normals and features in it.
constexpr float voxel_part = 0.03f, normal_radius = 3.0f, feature_radius = 7.0f;
/// Sample consensus: tries, and in voxels the least distance of its three samples and that beyond which points count as
/// if they were no farther.
constexpr int tries = 1000;
constexpr float sample_distance = 3.0f, inlier_distance = 1.5f;
constexpr int orientation_neighbours = 15, fewest_points = 10, icp_steps = 100;
constexpr double greatest_distance = 0.01, greatest_scale_error = 0.02;

/// A PLY file as points_success writes it.
Points::Ptr read_ply(const fs::path& path) {
    std::ifstream in(path);
    std::string line;
    while (std::getline(in, line) && line != "end_header") {
    }
    Points::Ptr points(new Points);
    for (Point p; in >> p.x >> p.y >> p.z;) points->push_back(p);
    if (points->empty()) throw std::runtime_error(path.string() + ": holds no points");
    return points;
}

Points::Ptr scaled(const Points& points, float factor) {
    Points::Ptr result(new Points(points));
    for (Point& p : *result) p.getVector3fMap() *= factor;
    return result;
}

/// Turns normals to one side, from neighbour to neighbour over those that agree best.
void orient(Normals& normals, const Points::Ptr& points) {
    pcl::KdTreeFLANN<Point> tree;
    tree.setInputCloud(points);
    std::vector<char> done(points->size(), 0);
    std::vector<int> near;
    std::vector<float> squared;
    std::priority_queue<std::tuple<float, int, int>> next;  // agreement, from, to
    for (int start = 0; start < static_cast<int>(points->size()); ++start) {
        if (done[start]) continue;
        next.emplace(1.0f, start, start);
        while (!next.empty()) {
            const auto [agreement, from, to] = next.top();
            next.pop();
            if (done[to]) continue;
            done[to] = 1;
            if (normals[from].getNormalVector3fMap().dot(normals[to].getNormalVector3fMap()) < 0.0f)
                normals[to].getNormalVector3fMap() *= -1.0f;
            tree.nearestKSearch((*points)[to], orientation_neighbours, near, squared);
            for (const int other : near)
                if (!done[other])
                    next.emplace(
                        std::abs(normals[to].getNormalVector3fMap().dot(normals[other].getNormalVector3fMap())), to,
                        other);
        }
    }
}

struct Prepared {
    Points::Ptr points;
    Features::Ptr features;
};

/// Points of one density and their features. Which side of a cloud is outside is not known, and features depend on it.
Prepared prepared(const Points::Ptr& all, float voxel, bool turn_normals) {
    Prepared result{Points::Ptr(new Points), Features::Ptr(new Features)};
    pcl::VoxelGrid<Point> grid;
    grid.setInputCloud(all);
    grid.setLeafSize(voxel, voxel, voxel);
    grid.filter(*result.points);
    const Normals::Ptr normals(new Normals);
    const pcl::search::KdTree<Point>::Ptr tree(new pcl::search::KdTree<Point>);
    pcl::NormalEstimation<Point, pcl::Normal> estimation;
    estimation.setInputCloud(result.points);
    estimation.setSearchMethod(tree);
    estimation.setRadiusSearch(normal_radius * voxel);
    estimation.compute(*normals);
    for (pcl::Normal& normal : *normals)
        if (!normal.getNormalVector3fMap().allFinite()) normal.getNormalVector3fMap().setUnit(2);
    orient(*normals, result.points);
    if (turn_normals)
        for (pcl::Normal& normal : *normals) normal.getNormalVector3fMap() *= -1.0f;
    pcl::FPFHEstimation<Point, pcl::Normal, pcl::FPFHSignature33> features;
    features.setInputCloud(result.points);
    features.setInputNormals(normals);
    features.setSearchMethod(tree);
    features.setRadiusSearch(feature_radius * voxel);
    features.compute(*result.features);
    return result;
}

Eigen::Matrix4f initial_alignment(const Prepared& suspect, const Prepared& original, float voxel) {
    pcl::SampleConsensusInitialAlignment<Point, Point, pcl::FPFHSignature33> search;
    search.setInputSource(suspect.points);
    search.setSourceFeatures(suspect.features);
    search.setInputTarget(original.points);
    search.setTargetFeatures(original.features);
    search.setMaximumIterations(tries);
    search.setMinSampleDistance(sample_distance * voxel);
    search.setMaxCorrespondenceDistance(inlier_distance * voxel);
    Points moved;
    search.align(moved);
    return search.getFinalTransformation();
}

/// ICP with all points; the residual is the root mean square of distances, those beyond the reach counted as the reach.
std::pair<Eigen::Matrix4f, double> refined(const Points::Ptr& suspect, const Points::Ptr& original, float reach,
                                           const Eigen::Matrix4f& start, bool free_scale) {
    pcl::IterativeClosestPoint<Point, Point> icp;
    if (free_scale)
        icp.setTransformationEstimation(pcl::registration::TransformationEstimationSVDScale<Point, Point>::Ptr(
            new pcl::registration::TransformationEstimationSVDScale<Point, Point>));
    icp.setInputSource(suspect);
    icp.setInputTarget(original);
    icp.setMaxCorrespondenceDistance(reach);
    icp.setMaximumIterations(icp_steps);
    Points moved;
    icp.align(moved, start);
    pcl::KdTreeFLANN<Point> tree;
    tree.setInputCloud(original);
    std::vector<int> index;
    std::vector<float> squared;
    double sum = 0.0;
    for (const Point& p : moved) {
        tree.nearestKSearch(p, 1, index, squared);
        sum += std::min(squared[0], reach * reach);
    }
    return {icp.getFinalTransformation(), std::sqrt(sum / static_cast<double>(moved.size()))};
}

double scale_of(const Eigen::Matrix4f& pose) {
    return std::cbrt(pose.topLeftCorner<3, 3>().determinant());
}

std::optional<Eigen::Matrix4f> aligned(const Points::Ptr& suspect, const Points::Ptr& original, double size,
                                       bool unknown_scale) {
    const float voxel = voxel_part * static_cast<float>(size);
    const Prepared target = prepared(original, voxel, false);
    std::optional<Eigen::Matrix4f> best;
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < (unknown_scale ? scale_count : 1); ++i) {
        const double factor =
            unknown_scale ? lowest_scale * std::pow(highest_scale / lowest_scale, i / (scale_count - 1.0)) : 1.0;
        const Points::Ptr source = scaled(*suspect, static_cast<float>(factor));
        for (const bool turn_normals : {false, true}) {
            const Prepared from = prepared(source, voxel, turn_normals);
            if (from.points->size() < static_cast<std::size_t>(fewest_points)) continue;
            const Eigen::Matrix4f start = initial_alignment(from, target, voxel);
            const auto [pose, residual] = refined(source, original, 2.0f * voxel, start, unknown_scale);
            const double scale = factor * scale_of(pose);
            if (!(scale > 0.0) || !(residual / scale < least)) continue;
            least = residual / scale;  // in the suspect's unit
            Eigen::Matrix4f whole = pose;
            whole.topLeftCorner<3, 3>() *= static_cast<float>(factor);
            best = whole;
        }
    }
    return best;
}

struct Trial {
    fs::path place;
    bool unknown_scale = false;
};

struct Outcome {
    bool success = false;
    double seconds = 0.0;
};

Outcome run(const Trial& trial, const pcl::KdTreeFLANN<Point>& dense) {
    const Points::Ptr original = read_ply(trial.place / "original.ply"),
                      suspect = read_ply(trial.place / "suspect.ply");
    const Points::Ptr exact = read_ply(trial.place / "exact.ply");
    std::ifstream words(trial.place / "truth.txt");
    std::vector<double> truth;
    for (double word = 0.0; words >> word;) truth.push_back(word);
    if (truth.size() < 2) throw std::runtime_error(trial.place.string() + ": holds no truth");
    const double scale = truth.front(), size = truth.back();
    std::srand(1);  // what PCL draws its samples with
    const std::clock_t start = std::clock();
    const auto found = aligned(suspect, original, size, trial.unknown_scale);
    Outcome outcome{false, umbilic::bench::seconds_since(start)};
    if (!found || std::abs(scale_of(*found) / scale - 1.0) > greatest_scale_error) return outcome;
    std::vector<int> index;
    std::vector<float> squared;
    double greatest = 0.0;
    for (const Point& p : *exact) {
        Point moved;
        moved.getVector4fMap() = *found * p.getVector4fMap();
        dense.nearestKSearch(moved, 1, index, squared);
        greatest = std::max(greatest, std::sqrt(static_cast<double>(squared[0])));
    }
    outcome.success = greatest / size < greatest_distance;
    return outcome;
}

/// Row, kind of scale, coverage and shape of a trial's folder: noise0.0003_free_0.3_hood_001.
std::array<std::string, 4> words_of(const fs::path& place) {
    std::array<std::string, 4> words;
    std::string name = place.filename().string();
    for (std::string& word : words) {
        const std::size_t end = name.find('_');
        word = name.substr(0, end);
        name.erase(0, end == std::string::npos ? name.size() : end + 1);
    }
    return words;
}

void run_all(const fs::path& folder, const std::vector<std::string>& rows) {
    std::map<std::tuple<std::string, double>, std::vector<fs::path>> cells;  // coverage negated: the whole first
    std::map<std::string, pcl::KdTreeFLANN<Point>> dense;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (!entry.is_directory()) continue;
        const auto [noise, scale, coverage, shape] = words_of(entry.path());
        const std::string row = noise + "_" + scale;
        if (!rows.empty() && std::find(rows.begin(), rows.end(), row) == rows.end()) continue;
        cells[{row, -std::stod(coverage)}].push_back(entry.path());
        if (!dense.count(shape)) dense[shape].setInputCloud(read_ply(folder / (shape + "_dense.ply")));
    }
    std::printf("%-20s %6s %6s %10s %7s\n", "row", "cover", "cases", "sac-ia %", "s");
    for (auto& [cell, places] : cells) {
        const auto& [row, coverage] = cell;
        std::sort(places.begin(), places.end());
        int successes = 0;
        std::vector<double> seconds;
        for (const fs::path& place : places) {
            const Outcome outcome = run({place, row.ends_with("_free")}, dense.at(words_of(place)[3]));
            successes += outcome.success;
            seconds.push_back(outcome.seconds);
        }
        std::printf("%-20s %5.0f%% %6zu %10.1f %7.2f\n", row.c_str(), -100.0 * coverage, places.size(),
                    100.0 * successes / static_cast<double>(places.size()), umbilic::bench::median(seconds));
        std::fflush(stdout);
    }
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        std::fprintf(stderr, "points_peer_pcl DIR [ROW ...]\n");
        return 2;
    }
    try {
        run_all(argv[1], {argv + 2, argv + argc});
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
