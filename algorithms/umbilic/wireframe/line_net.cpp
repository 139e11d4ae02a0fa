// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/wireframe/line_net.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include <umbilic/wireframe/net_builder.h>

namespace umbilic {

namespace {

/// A line without a crossing for longer than this gets a new one: at its end, or in the middle between two.
constexpr double longest_end = 1.313;
constexpr double longest_gap = 1.672;
/// Points between neighbouring crossings.
constexpr int between_points = 3;

}  // namespace

/// No line shall start there again.
void NetBuilder::refuse(const NetSeed& seed) {
    if (seed.line < 0) return;
    lines_[seed.line].refused.push_back(seed.s);
    lines_[seed.line].changed = true;
}

/// Adds the lines of seeds that are equally far from the start. False if none of them can start.
bool NetBuilder::add_lines(const std::vector<NetSeed>& seeds) {
    std::vector<NetLine> lines;
    std::vector<const NetSeed*> origins;
    for (const NetSeed& seed : seeds)
        if (std::optional<NetLine> line = trace(seed)) {
            lines.push_back(std::move(*line));
            origins.push_back(&seed);
        } else {
            refuse(seed);
        }
    grow(lines);
    bool added = false;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (!(lines[i].high - lines[i].low > sample_share * step_)) {
            refuse(*origins[i]);
            continue;
        }
        const int number = static_cast<int>(lines_.size());
        lines_.push_back(std::move(lines[i]));
        find_crossings(number);
        const NetLine& line = lines_.back();
        for (std::size_t k = 0; k < line.samples.size(); ++k)
            grids_[index(line.family)].add(line.samples[k].point, {number, static_cast<int>(k)});
        added = true;
        // A line that does not cross the one it should is of no use there again.
        refuse(*origins[i]);
        // A half-line from an umbilic begins a little beside it.
        if (origins[i]->one_way)
            lines_.back().crossings.emplace(-(line.samples.front().point - net_.nodes.front().point).norm(), 0);
    }
    return added;
}

/// Places on a line where crossing lines are missing.
std::vector<NetSeed> NetBuilder::seeds_of(int number) const {
    const NetLine& line = lines_[number];
    std::vector<NetSeed> seeds;
    const auto add = [&](double s) {
        if (line.closed) s -= line.high * std::floor(s / line.high);
        if (s < line.low || s > line.high) return;
        for (const double refused : line.refused)
            if (std::abs(refused - s) < same_crossing * step_) return;
        const double way = line.closed ? std::min(s, line.high - s) : std::abs(s);
        seeds.push_back(
            {line.distance + way, tracer_.wrapped(line.at(s)), other(line.family), std::nullopt, number, s});
    };
    if (line.crossings.empty()) return seeds;
    const double first = line.crossings.begin()->first, last = line.crossings.rbegin()->first;
    const auto fill = [&](double low, double high) {
        const double gap = high - low;
        if (gap <= longest_gap * step_) return;
        const double part = gap / std::max(2.0, std::round(gap / step_ - 0.137));
        // From the end that is nearer to the seed of the line; from both if they are equally near.
        const double from_low = line.closed ? std::min(low, line.high - low) : std::abs(low);
        const double from_high = line.closed ? std::abs(line.high - high) : std::abs(high);
        if (from_low <= from_high + tie * step_) add(low + part);
        if (from_high <= from_low + tie * step_) add(high - part);
    };
    if (line.closed) {
        fill(last, first + line.high);
    } else {
        if (line.high - last > longest_end * step_) add(last + step_);
        if (first - line.low > longest_end * step_) add(first - step_);
    }
    for (auto at = line.crossings.begin(); std::next(at) != line.crossings.end(); ++at)
        fill(at->first, std::next(at)->first);
    return seeds;
}

LineNet NetBuilder::build(const NetStart& start) {
    std::vector<NetSeed> seeds;
    if (start.spokes.empty()) {
        for (const CurvatureFamily family : {CurvatureFamily::maximum, CurvatureFamily::minimum})
            seeds.push_back({0.0, start.parameters, family, std::nullopt, -1, 0.0});
    } else {
        net_.nodes.push_back(
            {start.parameters, tracer_.face().surface.value(start.parameters.x(), start.parameters.y()), 0.0});
        for (const NetStart::Spoke& spoke : start.spokes)
            seeds.push_back({0.0, spoke.parameters, spoke.family, spoke.direction, -1, 0.0});
    }
    add_lines(seeds);
    while (lines_.size() < options_.most_lines) {
        progress_.check();
        seeds.clear();
        // Those that are nearest to the start, all at once.
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < lines_.size(); ++i) {
            if (lines_[i].changed) lines_[i].seeds = seeds_of(static_cast<int>(i));
            lines_[i].changed = false;
            for (const NetSeed& seed : lines_[i].seeds) nearest = std::min(nearest, seed.distance);
        }
        for (const NetLine& line : lines_)
            std::copy_if(line.seeds.begin(), line.seeds.end(), std::back_inserter(seeds),
                         [&](const NetSeed& seed) { return seed.distance <= nearest + tie * step_; });
        if (seeds.empty()) break;
        add_lines(seeds);
    }
    net_.lines = static_cast<int>(lines_.size());
    for (const NetLine& line : lines_) {
        const auto join = [&](double s, int from, double t, int to) {
            NetEdge edge{from, to, line.family, t - s};
            for (int k = 1; options_.drawn && k <= between_points; ++k) {
                double at = s + (t - s) * k / (between_points + 1);
                if (line.closed && at > line.high) at -= line.high;
                const Vector2 p = tracer_.wrapped(line.at(at));
                edge.between.push_back(tracer_.face().surface.value(p.x(), p.y()));
            }
            net_.edges.push_back(std::move(edge));
        };
        for (auto at = line.crossings.begin(); at != line.crossings.end() && std::next(at) != line.crossings.end();
             ++at)
            join(at->first, at->second, std::next(at)->first, std::next(at)->second);
        if (line.closed && line.crossings.size() > 2)
            join(line.crossings.rbegin()->first, line.crossings.rbegin()->second,
                 line.crossings.begin()->first + line.high, line.crossings.begin()->second);
    }
    return std::move(net_);
}

LineNet line_net(const LineTracer& tracer, const NetStart& start, const LineNetOptions& options,
                 const Progress& progress) {
    return NetBuilder(tracer, options, progress).build(start);
}

}  // namespace umbilic
